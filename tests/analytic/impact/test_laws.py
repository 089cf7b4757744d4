"""The contact laws: momentum, restitution and the law's own constraint, energy, limits."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.models.certificate import energy_residuals, law_residuals, momentum_residuals
from cointoss.models.contact_laws import sliding_friction
from cointoss.models.contact_laws.table import LAWS
from cointoss.models.laws import ContactLaw
from cointoss.models.records import Impacts
from tests.helpers.draws import AIR, PAPER_LAWS, draw_release, scenario
from tests.helpers.impacts import asked, draw_impact, struck

COUNT, IDEAL = 40, (0.0, 0.0, 0.0)


@pytest.mark.parametrize("law", PAPER_LAWS)
@pytest.mark.parametrize(
    ("center", "spin"),
    [(None, None), (IDEAL, 0.0), (IDEAL, 1e-15), (IDEAL, -30.0), ((-1e-3, -1e-3, 0.0), 0.0)],
)
def test_every_law_obeys_newton_momentum_and_its_own_constraint(law, center, spin):
    """A coin of either kind, or one with a spin about ζ, which an ideal one keeps where the law spares it."""
    rng, turned = np.random.default_rng([int(law), spin is None]), 0
    for _ in range(COUNT):
        case, y = draw_impact(rng, law)
        if center is not None:
            case, y[12] = case.replace("coin.center_of_mass", center), spin
        row, after, _ = struck(case, y)
        body, impacts = case.body, Impacts.from_rows(np.array([row]))
        assert np.array_equal(after[[0, 1, 2, 6, 7, 8, 9]], y[[0, 1, 2, 6, 7, 8, 9]])
        assert momentum_residuals(body, impacts) < 1e-12
        assert law_residuals(body, case.rules, impacts) < 1e-12
        assert np.abs(energy_residuals(impacts)) < 1e-13 * row["energy"]
        turned += abs(after[12] - y[12]) > 1e-3 * np.linalg.norm(after[10:13] - y[10:13])
    assert center != IDEAL or (turned > COUNT / 2) == (not LAWS[law].spares_spin)


@pytest.mark.slow_after_first
@pytest.mark.parametrize("law", list(ContactLaw))
@pytest.mark.parametrize("thickness", [0.0, 2e-2])
def test_an_ideal_coin_gets_no_spin_about_its_axis_by_rounding(law, thickness):
    """Of none, in air, by a law that spares it; by the others where it moves in a plane."""
    rng, spins = np.random.default_rng([16, int(law)]), []
    for _ in range(10):
        release = draw_release(rng, spin=80.0)
        release["angular_velocity"][2] = 0.0
        if not LAWS[law].spares_spin:
            half, axis = rng.uniform(0, np.pi), rng.integers(2)
            release["quaternion"] = [np.cos(half), *(np.sin(half) * np.eye(3)[axis])]
            release["velocity"][axis] = release["angular_velocity"][1 - axis] = 0.0
        floor = {"contact": str(law), "restitution": 0.8, "friction": 0.3}
        parts = {"coin": {"thickness": thickness}, "air": AIR, "floor": floor, "release": release}
        toss = analytic.toss(scenario(**parts, ending={"max_impacts": 40}))
        free = toss.impacts.time < toss.contacts[:, 0].min(initial=np.inf)
        spins += toss.impacts.angular_velocity_after[free, 2].tolist()
    assert len(spins) > 50
    assert not any(spins)


@pytest.mark.parametrize("law", list(ContactLaw))
@pytest.mark.parametrize("up", [1.0, -1.0])
def test_a_flat_coin_bounces_flat_whatever_the_law(law, up):
    case = scenario(
        coin={"center_of_mass": [-1e-3, -1e-3, -2e-4]},
        floor={"restitution": 0.6, "contact": str(law), "friction": 0.2},
    )
    e = [1.0, 0, 0, 0] if up > 0 else [0, 1.0, 0, 0]
    y = np.array([0, 0, 0.001 - up * 2e-4, 0.3, 0.1, -2.0, *e, 0, 0, 4.0])
    row, after, _ = struck(case, y)
    assert after[3:6] == pytest.approx([0.3, 0.1, 1.2], rel=1e-15)
    assert np.array_equal(after[10:13], y[10:13])
    assert row["point"] == pytest.approx([-1e-3, -1e-3, -up * 1e-3], rel=1e-15)
    assert row["impulse"] == pytest.approx([0, 0, 2e-3 * 1.6 * 2.0], rel=1e-15)


@pytest.mark.parametrize(
    ("K_xz", "mu", "gained"),
    [(-900.0, 0.0, 1000.0), (-900.0, 1.0, 100.0), (-900.0, 1.2, None), (-800.0, 1.25, None)],
)
def test_painleves_case_has_no_solution_and_says_so(K_xz, mu, gained):
    """Along (μ, 0, 1) the velocity gained is 1000 + μ K_xz: positive, or no impulse stops the approach."""
    K = ((1500.0, 0.0, K_xz), (0.0, 1500.0, 0.0), (K_xz, 0.0, 1000.0))
    S, possible = sliding_friction.impulse(asked(K, (-1.0, 0.0, -1.0), 0.5, mu))
    assert possible == (gained is not None)
    assert S == pytest.approx([1.5 / gained * mu, 0, 1.5 / gained] if gained else [0, 0, 0], rel=1e-12)
