"""What musl's functions cost: `python -m tests.benchmarks.libms` prints rates of tosses.

`make bench` runs it. Two processes, one with musl's functions and one with those of the system, toss in turn;
each answers a line that names a kind with the seconds of processor time that it took.
"""

import os
import subprocess
import sys
import time
from subprocess import PIPE
from typing import Any

import numpy as np

from cointoss import analytic
from cointoss.compare.reproduction.setups.general_coins import CLASSES
from cointoss.models.releases import Releases
from tests.helpers.draws import AIR, THIN, scenario

PLANAR, GENERAL, DENSE = 8192, 256, 8
"""Tosses that are timed at once."""
REPEATS, ANSWERS = 9, "answers"
_THICK = {kind.name: kind for kind in CLASSES if kind.thick and kind.imperfect and kind.coulomb}
_VACUUM, _AIR = (_THICK[f"thick, imperfect, {air}, coulomb"] for air in ("vacuum", "air"))


def planar(air):
    """Return a thin coin that spins about one diameter, and its releases."""
    coin = scenario(coin=THIN, air=air, floor={"restitution": 0.6}, release={"position": [0, 0, 0.4]})
    ends = {
        "height": np.linspace(0.2, 0.6, PLANAR),
        "angular_velocity_eta": np.linspace(20, 60, PLANAR)[::-1],
    }
    return coin, Releases.of(coin, PLANAR, **ends)


def kinds():
    """Return what is tossed, by name: a scenario, and releases."""
    dense = _AIR.scenario.replace("air", {**AIR, "exponent": 0.5}, "ending.max_impacts", 2)
    return {
        "planar coin, vacuum": planar({}),
        "planar coin, air": planar(AIR),
        "general coin, vacuum": (_VACUUM.scenario, _VACUUM.releases(GENERAL)),
        "general coin, air": (_AIR.scenario, _AIR.releases(GENERAL)),
        "general coin, air with b = 0.5, two impacts": (dense, _AIR.releases(DENSE)),
    }


def rates():
    """Yield what is tossed, how many in a second by the system's functions and by musl's, and the ratio."""
    own = {name: value for name, value in os.environ.items() if name != "COINTOSS_LIBM"}
    pipes: Any = {"stdin": PIPE, "stdout": PIPE, "text": True}
    command = [sys.executable, "-m", "tests.benchmarks.libms", ANSWERS]
    with (
        subprocess.Popen(command, env=own, **pipes) as system,
        subprocess.Popen(command, env={**own, "COINTOSS_LIBM": "musl"}, **pipes) as musl,
    ):
        for name, (_, releases) in kinds().items():
            times = np.array([[_asked(system, name), _asked(musl, name)] for _ in range(REPEATS + 1)])[1:]
            yield name, *(len(releases) / np.min(times, axis=0)), np.median(times[:, 0] / times[:, 1])
        for process in (system, musl):
            process.communicate()


def _asked(process, name):
    print(name, file=process.stdin, flush=True)
    return float(process.stdout.readline())


def answer():
    """Answer the lines of standard input."""
    from numba import config

    config.__dict__["NUMBA_NUM_THREADS"] = 1
    known = kinds()
    for line in sys.stdin:
        case, releases = known[line.rstrip("\n")]
        begun = time.process_time()
        analytic.toss_many(case, releases)
        print(time.process_time() - begun, flush=True)


if __name__ == "__main__":
    if sys.argv[1:] == [ANSWERS]:
        answer()
    else:
        for name, system, musl, ratio in rates():
            print(
                f"{name}: {system:.4g} tosses/s by the system's functions, {musl:.4g} by musl's: {ratio:.2f}"
            )
