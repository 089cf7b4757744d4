"""Each pixel is the toss of its own scenario, to the bit; what is no scenario is refused before."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from cointoss import analytic, coin_mj
from cointoss.coin_mj import Friction, MujocoSettings, Realisation
from cointoss.compare.engines import Engine
from cointoss.compare.sweep.pieces import check_map, toss_part
from cointoss.models.records import UnsupportedError
from cointoss.models.unused import UnusedFieldWarning
from tests.helpers.basin_runs import TUMBLING, map_asked
from tests.helpers.draws import scenario

pytestmark = pytest.mark.usefixtures("without_horizon")

AXES = [
    ("release.angular_velocity.eta=20:60:4", "release.position.z=0.2:0.6:3"),
    ("release.angles.theta=0.1:3:4", "release.angles.psi=-1:1:3"),
    ("floor.restitution=0.2:0.6:4", "release.velocity.x=0:1:3"),
    ("release.velocity.z=0:1:4", "coin.thickness=0:3 mm:3"),
    ("coin.mass=1 g:5 g:4", "air.normal=0:0.8:3"),
]


LONG = scenario(floor={"restitution": 0.9}, release={"angular_velocity": [3.0, 40.0, 5.0]})
"""Long tosses multiply a difference in the last digit: their numbers of impacts would tell."""


@pytest.mark.parametrize(
    ("case", "x", "y", "after"),
    [
        *((TUMBLING, x, y, after) for x, y in AXES for after in (None, 0, 2)),
        (TUMBLING, "gravity=1:20:4", "ending.max_impacts=1:9:3", None),
        (LONG, "release.angles.theta=0.1:3:4", "release.angles.phi=-1:1:3", None),
    ],
)
def test_each_pixel_is_its_own_toss_to_the_bit(case, x, y, after):
    batch, how = map_asked(x, y, case, after=after)
    pixels = toss_part(batch, how, np.arange(12))
    assert case is TUMBLING or pixels["impacts"].max() > 1000
    for number, found in enumerate(zip(pixels["outcome"], pixels["impacts"], strict=True)):
        toss = analytic.toss(batch.scenario_at(number))
        if after is None or len(toss.impacts) <= after:
            assert found == (toss.outcome, len(toss.impacts))
        else:
            assert found == (toss.impacts.face[after], after + 1)
    part = toss_part(batch, how, np.array([6, 7, 10, 11]))
    assert all(np.array_equal(pixels[name][[6, 7, 10, 11]], part[name], equal_nan=True) for name in part)


def test_what_mujoco_cannot_toss_is_refused_at_either_end_of_an_axis():
    axes = ("floor.rolling_friction=0:1e-4:4", "floor.restitution=0.5:0:3")
    check_map(*map_asked(*axes, TUMBLING, engine=Engine.MUJOCO))
    native = replace(coin_mj.MANY, friction=Friction.NATIVE)
    with pytest.raises(UnsupportedError, match=r"floor\.rolling_friction = 0\.0001"):
        check_map(*map_asked(*axes, TUMBLING, engine=Engine.MUJOCO, settings=native))


def test_a_field_that_a_map_varies_is_one_that_is_used():
    rough = scenario(floor={"contact": "coulomb"})
    # Warnings are errors.
    check_map(*map_asked("floor.friction=0:0.5:3", "release.position.z=0.3:0.4:3", rough))
    check_map(*map_asked("floor.friction=-0.0:0.5:2", "floor.restitution=0.5:0:2", rough))
    z = "release.position.z=0.3:0.4:3"
    for case, x, y in ((TUMBLING, "floor.friction=0.5:0:3", z), (rough, "gravity=9:10:2", z)):
        with pytest.warns(UnusedFieldWarning, match=r"^floor\.friction = "):
            check_map(*map_asked(x, y, case))


@pytest.mark.parametrize("contact", ["spring", "one_step"])
def test_a_pixel_by_mujoco_is_the_toss_with_the_settings_that_its_map_records(contact):
    axes = ("release.angular_velocity.eta=20:40:2", "release.position.z=0.2:0.3:2")
    chosen = replace(coin_mj.MANY, contact=Realisation(contact))
    batch, how = map_asked(*axes, TUMBLING, engine=Engine.MUJOCO, settings=chosen)
    recorded: dict[str, Any] = how.settings.as_dict()
    assert recorded["contact"] == contact
    made = toss_part(batch, how, np.arange(4))
    for number in range(4):
        one = coin_mj.toss(batch.scenario_at(number), settings=MujocoSettings(**recorded))
        assert (made["outcome"][number], made["impacts"][number]) == (one.outcome, len(one.impacts))
    assert made["impacts"].all()
