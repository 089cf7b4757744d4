"""The other houses import names that cointoss, its engines and its facade make public, and no others."""

import ast
from importlib import import_module
from pathlib import Path

HOUSES = [Path(__file__).parents[1] / name / f"cointoss_{name}" for name in ("reproduction", "yardstick")]
DOORS = ("cointoss", "cointoss.analytic", "cointoss.coin_mj", "cointoss.study")


def asked(source: str) -> set[tuple[str, str]]:
    """Return the names that a source takes from cointoss, each with the module that offers it."""
    tree = ast.parse(source)
    imports = [node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module]
    names = {(node.module or "", each.name) for node in imports for each in node.names}
    engines = {each for module, each in names if f"{module}.{each}" in DOORS}
    used = {
        (f"cointoss.{node.value.id}", node.attr)
        for node in ast.walk(tree)
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id in engines
    }
    return {(module, name) for module, name in names | used if module.partition(".")[0] == "cointoss"}


def test_what_is_not_public_is_seen():
    source = "from cointoss import analytic\nfrom cointoss.models.rows import row_of\nanalytic.toss.run()\n"
    assert asked(source) == {
        ("cointoss", "analytic"),
        ("cointoss.models.rows", "row_of"),
        ("cointoss.analytic", "toss"),
    }


def test_a_house_asks_for_public_names_alone():
    sources = [path for house in HOUSES for path in house.rglob("*.py")]
    assert len(sources) > 60
    found = {name for path in sources for name in asked(path.read_text(encoding="utf-8"))}
    public = {(door, name) for door in DOORS for name in import_module(door).__all__}
    assert found - public == set()


def test_the_facade_offers_what_the_houses_ask_for_and_no_more():
    sources = [path for house in HOUSES for path in house.parent.rglob("*.py")]
    found = {name for path in sources for name in asked(path.read_text(encoding="utf-8"))}
    offered = {("cointoss.study", name) for name in import_module("cointoss.study").__all__}
    assert offered - found == set()
