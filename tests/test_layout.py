"""Tests share what is in tests/helpers, leave no process behind, and have no limit for a busy machine."""

import ast
from pathlib import Path

import pytest

from tests.helpers.processes import HANGS

TESTS = Path(__file__).parent
SOURCES = sorted(TESTS.rglob("*.py"))
PACKAGES = [
    path
    for name in ("models", "analytic", "coin_mj", "compare")
    for path in (TESTS.parent / name).rglob("*.py")
]
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


def unwaited(source: str) -> list[int]:
    """Return the lines that start a process which neither `subprocess.run` nor a `with` statement ends."""
    tree = ast.parse(source)
    ended = {
        id(item.context_expr) for node in ast.walk(tree) if isinstance(node, ast.With) for item in node.items
    }
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call) and id(node) not in ended]
    starting = {"Popen", "Process", "Pool", "ProcessPoolExecutor", "fork", "system", "popen"}
    return [call.lineno for call in calls if ast.unparse(call.func).rpartition(".")[2] in starting]


@pytest.mark.parametrize(
    "line", ["a = subprocess.Popen(b)", "return Popen(b)", "os.fork()", "with x(Pool()): pass"]
)
def test_a_process_left_behind_is_seen(line):
    assert unwaited(line) == [1]


def test_every_process_is_waited_for():
    assert [path for path in [*PACKAGES, *SOURCES] if unwaited(path.read_text(encoding="utf-8"))] == []


def hasty(source: str) -> list[int]:
    """Return the lines that limit something by a number of seconds of their own."""
    calls = [node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Call)]
    limits = [one.value for call in calls for one in call.keywords if one.arg == "timeout"]
    waits = [call.args[0] for call in calls if ast.unparse(call.func).endswith("process.wait") and call.args]
    return [one.lineno for one in (*limits, *waits) if isinstance(one, ast.Constant)]


@pytest.mark.parametrize(
    "line", ["process.communicate(timeout=60)", "process.wait(60)", "connect(timeout=9)"]
)
def test_a_limit_by_the_clock_is_seen(line):
    assert hasty(line) == [1]


def test_a_busy_machine_meets_no_limit(pytestconfig):
    assert [path for path in SOURCES if hasty(path.read_text(encoding="utf-8"))] == []
    assert float(pytestconfig.getini("faulthandler_timeout")) >= 3 * HANGS
