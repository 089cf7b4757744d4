"""The folders of the product and of its tests keep to their rules, as their sources show."""

import ast
from collections import Counter
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


def reaches_by_name(source: str) -> list[int]:
    """Return the lines that import a module of the package by its name, past import-linter."""
    calls = [node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Call)]
    importing = [one for one in calls if ast.unparse(one.func).endswith(("import_module", "__import__"))]
    return [
        call.lineno
        for call in importing
        if any(
            isinstance(part, ast.Constant) and str(part.value).partition(".")[0] == "cointoss"
            for given in (*call.args, *(one.value for one in call.keywords))
            for part in ast.walk(given)
        )
    ]


@pytest.mark.parametrize(
    "line",
    [
        "import_module('cointoss.compare.output.plots')",
        "importlib.import_module(name='cointoss.compare')",
        "a = __import__('cointoss.compare')",
        "import_module(f'cointoss.{name}').explore()",
        "import_module('cointoss.' + name)",
    ],
)
def test_an_import_by_name_is_seen(line):
    assert reaches_by_name(line) == [1]


def test_neither_the_models_nor_an_engine_imports_a_module_of_the_package_by_its_name():
    lower = [path for path in PACKAGES if path.relative_to(TESTS.parent).parts[0] != "compare"]
    assert len(lower) > 100
    assert [path for path in lower if reaches_by_name(path.read_text(encoding="utf-8"))] == []


def shared_names(sources: list[str]) -> set[str]:
    """Return the names that two or more classes of some modules have."""
    nodes = [node for source in sources for node in ast.walk(ast.parse(source))]
    counts = Counter(node.name for node in nodes if isinstance(node, ast.ClassDef))
    return {name for name, count in counts.items() if count > 1}


def test_a_name_that_two_classes_share_is_seen():
    assert shared_names(["class A: pass\nclass B: pass", "def f():\n    class A: pass"]) == {"A"}


def test_each_class_of_the_product_has_a_name_of_its_own():
    assert shared_names([path.read_text(encoding="utf-8") for path in PACKAGES]) == set()
