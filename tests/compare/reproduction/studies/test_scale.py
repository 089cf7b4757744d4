"""The study of what maps cost: its tables follow from its times, and it runs."""

from cointoss.compare.reproduction.studies import scale
from cointoss.compare.reproduction.studies.scale import MapCosts
from tests.helpers.studies import missed, result_of

COSTS = MapCosts(
    cores=2,
    toss={"thin coin": 2e-4, "thin coin by MuJoCo": 0.2},
    tile={100: 3e-4, 10000: 2e-4},
    parts={"check the grid": 0.5, scale.TOSS: 9.5},
    tosses=100_000,
)


def test_the_tables_follow_from_the_times():
    lines = result_of("scale", COSTS).tables.splitlines()
    assert "| thin coin | 0.2 | 5,000 |" in lines
    assert "| 100 | 0.3 |" in lines
    assert "| toss | 9.5 | 95 |" in lines
    # 1e6 * 2e-4 s / 2; 1e9 * 2e-4 s / 16; 1e12 * 0.2 s / 1024
    assert next(line for line in lines if line.startswith("| thin coin, 2 |")).split(" | ")[1] == "1.7 min"
    assert next(line for line in lines if line.startswith("| thin coin, 16 |")).split(" | ")[2] == "3.5 h"
    assert lines[-1] == "| thin coin by MuJoCo, 1024 | 3.3 min | 2.3 days | 6.2 years |"


def test_a_map_that_does_not_consist_of_tosses_fails_its_claim():
    assert missed("scale", COSTS) == ()
    slow = MapCosts(**{**vars(COSTS), "parts": {"check the grid": 1.2, scale.TOSS: 9.5}})
    assert "a map of 100000 tosses" in missed("scale", slow)[0]


def test_the_study_runs(monkeypatch):
    monkeypatch.setattr(scale, "TILE_SIDES", (50,))
    done = []
    study = scale.compute(lambda *progress: done.append(progress), 9, 2)
    assert done == [(i, 7) for i in range(1, 8)]
    assert study.tosses == 81
    assert all(cost > 0 for cost in [*study.toss.values(), *study.tile.values()])
    assert result_of("scale", study).tables
