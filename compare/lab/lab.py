"""The lab as one file: a page with the engine in it, which needs no server and no network."""

from cointoss.compare.web.playable import shown_outcomes
from cointoss.compare.web.scripts import ENGINE_POLICY, files_of, one_file
from cointoss.compare.web.wasm.carried import engine_data, engine_scripts
from cointoss.models.records import UnusableEngineError
from cointoss.models.scenario import Scenario

MOST_BYTES = 2_000_000
"""The largest size of the file."""


def lab_page(scenario: Scenario) -> str:
    """Return the page, which begins with a scenario.

    Raises:
        UnusableEngineError: where the engine for a browser was not built.
    """
    data = engine_data(scenario)
    if data is None:
        raise UnusableEngineError("engine.wasm: not built, or of other sources; make docs builds it")
    files = {**files_of("cointoss.compare.lab"), **engine_scripts()}
    return one_file(files, {**data, "outcomes": shown_outcomes()}, ENGINE_POLICY)
