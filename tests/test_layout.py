"""Rules of the sources that neither import-linter nor ruff sees; a process that is left warns by itself."""

import ast
import re
from collections import Counter
from pathlib import Path

import pytest

TESTS = Path(__file__).parent
SOURCES = sorted({*TESTS.rglob("*.py")} - {Path(__file__)})
LOWER = [path for name in ("models", "analytic", "coin_mj") for path in (TESTS.parent / name).rglob("*.py")]
RULES = {
    "no test imports a test": (r"^ *(from|import) .*\btest_", SOURCES, "from tests.compare import test_cli"),
    "a busy machine meets no limit by the clock": (r"timeout=\d", SOURCES, "process.wait(timeout=9)"),
    "neither the models nor an engine imports a module of the package by its name": (
        r"\b(import_module|__import__)\([^)]*[\"']cointoss\b",
        LOWER,
        "importlib.import_module(name=f'cointoss.{name}')",
    ),
}


@pytest.mark.parametrize(("broken", "held", "example"), RULES.values(), ids=RULES)
def test_a_rule_is_kept(broken, held, example):
    pattern = re.compile(broken, re.MULTILINE)
    assert pattern.search(example)
    assert [path for path in held if pattern.search(path.read_text(encoding="utf-8"))] == []


def test_each_class_of_the_product_has_a_name_of_its_own():
    paths = [*LOWER, *(TESTS.parent / "compare").rglob("*.py")]
    nodes = [node for path in paths for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))]
    counts = Counter(node.name for node in nodes if isinstance(node, ast.ClassDef))
    assert [name for name, count in counts.items() if count > 1] == []
