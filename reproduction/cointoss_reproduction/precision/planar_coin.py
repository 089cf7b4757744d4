"""A planar thin coin in its own units: radius, mass and gravity are 1."""

from fractions import Fraction
from math import isqrt
from typing import NamedTuple

from cointoss import ContactLaw, Scenario
from cointoss.study import RESISTANCES, in_vacuum

LAWS = (ContactLaw.SMOOTH, ContactLaw.PERFECTLY_ROUGH)


class PlanarCoin(NamedTuple):
    """Coin, air and floor; the unit of time is sqrt(r/g)."""

    inertia: Fraction
    """J_ξ."""
    restitution: Fraction
    """χ."""
    rough: bool
    """Whether the floor stops the contact point, eq. (c) of Fig. 17, or is smooth."""
    in_air: bool
    drag_mean: Fraction
    """(c_t + c_n)/2: the drag is -(mean) v - (difference) e^(2iθ) v*, v = v_y + i v_z."""
    drag_difference: Fraction
    """(c_t - c_n)/2."""
    slowing: Fraction
    """d_t/J_ξ: at this rate air slows the spin."""
    sliding_share: float
    """The part of the energy of horizontal motion that air can still turn into height; see
    `cointoss.models.drag`."""


class Units(NamedTuple):
    """How to convert a scenario's numbers."""

    length: Fraction
    """r [m]."""
    gravity: Fraction
    """g [m/s²]."""


class PlanarRelease(NamedTuple):
    """A release of a coin at rest but for its spin, or the difference of two such releases."""

    height: Fraction = Fraction(0)
    """The height of C [m]."""
    spin: Fraction = Fraction(0)
    """The spin [rad/s]."""
    tilt: Fraction = Fraction(0)
    """The tilt, within ±π/2 [rad]."""


_REFUSED = ("restitution_threshold", "restitution_exponent", "restitution_viscous", "slope")
"""Fields of a floor that this coin's mechanics leaves out."""


def planar_coin(scenario: Scenario) -> PlanarCoin:
    """Return the coin of a scenario.

    Raises:
        ValueError: where the coin is thick, unbalanced or does not keep turning about ξ, the air is not
            linear, or the floor is another.
    """
    coin, air, body = scenario.coin, scenario.air, scenario.body
    refused = {
        f"coin.thickness: {coin.thickness}, accepted: 0": coin.thickness != 0,
        f"coin.center_of_mass: {coin.center_of_mass}, accepted: [0, 0, 0]": any(coin.center_of_mass),
        f"coin.inertia: {coin.inertia}, accepted: without products with ξ": any(body.inertia[0][1:]),
        f"air.exponent: {air.exponent}, accepted: 0": air.exponent != 0 and not in_vacuum(body),
        f"floor.contact: {scenario.floor.contact}, accepted: {', '.join(str(law) for law in LAWS)}": (
            scenario.floor.contact not in LAWS
        ),
        **{
            f"floor.{name}: {getattr(scenario.floor, name)}, accepted: 0": getattr(scenario.floor, name) > 0
            for name in (*RESISTANCES, *_REFUSED)
        },
        f"air.viscosity: {air.viscosity}, accepted: 0": air.viscosity > 0,
    }
    for message, is_so in refused.items():
        if is_so:
            raise ValueError(message)
    mass, radius, gravity = (Fraction(x) for x in (coin.mass, coin.radius, scenario.gravity))
    inertia = Fraction(body.inertia[0][0]) / (mass * radius**2)
    drag, time = body.drag, square_root(radius / gravity)
    tangential, normal = (Fraction(c) * time / mass for c in (drag.force_tangential, drag.force_normal))
    turning = Fraction(drag.moment_tangential) * time / Fraction(body.inertia[0][0])
    return PlanarCoin(
        inertia=inertia,
        restitution=Fraction(scenario.floor.restitution),
        rough=scenario.floor.contact == ContactLaw.PERFECTLY_ROUGH,
        in_air=bool(drag.force_tangential or drag.force_normal),
        drag_mean=(tangential + normal) / 2,
        drag_difference=(tangential - normal) / 2,
        slowing=turning,
        sliding_share=body.sliding_share,
    )


def units(scenario: Scenario) -> Units:
    """Return the units of a scenario's coin."""
    return Units(length=Fraction(scenario.coin.radius), gravity=Fraction(scenario.gravity))


def square_root(number: Fraction, bits: int = 400) -> Fraction:
    """Return the square root to a given number of bits."""
    shifted = number * 4**bits
    return Fraction(isqrt(shifted.numerator // shifted.denominator), 2**bits)
