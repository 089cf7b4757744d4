"""The rates of tosses that `make bench` prints."""

import time
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest

from cointoss.models.scenario import Scenario

RATES: dict[str, np.ndarray] = {}
"""Tosses in a second, and in a second of processor time, by whom."""


def _numbers_for_heyoka(case: Scenario) -> Any:
    """Return what heyoka's integrators take of a scenario; skip the test where there is no heyoka."""
    pytest.importorskip("heyoka", reason="heyoka has wheels for Linux on x86-64 only")
    from tests.helpers.extended import Extended

    return Extended(case)


numbers_for_heyoka: Any = cache(_numbers_for_heyoka)
"""Makes them of a scenario once, as what times a toss must not time them."""


def report(
    capsys: Any, benchmark: Any, name: str, tosses: int, toss: Callable[[], Any], *, heyoka: str = ""
) -> None:
    """Print the rate of the best round where it was timed, and that by processor time.

    Args:
        capsys: pytest's.
        benchmark: of the tosses.
        name: who makes them.
        tosses: how many.
        toss: makes them.
        heyoka: name of heyoka's rate, reported before; the ratios to it are printed too.
    """
    if not benchmark.stats:
        return
    start = time.process_time()
    toss()
    RATES[name] = tosses / np.array([benchmark.stats.stats.min, time.process_time() - start])
    rates = [f"{rate:.0f}" for rate in RATES[name]]
    if heyoka in RATES:
        ratios = RATES[name] / RATES[heyoka]
        rates = [f"{rate} ({ratio:.3g} times heyoka's)" for rate, ratio in zip(rates, ratios, strict=True)]
    with capsys.disabled():
        print(f"\n{name}: {rates[0]} tosses/s, {rates[1]} in a second of processor time", end="")
