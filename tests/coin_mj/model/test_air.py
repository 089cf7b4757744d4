"""MuJoCo's air with b > 0: its force against the paper's mechanics, and that each coin feels its own."""

import math

import numpy as np
import pytest

from cointoss.analytic.entries import force_and_moment
from cointoss.coin_mj.entries import air_force
from cointoss.models.body import AirLaw
from tests.helpers.draws import AIR, ZLOTY, scenario
from tests.helpers.tuples import vector

R, H = ZLOTY["radius"], ZLOTY["thickness"]
LN, LT = AIR["normal"], AIR["tangential"]


def by_both(b, h, v, w):
    """Force and moment about B over r by both engines, (6,) each, in units of λ (|v| + r |ω|)^(1+b) π r²."""
    body = scenario(coin={"thickness": h}, air={**AIR, "exponent": b}).body
    pairs = (
        air_force(R, h, AirLaw(b, LN, LT), vector(v), vector(w)),
        force_and_moment(body, vector(v), vector(w)),
    )
    speed = np.linalg.norm(v) + R * np.linalg.norm(w)
    size = (LN + LT) * speed ** (1 + b) * np.pi * R**2 * (1 + h / R)
    return [np.array([*f, *(x / R for x in m)]) / size for f, m in pairs]


def at_rest_somewhere(rng, h):
    """Draw a motion for which a point or a line of the surface is at rest, or nearly."""
    v, w = rng.normal(size=3), rng.normal(size=3) * 10.0 ** rng.uniform(-1, 3)
    near = 1 + rng.choice([0, 1e-12, 1e-8, -1e-8, 1e-4, -1e-4])
    match rng.integers(6):
        case 0:
            v[2] = R * math.hypot(w[0], w[1]) * near
        case 1:
            v[:2] = R * w[2] * near, 0
        case 2:
            w[:2] *= rng.choice([0, 1e-9, 1e-4])
        case 3:
            v[:] *= rng.choice([0, 1e-9, 1e-4])
        case 4:
            w[:] *= rng.choice([0, 1e-9, 1e-4])
        case 5:
            theta, z = rng.uniform(0, 2 * np.pi), rng.uniform(-h / 2, h / 2) * near
            v = -np.cross(w, [R * np.cos(theta), R * np.sin(theta), z])
            v += rng.choice([0, 1e-12, 1e-6]) * rng.normal(size=3)
    return v, w


@pytest.mark.slow_after_first
@pytest.mark.parametrize("b", [1e-3, 0.1, 0.5, 0.9, 1.0])
@pytest.mark.parametrize("h", [0.0, H, 0.6 * R, 4 * R])
def test_two_quadratures_give_one_force(b, h):
    rng = np.random.default_rng([int(1000 * b), int(1e4 * h)])
    motions = [(rng.normal(size=3), rng.normal(size=3) * 60) for _ in range(40)]
    motions += [at_rest_somewhere(rng, h) for _ in range(40)]
    for v, w in motions:
        mine, other = by_both(b, h, v, w)
        # On a rod the nodes of the paper's mechanics are good to 1e-11, as its own tests say.
        assert np.abs(mine - other).max() < (1e-12 if h < R else 1e-11)
        assert np.abs(other).max() > 0.01, "the unit should be that of the force"


def test_a_spin_whose_square_underflows_is_none():
    force = {spin: by_both(0.3, H, (0.0, 1.0, 0.0), (0.0, spin, 0.0))[0] for spin in (0.0, 1e-160)}
    assert np.abs(force[1e-160] - force[0.0]).max() < 1e-15, "but for rounding"
    assert force[0.0][1] < -0.1


def test_a_coin_at_rest_feels_no_air():
    assert air_force(R, H, AirLaw(0.5, LN, LT), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)) == ((0, 0, 0), (0, 0, 0))
