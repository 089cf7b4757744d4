"""What a toss measures of itself: rounding where the engine is exact, and the damage done to a record."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from cointoss import analytic, coin_mj
from cointoss.analytic.air.force import force_and_moment
from cointoss.models import certificate
from cointoss.models.certificate import Changes, InContact, measurements
from cointoss.models.laws import ContactLaw
from cointoss.models.reading import load
from cointoss.models.records import Array, Impacts, States, Toss
from cointoss.models.scenario import Scenario
from tests.helpers.draws import AIR, LONG_TRANSIENT, ZLOTY, draw_coin, draw_release, scenario

pytestmark = pytest.mark.usefixtures("without_horizon")


def measured(toss: Toss) -> dict[str, float]:
    return {item.name: float(item.value) for item in toss.certificate if item.name in certificate.NAMES}


def draw(seed: int, **floor: Any) -> Scenario:
    rng = np.random.default_rng(seed)
    return scenario(
        coin=draw_coin(rng),
        air=AIR if seed % 2 else {},
        floor={"friction": 0.3, "restitution": 0.7, **floor},
        release=draw_release(rng),
        ending={"max_impacts": 20, "test": "paper"},
    )


def again(toss: Toss, impacts: Impacts | None = None, **parts: Any) -> dict[str, float]:
    """Measure a toss anew, with its impacts or other parts exchanged."""
    none = toss.path.sample(np.empty(0))
    lines = measurements(
        toss.scenario,
        impacts or toss.impacts,
        toss.contacts,
        InContact(
            parts.get("stretches", Changes(none, none)),
            parts.get("landings", Changes(none, none)),
            parts.get("gaps", np.empty(0)),
        ),
        parts.get("path", toss.path),
        force_and_moment,
    )
    return {line.name: float(line.value) for line in lines}


def outside(toss: Toss, bounds: Mapping[str, tuple[float, float]]) -> dict[str, float]:
    """Return the measured lines that are not between their bounds."""
    found = measured(toss)
    return {name: found[name] for name, (low, high) in bounds.items() if not low < abs(found[name]) < high}


ROUNDING = {
    certificate.LAW: (0, 1e-11),
    certificate.MOMENTUM: (0, 1e-11),
    certificate.IMPACT_ENERGY: (-1, 1e-11),
    certificate.FLIGHT_ENERGY: (0, 1e-10),
    certificate.NORM: (-1, 1e-14),
    certificate.GAP: (-1, 1e-11),
}


@pytest.mark.parametrize("law", list(ContactLaw))
@pytest.mark.parametrize(("seed", "slope"), [(0, 0.0), (1, 0.0), (2, 0.2), (3, 0.2)])
def test_the_analytic_engine_errs_by_rounding(law, seed, slope):
    toss = analytic.toss(draw(seed, contact=str(law), slope=slope))
    assert len(toss.impacts) >= 3
    assert outside(toss, ROUNDING) == {}


@pytest.mark.parametrize("seed", range(2))
def test_energetic_restitution_is_measured_by_what_it_may_not_gain(seed):
    toss = analytic.toss(draw(seed, contact="coulomb", restitution_kind="energetic"))
    assert measured(toss)[certificate.LAW] < 1e-11
    impacts = replace(toss.impacts, energy_change=np.abs(toss.impacts.energy_change))
    sizes = (np.linalg.norm(each, axis=1) for each in (impacts.impulse, impacts.contact_velocity_before))
    expected = max(gain / S / v for gain, S, v in zip(impacts.energy_change, *sizes, strict=True))
    assert again(toss, impacts)[certificate.LAW] == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize(
    ("field", "place", "change", "line", "expected"),
    [
        ("velocity_after", (1, 0), 1e-6, certificate.MOMENTUM, lambda body, S: 1e-6 * body.mass / S),
        (
            "angular_velocity_after",
            (1, 1),
            1e-2,
            certificate.MOMENTUM,
            lambda body, S: 1e-2 * np.linalg.norm(body.inertia[1]) / S / body.radius,
        ),
        ("energy_change", 1, -1e-6, certificate.IMPACT_ENERGY, lambda *_: 1e-6),
        ("energy_change", 1, -1e-6, certificate.FLIGHT_ENERGY, lambda *_: 1e-6),
    ],
)
def test_a_damaged_impact_shows_by_as_much_as_it_is_off(field, place, change, line, expected):
    """Of its momenta against |S| and r |S|, and of its energy, which is given in m g r."""
    toss = analytic.toss(draw(2))
    body, damaged = toss.scenario.body, getattr(toss.impacts, field).copy()
    unit = body.mass * body.gravity * body.radius if field == "energy_change" else 1.0
    damaged[place] += change * unit
    found = again(toss, replace(toss.impacts, **{field: damaged}))
    S = float(np.linalg.norm(toss.impacts.impulse[1]))
    assert found[line] == pytest.approx(expected(body, S), rel=0.05)


def test_a_gain_of_energy_is_a_line_of_its_own():
    toss = analytic.toss(draw(2))
    body, change = toss.scenario.body, toss.impacts.energy_change.copy()
    change[1] = 0.3 * body.mass * body.gravity * body.radius
    found = again(toss, replace(toss.impacts, energy_change=change))
    assert found[certificate.GAIN] == pytest.approx(0.3)
    assert certificate.GAIN not in measured(toss)


@pytest.mark.parametrize("law", [ContactLaw.SMOOTH, ContactLaw.SLIDING_FRICTION])
def test_a_damaged_impulse_breaks_the_law_that_says_where_it_points(law):
    toss = analytic.toss(draw(1, contact=str(law)))
    S = toss.impacts.impulse.copy()
    S[2, 0] += 1e-6 * float(np.linalg.norm(S[2]))
    assert 0.25e-6 < again(toss, replace(toss.impacts, impulse=S))[certificate.LAW] < 4e-6


def test_a_missed_restitution_is_taken_of_the_change_that_is_asked_for():
    """(1 + χ)|v_Az|; up to the threshold χ is 0."""
    toss = analytic.toss(draw(2))
    approach, v = -toss.impacts.contact_velocity_before[1, 2], toss.impacts.contact_velocity_after.copy()
    v[1, 2] += 1e-3 * approach
    damaged = replace(toss.impacts, contact_velocity_after=v)
    found = certificate.restitution_residuals(toss.scenario.rules, damaged)
    assert found[1] == pytest.approx(1e-3 / 1.7)
    plastic = toss.scenario.rules._replace(restitution_threshold=approach)
    assert certificate.restitution_residuals(plastic, toss.impacts)[1] == pytest.approx(0.7)


ALL_OF_IT, OF_EDGE = (0.999e-6, 1.001e-6), (0.7e-6, 1.01e-6)
ALONG_THE_FLOOR = {
    ContactLaw.PERFECTLY_ROUGH: ALL_OF_IT,
    ContactLaw.SLIP_PRESERVING: ALL_OF_IT,
    ContactLaw.SHARP_EDGE: OF_EDGE,
    ContactLaw.KNURLED: OF_EDGE,
}
"""What a law says of the slip after an impact, over what it is off."""


@pytest.mark.parametrize("law", list(ContactLaw))
@pytest.mark.parametrize("axis", range(3))
def test_a_damaged_velocity_of_the_contact_point_shows(law, axis):
    toss = analytic.toss(draw(2, contact=str(law)))
    v = toss.impacts.contact_velocity_after.copy()
    v[1, axis] += 1e-6 * np.linalg.norm(toss.impacts.contact_velocity_before[1])
    found = again(toss, replace(toss.impacts, contact_velocity_after=v))
    low, high = ALL_OF_IT if axis == 2 else ALONG_THE_FLOOR.get(law, (-1, 1))
    assert low < found[certificate.LAW] < high
    if toss.impacts.impulse[1, axis] != 0:
        assert found[certificate.IMPACT_ENERGY] > 1e3 * measured(toss)[certificate.IMPACT_ENERGY]


@pytest.mark.parametrize(
    ("sink", "stretch", "line", "low", "high"),
    [
        (0.0, 1e-7, certificate.NORM, 0.999e-7, 1.001e-7),
        (0.5, 0.0, certificate.GAP, -0.6 / 0.0125, -0.1 / 0.0125),
    ],
)
def test_a_damaged_path_shows(sink, stretch, line, low, high):
    toss = analytic.toss(draw(2))

    class Damaged:
        def sample(self, times: Array) -> States:
            states = toss.path.sample(times)
            lowered = states.position - [0, 0, sink]
            return replace(states, position=lowered, quaternion=states.quaternion * (1 + stretch))

    assert low < again(toss, path=Damaged())[line] < high


def test_contacts_are_measured_where_there_are_any():
    toss = analytic.toss(load("contact_coulomb"))
    sloping = analytic.toss(load("contact_coulomb").replace("floor.slope", 0.1))
    for each in (toss, sloping):
        assert 0 <= measured(each)[certificate.CONTACT_ENERGY] < 1e-9
    radius, states = toss.scenario.coin.radius, toss.path.sample(toss.contacts[0])
    risen = replace(states, position=states.position + np.outer([-1, 1e-3], [0, 0, radius]))
    found = again(toss, stretches=Changes(states, risen), gaps=np.array([0.0, -0.03 * radius, 0.1]))
    assert found[certificate.GAP] == pytest.approx(-0.03)
    assert found[certificate.CONTACT_ENERGY] == pytest.approx(1e-3)
    assert certificate.KEPT not in found
    assert certificate.CONTACT_ENERGY not in measured(analytic.toss(draw(2)))


UPRIGHT = [0.5**0.5, 0.5**0.5, 0.0, 0.0]
"""On its edge, the normal along -y: ω_η turns it about the vertical, and ω_ξ is minus the rate of n_z."""


def states_of(velocity: list[float], angular_velocity: list[float]) -> States:
    return States(
        time=np.zeros(1),
        position=np.zeros((1, 3)),
        velocity=np.array([velocity]),
        quaternion=np.array([UPRIGHT]),
        angular_velocity=np.array([angular_velocity]),
    )


def test_a_landing_of_the_other_rim_on_a_smooth_floor_takes_only_rocking():
    """It keeps the part (J/m - h²/4)/(J/m + h²/4) of it, or nothing if the coin then stands on both rims."""
    case = scenario()
    body, half = case.body, case.coin.thickness / 2
    by_mass = body.inertia[0][0] / body.mass
    kept = (by_mass - half**2) / (by_mass + half**2)
    before = states_of([0.3, 0.1, -2.0 * half], [2.0, 5.0, -7.0])

    def missed(rocking: float, turning: float) -> float:
        after = states_of([0.3, 0.1, rocking * half], [rocking, turning, -7.0])
        return certificate.landing_residuals(body, case.rules, Changes(before, after))[0]

    assert missed(2 * kept, 5.0) < 1e-13
    assert missed(0.0, 5.0) < 1e-13
    assert missed(2 * kept * (1 + 1e-6), 5.0) > 1e-6
    assert missed(2 * kept, 5.0 * (1 + 1e-6)) > 1e-6
    assert certificate.landing_residuals(body, case.rules, Changes(before, before)) == pytest.approx([1.0])


ZLOTY_ON_EDGE = load("zloty").replace("floor.restitution_threshold", 0.3)
"""Its first plastic impact leaves nothing for the landing after it."""
ON_A_FACE = scenario(
    coin={"mass": 0.007, "radius": 0.0125, "thickness": 4e-4, "center_of_mass": [-0.001, 0.0005, 8e-5]},
    air={"normal": 0.8, "tangential": 0.2},
    floor={"contact": "smooth", "restitution": 0.0, "rolling_friction": 1e-4, "slope": 0.02},
    release={
        "position": [0, 0, 0.2241743225227771],
        "velocity": [0.2937353480213742, 0.08885489348007108, -0.08087307750083453],
        "quaternion": [-0.45657533317707627, 0.740682271112038, -0.43258722233855257, -0.23621395696268885],
        "angular_velocity": [10.956966842409322, 8.420150700638054, 26.081749645622907],
    },
)
"""The other end of a rim lands on the way to lying flat, where the points of both rims are one."""


def spun(contact: str) -> Scenario:
    """Return a thin coin that leans by 0.01 rad off its edge, 1 pm high, and turns about its diameter."""
    lean, thickness, radius = 0.01, 4e-4, ZLOTY["radius"]
    return scenario(
        coin={"thickness": thickness},
        floor={"contact": contact, "friction": 0.2, "restitution": 0.6},
        release={
            "position": [0, 0, radius * np.cos(lean) + thickness / 2 * np.sin(lean) + 1e-12],
            "angles": [0, np.pi / 2 - lean, 0],
            "angular_velocity": [0, 20 * np.cos(lean), 20 * np.sin(lean)],
        },
        ending={"test": "paper", "max_time": 1.0},
    )


@pytest.mark.parametrize("law", ["smooth", "coulomb"])
@pytest.mark.parametrize(("engine", "error"), [(analytic, 1e-10), (coin_mj, 1e-3)])
def test_each_landing_in_contact_is_a_plastic_impact(engine, error, law):
    found = measured(engine.toss(spun(law)))
    assert found[certificate.LANDINGS] > 5
    assert 0 < found[certificate.LANDING] < error
    assert (certificate.KEPT in found) == (law == "smooth")


@pytest.mark.parametrize("start", [ZLOTY_ON_EDGE, ON_A_FACE])
def test_a_rim_that_lands_far_from_the_edge_or_with_nothing_to_take_is_no_error(start):
    found = measured(analytic.toss(start))
    assert found.get(certificate.LANDING, 0.0) < 1e-6


def test_momenta_that_a_smooth_floor_keeps_are_measured():
    """m r √(g r) is their unit; a coin off balance does not keep L_ζ."""
    toss = analytic.toss(spun("smooth"))
    unbalanced = scenario(**LONG_TRANSIENT, ending={"max_time": 2.0})
    assert 0 < measured(toss)[certificate.KEPT] < 1e-11
    assert 0 < measured(analytic.toss(unbalanced))[certificate.KEPT] < 1e-8
    states, body = toss.path.sample(toss.contacts[-1]), toss.scenario.body
    unit = (body.gravity * body.radius) ** 0.5
    turn = 0.01 * body.inertia[2][2] / (body.mass * body.radius)
    for name, axis, expected in (("velocity", 0, 0.01), ("velocity", 1, 0.01), ("angular_velocity", 2, turn)):
        damaged = replace(states, **{name: getattr(states, name) + 0.01 * np.eye(3)[axis]})
        found = again(toss, stretches=Changes(states, damaged))[certificate.KEPT]
        assert found == pytest.approx(expected / unit, rel=1e-6)


def test_a_toss_without_impacts_measures_none():
    toss = analytic.toss(scenario(ending={"max_time": 0.01}))
    assert len(toss.impacts) == 0
    assert measured(toss) == {}


@pytest.mark.parametrize(
    "thrown",
    [{"velocity": [0, 0, 1e4]}, {"angular_velocity": [0, 1e4, 0]}],
    ids=["up at 10 km/s", "spinning"],
)
def test_a_flight_that_the_quadrature_cannot_follow_is_not_measured(thrown):
    case = scenario(air=AIR, release={"velocity": [0, 0, 3], **thrown}, ending={"max_impacts": 1})
    assert certificate.FLIGHT_ENERGY not in measured(analytic.toss(case))
    gentle = case.replace("release.velocity", [0, 0, 3], "release.angular_velocity", [0, 100, 0])
    assert measured(analytic.toss(gentle))[certificate.FLIGHT_ENERGY] < 1e-10


def test_the_work_of_air_that_is_not_linear_is_measured():
    case = scenario(
        air={**AIR, "exponent": 0.5},
        release={"angles": [0, 0.4, 0], "angular_velocity": [3.0, 5.0, 2.0], "position": [0, 0, 0.05]},
        ending={"max_impacts": 2},
    )
    assert outside(analytic.toss(case), {certificate.FLIGHT_ENERGY: (-1, 1e-9)}) == {}


def test_a_flat_landing_is_measured_as_vertical():
    toss = analytic.toss(scenario(floor={"contact": "perfectly_rough"}, release={"velocity": [0.3, 0, 0]}))
    found = measured(toss)
    assert len(toss.impacts) > 3
    assert found[certificate.LAW] < 1e-12
    S = toss.impacts.impulse + np.array([1e-9, 0, 0])
    assert again(toss, replace(toss.impacts, impulse=S))[certificate.LAW] > 1e-7
