"""The floor's force on a rim point: it pushes, and lies in the friction cone."""

import pytest

from cointoss.analytic.contact.floor_force import friction_holds, holding_force, slip_direction

IDENTITY = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@pytest.mark.parametrize("mu", [0.0, 0.5])
def test_the_floor_holds_no_point_that_free_flight_lifts_or_leaves_at_rest(mu):
    """The force that would hold it pulls, or is none: within every cone, also that of a smooth floor."""
    for rise in (0.0, 2.0):
        F = holding_force(IDENTITY, (0.0, 0.0, rise))
        assert F == (0.0, 0.0, -rise)
        assert not friction_holds(mu, F)
    assert friction_holds(mu, holding_force(IDENTITY, (0.0, 0.0, -2.0)))


def test_a_force_on_the_cone_holds_and_one_outside_does_not():
    assert friction_holds(0.5, (0.3, -0.4, 1.0))
    assert not friction_holds(0.5, (0.3, -0.4, 0.999))
    assert not friction_holds(0.5, (0.3, -0.4, -2.0))


def test_what_does_not_slip_has_no_direction_nor_has_slip_on_a_smooth_floor():
    assert slip_direction((0.0, 0.0, 1.0), 0.3) == (0.0, 0.0)
    assert slip_direction((3.0, 4.0, 1.0), 0.0) == (0.0, 0.0)
