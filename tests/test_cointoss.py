"""`import cointoss` and `python -m cointoss`: the public names, brought when first used, and the command."""

import ast
import inspect
import pydoc
import re
import shutil
import sys
from importlib import import_module
from importlib.metadata import version
from pathlib import Path

import pytest

import cointoss
from cointoss.compare.report.comparison import compare
from cointoss.models.batch import rows_of
from cointoss.models.distribution import DISTRIBUTION
from tests.helpers.command_line import python

TOP = Path(__file__).parents[1]
PACKAGES = ("models", "analytic", "coin_mj", "compare")


def test_each_name_is_that_of_its_home_says_what_it_is_and_a_type_checker_knows_it():
    body = ast.parse((TOP / "cointoss" / "__init__.py").read_text(encoding="utf-8")).body
    told = next(node for node in body if isinstance(node, ast.If)).body
    imported = [node for node in told if isinstance(node, ast.ImportFrom)]
    homes = {alias.asname or "": node.module or "" for node in imported for alias in node.names}
    assert sorted([*({*homes} - {*PACKAGES}), *PACKAGES, "__version__"]) == dir(cointoss)
    public = {name: getattr(cointoss, name) for name in dir(cointoss) if name != "__version__"}
    brought = {name: getattr(import_module(home), name) for name, home in homes.items() if name in public}
    assert public == brought | {name: sys.modules[f"cointoss.{name}"] for name in PACKAGES}
    assert [name for name, item in public.items() if len((item.__doc__ or "").split()) < 3] == []
    assert len(public) > 25
    assert cointoss.__version__ == version(DISTRIBUTION)


BARE = """
import sys, analytic, models.records, cointoss
from compare.sweep.axes import parse_axis
import coin_mj.model.settings as settings
from cointoss import coin_mj
assert analytic is cointoss.analytic and models.records is sys.modules['cointoss.models.records']
assert models.records.Toss is cointoss.Toss and settings.MujocoSettings is coin_mj.MujocoSettings
assert parse_axis.__module__ == 'cointoss.compare.sweep.axes'
assert models.records.__spec__.name == models.records.__name__ == 'cointoss.models.records'
bare = ('models', 'analytic', 'coin_mj', 'compare')
print([m for m in sys.modules.values() if m.__name__.partition('.')[0] in bare])
"""
NEXT_TO_NOTHING = """
import sys; before = set(sys.modules); import cointoss; new = set(sys.modules) - before
print({name.partition('.')[0] for name in new} - sys.stdlib_module_names, 'importlib.metadata' in new)
import cointoss.compare; print('numpy' in sys.modules)
"""
PLOT = """
import sys; from cointoss.analytic import toss; made = toss('fig24a'); print('matplotlib' in sys.modules)
print(len(made.plot().get_lines()) > 1, 'matplotlib' in sys.modules, made.play().title)
"""
STAR = "from cointoss import *\nimport cointoss\nprint(*(n for n in dir(cointoss) if n not in globals()))"
ALIEN = "cannot be directly executed"
PROCESSES = [
    pytest.param(
        ("-c", NEXT_TO_NOTHING), r"\{'cointoss'\} False\nFalse\n", "", id="next to nothing is imported"
    ),
    pytest.param(("-c", BARE), r"\[\]\n", "", id="a bare name in a checkout gives the same objects"),
    pytest.param(("-m", "analytic"), "", f".*'analytic' is a package and {ALIEN}\n", id="no package is run"),
    pytest.param(
        ("-m", "analytic.tosses"), "", ".*No module named analytic.tosses\n", id="nor what is not there"
    ),
    pytest.param(
        ("-m", "compare.cli"), "", ".*: accepted: python -m cointoss.compare.cli\n", id="nor a bare name"
    ),
    pytest.param(("-c", STAR), "__version__\n", "", id="a star brings the names", marks=pytest.mark.slow),
    pytest.param(
        ("-c", PLOT),
        "False\nTrue True toss of 2 g.*\n",
        "",
        id="only a plot brings matplotlib",
        marks=pytest.mark.slow,
    ),
]


