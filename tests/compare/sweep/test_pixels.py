"""Each pixel is the toss of its own scenario, to the bit; what is no scenario is refused before."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from cointoss import analytic, coin_mj
from cointoss.coin_mj import Friction, MujocoSettings, Realisation
from cointoss.compare.engines import Engine
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.grid import numbers_in
from cointoss.compare.sweep.pixels import check, pixel_scenario
from cointoss.compare.sweep.run import toss_part
from cointoss.models.records import UnsupportedError
from cointoss.models.unused import UnusedFieldWarning
from tests.helpers.basin_runs import TUMBLING, sweep_of
from tests.helpers.draws import scenario

pytestmark = pytest.mark.usefixtures("without_horizon")

WHOLE = (slice(0, 3), slice(0, 4))


def toss_pixels(sweep, part=WHOLE):
    """Toss a part of a map, and return its layers over the part."""
    numbers = numbers_in(part, sweep.shape)
    found = toss_part(sweep, numbers.ravel())
    return SimpleNamespace(**{name: array.reshape(numbers.shape) for name, array in found.items()})


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
    sweep = sweep_of(x, y, case, after=after)
    pixels = toss_pixels(sweep)
    assert pixels.outcome.shape == (3, 4)
    assert case is TUMBLING or pixels.impacts.max() > 1000
    for i, at_y in enumerate(sweep.y.values):
        for j, at_x in enumerate(sweep.x.values):
            given = [
                (axis.field, int(at) if axis.field == "ending.max_impacts" else at)
                for axis, at in ((sweep.x, at_x), (sweep.y, at_y))
            ]
            toss = analytic.toss(sweep.scenario.replace(*given[0], *given[1]))
            if after is None or len(toss.impacts) <= after:
                due = toss.outcome, len(toss.impacts)
            else:
                due = toss.impacts.face[after], after + 1
            assert (pixels.outcome[i, j], pixels.impacts[i, j]) == due


def test_a_part_of_a_map_is_that_part_of_the_whole():
    sweep = sweep_of("floor.restitution=0.2:0.6:4", "release.position.z=0.2:0.6:3", TUMBLING)
    whole, part = toss_pixels(sweep), toss_pixels(sweep, (slice(1, 3), slice(2, 4)))
    assert np.array_equal(part.outcome, whole.outcome[1:3, 2:4])
    assert np.array_equal(part.impacts, whole.impacts[1:3, 2:4])


def test_euler_parameters_off_norm_are_refused_inside_an_axis():
    case = scenario(release={"quaternion": [1.0, 0, 0, 0]})
    check(sweep_of("release.quaternion.e1=-0.01:0.01:9", "release.position.x=0:1:3", case))
    with pytest.raises(SweepError, match="norm 1 within 1e-3"):
        check(sweep_of("release.quaternion.e1=0:0.1:9", "release.position.x=0:1:3", case))


def test_what_mujoco_cannot_toss_is_refused_at_either_end_of_an_axis():
    axes = ("floor.rolling_friction=0:1e-4:4", "floor.restitution=0.5:0:3")
    check(sweep_of(*axes, TUMBLING, engine=Engine.MUJOCO))
    native = replace(coin_mj.MANY, friction=Friction.NATIVE)
    with pytest.raises(UnsupportedError, match=r"floor\.rolling_friction = 0\.0001"):
        check(sweep_of(*axes, TUMBLING, engine=Engine.MUJOCO, settings=native))


def test_a_field_that_a_map_varies_is_one_that_is_used():
    rough = scenario(floor={"contact": "coulomb"})
    # Warnings are errors.
    check(sweep_of("floor.friction=0:0.5:3", "release.position.z=0.3:0.4:3", rough))
    check(sweep_of("floor.friction=-0.0:0.5:2", "floor.restitution=0.5:0:2", rough))
    z = "release.position.z=0.3:0.4:3"
    for case, x, y in ((TUMBLING, "floor.friction=0.5:0:3", z), (rough, "gravity=9:10:2", z)):
        with pytest.warns(UnusedFieldWarning, match=r"^floor\.friction = "):
            check(sweep_of(x, y, case))


@pytest.mark.parametrize("contact", ["spring", "one_step"])
def test_a_pixel_by_mujoco_is_the_toss_with_the_settings_that_its_map_records(contact):
    axes = ("release.angular_velocity.eta=20:40:2", "release.position.z=0.2:0.3:2")
    chosen = replace(coin_mj.MANY, contact=Realisation(contact))
    sweep = sweep_of(*axes, TUMBLING, engine=Engine.MUJOCO, settings=chosen)
    made = toss_pixels(sweep, (slice(0, 2), slice(0, 2)))
    recorded: dict[str, Any] = sweep.settings.as_dict()
    assert recorded["contact"] == contact
    for row, y in enumerate(sweep.y.values):
        for column, x in enumerate(sweep.x.values):
            one = coin_mj.toss(pixel_scenario(sweep, y, x), settings=MujocoSettings(**recorded))
            assert made.outcome[row, column] == one.outcome
            assert made.impacts[row, column] == len(one.impacts) > 0
