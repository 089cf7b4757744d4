"""The package as it is shipped: a wheel, unpacked elsewhere, tosses a coin beside a foreign `models`."""

import os
import subprocess
import sys
import tomllib
from pathlib import Path
from zipfile import ZipFile

import pytest

TOP = Path(__file__).parents[1]
PACKAGES = ("cointoss", "models", "analytic", "coin_mj", "compare")


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    built = subprocess.run(
        [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)],
        cwd=TOP,
        capture_output=True,
        text=True,
    )
    assert built.returncode == 0, built.stderr
    (path,) = folder.glob("cointoss-*.whl")
    return path


@pytest.fixture(scope="module")
def installed(wheel, tmp_path_factory):
    folder = tmp_path_factory.mktemp("installed")
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--no-compile"]
    subprocess.run([*pip, "--target", str(folder), str(wheel)], check=True, stdin=subprocess.DEVNULL)
    return folder


@pytest.fixture
def foreign(tmp_path):
    """A folder with another project's packages of the same names, as a working folder may have."""
    for package in PACKAGES:
        (tmp_path / package).mkdir()
        (tmp_path / package / "__init__.py").write_text("raise RuntimeError('foreign')\n")
    return tmp_path


# A row of an array shows its fields as attributes to Python only where the type is a record.
INTERPRETED = """
import importlib.util, numpy, models.records
found = {importlib.util.find_spec(name).origin for name in PACKAGES}
assert found == {f"FOLDER/{name}/__init__.py" for name in PACKAGES}, found
models.records.IMPACT_ROW = numpy.dtype((numpy.record, models.records.IMPACT_ROW))
import runpy; runpy.run_path("FOLDER/bin/cointoss", run_name="__main__")
""".replace("PACKAGES", repr(PACKAGES))


def run(installed, folder, *words, interpreted=False):
    """Run the command that pip made, and see that the packages are those installed."""
    script = INTERPRETED.replace("FOLDER", str(installed))
    command = ["-c", script] if interpreted else [str(installed / "bin" / "cointoss")]
    return subprocess.run(
        [sys.executable, "-P", *command, *words],
        cwd=folder,
        env={
            **os.environ,
            "PYTHONPATH": str(installed),
            "PYTHONDONTWRITEBYTECODE": "1",
            **({"NUMBA_DISABLE_JIT": "1"} if interpreted else {}),
        },
        capture_output=True,
        text=True,
    )


def test_a_wheel_has_every_file_of_the_packages_and_no_other(wheel):
    expected = {
        path.relative_to(TOP).as_posix()
        for package in PACKAGES
        for path in (TOP / package).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    files = {name for name in ZipFile(wheel).namelist() if ".dist-info/" not in name}
    assert files == expected
    assert {"models/coin.xml", "models/scenarios/fig24a.toml", "compare/report/report.html.j2"} <= files


@pytest.mark.parametrize(
    "interpreted",
    # To compile what is installed anew takes minutes.
    [True, pytest.param(False, marks=pytest.mark.slow)],
)
def test_the_installed_command_tosses_a_coin_beside_foreign_packages(installed, foreign, interpreted):
    done = run(installed, foreign, "toss", "fig24a", "--max-impacts", "1", interpreted=interpreted)
    assert (done.returncode, done.stderr) == (0, "")
    assert "sequence  H" in done.stdout


def test_the_installed_command_knows_its_version(installed, foreign):
    project = tomllib.loads((TOP / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    done = run(installed, foreign, "--version")
    assert done.stdout.split() == ["cointoss,", "version", project["version"]]
