"""The toss of a pixel is that of its map, and goes on until its coin lies."""

from cointoss import read_map
from cointoss.compare.engines import Engine
from cointoss.compare.explorer.tosses import toss_pixel
from tests.helpers.explored import FIELDS


def test_a_toss_is_played_on_after_its_proof(map_path):
    made = read_map(map_path)
    x, y = made[FIELDS[0]].values[11], made[FIELDS[1]].values[6]
    longer = made.cointoss.scenario.replace("ending.max_impacts", 1000).to_toml()
    found = toss_pixel(made.assign_attrs(scenario=longer), x, y, Engine.ANALYTIC)
    assert found["path"]["time"][-1] > found["end_time"] + 0.05
    assert min(found["later_times"]) >= found["end_time"] - 1e-6
    assert len(found["times"]) == found["count"]
    cut = toss_pixel(made, x, y, Engine.ANALYTIC)
    assert cut["later_times"] == []
    assert abs(cut["path"]["time"][-1] - cut["end_time"]) < 1e-6
