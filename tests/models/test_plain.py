"""Plain mode: compiled by what numba makes public, to the same bits; and nothing compiled at all."""

import json

import pytest

from cointoss.models.kernel.fork import TESTED
from cointoss.models.kernel.libm import FILE
from cointoss.models.kernel.vectors import solve
from tests.helpers.command_line import python

SOLVED = """
import sys
{first}
from cointoss.models.kernel.vectors import solve
print(*(x.hex() for x in solve({matrix}, {vector})))
assert "cointoss.models.kernel.fork.function" not in sys.modules
"""
MATRIX, VECTOR = ((2.0, 0.1, 1.0), (0.3, 3.0, 0.0), (0.5, 0.0, 4.0)), (1.0, 2.0, 3.0)


def run(cache, *words, **environment):
    """Run Python with a cache of its own."""
    done = python(*words, NUMBA_CACHE_DIR=str(cache), **environment)
    assert done.returncode == 0, done.stderr
    return done


@pytest.mark.parametrize(
    ("first", "asked", "why"),
    [
        ("", "plain", "as COINTOSS_COMPILER=plain asks; it takes longer"),
        (
            "import numba; numba.__version__ = '0.99.1'",
            "",
            f"with numba 0.99.1; it takes longer than with numba {' or '.join(TESTED)}",
        ),
    ],
)
def test_plain_mode_gives_the_same_bits_and_says_once_why(tmp_path, first, asked, why):
    script = SOLVED.format(first=first, matrix=MATRIX, vector=VECTOR)
    done = run(tmp_path, "-c", script, COINTOSS_COMPILER=asked)
    assert done.stdout.split() == [x.hex() for x in solve(MATRIX, VECTOR)]
    assert done.stderr == f"cointoss: compiling in plain mode, {why}\n"
    again = run(tmp_path, "-c", script, COINTOSS_COMPILER=asked)
    assert (again.stdout, again.stderr) == (done.stdout, ""), "read from disk"


@pytest.mark.parametrize(
    ("words", "status", "begins"),
    [
        (("-m", "cointoss", "toss", "fig24a"), 2, "cointoss: "),
        (("-c", "import cointoss; cointoss.Scenario"), 1, "ImportError: "),
    ],
)
def test_another_compiler_is_refused_in_one_line(words, status, begins):
    done = python(*words, COINTOSS_COMPILER="nonsense")
    *above, line = done.stderr.splitlines()
    assert (done.returncode, done.stdout) == (status, "")
    assert line == f"{begins}COINTOSS_COMPILER = 'nonsense': accepted: plain, or unset"
    assert not (above and status == 2)


@pytest.mark.parametrize(
    ("environment", "refusal"),
    [
        ({"COINTOSS_LIBM": "glibc"}, "'glibc': accepted: musl, or unset"),
        (
            {"COINTOSS_LIBM": "musl", "COINTOSS_COMPILER": "plain"},
            f"'musl': needs numba {' or '.join(TESTED)}, COINTOSS_COMPILER unset, and no Windows",
        ),
        (
            {"COINTOSS_LIBM": "musl", "NUMBA_DISABLE_JIT": "1"},
            "'musl': unset NUMBA_DISABLE_JIT: nothing is compiled",
        ),
    ],
)
def test_other_functions_of_the_system_are_refused_in_one_line(environment, refusal):
    done = python("-m", "cointoss", "toss", "fig24a", **environment)
    assert (done.returncode, done.stdout) == (2, "")
    (line,) = done.stderr.splitlines()
    missing = f"'musl': {FILE} is missing; make libm builds it"
    is_built = FILE.is_file() or "glibc" in environment.values()
    assert line == f"cointoss: COINTOSS_LIBM = {refusal if is_built else missing}"


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["analytic", "mujoco"])
def test_a_toss_in_plain_mode_is_the_same_to_the_bit(tmp_path, engine):
    words = ("-m", "cointoss", "toss", "fig24a", "--engine", engine, "--json")
    plain, tested = run(tmp_path, *words, COINTOSS_COMPILER="plain"), run(tmp_path, *words)
    assert json.loads(plain.stdout) == json.loads(tested.stdout)


def test_without_a_compiler_mujoco_is_refused_in_one_line():
    words = ("-m", "cointoss", "toss", "fig24a", "--engine", "mujoco")
    done = python(*words, NUMBA_DISABLE_JIT="1")
    (line,) = [line for line in done.stderr.splitlines() if "getting ready" not in line]  # on a busy machine
    assert (done.returncode, done.stdout) == (2, "")
    assert "NUMBA_DISABLE_JIT" in line
