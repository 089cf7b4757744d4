"""The lab as one file: a page with the engine in it, which needs no network."""

import gzip
from base64 import b64encode

from cointoss.compare.web.playable import shown_outcomes
from cointoss.compare.web.scripts import ENGINE_POLICY, files_of, one_file
from cointoss.compare.web.wasm.carried import engine_bytes, engine_scripts
from cointoss.models.notebook import Frame
from cointoss.models.reading import ScenarioSource, scenario_of
from cointoss.models.rows import fields_of
from cointoss.models.scenario import Scenario
from cointoss.models.title import title_of_toss

MOST_BYTES = 2_000_000
"""The largest size of the file."""
SERVED_POLICY = f"{ENGINE_POLICY}; connect-src 'self'"
"""The Content-Security-Policy of the page where it is served."""


def lab(scenario: ScenarioSource) -> Frame:
    """Return what a notebook shows as the lab: a toss that plays, a map, and sliders that change both.

        cointoss.lab("table")

    Args:
        scenario: with which it begins; or a file's path, or a name such as "fig24a".

    Returns:
        A frame, whose `page` is the HTML of a page that needs no other file and no network.

    Raises:
        ScenarioError: for a scenario, a file or a name that can't be used.
        UnusableEngineError: where the engine for a browser was not built.
    """
    described = scenario_of(scenario)
    return Frame(f"lab with {title_of_toss(described, '')}", lab_page(described))


def lab_page(
    scenario: Scenario,
    *,
    is_tour: bool = False,
    is_served: bool = False,
    saved: object = False,
    tosses: object = None,
) -> str:
    """Return the page, which begins with a scenario.

    Args:
        scenario: the first one.
        is_tour: whether the page begins with its tour instead.
        is_served: whether it asks the server that it comes from for its map; else it needs none.
        saved: a map of that scenario as `saved_map` returns it, or whether the server has one.
        tosses: some of its pixels, tossed by MuJoCo.

    Raises:
        UnusableEngineError: where the engine for a browser was not built.
    """
    files = {**files_of("cointoss.compare.lab"), **engine_scripts()}
    told = {
        "wasm": b64encode(gzip.compress(engine_bytes(), mtime=0)).decode("ascii"),
        "scenario": fields_of(scenario),
        "outcomes": shown_outcomes(),
        "tour": is_tour,
        "served": is_served,
        "saved": saved,
        "tosses": tosses,
    }
    return one_file(files, told, SERVED_POLICY if is_served else ENGINE_POLICY)
