"""Whole tosses: in air against an independent integration, at the limits, and how they end."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.models.attitude import rotation_matrix
from cointoss.models.records import Ending, Outcome
from tests.helpers.bits import cases
from tests.helpers.draws import AIR, PAPER_LAWS, THIN, ZLOTY, draw_coin, draw_release, scenario
from tests.helpers.referee import Referee
from tests.helpers.states import energies, gaps


@pytest.mark.slow_after_first
@pytest.mark.parametrize(("b", "thickness"), [(0.5, 0.0), (1.0, 2e-3)])
def test_impacts_in_air_of_any_exponent_are_those_of_an_independent_integration(b, thickness):
    """The air is thick enough to move the last impact by far more than the tolerance."""
    rng = np.random.default_rng([5, int(10 * b), int(1e4 * thickness)])
    offset = [-1e-3, -1e-3, -thickness / 10]
    parts = {
        "coin": {**ZLOTY, "thickness": thickness, "center_of_mass": offset},
        "floor": {"restitution": 0.6},
        "release": draw_release(rng),
        "ending": {"max_impacts": 2},
    }
    air = {"normal": 2.0, "tangential": 0.5, "exponent": b}
    case = scenario(air=air, **parts)
    tossed = analytic.toss(case)
    assert tossed.trusted_impacts == 2
    impacts, linear = tossed.impacts, analytic.toss(scenario(air={**air, "exponent": 0.0}, **parts)).impacts
    assert np.abs(impacts.time - linear.time).max() > 1e-4, "the exponent should matter"
    referee = Referee(case)
    y, time = referee.start(), 0.0
    for i in range(2):
        flown, y = referee.fly(y, 2.0, until_touch=True)
        time += flown
        y, S = referee.hit(y)
        assert impacts.time[i] == pytest.approx(time, abs=1e-7)
        assert impacts.impulse[i] == pytest.approx(S, abs=1e-5 * float(np.linalg.norm(S)))


@pytest.mark.slow_after_first
@pytest.mark.parametrize("chi", [0.0, 0.01, 0.3, 0.8])
@pytest.mark.usefixtures("without_horizon")
def test_no_recorded_or_sampled_state_is_below_the_floor(chi):
    rng = np.random.default_rng(21)
    for _ in range(40):
        case = scenario(coin=draw_coin(rng), air=AIR, floor={"restitution": chi}, release=draw_release(rng))
        tossed, body = analytic.toss(case), case.body
        times = np.concatenate(
            [np.linspace(0, tossed.end_time, 300), tossed.impacts.time, np.nextafter(tossed.impacts.time, 0)]
        )
        # A touch of the last digits of time at 10 m/s is 1e-15 m.
        assert gaps(body, tossed.sample(times)).min() > -1e-12 * case.coin.radius
        assert np.abs(gaps(body, tossed.impacts)).max() < 1e-12 * case.coin.radius


@pytest.mark.parametrize(
    ("chi", "release"),
    [
        (0.6, {"position": [0, 0, 0.166], "angles": [0, 2.54, 0], "angular_velocity": [12, -2, 35]}),
        (0.0, {"position": [0, 0, 0.3], "angles": [0.1, 0.4, 0.2], "angular_velocity": [40, 5, 3]}),
        (0.01, {"position": [0, 0, 0.3], "angles": [0.1, 0.4, 0.2], "angular_velocity": [40, 5, 3]}),
    ],
)
def test_impacts_that_crowd_together_become_a_contact(chi, release):
    """Nearly flat, the rim turns under the coin: the gap then falls much faster than any point of it."""
    tossed = analytic.toss(scenario(floor={"restitution": chi}, release=release))
    begins = tossed.contacts[0, 0]
    between = np.diff([*tossed.impacts.time[tossed.impacts.time < begins], begins])
    assert len(between) < 60
    assert between[-1] < 1e-5
    # Under a steady acceleration of the gap each flight takes χ of the time of the one before.
    assert between[-1] == pytest.approx(chi * between[-2], rel=0.05, abs=1e-8)
    assert tossed.outcome != Outcome.UNDECIDED


DECIDED = {
    # Released 7e-8 rad from flat onto a floor without rebound: each rim point that lands lifts the other.
    "rattles between two rim points": (
        scenario(
            air={"normal": 8.0, "tangential": 0.2},
            floor={"restitution": 0.0, "contact": "coulomb", "friction": 0.0},
            release={
                "position": [0, 0, 0.0435],
                "velocity": [-0.601, 0.531, -0.2456],
                "quaternion": [-3.5265e-08, 0.6381526178055826, -0.7699098884855815, 3.2961e-09],
            },
        ),
        Ending.LYING,
    ),
    # Late in a long fall one step of floating-point time lowers the coin by more than a touch allows.
    "touches where time has no finer step": (
        scenario(
            coin=ZLOTY,
            air={"normal": 20.0, "tangential": 5.0},
            release={
                "position": [0, 0, 50.0],
                "velocity": [-0.10226171441695878, -0.17010859092786915, 0.17821003964198645],
                "quaternion": [-0.38392404740485, -0.75526136023087, -0.50666387733588, -0.15960676354551],
                "angular_velocity": [-44.16113810381836, -125.06565643474042, -173.30553798126397],
            },
        ),
        Ending.SETTLED,
    ),
    # Its lowest point is at rest within rounding, and its other side about to land: that is no touch yet.
    "comes to lie out of a contact": (
        scenario(
            coin=THIN,
            floor={"restitution": 0.6},
            release={"position": [0, 0, 0.205295753569799], "angular_velocity": [0, 52.710304646806165, 0]},
            ending={"max_impacts": 1000},
        ),
        Ending.SETTLED,
    ),
    "has no rebound": (
        scenario(floor={"restitution": 0.0}, release={"angles": [0, 0.3, 0]}),
        Ending.SETTLED,
    ),
}
"""Tosses that once went on for ever or ended without a verdict, and how they end."""


@pytest.mark.parametrize("name", DECIDED)
def test_a_toss_is_decided_soon_and_above_the_floor(name):
    case, ending = DECIDED[name]
    tossed = analytic.toss(case)
    assert tossed.ending == ending
    assert len(tossed.impacts) < 100
    assert gaps(case.body, tossed.impacts).min() > -1e-12 * case.coin.radius


@pytest.mark.parametrize("name", ["coulomb", "imperfect, air, smooth", "stout"])
def test_the_energy_at_the_end_is_that_of_the_last_state(name):
    tossed = analytic.toss(cases()[name])
    said = {line.name: line.value for line in tossed.certificate}
    last = energies(tossed.scenario, tossed.sample([tossed.end_time]))
    assert [said["energy at the end"]] == pytest.approx(last, rel=1e-9)


@pytest.mark.parametrize("angular_velocity", [[0, 0, 0], [0, 0, 30.0]])
def test_a_coin_exactly_on_its_edge_lands_on_a_line(angular_velocity):
    """Half a turn of e keeps n_z at exactly 0; the impulse goes through C and leaves the spin alone."""
    release = {"quaternion": [0.5, 0.5, 0.5, 0.5], "angular_velocity": angular_velocity}
    tossed = analytic.toss(scenario(release=release, ending={"max_impacts": 1}))
    assert tossed.impacts.point[0, 2] == 0
    assert tossed.impacts.impulse[0, 2] == pytest.approx(
        -1.8 * 2e-3 * tossed.impacts.velocity_before[0, 2], rel=1e-12
    )
    assert tossed.impacts.angular_velocity_after[0] == pytest.approx(angular_velocity, abs=1e-10)
    assert tossed.trusted_impacts == 0


def test_the_imperfect_coin_turns_over_in_the_drop_of_fig_3():
    case = scenario(
        coin={**ZLOTY, "center_of_mass": [-1e-3, -1e-3, -2e-4]}, air=AIR, release={"position": [0, 0, 1.86]}
    )
    tossed = analytic.toss(case)
    tilt = np.degrees(np.arccos(rotation_matrix(tuple(tossed.impacts.quaternion[0]))[2][2]))
    assert 120 < tilt < 124
    assert tossed.sequence[0] == "T"


WOBBLING = scenario(
    coin=THIN,
    floor={"restitution": 0.26},
    release={"position": [0, 0, 0.013], "angles": [0, 1.2, 0], "angular_velocity": [0, 60, 0]},
)


def test_a_coin_that_loses_nothing_may_wobble_for_ever():
    tossed = analytic.toss(WOBBLING)
    assert (tossed.outcome, tossed.ending) == (Outcome.PERPETUAL, Ending.PERIODIC)
    energies = {item.name: float(item.value) for item in tossed.certificate if item.unit == "J"}
    assert energies["energy at the end"] > energies["energy of the lowest pass to the other face"]
    assert tossed.trusted_impacts <= np.sum(tossed.impacts.time < tossed.contacts[0, 0])
    start, end = tossed.contacts[-1]
    assert end == tossed.end_time
    states = tossed.sample(np.linspace(start, end, 500))
    assert np.abs(states.normal[:, 2]).max() < 1
    assert np.abs(gaps(WOBBLING.body, states)).max() < 1e-12 * ZLOTY["radius"]
    again = analytic.toss(WOBBLING.replace("air", AIR))
    assert again.outcome in (Outcome.HEADS, Outcome.TAILS), "air takes what it keeps in vacuum"


@pytest.mark.parametrize("law", [law for law in PAPER_LAWS if str(law) not in ("smooth", "perfectly_rough")])
def test_contact_is_not_followed_under_a_law_that_prescribes_the_slip(law):
    """The flat drop ends by its energy; a slow spinning one would stay in contact."""
    tossed = analytic.toss(
        scenario(
            floor={"restitution": 0.1, "contact": str(law), "friction": 0.2},
            release={"position": [0, 0, 0.013], "angles": [0, 1.2, 0], "angular_velocity": [0, 60, 0]},
        )
    )
    assert len(tossed.contacts) == 0


@pytest.mark.parametrize("thickness", [0.0, 2e-3])
@pytest.mark.parametrize("offset", [[0.0, 0.0], [-1e-3, -1e-3]])
@pytest.mark.usefixtures("without_horizon")
def test_a_face_settled_early_in_air_is_that_of_the_toss_followed_on(thickness, offset):
    """Under the paper's test the same toss goes on until E < m g r, mostly after: then with the same face."""
    rng, earlier = np.random.default_rng(12), 0
    coin = {**ZLOTY, "thickness": thickness, "center_of_mass": [*offset, 0.0]}
    for _ in range(25):
        parts = {"coin": coin, "air": AIR, "floor": {"restitution": 0.6}, "release": draw_release(rng)}
        settled, on = (
            analytic.toss(scenario(**parts, ending={"test": test})) for test in ("rigorous", "paper")
        )
        assert settled.outcome in (Outcome.HEADS, Outcome.TAILS, Outcome.EDGE)
        if settled.outcome != Outcome.EDGE and settled.end_time < on.end_time:
            assert on.outcome == settled.outcome
            earlier += 1
    # Of an unbalanced coin E < m g r is above its lowest pass, so it often comes first, and decides nothing.
    assert earlier > (5 if any(offset) else 15)


@pytest.mark.parametrize(("test", "slide"), [("paper", 0.8), ("paper_smooth", 0.0)])
@pytest.mark.usefixtures("without_horizon")
def test_in_vacuum_a_toss_that_never_meets_the_papers_test_ends_as_what_it_is(test, slide):
    """Sliding that nothing takes keeps E above m g r; a coin that turns over for ever meets neither test."""
    named, settled_alike = set(), 0
    for spin in np.linspace(20, 60, 12):
        parts = {
            "coin": THIN,
            "floor": {"restitution": 0.6},
            "release": {
                "position": [0, 0, 0.3],
                "velocity": [slide, 0, 0],
                "angles": [0, np.deg2rad(7), 0],
                "angular_velocity": [10, spin, 5],
            },
        }
        tossed, settled = (
            analytic.toss(scenario(**parts, ending={"test": test})),
            analytic.toss(scenario(**parts)),
        )
        named.add(tossed.ending)
        assert tossed.outcome == settled.outcome
        settled_alike += tossed.ending == Ending.SETTLED
    assert Ending.PERIODIC in named
    if test == "paper":
        assert named <= {Ending.PERIODIC, Ending.PERPETUAL, Ending.SETTLED, Ending.LYING}
        assert settled_alike > 3
