"""`import cointoss` and `python -m cointoss`: the public names, brought when first used, and the command."""

import ast
import inspect
import pydoc
import re
import shutil
import sys
import tomllib
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


def described():
    """Return the home of each name that a type checker is told of."""
    body = ast.parse((TOP / "cointoss" / "__init__.py").read_text(encoding="utf-8")).body
    told = next(node for node in body if isinstance(node, ast.If))
    return {
        alias.asname or "": node.module or ""
        for node in told.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }


def test_each_name_is_that_of_its_home_and_a_type_checker_knows_it():
    homes = described()
    assert sorted([*({*homes} - {*PACKAGES}), *PACKAGES, "__version__"]) == dir(cointoss)
    for name, home in homes.items():
        if name not in PACKAGES:
            assert getattr(cointoss, name) is getattr(import_module(home), name)
    assert [getattr(cointoss, name) for name in PACKAGES] == [
        sys.modules[f"cointoss.{name}"] for name in PACKAGES
    ]
    assert cointoss.__version__ == version(DISTRIBUTION)


def test_a_star_brings_the_public_names():
    script = (
        "from cointoss import *\nimport cointoss\nprint(*(n for n in dir(cointoss) if n not in globals()))"
    )
    done = python("-c", script)
    assert (done.stdout, done.stderr) == ("__version__\n", "")


def test_a_bare_name_in_a_checkout_gives_the_same_objects():
    script = (
        "import sys, analytic, models.records, cointoss\n"
        "from compare.sweep.axes import parse_axis\nimport coin_mj.model.settings as settings\n"
        "from cointoss import coin_mj\n"
        "assert analytic is cointoss.analytic and models.records is sys.modules['cointoss.models.records']\n"
        "assert models.records.Toss is cointoss.Toss and settings.MujocoSettings is coin_mj.MujocoSettings\n"
        "assert parse_axis.__module__ == 'cointoss.compare.sweep.axes'\n"
        "assert models.records.__spec__.name == models.records.__name__ == 'cointoss.models.records'\n"
        "bare = ('models', 'analytic', 'coin_mj', 'compare')\n"
        "assert not [m for m in sys.modules.values() if m.__name__.partition('.')[0] in bare]\n"
    )
    done = python("-c", script, folder=TOP)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize(
    ("name", "line"),
    [
        ("analytic", "'analytic' is a package and cannot be directly executed"),
        ("analytic.tosses", "No module named analytic.tosses"),
        ("compare.cli", "compare.cli: accepted: python -m cointoss.compare.cli"),
    ],
)
def test_a_bare_name_that_is_run_is_answered_in_one_line(name, line):
    done = python("-m", name, folder=TOP)
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.count("\n") == 1
    assert done.stderr.endswith(f"{line}\n")


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
    if beside:
        assert (done.returncode, done.stdout) == (0, "0.0125 cointoss.models.scenario\n")
    else:
        last = done.stderr.splitlines()[-1]
        assert last.startswith(
            f"ImportError: {tmp_path / 'cointoss'}: without its folders models, analytic, "
        )


def test_each_public_name_says_what_it_is():
    public = [getattr(cointoss, name) for name in dir(cointoss) if name != "__version__"]
    assert len(public) > 25
    assert [item for item in public if len((item.__doc__ or "").split()) < 3] == []


def test_an_unknown_name_is_answered_with_the_names_there_are():
    script = "import cointoss; cointoss.Coins"
    done = python("-c", script)
    accepted, meant = r"accepted: Air, .* Coin, .*, toss_many\.", r"Did you mean: 'Coin'\?"
    said = rf"AttributeError: cointoss has no Coins; {accepted} {meant}"
    assert re.fullmatch(said, done.stderr.splitlines()[-1])


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
    package, described = getattr(cointoss, engine), cointoss.load("fig24a")
    for toss, given in ((package.toss, described), (package.toss_rows, rows_of(described, 1))):
        with pytest.raises(TypeError, match=f"^settings: of type .*, accepted: {engine}.{name}, such as"):
            toss(given, settings=wrong)


def test_the_package_compare_is_described_as_the_function_once_it_is_asked():
    assert inspect.signature(cointoss.compare) == inspect.signature(compare)
    described = pydoc.plain(pydoc.render_doc(cointoss.compare))
    assert "Both engines asked the same question" in described
    assert f"compare{inspect.signature(compare)}\n" in described
    assert "mujoco: MuJoCo's settings" in described
    script = "import sys, cointoss.compare; assert 'numpy' not in sys.modules"
    assert python("-c", script).returncode == 0


def test_import_cointoss_imports_next_to_nothing():
    script = "import sys; before = set(sys.modules); import cointoss; print(*set(sys.modules) - before)"
    imported = set(python("-c", script).stdout.split())
    assert {name.partition(".")[0] for name in imported} - sys.stdlib_module_names == {"cointoss"}
    assert "importlib.metadata" not in imported


def test_the_package_runs_the_command(tmp_path):
    for module in ("cointoss", "cointoss.compare.cli"):
        done = python("-m", module, "--version", folder=tmp_path)
        assert (done.returncode, done.stdout) == (0, f"cointoss, version {version(DISTRIBUTION)}\n")


@pytest.mark.parametrize("home", ["cointoss", "cointoss.analytic"])
def test_a_toss_has_its_views_whichever_module_made_it_and_only_a_plot_brings_matplotlib(home):
    script = (
        f"import sys; from {home} import toss; made = toss('fig24a'); print('matplotlib' in sys.modules)\n"
        "print(len(made.plot().get_lines()) > 1, 'matplotlib' in sys.modules, made.play().title)"
    )
    done = python("-c", script, MPLBACKEND="agg")
    before, after = done.stdout.splitlines()
    assert before == "False"
    assert after.startswith("True True toss of 2 g")


@pytest.mark.parametrize("name", ["analytic", "Scenario"])
def test_a_public_name_brings_what_shows_progress(name):
    script = (
        f"import sys, cointoss; cointoss.{name}; print('cointoss.compare.output.progress' in sys.modules)"
    )
    done = python("-c", script)
    assert (done.stdout, done.stderr) == ("True\n", "")


def test_beside_foreign_packages_of_such_names_it_works(tmp_path):
    for name in PACKAGES:
        (tmp_path / f"{name}.py").write_text("raise RuntimeError('foreign')\n")
    done = python("-m", "cointoss", "--version", folder=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")


def test_the_version_is_that_of_pyproject_wherever_it_is_written():
    written = tomllib.loads((TOP / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
    assert version(DISTRIBUTION) == written
    headings = re.findall(
        r"^## (\S+?),? ", (TOP / "docs/CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE
    )
    assert headings[0] == written
