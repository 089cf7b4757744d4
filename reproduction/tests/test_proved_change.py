"""A proof is of the toss that a scenario describes: each field is honoured, refused, or without use to it."""

from dataclasses import replace
from fractions import Fraction
from functools import cache
from typing import Any

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.toss import state_at_release
from cointoss.compare.metrics.margin import QUANTITIES, margins, offered_proofs, quantity_of
from cointoss.models.batch import rows_from_states
from cointoss.models.records import Ending, Outcome
from cointoss_reproduction.precision.certified import certified_toss
from cointoss_reproduction.precision.planar_coin import PlanarRelease, planar_coin, units
from cointoss_reproduction.precision.planar_ending import planar_ending
from cointoss_reproduction.precision.proved_change import PROVED, proved_change, refusal
from tests.helpers.command_line import cointoss
from tests.helpers.draws import THIN, scenario

pytestmark = pytest.mark.usefixtures("without_horizon")

BASE = scenario(
    coin=THIN,
    floor={"restitution": 0.3},
    release={"position": [0, 0, 0.4], "angular_velocity": [40.0, 0, 0]},
)
J = 2e-3 * 0.0125**2 / 4
HONOURED: list[tuple[str, Any]] = [
    ("gravity", 3.7),
    ("coin.radius", 0.02),
    ("coin.inertia", [[1.3 * J, 0, 0], [0, J, 1e-9], [0, 1e-9, 1.9 * J]]),
    ("floor.restitution", 0.5),
    ("floor.restitution", 0.0),
    ("floor.contact", "perfectly_rough"),
    ("release.position", [0.3, -0.2, 0.37]),
    ("release.quaternion", [-1.0, 0.0, 0.0, 0.0]),
    ("release.angular_velocity", [31.0, 0, 0]),
    ("ending.test", "paper"),
    ("ending.test", "paper_smooth"),
    ("ending.max_impacts", 12),
    ("ending.max_time", 0.6),
    ("ending.caught", 0.1),
]
WITHOUT_USE: list[tuple[str, Any]] = [
    ("coin.mass", 5e-3),  # all that acts on the coin is in proportion to it
    ("air.exponent", 1.0),  # of no air
    ("floor.friction", 0.4),  # of another law
    ("floor.restitution_speed", 2.0),  # of a restitution that does not fall with speed
    ("release.angles", [0.0, 0.0, 0.0]),  # as by default
    ("ending.until", 3.0),  # after the proof
]
REFUSED: list[tuple[str, Any]] = [
    ("coin.thickness", 1e-6),
    ("coin.center_of_mass", [1e-9, 0, 0]),
    ("coin.inertia", [[J, 1e-12, 0], [1e-12, J, 0], [0, 0, 1.9 * J]]),
    ("coin.inertia", [[J, 0, 1e-12], [0, J, 0], [1e-12, 0, 1.9 * J]]),
    ("air.normal", 1e-9),
    ("air.tangential", 1e-9),
    ("floor.contact", "coulomb"),
    ("floor.contact", "sharp_edge"),
    ("floor.restitution_kind", "energetic"),
    ("floor.restitution_threshold", 1e-9),
    ("floor.rolling_friction", 1e-9),
    ("floor.pivoting_friction", 1e-9),
    ("floor.contour_friction", 1e-9),
    ("floor.contour_viscosity", 1e-9),
    ("floor.restitution_exponent", 1e-9),
    ("floor.restitution_viscous", 1e-9),
    ("floor.slope", 1e-9),
    ("air.viscosity", 1e-9),
    ("release.velocity", [0, 0, 1e-9]),
    ("release.angles", [0, 1e-9, 0]),
    ("release.quaternion", [1.0, 0.0, 0.0, 1e-9]),
    ("release.angular_velocity", [40.0, 0, 1e-9]),
    ("ending.test", "lying"),
]


def changed(field, value):
    more = ("floor.contact", "coulomb") if field == "floor.restitution_kind" else ()
    return BASE.replace(field, value, *more)


def proofs(case, change=1e-3, names=tuple(quantity.name for quantity in QUANTITIES)):
    """Return what is proved along each quantity."""
    return {name: proved_change(case, quantity_of(name), change) for name in names}


@cache
def known():
    """Return what is proved of the toss that is changed."""
    return proofs(BASE, names=PROVED)


def outcomes_within(case, quantity, change, settings=analytic.MANY):
    """Return the outcomes of the toss and of releases up to a change away."""
    by = change * np.array([0, 1, -1, 0.9, -0.9, 0.5, -0.3])
    rows = rows_from_states(case, np.tile(state_at_release(case.release), (len(by), 1)))
    return analytic.toss_rows(quantity.change(rows, by), settings=settings).outcome


def assert_proofs_hold(case, *, names=PROVED):
    """See that the tosses within each proof end as the scenario's, and return how many proofs there are."""
    found = proofs(case, names=names)
    for name, change in found.items():
        outcomes = outcomes_within(case, quantity_of(name), change)
        assert outcomes[0] in (Outcome.HEADS, Outcome.TAILS)
        assert np.all(outcomes == outcomes[0])
    return sum(change > 0 for change in found.values())


