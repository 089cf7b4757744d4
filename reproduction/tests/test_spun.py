"""The study of spun coins: what it counts, and a coin that rocks over its other rim."""

import numpy as np
import pytest

from cointoss import Scenario, analytic
from cointoss.study import Body
from cointoss_reproduction.setups.general_coins import cent
from cointoss_reproduction.studies.spun.study import balance, spun


@pytest.mark.parametrize(
    ("scatter", "engine", "spins"), [(1.0, "analytic", 2), (10.0, "analytic", 4), (1.0, "mujoco", 1)]
)
def test_a_small_run_spins_every_coin(scatter, engine, spins):
    found = spun(0.4e-3, scatter, 1e-4, 0.3, 120.0, engine, parts=500, by_mujoco=1)
    assert found is not None
    assert found["tosses"] == spins


def goes_over(body: Body, a: float, other: float, spin: float, lean: float) -> bool:
    """Return whether a coin on a smooth floor that is driven back rocks over its other rim.

    Its energy at upright, with L_z and L_ζ kept, is held against that of the top behind it, for small leans
    and J_ξ Ω² < m g r.

    Args:
        body: the coin.
        a: from C to the lowest point of the rim on which it leans, along the normal [m].
        other: that of the other rim [m].
        spin: Ω [rad/s].
        lean: at rest but for Ω [rad].
    """
    weight, own = body.mass * body.gravity, body.inertia[2][2] * spin**2 * lean
    back = weight * body.radius - body.inertia[0][0] * spin**2
    at_upright = weight * a * lean - own * lean - back * lean**2 / 2
    return at_upright > (weight * other + own) ** 2 / (2 * back)


@pytest.mark.parametrize("part", [0.05, 0.1, 0.15, 0.9, 0.95])
@pytest.mark.parametrize("spin", [30.0, 60.0])
def test_a_coin_that_is_driven_back_goes_over_where_its_energy_says_so(spin, part):
    """Without air and resistance; beside the bound at 30 rad/s, and at 60 rad/s nowhere."""
    a, other = 3e-4, 1e-4
    told = cent(a + other, contact="smooth", rolling_friction=0.0, pivoting_friction=0.0) | {"air": {}}
    body = Scenario.model_validate(told).body
    lean = part * balance(body, np.array([a]), spin)[0]
    release = {
        "position": (0, 0, body.radius * np.cos(lean) + a * np.sin(lean) + 1e-8),
        "angles": (0, np.pi / 2 - lean, 0),
        "angular_velocity": (0, spin * np.cos(lean), spin * np.sin(lean)),
    }
    tossed = analytic.toss(Scenario.model_validate(told | {"release": release, "ending": {"max_time": 0.5}}))
    e = tossed.path.sample(np.linspace(0, 0.4, 200)).quaternion
    leans_out = (e[:, 0] ** 2 - e[:, 1] ** 2 - e[:, 2] ** 2 + e[:, 3] ** 2).min() < -0.5
    assert leans_out == goes_over(body, a, other, spin, lean)
    assert leans_out == (spin == 30 and 0.1 < part < 0.95)
