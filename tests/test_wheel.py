"""The package as it is shipped: one name, which tosses a coin beside a foreign `models`."""

import os
import re
import shutil
import stat
import subprocess
import sys
import tarfile
import tomllib
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from zipfile import ZipFile

import pytest

from cointoss.compare.web.wasm import carried
from cointoss.models.kernel.build import wheel as hooks
from cointoss.models.kernel.build.wheel import BROWSER, MODULES, Engines
from cointoss.models.kernel.building import library_file
from cointoss.models.kernel.manifest import SYSTEM
from tests.helpers.command_line import python

TOP = Path(__file__).parents[1]
FOLDERS = ("models", "analytic", "coin_mj", "compare")


def build(target, source, folder, **environment):
    """Build an sdist or a wheel from a folder of sources into another folder, and return its path."""
    built = python("-m", "hatchling", "build", "-t", target, "-d", folder, folder=source, **environment)
    assert built.returncode == 0, built.stderr
    (path,) = folder.glob("cointoss_dynamics-*")
    return path


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """A wheel made as pip makes one of an archive of the sources, without links, or the one to release."""
    if "COINTOSS_WHEEL" in os.environ:
        return TOP / os.environ["COINTOSS_WHEEL"]
    archive = build("sdist", TOP, tmp_path_factory.mktemp("archive"))
    sources = tmp_path_factory.mktemp("sources")
    # Python 3.11.4 is the first that knows what to leave out.
    safely: Any = {"filter": "data"} if hasattr(tarfile, "data_filter") else {}
    shutil.unpack_archive(archive, sources, **safely)
    engines = tmp_path_factory.mktemp("engines")
    for module in MODULES:  # as `make wheels` has them ready
        file = library_file(module)
        named = engines / f"{module.split('.')[-2]}-{SYSTEM}.so"
        shutil.copy(file, named)
        shutil.copy(f"{file}.json", f"{named}.json")
    (engines / "engine.wasm").write_text(f'cointoss{{"sources": "{carried.sources()}"}}')
    unpacked = sources / archive.name.removesuffix(".tar.gz")
    return build("wheel", unpacked, tmp_path_factory.mktemp("wheel"), COINTOSS_ENGINES=str(engines))


@pytest.fixture(scope="module")
def installed(wheel, tmp_path_factory):
    folder = tmp_path_factory.mktemp("installed")
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--no-compile"]
    subprocess.run([*pip, "--target", str(folder), str(wheel)], check=True, stdin=subprocess.DEVNULL)
    return folder


@pytest.fixture
def foreign(tmp_path):
    """A folder with another project's packages of such names, as a working folder may have."""
    for package in FOLDERS:
        (tmp_path / package).mkdir()
        (tmp_path / package / "__init__.py").write_text("raise RuntimeError('foreign')\n")
    return tmp_path


ABOUT: Any = SimpleNamespace(version="1")
HOOK = Engines(str(TOP), {}, ABOUT, ABOUT, "", "wheel")


@pytest.mark.parametrize(
    ("name", "value", "says"),
    [
        ("sys", SimpleNamespace(version_info=(3, 10)), r"needs Python >= 3\.11; this is 3\."),
        ("SYSTEM", "plan9-mips", "has no engine for plan9-mips; accepted: linux-x86_64, "),
        ("platform", SimpleNamespace(libc_ver=lambda: ("", "")), "needs glibc: MuJoCo and numba have no "),
    ],
)
def test_where_it_cannot_be_installed_the_hook_says_so_before_anything_is(monkeypatch, name, value, says):
    assert HOOK.dependencies() == []
    monkeypatch.setattr(hooks, name, value)
    with pytest.raises(SystemExit, match=f"^cointoss-dynamics {says}.*$"):
        HOOK.dependencies()


def test_what_builds_an_engine_finds_what_the_hook_finds(monkeypatch, tmp_path):
    ran = []
    monkeypatch.setattr(
        hooks, "_run", lambda words, paths, _: ran.append([words[0], *paths.split(os.pathsep)])
    )
    monkeypatch.setattr(sys, "path", ["", "/of/an/installer"])
    HOOK._made = tmp_path
    assert HOOK._built(SYSTEM) == tmp_path / "engines"
    builds = ["cointoss.models.kernel.build"] * 3 + ["cointoss.compare.web.wasm.build"]
    assert ran == [[module, str(tmp_path), "/of/an/installer"] for module in builds]


