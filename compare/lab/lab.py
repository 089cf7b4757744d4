"""The lab as one file: a page with the engine in it, which needs no server and no network."""

from base64 import b64encode
from importlib import resources
from typing import Any

from cointoss.compare.web.playable import shown_outcomes
from cointoss.compare.web.scripts import ENGINE_POLICY, one_file, shared_files
from cointoss.compare.web.wasm.carried import engine_bytes, wrapper
from cointoss.compare.web.wasm.interface import numbers_of
from cointoss.models.fields import UNITS, split
from cointoss.models.records import UnusableEngineError
from cointoss.models.scenario import Scenario

MOST_BYTES = 2_000_000
"""Of the file."""
WORDED = ("floor.contact", "floor.restitution_kind", "ending.test")
"""Fields that are a word."""


def lab_page(scenario: Scenario) -> str:
    """Return the page, which begins with a scenario.

    Raises:
        UnusableEngineError: where the engine for a browser was not built.
        UnsupportedError: for what the engine in a page does not toss.
    """
    content = engine_bytes()
    if content is None:
        raise UnusableEngineError("engine.wasm: not built, or of other sources; make docs builds it")
    numbers_of(scenario)
    page = resources.files("cointoss.compare.lab") / "page"
    own = {entry.name: entry.read_bytes() for entry in page.iterdir()}
    data = {
        "wasm": b64encode(content).decode("ascii"),
        "scenario": flat(scenario),
        "outcomes": shown_outcomes(),
    }
    return one_file({**shared_files(), **own, "engine.js": wrapper()}, data, ENGINE_POLICY)


def flat(scenario: Scenario) -> dict[str, Any]:
    """Return a scenario as an object of its fields, components by name, those without a value left out."""
    tables, found = scenario.as_tables(), {}
    for field in (*UNITS, *WORDED):
        table, key, index = split(field)
        value = (tables[table] if table else tables).get(key)
        if value is not None:
            found[field] = value if index is None else value[index]
    return found
