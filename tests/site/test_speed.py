"""Tosses by the engine in a browser and natively, on one core each, and a map on workers.

`make bench` prints how many each makes in a second; else a few are made, to see that they are the same.
"""

import time

import numpy as np
import pytest

import cointoss
from cointoss import analytic
from cointoss.models.batch import rows_from_states, rows_of
from tests.helpers.corpus import CLASSES
from tests.helpers.draws import AIR, THIN, scenario
from tests.helpers.engine_page import changes, written
from tests.helpers.many import same_states

FEW = 8
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


@pytest.mark.parametrize("name", KINDS)
def test_tosses(loaded, benchmark, capsys, monkeypatch, name):
    monkeypatch.setenv("COINTOSS_THREADS", "1")
    case, states_of, many = KINDS[name]
    states = states_of(FEW if benchmark.disabled else many)
    script = f"""(() => {{
      const given = {changes(states)}, begun = performance.now();
      const {{ outcome }} = engine.tossEach({written(case)}, given);
      return [performance.now() - begun, [...outcome]];
    }})()"""
    rows = rows_from_states(case, states)
    native = analytic.toss_rows(rows, trust="certain")
    sure = native.outcome_certain == 1
    assert sure.sum() >= FEW / 2
    elapsed, outcome = loaded.value(script)
    assert np.array_equal(np.array(outcome)[sure], native.outcome[sure])
    benchmark(lambda: analytic.toss_rows(rows))
    if not benchmark.stats:
        return
    in_page = min(elapsed, *(loaded.value(script)[0] for _ in range(4))) / 1000
    here = benchmark.stats.stats.min
    with capsys.disabled():
        rates = f"{len(rows) / in_page:.0f} tosses/s in the page, {len(rows) / here:.0f} natively"
        print(f"\n{name}, one core: {rates}: {here / in_page:.2f}", end="")


def test_a_map(loaded, benchmark, capsys):
    """The map of fig24a, the face at the third touch: when it is first seen, and when it is whole."""
    case = cointoss.load("fig24a")
    nx, ny = (40, 30) if benchmark.disabled else (400, 300)
    axes = (
        f"{{ field: 'release.angular_velocity.eta', start: 20, stop: 60, count: {nx} }},"
        f"{{ field: 'release.position.z', start: 0.2, stop: 0.6, count: {ny} }}"
    )
    script = f"""(async () => {{
      const begun = performance.now();
      let first = null, largest = 0, seen = 0;
      await workers.map({written(case)}, {axes}, {{ after: 2 }}, ({{ stride, codes }}) => {{
        largest ||= stride;
        seen += stride === largest ? codes.length * stride ** 2 : 0;
        if (seen >= {nx * ny}) first ??= performance.now() - begun;
      }});
      return [first, performance.now() - begun];
    }})()"""
    first, whole = benchmark(lambda: loaded.value(script))
    assert 0 < first <= whole
    if not benchmark.stats:
        return
    axes = {
        "release.angular_velocity.eta": np.tile(np.linspace(20, 60, nx), ny),
        "release.position.z": np.repeat(np.linspace(0.2, 0.6, ny), nx),
        "ending.max_impacts": 3,
    }
    rows = rows_of(case, nx * ny, axes)
    begun = time.perf_counter()
    analytic.toss_rows(rows)
    here = time.perf_counter() - begun
    with capsys.disabled():
        seen = f"seen after {first / 1000:.2f} s, whole after {whole / 1000:.2f} s"
        print(f"\nmap of fig24a, {nx} x {ny}: {seen}; natively {here:.2f} s", end="")


def test_the_start(loaded, benchmark):
    case = written(cointoss.load("fig24a"))
    script = f"""(async () => {{
      const begun = performance.now(), started = await load(bytes);
      return [performance.now() - begun, started.toss({case}).outcome, performance.now() - begun];
    }})()"""
    compiled, outcome, tossed = benchmark(lambda: loaded.value(script))
    assert outcome == str(analytic.toss("fig24a").outcome)
    assert 0 < compiled < tossed