def test_an_engine_that_cannot_be_built_is_told_with_the_reason(tmp_path):
    (tmp_path / "failing.py").write_text("import sys; sys.exit('first\\nziglang is missing')")
    with pytest.raises(
        SystemExit, match=r"^cointoss-dynamics: an engine could not be built: ziglang is missing$"
    ):
        hooks._run(["failing"], str(tmp_path), "an engine")


@pytest.mark.slow
def test_a_wheel_has_every_file_under_one_name_and_no_other(wheel):
    folders = [TOP / "cointoss", *(TOP / "cointoss" / folder for folder in FOLDERS)]
    expected = {
        path.relative_to(TOP).as_posix()
        for folder in folders
        for path in folder.rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    files = {name for name in ZipFile(wheel).namelist() if ".dist-info/" not in name}
    engines = {
        f"{module.split('.')[-2]}-{hooks.SYSTEM}.so{end}" for module in MODULES for end in ("", ".json")
    }
    engines = {f"cointoss/models/kernel/engines/{name}" for name in engines}
    assert files == expected | engines | {f"cointoss/{BROWSER}"}
    kinds = {entry.external_attr >> 28 for entry in ZipFile(wheel).infolist()}
    assert kinds <= {0, stat.S_IFREG >> 12}, "Windows makes no links"
    assert {f"cointoss/{name}" for name in ("models/coin.xml", "compare/report/report.html.j2")} <= files


SEQUENCE = "(?s).*sequence  H.*"
TOSS = ("toss", "fig24a", "--max-impacts", "1", "--engine")
WITHOUT_COMPILERS = (
    "import sys\n"
    "sys.modules |= dict.fromkeys(['numba', 'llvmlite', 'flint', 'ziglang'])\n"
    "from cointoss import analytic, coin_mj\n"
    "print(analytic.toss('fig24a').outcome, coin_mj.toss('fig24a').outcome)"
)
ELSEWHERE = (
    "from cointoss.models.kernel import building\n"
    "building.SYSTEM = 'plan9-mips'\n"
    "from cointoss.__main__ import main\n"
    "import sys; sys.argv[1:] = ['toss', 'fig24a']; main()"
)
VERSION = tomllib.loads((TOP / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
SAYS_VERSION = f"cointoss, version {re.escape(VERSION)}\n"


@pytest.mark.parametrize(
    ("words", "status", "printed", "said"),
    [
        pytest.param(("bin/cointoss", *TOSS, "analytic"), 0, SEQUENCE, "", id="toss"),
        pytest.param(
            ("bin/cointoss", *TOSS, "mujoco"),
            0,
            SEQUENCE,
            "",
            id="mujoco",
            marks=pytest.mark.slow,
        ),
        (("bin/cointoss", "lab", "--out", "lab.html"), 0, r"lab\.html\n", ""),
        (("bin/cointoss", "--version"), 0, SAYS_VERSION, ""),
        (("-m", "cointoss", "--version"), 0, SAYS_VERSION, ""),
        (("-m", "cointoss.compare.cli", "--version"), 0, SAYS_VERSION, ""),
        (("-c", "import cointoss; print(cointoss.__file__)"), 0, "{installed}/cointoss/__init__.py\n", ""),
        pytest.param(("-c", WITHOUT_COMPILERS), 0, "heads heads\n", "", id="without compilers"),
        pytest.param(
            ("-c", ELSEWHERE),
            2,
            "",
            f".*no models engine for plan9-mips; there is: {SYSTEM}\n",
            id="elsewhere",
        ),
    ],
)
def test_what_is_installed_runs_beside_foreign_packages(installed, foreign, words, status, printed, said):
    first, *others = words
    program = str(installed / first) if "/" in first else first
    # The foreign folder comes first.
    where = {"PYTHONPATH": f"{foreign}{os.pathsep}{installed}", "COINTOSS_CACHE": str(foreign / "cache")}
    done = python("-P", program, *others, folder=foreign, **where)
    assert done.returncode == status
    assert re.fullmatch(printed.replace("{installed}", str(installed)), done.stdout)
    assert re.fullmatch(said, done.stderr)
    assert not (foreign / "cache").exists(), "nothing is built or kept at a user's"