@pytest.mark.parametrize(("words", "printed", "said"), PROCESSES)
def test_a_process_prints(words, printed, said):
    done = python(*words, folder=TOP, MPLBACKEND="agg")
    assert re.fullmatch(printed, done.stdout)
    assert re.fullmatch(said, done.stderr)


SAID = {
    "Coins": (AttributeError, r"cointoss has no Coins; did you mean Coin\?$"),
    "qqq": (AttributeError, "cointoss has no qqq; accepted: Air, .* Coin, .*, toss_many$"),
    "Card": (ImportError, "cointoss.Card is cointoss_yardstick.Card now; accepted: pip "),
    "conform": (ImportError, "cointoss.conform is cointoss_yardstick.conform now; "),
    "solref": (ImportError, "cointoss.solref is cointoss_bounce.solref now; "),
    "coin_mj.bounce": (ImportError, "cointoss.coin_mj.bounce is cointoss_bounce.bounce now; accepted: pip "),
    "testing.Card": (ImportError, "cointoss.testing is cointoss_yardstick.testing now; "),
}


@pytest.mark.parametrize("name", SAID)
def test_what_is_no_name_is_answered_in_a_line(name):
    error, says = SAID[name]
    *parts, last = name.split(".")
    with pytest.raises(error, match=f"^{says}"):
        getattr(import_module(".".join(["cointoss", *parts])), last)


@pytest.mark.parametrize("beside", [True, False])
def test_without_links_the_folders_are_found_beside_or_one_line_says_what_to_do(tmp_path, beside):
    """As where an archive was unpacked, or git makes a file of a link."""
    shutil.copytree(TOP / "cointoss", tmp_path / "cointoss", symlinks=True)
    for name in PACKAGES:
        (tmp_path / "cointoss" / name).unlink()
        (tmp_path / "cointoss" / name).write_text(f"../{name}")
        if beside:
            shutil.copytree(TOP / name, tmp_path / name, ignore=shutil.ignore_patterns("__pycache__"))
    script = "import cointoss; print(cointoss.load('fig24a').coin.radius, cointoss.Scenario.__module__)"
    done = python("-c", script, folder=tmp_path, PYTHONPATH=str(tmp_path))
    needed = f"ImportError: {tmp_path / 'cointoss'}: without its folders models, analytic, "
    assert (done.stdout == "0.0125 cointoss.models.scenario\n") == beside
    assert done.stderr.splitlines()[-1:] == [] if beside else done.stderr.splitlines()[-1].startswith(needed)


def test_either_engine_tosses_by_its_name():
    few = cointoss.load("fig24a").replace("ending.max_impacts", 1)
    assert [cointoss.toss(few).engine, cointoss.toss(few, "mujoco").engine] == ["analytic", "mujoco"]
    finer = cointoss.toss(few, engine="mujoco", settings=cointoss.coin_mj.MujocoSettings(stiffness=1e13))
    assert ("contact stiffness", 1e13) in [(one.name, one.value) for one in finer.certificate]
    with pytest.raises(ValueError, match=r"^engine: 'paper', accepted: analytic, mujoco$"):
        cointoss.toss(few, "paper")


@pytest.mark.parametrize(
    ("engine", "name"), [("analytic", "AnalyticSettings"), ("coin_mj", "MujocoSettings")]
)
@pytest.mark.parametrize("wrong", [3, None, {"steps": 2}], ids=str)
def test_settings_of_another_type_are_refused(engine, name, wrong):
    package, given = getattr(cointoss, engine), cointoss.load("fig24a")
    for toss, tossed in ((package.toss, given), (package.toss_rows, rows_of(given, 1))):
        with pytest.raises(TypeError, match=f"^settings: of type .*, accepted: {engine}.{name}, such as"):
            toss(tossed, settings=wrong)


def test_the_package_compare_is_described_as_the_function_once_it_is_asked():
    told = pydoc.plain(pydoc.render_doc(cointoss.compare))
    assert inspect.signature(cointoss.compare) == inspect.signature(compare)
    words = "Both engines asked the same question", "settings: of our engines"
    assert all(said in told for said in (f"compare{inspect.signature(compare)}\n", *words))
