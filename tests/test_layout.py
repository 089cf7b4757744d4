"""The folders of the product and of its tests keep to their rules, as their sources show."""

import ast
from collections import Counter
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import NamedTuple

import pytest

from tests.helpers.processes import HANGS

TESTS = Path(__file__).parent
SOURCES = sorted(TESTS.rglob("*.py"))
PRODUCT = {name: sorted((TESTS.parent / name).rglob("*.py")) for name in ("models", "analytic", "coin_mj")}
LOWER = [path for paths in PRODUCT.values() for path in paths]
PACKAGES = [*LOWER, *(TESTS.parent / "compare").rglob("*.py")]
SHARED = (TESTS / "helpers", TESTS / "benchmarks")


def calls_in(tree: ast.AST) -> list[ast.Call]:
    """Return all calls of a module."""
    return [node for node in ast.walk(tree) if isinstance(node, ast.Call)]


def imports_of_tests(tree: ast.AST) -> list[str]:
    """Return the imports of test modules, or of something in them."""
    names: list[str] = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Import | ast.ImportFrom):
            home = f"{node.module}." if isinstance(node, ast.ImportFrom) and node.module else ""
            names += [home + alias.name for alias in node.names]
    return [name for name in names if any(part.startswith("test_") for part in name.split("."))]


def unwaited(tree: ast.AST) -> list[int]:
    """Return the lines that start a process which neither `subprocess.run` nor a `with` statement ends."""
    ended = [
        item.context_expr for node in ast.walk(tree) if isinstance(node, ast.With) for item in node.items
    ]
    starting = {"Popen", "Process", "Pool", "ProcessPoolExecutor", "fork", "system", "popen"}
    return [
        call.lineno
        for call in calls_in(tree)
        if call not in ended and ast.unparse(call.func).rpartition(".")[2] in starting
    ]


def hasty(tree: ast.AST) -> list[int]:
    """Return the lines that limit something by a number of seconds of their own."""
    calls = calls_in(tree)
    limits = [one.value for call in calls for one in call.keywords if one.arg == "timeout"]
    waits = [call.args[0] for call in calls if ast.unparse(call.func).endswith("process.wait") and call.args]
    return [one.lineno for one in (*limits, *waits) if isinstance(one, ast.Constant)]


def reaches_by_name(tree: ast.AST) -> list[int]:
    """Return the lines that import a module of the package by its name, past import-linter."""
    return [
        call.lineno
        for call in calls_in(tree)
        if ast.unparse(call.func).endswith(("import_module", "__import__"))
        and any(
            isinstance(part, ast.Constant) and str(part.value).partition(".")[0] == "cointoss"
            for part in ast.walk(call)
        )
    ]


class Rule(NamedTuple):
    """What no module may do."""

    breaches: Callable[[ast.AST], Iterable[object]]
    held: list[Path]
    """The modules that keep it."""
    broken_by: list[str]
    """Sources, each of which breaks it once."""


RULES = {
    "no test imports a test": Rule(
        imports_of_tests,
        SOURCES,
        [
            "import tests.compare.test_cli",
            "from tests.compare.test_cli import cointoss",
            "from tests.compare import test_cli",
            "from . import test_cli",
            "def later():\n    from .test_cli import cointoss",
        ],
    ),
    "every process is waited for": Rule(
        unwaited,
        [*PACKAGES, *SOURCES, *(TESTS.parent / "yardstick").rglob("*.py")],
        ["a = subprocess.Popen(b)", "return Popen(b)", "os.fork()", "with x(Pool()): pass"],
    ),
    "a busy machine meets no limit by the clock": Rule(
        hasty, SOURCES, ["process.communicate(timeout=60)", "process.wait(60)", "connect(timeout=9)"]
    ),
    "neither the models nor an engine imports a module of the package by its name": Rule(
        reaches_by_name,
        LOWER,
        [
            "import_module('cointoss.compare.output.plots')",
            "importlib.import_module(name='cointoss.compare')",
            "a = __import__('cointoss.compare')",
            "import_module(f'cointoss.{name}').explore()",
            "import_module('cointoss.' + name)",
        ],
    ),
}


@pytest.mark.slow_after_first
@pytest.mark.parametrize("rule", RULES.values(), ids=RULES)
def test_a_rule_is_kept_and_what_breaks_it_is_seen(rule):
    assert len(rule.held) > 50
    assert [len([*rule.breaches(ast.parse(line))]) for line in rule.broken_by] == [1] * len(rule.broken_by)
    trees = {path: ast.parse(path.read_text(encoding="utf-8")) for path in rule.held}
    assert [path for path, tree in trees.items() if rule.breaches(tree)] == []


def test_what_hangs_is_told_long_after_no_wait_is_left(pytestconfig):
    assert float(pytestconfig.getini("faulthandler_timeout")) >= 3 * HANGS


def test_what_is_shared_lies_in_helpers():
    elsewhere = [path for path in SOURCES if not any(path.is_relative_to(folder) for folder in SHARED)]
    named = [path for path in elsewhere if path.name not in ("__init__.py", "conftest.py")]
    assert len(named) > 50
    assert [path for path in named if not path.match("test_*.py")] == []


def test_each_class_of_the_product_has_a_name_of_its_own():
    nodes = [node for path in PACKAGES for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))]
    counts = Counter(node.name for node in nodes if isinstance(node, ast.ClassDef))
    assert [name for name, count in counts.items() if count > 1] == []
