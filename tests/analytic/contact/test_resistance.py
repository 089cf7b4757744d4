"""Resistance to rolling and pivoting: of slow motion, and at rest; its power is in test_power.py."""

import numpy as np
import pytest

from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.resistance import FloorFriction, moment_per_force
from cointoss.analytic.contact.rest import rests
from cointoss.analytic.numerics.tolerances import SLOW
from cointoss.models.attitude import quaternion_from_angles
from cointoss.models.contour import Contour
from tests.helpers.contacts import held, put_on_floor, set_upright
from tests.helpers.draws import THIN, ZLOTY, scenario

G, R = 9.81, ZLOTY["radius"]
UNIT = (G / R) ** 0.5


def test_slow_motion_is_resisted_in_proportion_to_it():
    body, friction = scenario().body, FloorFriction(0.0, 2e-4, 3e-4)
    slow = SLOW * UNIT
    fast = moment_per_force(body, friction, (0.0, 0.0, 1.0), (3.0, -4.0, 5.0))
    assert fast == pytest.approx((-1.2e-4, 1.6e-4, -3e-4), rel=1e-14)
    half = moment_per_force(body, friction, (0.0, 0.0, 1.0), (0.0, slow / 2, -slow / 4))
    assert half == pytest.approx((0.0, -1e-4, 0.75e-4), rel=1e-14)
    assert moment_per_force(body, friction, (0.0, 0.0, 1.0), (0.0, 0.0, 0.0)) == (0.0, 0.0, 0.0)


THICK, NICKEL = {**ZLOTY, "thickness": 4e-3}, {"mass": 5e-3, "radius": 10.6e-3, "thickness": 1.95e-3}
DELTA, SLOPE = 1e-3, 0.1
OF_NICKEL, OF_RIM = NICKEL["radius"] * np.tan(np.radians(0.54)), Contour(1e-4)
DEFAULT = {
    "coin": THIN,
    "mode": Mode.STICKING,
    "friction": FloorFriction(0.3, DELTA),
    **{"slope": 0.0, "across": 0.0, "lean": 0.0, "spin": 0.0},
}
ON_LINE = {"coin": THICK, "mode": Mode.UPRIGHT}
HELD = {
    # The weight's moment is m g a, a the horizontal distance of C from A: a <= δ.
    **{
        f"C {share} δ from its point, μ = {mu}": (
            {"lean": np.arcsin(share * DELTA / R), "friction": FloorFriction(mu, DELTA), "mode": mode},
            abs(share) < 1,
        )
        for share in (0.5, -0.9, 1.2)
        for mu, mode in ((0.0, Mode.SLIDING), (0.3, Mode.STICKING))
    },
    "against pivoting alone": ({"friction": FloorFriction(0.3, 0.0, DELTA)}, False),
    "while it turns": ({"spin": 0.1 * UNIT}, False),
    # On both rims a is the distance from the line, and contour friction holds it too.
    **{
        f"C {share} c from its line": (
            {
                **ON_LINE,
                "coin": {**THICK, "center_of_mass": [share * OF_RIM.friction, 0, 0]},
                "friction": FloorFriction(0.3, contour=OF_RIM),
            },
            share < 1,
        )
        for share in (0.5, 0.9, 1.1)
    },
    "against nothing": ({**ON_LINE, "friction": FloorFriction(0.3)}, False),
    "by viscosity": ({**ON_LINE, "friction": FloorFriction(0.3, contour=Contour(0.0, 1e-4))}, False),
    "on a point by its contour": ({"friction": FloorFriction(0.3, contour=OF_RIM)}, False),
    # On a slope tan(a) <= δ/r, of a nickel 0.54°, and friction must hold it.
    **{
        f"nickel at {degrees}°, h = {thickness}, μ = {mu}": (
            {
                "coin": {**NICKEL, "thickness": thickness},
                "mode": Mode.UPRIGHT if thickness else Mode.STICKING,
                "friction": FloorFriction(mu, OF_NICKEL),
                "slope": np.radians(degrees),
            },
            is_held,
        )
        for thickness in (NICKEL["thickness"], 0.0)
        for degrees, mu, is_held in (
            (0.5, 0.3, True),
            (0.53, 0.3, True),
            (0.55, 0.3, False),
            (0.5, 8e-3, False),
        )
    },
    # The weight meets the floor downhill of C by r tan(a).
    **{
        f"C {-side:+} r tan(a) along the slope from its line": (
            {
                "coin": {
                    **{**ZLOTY, "center_of_mass": [-side * R * np.tan(SLOPE), 0, 0]},
                    "inertia": np.diag([8e-8, 8e-8, 1.6e-7]),
                },
                "mode": Mode.UPRIGHT,
                "friction": FloorFriction(0.9, 1e-4),
                "slope": SLOPE,
            },
            side > 0,
        )
        for side in (1, -1)
    },
    # It may pivot: C is above the point where it leans uphill by the slope, and would fall from there.
    **{
        f"leaning by {lean} across a slope": (
            {"friction": FloorFriction(0.9, 1.5e-3), "slope": SLOPE, "across": np.pi / 2, "lean": lean},
            lean == 0,
        )
        for lean in (0.0, -SLOPE, SLOPE)
    },
}
"""What is special of coins at rest on their edges, and whether the floor's resistance holds them."""


@pytest.mark.parametrize(("special", "is_held"), HELD.values(), ids=HELD)
def test_resistance_holds_a_coin_on_its_edge_by_where_its_weight_meets_the_floor(special, is_held):
    coin, mode, friction, slope, across, lean, spin = (DEFAULT | special).values()
    body = scenario(coin=coin, floor={"contact": "smooth", "slope": slope}).body
    y = set_upright(coin, spin=(spin, 0.0, 0.0))
    y[6:10] = quaternion_from_angles((across, np.pi / 2 + lean, 0.0))
    put_on_floor(body, friction, mode, y)
    assert rests(held(body, friction, mode, y), y) == is_held
