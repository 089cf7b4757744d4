"""About when the other rim of a coin in contact lands: where the parabola of n_z passes zero."""

import numpy as np
import pytest

from cointoss.analytic.contact.automaton import Event, Mode
from cointoss.analytic.contact.integrator import contact_work
from cointoss.analytic.contact.landing import time_to_landing
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.contact.upright import tilt
from cointoss.analytic.numerics.tolerances import CONTACT_STEP_ERROR
from cointoss.models.attitude import quaternion_from_angles, rotation_matrix
from tests.helpers.contacts import SMOOTH, follow_for, held, put_on_floor, step_contact, upright_coin
from tests.helpers.draws import scenario

LEAN = 0.01


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize(
    ("rate", "acceleration"),
    [
        (0.3, 0.0),
        (0.3, 40.0),
        (0.3, -2.0),
        (-0.3, 20.0),
        (-0.3, -2.0),
        (-0.3, -5.0),
        (0.0, -1.0),
        (0.3, -10.0),
    ],
)
def test_the_other_rim_lands_where_the_parabola_of_the_lean_ends_if_it_does(side, rate, acceleration):
    """A coin that turns about the horizontal ξ alone: n_z is the cosine of its tilt θ.

    Args:
        side: 1 for heads up.
        rate: of θ towards the edge and past it [rad/s].
        acceleration: likewise [rad/s²].
    """
    tilt = np.pi / 2 - side * LEAN
    y = np.array([0, 0, 0.01, 0, 0, 0, *quaternion_from_angles((0.0, tilt, 0.0)), side * rate, 0, 0])
    dy = np.zeros(13)
    dy[10] = side * acceleration
    c, s = np.sin(LEAN), np.cos(LEAN)
    parabola = [(-c * rate**2 - s * acceleration) / 2, -s * rate, c]
    roots = [root.real for root in np.roots(np.trim_zeros(parabola, "f")) if root.imag == 0 and root.real > 0]
    contact = held(scenario().body, FloorFriction(0.0), Mode.SLIDING, y)
    assert time_to_landing(contact, y, dy) == pytest.approx(min(roots, default=np.inf), rel=1e-12)


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("longest", np.linspace(2e-3, 8e-3, 7))
def test_a_rim_that_lands_and_would_rise_again_within_a_step_lands(side, longest):
    """A coin that its spin turns off its edge at 3e-3 rad/s lands at that rate when all is reversed."""
    body, sliding = scenario().body, Mode.SLIDING
    y = upright_coin(body, 0.3, 12.0, 20.0 * side)
    up = rotation_matrix(tuple(y[6:10]))[2]
    y[10:12] += 3e-3 * side * np.array([-up[1], up[0]])
    tilt(y, -1e-12 * side)
    put_on_floor(body, SMOOTH, sliding, y)
    states, times = follow_for(body, SMOOTH, sliding, y, 0.03)
    back = states[-1] * [1, 1, 1, -1, -1, -1, 1, 1, 1, 1, -1, -1, -1]
    contact, elapsed, event = held(body, SMOOTH, sliding, back), 0.0, Event.NONE
    stages = contact_work(contact, back)
    while event == Event.NONE and elapsed < 0.04:
        step = step_contact(contact, back, longest, CONTACT_STEP_ERROR, stages)
        elapsed, event = elapsed + step.elapsed, step.event
    assert event == Event.SECOND_RIM_LANDS
    assert elapsed == pytest.approx(times[-1], abs=CONTACT_STEP_ERROR / 3e-3)
