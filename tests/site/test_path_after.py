"""The path of a coin that is followed after its toss, in a browser as the package has it."""

import json

import pytest

import cointoss
from cointoss import analytic
from cointoss.compare.web.playable import playable
from tests.helpers.engine_page import written


@pytest.mark.parametrize(("name", "until"), [("fig24a", 3.0), ("table", 3.0), ("fig2", "rest")])
def test_the_path_goes_on_as_in_the_package(loaded, name, until):
    case = cointoss.load(name).replace("ending.until", until)
    toss = analytic.toss(case)
    times = [0.0, toss.end_time, (toss.end_time + toss.path_end) / 2, toss.path_end]
    asked = f"const toss = engine.toss({written(case)}), path = toss.path({times});"
    found = loaded.value(f"(() => {{ {asked} return {{ ...toss, states: [...path.states] }}; }})()")
    assert found["pathEnd"] == toss.path_end > toss.end_time
    assert found["laterTimes"] == toss.later_times.tolist()
    assert found["endTime"] == toss.end_time
    assert len(found["impacts"]) == len(toss.impacts)
    heights = [found["states"][13 * i + 2] for i in range(len(times))]
    assert heights == toss.sample(times).position[:, 2].tolist()


def test_a_page_plays_it_to_its_end(loaded):
    case = cointoss.load("fig24a").replace("ending.until", 3.0)
    told = playable(analytic.toss(case), 400)
    found = json.loads(
        loaded.value(f"workers.toss({written(case)}, 400).then((toss) => JSON.stringify(toss))")
    )
    assert found["end_time"] == pytest.approx(told["end_time"])
    for toss in (told, found):
        assert toss["path"]["time"][-1] == 3
        assert len(toss["times"]) == toss["count"] == len(toss["sequence"])
        assert min(toss["later_times"]) > toss["end_time"]
    assert found["later_times"] == pytest.approx(told["later_times"], rel=1e-6)


def test_a_toss_that_is_not_followed_has_no_later_touches(loaded):
    case = cointoss.load("fig24a")
    found = loaded.value(f"workers.toss({written(case)}, 40)")
    assert "later_times" not in found
    assert "later_times" not in playable(analytic.toss(case), 40)
    assert found["path"]["time"][-1] == found["end_time"]
