"""The toss of a pixel is that of its map, and goes on until its coin lies."""

from dataclasses import replace

from cointoss.compare.engines import Engine
from cointoss.compare.explorer.tosses import toss_pixel
from cointoss.compare.sweep.reading import tossed_map_at


def test_a_toss_is_played_on_after_its_proof(map_path):
    sweep = tossed_map_at(map_path).sweep
    longer = replace(sweep, scenario=sweep.scenario.replace("ending.max_impacts", 1000))
    found = toss_pixel(longer, sweep.x.values[11], sweep.y.values[6], Engine.ANALYTIC)
    assert found["path"]["time"][-1] > found["end_time"] + 0.05
    assert min(found["later_times"]) >= found["end_time"] - 1e-6
    assert len(found["times"]) == found["count"]
    cut = toss_pixel(sweep, sweep.x.values[11], sweep.y.values[6], Engine.ANALYTIC)
    assert cut["later_times"] == []
    assert abs(cut["path"]["time"][-1] - cut["end_time"]) < 1e-6