def test_every_field_of_a_scenario_is_decided():
    declared = set()
    for name, part in BASE.model_dump().items():
        declared |= {f"{name}.{key}" for key in part} if isinstance(part, dict) else {name}
    assert {field for field, _ in (*HONOURED, *WITHOUT_USE, *REFUSED)} == declared


@pytest.mark.slow_after_first
@pytest.mark.parametrize(("number", "field", "value"), [(n, *each) for n, each in enumerate(HONOURED)])
def test_what_is_honoured_has_its_own_proof(number, field, value):
    """Along one quantity, each in turn."""
    case = changed(field, value)
    assert refusal(case) == ""
    assert assert_proofs_hold(case, names=[list(PROVED)[number % len(PROVED)]]) == 1


@pytest.mark.slow
@pytest.mark.parametrize(("number", "field", "value"), [(n, *each) for n, each in enumerate(WITHOUT_USE)])
def test_what_is_without_use_changes_no_proof(number, field, value):
    """Along one quantity, each in turn."""
    name = list(PROVED)[number % len(PROVED)]
    assert proofs(changed(field, value), names=[name])[name] == known()[name] > 0


@pytest.mark.parametrize(("field", "value"), REFUSED)
def test_what_is_refused_has_no_proof_and_says_so(field, value):
    case = changed(field, value)
    assert not any(proofs(case).values())
    if field.startswith(("floor", "ending", "coin.inertia", "coin.center", "air.viscosity")):
        said = "floor.contact" if field == "floor.restitution_kind" else field
        assert refusal(case).startswith(f"{said}: ")
        assert ", accepted: " in refusal(case)
    else:
        assert refusal(case).startswith("accepted: a thin coin released flat in vacuum, ")


G = 9.81


@pytest.mark.parametrize(
    ("hand", "spin", "halves", "chi", "above"),
    [
        (0.2, 40.0, 2, 0.0, 1e-4),
        (0.2, 40.0, 2, 0.9, -1e-4),
        (0.15, 62.0, 3, 0.5, 3e-6),
        (0.02, 25.0, 1, 0.5, -2e-5),
        (1.3, 55.0, 5, 1.0, 1e-3),
    ],
)
@pytest.mark.parametrize("law", ["smooth", "perfectly_rough"])
def test_a_catch_is_proved_up_to_its_closed_form(hand, spin, halves, chi, above, law):
    """Caught after t = sqrt(2 (z - c)/g), a coin shows another face from ω t = (n + 1/2) π on."""
    t = (halves + 0.5) * np.pi / spin
    case = BASE.replace(
        "release.position.z", hand + G * t * t / 2 + above, "release.angular_velocity.xi", spin,
        "floor.restitution", chi, "floor.contact", law, "ending.caught", hand,
    )  # fmt: skip
    height = QUANTITIES[0]
    assert analytic.toss(case).ending == Ending.CAUGHT
    assert 0.25 * abs(above) < proved_change(case, height, 1.01 * abs(above)) < abs(above)
    assert proved_change(case, height, 0.99 * above) > 0.4 * abs(above)
    assert assert_proofs_hold(case) == len(PROVED)
    beside = outcomes_within(case, height, 1.01 * above)
    assert set(beside) == {Outcome.HEADS, Outcome.TAILS}


def drawn(rng, **fields):
    case = BASE.replace(
        "release.position.z", rng.uniform(0.05, 0.4), "release.angular_velocity.xi", rng.uniform(20, 60)
    )
    return case.replace(*[one for pair in fields.items() for one in (pair[0].replace("__", "."), pair[1])])


@pytest.mark.slow
def test_a_catch_after_bounces_is_proved_of_the_face_in_the_hand():
    rng, proved, bounced = np.random.default_rng(3), 0, 0
    for _ in range(20):
        z, spin = rng.uniform(0.02, 0.06), rng.uniform(150, 300)
        given = {"release__position": [0, 0, z], "release__angular_velocity": [spin, 0, 0]}
        case = drawn(rng, floor__restitution=0.9, ending__caught=1.05 * z, **given)
        toss = analytic.toss(case)
        if toss.ending == Ending.CAUGHT:
            bounced += len(toss.impacts) > 0
            proved += assert_proofs_hold(case, names=["height"])
        else:
            assert not proved_change(case, QUANTITIES[0], 1e-3)
    assert bounced > 5
    assert proved > 5


SLOW = ("gravity", 1e-9, "release.position.z", 1e3, "release.angular_velocity.xi", 4e-6)


@pytest.mark.parametrize(
    ("given", "ending"), [(("ending.caught", 1.0), Ending.NOT_CAUGHT), (SLOW, Ending.MAX_TIME)]
)
def test_nothing_is_proved_of_a_coin_that_misses_the_hand_or_whose_time_by_default_is_up(given, ending):
    case = BASE.replace(*given)
    assert analytic.toss(case).ending == ending
    assert not any(proofs(case, 1e-6).values())


