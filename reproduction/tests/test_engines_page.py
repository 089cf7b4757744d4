"""docs/ENGINES.md and docs/MUJOCO.md show what the studies have found, as `make pages` writes it."""

import sys
from importlib import import_module
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
sys.path.append(str(DOCS / "extensions"))
engines = import_module("engines")


@pytest.mark.parametrize("name", engines.PAGES)
def test_the_page_includes_what_was_found(name):
    assert (DOCS / "made" / f"{name}.md").read_text(encoding="utf-8") == f"{engines.blocks(DOCS)[name]}\n"
    assert f"```{{include}} made/{name}.md\n```\n" in (DOCS / engines.PAGES[name]).read_text(encoding="utf-8")


def test_the_engines_that_the_page_names_make_the_laws_that_it_says():
    rows = [line.split(" | ") for line in engines.laws(DOCS).splitlines()[2:]]
    made = {cells[0].strip("| "): [cell[:3].strip(": ") for cell in cells[1:]] for cells in rows}
    assert made == {
        "(a) sharp_edge": ["yes", "no", "no", "no", "no"],
        "(b) knurled": ["yes", "no", "no", "no", "no"],
        "(c) perfectly_rough": ["yes", "yes", "yes", "yes", "no"],
        "(d) slip_preserving": ["yes", "no", "no", "yes", "yes"],
        "(e) smooth": ["yes", "yes", "yes", "yes", "yes"],
        "(f) sliding_friction": ["yes", "no", "no", "no", "no"],
        "coulomb": ["yes", "yes", "yes", "no", "no"],
    }
