"""Tosses by the engine in a browser and natively, on one core each, and a map on workers.

`make bench` tells their times; else few are made. That they are the same, tests/compare/web tests.
"""

import numpy as np
import pytest

import cointoss
from cointoss import analytic
from cointoss.models.batch import rows_from_states
from tests.helpers.corpus import CLASSES
from tests.helpers.draws import AIR, THIN, scenario
from tests.helpers.engine_page import changes, written
from tests.helpers.many import same_states

CASE, FEW = cointoss.load("fig24a"), 8
PLANAR = scenario(coin=THIN, air=AIR, floor={"restitution": 0.6}, release={"position": [0, 0, 0.4]})
GENERAL = {kind.name: kind for kind in CLASSES}


def planar(n):
    position, spin = np.zeros((2, n, 3))
    position[:, 2], spin[:, 1] = np.linspace(0.2, 0.6, n), np.linspace(60, 20, n)
    return same_states(n, position=position, angular_velocity=spin)


KINDS = {
    "planar, in air": (PLANAR, planar, 8192),
    **{
        name: (GENERAL[name].scenario, GENERAL[name].starts, 256)
        for name in ("thick, imperfect, air, smooth", "thick, ideal, air, coulomb")
    },
}


@pytest.mark.parametrize("in_page", [True, False], ids=["in the page", "natively"])
@pytest.mark.parametrize("name", KINDS)
def test_tosses(loaded, benchmark, monkeypatch, name, in_page):
    monkeypatch.setenv("COINTOSS_THREADS", "1")
    case, states_of, many = KINDS[name]
    states = states_of(FEW if benchmark.disabled else many)
    rows, benchmark.group = rows_from_states(case, states), f"{len(states)} tosses on one core, {name}"
    loaded.value(f"[window.S, window.given] = [{written(case)}, {changes(states)}], 0")
    benchmark(*((loaded.value, "engine.tossEach(S, given), 0") if in_page else (analytic.toss_rows, rows)))


def test_a_map(loaded, benchmark, capsys):
    """The map of fig24a, the face at the third touch: when it is first seen, and when it is whole."""
    nx, ny = (40, 30) if benchmark.disabled else (400, 300)
    axes = (
        f"{{ field: 'release.angular_velocity.eta', start: 20, stop: 60, count: {nx} }},"
        f"{{ field: 'release.position.z', start: 0.2, stop: 0.6, count: {ny} }}"
    )
    script = f"""(async () => {{
      const begun = performance.now();
      let first = null, largest = 0, seen = 0;
      await workers.map({written(CASE)}, {axes}, {{ after: 2 }}, ({{ stride, codes }}) => {{
        largest ||= stride;
        seen += stride === largest ? codes.length * stride ** 2 : 0;
        if (seen >= {nx * ny}) first ??= performance.now() - begun;
      }});
      return [first, performance.now() - begun];
    }})()"""
    first, whole = benchmark(lambda: loaded.value(script))
    assert 0 < first <= whole
    with capsys.disabled():
        print(f"\nmap of fig24a, {nx} x {ny}: seen after {first:.0f} ms, whole after {whole:.0f} ms", end="")
