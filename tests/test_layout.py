"""Where tests keep what they share: in tests/helpers, and no test imports a test."""

import ast
from pathlib import Path

import pytest

TESTS = Path(__file__).parent
SOURCES = sorted(TESTS.rglob("*.py"))
SHARED = (TESTS / "helpers", TESTS / "benchmarks")


def imported(source: str) -> set[str]:
    """Return the dotted names a module imports, those of `from a import b` as a.b."""
    names: set[str] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            names |= {f"{'.' * node.level}{node.module or ''}.{alias.name}" for alias in node.names}
    return names


def among_tests(names: set[str]) -> set[str]:
    """Return the names of test modules, or of something in them."""
    return {name for name in names if any(part.startswith("test_") for part in name.split("."))}


@pytest.mark.parametrize(
    "line",
    [
        "import tests.compare.test_cli",
        "from tests.compare.test_cli import cointoss",
        "from tests.compare import test_cli",
        "from . import test_cli",
        "def later():\n    from .test_cli import cointoss",
    ],
)
def test_an_import_of_a_test_is_seen(line):
    assert len(among_tests(imported(line))) == 1


def test_no_test_imports_a_test():
    assert len(SOURCES) > 50
    assert [path for path in SOURCES if among_tests(imported(path.read_text(encoding="utf-8")))] == []


def test_what_is_shared_lies_in_helpers():
    elsewhere = [path for path in SOURCES if not any(path.is_relative_to(folder) for folder in SHARED)]
    assert len(elsewhere) > 50
    assert [
        path
        for path in elsewhere
        if not path.match("test_*.py") and path.name not in ("__init__.py", "conftest.py")
    ] == []