@pytest.mark.slow_after_first
@pytest.mark.parametrize(("chi", "law"), [(0.3, "smooth"), (0.5, "smooth"), (0.3, "perfectly_rough")])
def test_impacts_and_time_up_to_which_a_toss_is_followed_are_those_of_the_proof(chi, law):
    rng, compared = np.random.default_rng(8), 0
    for _ in range(12):
        case = drawn(rng, floor__restitution=chi, floor__contact=law)
        toss, height = analytic.toss(case), QUANTITIES[0]
        known = proved_change(case, height, 1e-4)
        if len(toss.contacts) or not known:
            continue
        compared += 1
        n, end = len(toss.impacts), toss.end_time
        assert proved_change(case.replace("ending.max_impacts", n), height, 1e-4) == known
        assert proved_change(case.replace("ending.max_time", 1.001 * end), height, 1e-7) > 0
        for field, value in (("ending.max_impacts", max(n - 1, 1)), ("ending.max_time", end * (1 - 1e-9))):
            if (field, value) != ("ending.max_impacts", n):
                assert analytic.toss(case.replace(field, value)).outcome == Outcome.UNDECIDED
                assert proved_change(case.replace(field, value), height, 1e-7) == 0
        late = case.replace("ending.max_time", 1.0001 * end)
        assert np.all(outcomes_within(late, height, proved_change(late, height, 1e-3)) == toss.outcome)
    assert compared > 3


@pytest.mark.slow
def test_a_toss_whose_contact_lasts_is_proved_within_its_time_and_not_within_a_number_of_impacts():
    rng, compared = np.random.default_rng(6), 0
    for _ in range(12):
        case, height = drawn(rng, floor__restitution=0.0), QUANTITIES[0]
        toss = analytic.toss(case)
        if not len(toss.contacts) or not proved_change(case, height, 1e-5):
            continue
        compared += 1
        assert proved_change(case.replace("ending.max_impacts", 5), height, 1e-5) == 0
        assert proved_change(case.replace("ending.max_time", 1.0), height, 1e-5) > 0
        assert proved_change(case.replace("ending.max_time", 0.999 * toss.end_time), height, 1e-5) == 0
    assert compared > 3


@pytest.mark.parametrize("law", ["smooth", "perfectly_rough"])
def test_each_test_of_the_ending_ends_the_proof_at_the_impact_that_it_ends_the_toss(law):
    rng, counts = np.random.default_rng(4), []
    for _ in range(12):
        case, found = drawn(rng, floor__restitution=0.6, floor__contact=law), []
        for test in ("rigorous", "paper", "paper_smooth"):
            by_test = case.replace("ending.test", test)
            toss, spin = analytic.toss(by_test), case.release.angular_velocity[0]
            proof = certified_toss(
                planar_coin(case),
                units(case),
                PlanarRelease(Fraction(case.release.position[2]), Fraction(spin)),
                ending=planar_ending(by_test),
            )
            if not len(toss.contacts) and proof.outcome != Outcome.UNDECIDED:
                assert (proof.outcome, len(proof.impacts)) == (toss.outcome, len(toss.impacts))
                found.append(len(proof.impacts))
        counts.append(set(found))
    assert sum(len(found) > 0 for found in counts) > 4
    assert any(len(found) > 1 for found in counts) == (law == "perfectly_rough")


def test_a_margin_that_is_found_honours_the_catch_and_the_settings():
    t = 2.5 * np.pi / 40
    case = BASE.replace("release.position.z", 0.2 + G * t * t / 2 + 1e-4, "ending.caught", 0.2)
    height = margins(case, offered_proofs())[0]
    assert height.change == pytest.approx(-0.1, rel=1e-6)
    assert "-0.101 mm, proved to be above 0.05 mm" in height.line
    few = replace(analytic.FINE, contact_steps=1)
    plastic = BASE.replace("floor.restitution", 0.0)
    found = margins(plastic, settings=few)[0]
    assert len(set(outcomes_within(plastic, QUANTITIES[0], found.change / 1e3, few))) == 2
    assert found.change != margins(plastic)[0].change


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (("floor.restitution_threshold", 1e-3), "floor.restitution_threshold: 0.001, accepted: 0"),
        (("ending.test", "lying"), "ending.test: lying, accepted: rigorous, paper, paper_smooth"),
        (("--contact-steps", "900"), "--contact-steps: 900, accepted: none"),
    ],
)
def test_the_command_says_why_no_margin_of_a_planar_coin_is_proved(tmp_path, given, said):
    path, is_option = tmp_path / "coin.toml", given[0].startswith("--")
    path.write_text((BASE if is_option else BASE.replace(*given)).to_toml())
    lines = cointoss("toss", path, "--margin", *(given if is_option else ())).stdout.splitlines()
    assert lines[-1] == f"proved    none, for {said}"
    assert "proved to be above" not in "\n".join(lines)
