"""How long a process takes to start, and to toss by kept code: the processor time of nine processes."""

import resource
import subprocess
import sys

import pytest

from tests.helpers.command_line import HERE

COMMANDS = {
    "Python": ("-c", "pass"),
    "import cointoss": ("-c", "import cointoss"),
    "import numpy": ("-c", "import numpy"),
    "import numba": ("-c", "import numba"),
    "cointoss --version": ("-m", "cointoss", "--version"),
    "cointoss --help": ("-m", "cointoss", "--help"),
    "cointoss toss fig24a, kept": ("-m", "cointoss", "toss", "fig24a"),
}


@pytest.fixture(scope="module")
def environment(tmp_path_factory):
    """Python keeps its own code, as it does for those who install the package."""
    made = {name: value for name, value in HERE.items() if name != "PYTHONDONTWRITEBYTECODE"}
    return {**made, "PYTHONPYCACHEPREFIX": str(tmp_path_factory.mktemp("code"))}


def processor_time(words, environment):
    """Return the processor time of a process, user and system [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, *words], env=environment, stdout=subprocess.DEVNULL, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


@pytest.mark.parametrize("name", COMMANDS)
def test_a_process_starts(name, environment, benchmark):
    processor_time(COMMANDS[name], environment)  # what is done once is done
    times = [processor_time(COMMANDS[name], environment) for _ in range(9)]
    benchmark.extra_info["times"] = times
    benchmark.pedantic(lambda: times)
