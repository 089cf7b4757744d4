"""When a face or the edge is final: situations just below and just above the closed form that decides."""

from itertools import product

import numpy as np
import pytest

from cointoss.models.attitude import quaternion_from_angles, rotation_matrix
from cointoss.models.barriers import spin_barrier
from cointoss.models.ending import (
    cannot_be_caught,
    endless,
    final_face,
    followed_until,
    moments_may_grow,
    out_of_steps,
    unless_caught,
)
from cointoss.models.geometry import gap
from cointoss.models.making import AT_REST
from cointoss.models.perpetual import energy_history
from cointoss.models.records import Ending, Outcome
from cointoss.models.state import state
from tests.helpers.draws import AIR, IMPERFECT, THIN, ZLOTY, scenario

STILL = (0.0, 0.0, 0.0)
NONE = (Outcome.UNDECIDED, Ending.NONE)
HEADS, TAILS = (Outcome.HEADS, Ending.SETTLED), (Outcome.TAILS, Ending.SETTLED)
EDGE, LYING = (Outcome.EDGE, Ending.SETTLED), (Outcome.HEADS, Ending.LYING)
PAPER, PAPER_SMOOTH = (Outcome.HEADS, Ending.PAPER), (Outcome.HEADS, Ending.PAPER_SMOOTH)
UPRIGHT = np.pi / 2
G, R, H = 9.81, ZLOTY["radius"], ZLOTY["thickness"]


@pytest.fixture(autouse=True)
def _silent():
    """Compiled code divides by zero in silence."""
    with np.errstate(divide="ignore", invalid="ignore"):
        yield


def touching(body, tilt, v=STILL, w=STILL):
    """Return the state of a coin that touches the floor with this tilt."""
    e = quaternion_from_angles((0.0, tilt, 0.0))
    z = -gap(body, 0.0, rotation_matrix(e)[2])
    return state((0.0, 0.0, z), v, e, tuple(np.array(w, dtype=float)))


def up(part, tilt=0.3):
    """Return a velocity upwards that lifts the zloty by a part of what its mass centre is below the pass."""
    below = np.hypot(R, H / 2) - (R * np.sin(tilt) + H / 2 * np.cos(tilt))
    return (0.0, 0.0, np.sqrt(2 * G * below * part))


def to_mgr(part, tilt=0.01):
    """Return a speed whose energy is a part of what the zloty lacks of m g r."""
    return np.sqrt(2 * G * (R - R * np.sin(tilt) - H / 2 * np.cos(tilt)) * part)


SMOOTH, ROUGH = {"contact": "smooth"}, {"contact": "coulomb", "friction": 0.3}
ENERGETIC = {**ROUGH, "restitution_kind": "energetic"}
FED = {**ENERGETIC, "slope": 0.2}
THICK = {**ZLOTY, "thickness": 0.01}
AS_WIDE = {**ZLOTY, "thickness": 2 * R}
TALL = {"mass": 5e-3, "radius": 5e-3, "thickness": 0.02}
FAST = {"v": (2.0, 0.0, 0.0), "w": (0.0, 0.0, 300.0)}
SLIDES, SPINS, DRIFTS = {"v": (2.0, 0.0, 0.0)}, {"w": (0.0, 0.0, 300.0)}, {"v": (0.6, 0.0, 0.0)}
TURNS = {"v": (0.3, 0.0, 0.0), "w": (0.0, 0.0, 2.0)}
PAPERS, SMOOTH_TEST, WAITS = ({"ending": {"test": test}} for test in ("paper", "paper_smooth", "lying"))
FAST_AND_FLAT = {
    "rigorous": {"smooth": HEADS},
    "paper": {},
    "paper_smooth": {"smooth": PAPER_SMOOTH, "coulomb": PAPER_SMOOTH, "perfectly_rough": PAPER_SMOOTH},
}
"""How a coin that slides and spins flat ends, by test and law, where energy settles it before it lies."""
SITUATIONS = {
    "below the pass": ({"air": AIR}, 0.3, {"v": up(0.99)}, HEADS),
    "above the pass": ({"air": AIR}, 0.3, {"v": up(1.01)}, NONE),
    "tails, below the pass": ({"air": AIR}, np.pi - 0.3, {"v": up(0.99)}, TAILS),
    "tails, above the pass": ({"air": AIR}, np.pi - 0.3, {"v": up(1.01)}, NONE),
    "a law that may add energy": ({"floor": {"contact": "knurled"}}, 0.3, {}, PAPER),
    # E < m g r; eq. (20) leaves out what slides, and what spins about the vertical.
    "paper, below m g r": (PAPERS, 0.01, {"v": (to_mgr(0.99), 0.0, 0.0)}, PAPER),
    "paper, above m g r": (PAPERS, 0.01, {"v": (to_mgr(1.01), 0.0, 0.0)}, NONE),
    "eq. (20), sliding": (SMOOTH_TEST, 0.01, {"v": (to_mgr(1.01), 0.0, 0.0)}, PAPER_SMOOTH),
    "eq. (20), spinning": (SMOOTH_TEST, 0.01, SPINS, PAPER_SMOOTH),
    "eq. (20), below m g r": (SMOOTH_TEST, 0.01, {"v": (0.0, 0.0, to_mgr(0.99))}, PAPER_SMOOTH),
    "eq. (20), above m g r": (SMOOTH_TEST, 0.01, {"v": (0.0, 0.0, to_mgr(1.01))}, NONE),
    # A smooth floor conserves v_h and L_z in vacuum, whatever exponent the missing air has.
    "fast in vacuum": ({}, 0.05, FAST, HEADS),
    "fast in friction of the air": ({"air": {"tangential": 0.2, "exponent": 1.0}}, 0.05, FAST, NONE),
    "fast in pressure of the air": ({"air": {"normal": 0.8, "exponent": 0.5}}, 0.05, FAST, NONE),
    "fast without air, b = 1/2": ({"air": {"exponent": 0.5}}, 0.05, FAST, HEADS),
    "fast and unbalanced in vacuum": ({"coin": IMPERFECT}, 0.05, FAST, HEADS),
    # Linear air lifts a twentieth of the sliding, and no spin of a balanced coin where nothing resists it.
    "sliding in linear air": ({"air": AIR}, 0.05, SLIDES, HEADS),
    "sliding unbalanced in linear air": ({"coin": IMPERFECT, "air": AIR}, 0.05, SLIDES, HEADS),
    "sliding too fast in linear air": ({"air": AIR}, 0.05, {"v": (8.0, 0.0, 0.0)}, NONE),
    "spinning in linear air": ({"air": AIR}, 0.05, SPINS, HEADS),
    "spinning unbalanced in linear air": ({"coin": IMPERFECT, "air": AIR}, 0.05, SPINS, NONE),
    "spinning against resistance": ({"air": AIR, "floor": {"rolling_friction": 1e-4}}, 0.05, SPINS, NONE),
    # L_z - L_ζ cos s grows on the way up for one sense of the spin, and shrinks for the other.
    "leaning, kept down by its spin": ({}, UPRIGHT - 0.05, {"w": (0.0, 25.0, 40.0)}, HEADS),
    "leaning, lifted by its spin": ({}, UPRIGHT - 0.05, {"w": (0.0, 25.0, -40.0)}, NONE),
    **{
        f"upright within {aside:g} rad, {coin['thickness']:g} m thick": (
            {"coin": coin},
            UPRIGHT + aside,
            {"w": (0.0, 60.0, 0.0)},
            expected,
        )
        for aside in (-1e-9, -1e-12, 0.0, 1e-12, 1e-9)
        for coin, expected in ((THIN, NONE), (ZLOTY, EDGE))
    },
    "upright, tipped by its roll": ({}, UPRIGHT, {"w": (0.0, 10.0, G * H / (R * R * 10))}, NONE),
    "rolling in linear air": ({"air": AIR}, UPRIGHT, {"w": (0.0, 0.0, 60.0)}, EDGE),
    "rolling in other air": ({"air": {**AIR, "exponent": 0.5}}, UPRIGHT, {"w": (0.0, 0.0, 60.0)}, NONE),
    "rolling unbalanced": ({"coin": IMPERFECT, "air": AIR}, UPRIGHT, {"w": (0.0, 0.0, 60.0)}, NONE),
    # Upright a coin as thick as wide is as high as flat.
    "as thick as wide, upright": ({"coin": AS_WIDE, "floor": ROUGH}, UPRIGHT - 1e-10, DRIFTS, NONE),
    "as thick as wide, beyond": ({"coin": AS_WIDE, "floor": ROUGH}, UPRIGHT + 1e-10, DRIFTS, NONE),
    "as thick as wide, flat": ({"coin": AS_WIDE, "floor": ROUGH}, 0.0, DRIFTS, LYING),
    "thick, on its edge": ({"coin": THICK, "air": AIR}, UPRIGHT - 0.05, {}, EDGE),
    "thick, beyond its edge": ({"coin": THICK, "air": AIR}, UPRIGHT + 0.05, {}, EDGE),
    "thick, too fast": ({"coin": THICK, "air": AIR}, UPRIGHT - 0.05, {"v": (0.0, 0.0, 0.2)}, NONE),
    # C is 1 mm off towards the lowest point: the pass is at tan(tilt) = 11.5/5, where it is at 12.54 mm.
    "thick and unbalanced, beyond its pass": (
        {"coin": {**THICK, "center_of_mass": [0.0, -1e-3, 0.0]}},
        1.2,
        {},
        EDGE,
    ),
    # With C 1.5 mm off B the passes are at 14.1 and 13.0 mm, and C may rise to 13.5.
    "thick and unbalanced, between its passes": (
        {"coin": {**THICK, "center_of_mass": [0.0, 0.0, 1.5e-3]}},
        UPRIGHT - 0.05,
        {"v": (0.0, 0.0, 0.116)},
        NONE,
    ),
    **{
        f"flat, {law}, {test}": (
            {"floor": {"contact": law, "friction": 0.3}, "ending": {"test": test}},
            0.0,
            {"v": (3.0, 0.0, 0.0), "w": (0.0, 0.0, 300.0)},
            by_energy.get(law, LYING),
        )
        for test, by_energy in FAST_AND_FLAT.items()
        for law in ("smooth", "coulomb", "perfectly_rough")
    },
    "flat, a law without contact": ({"floor": {"contact": "sharp_edge"}}, 0.0, {"v": (3.0, 0.0, 0.0)}, NONE),
    # A tilt s raises C by m g r s; still to the eye is a thousandth of m g r.
    "waiting for it to lie": (WAITS, 1.1e-3, {}, NONE),
    "still to the eye": (WAITS, 0.9e-3, {}, LYING),
    "spins flat, tilted": ({"coin": IMPERFECT, "air": AIR}, 1e-3, SPINS, NONE),
    # A slope feeds all but what turns a coin on a smooth floor in vacuum.
    "slope, smooth": ({"floor": {"slope": 0.2}}, 0.3, {}, HEADS),
    "slope, contour friction": ({"floor": {"slope": 0.2, "contour_friction": 1e-4}}, 0.3, {}, HEADS),
    "slope, rolling friction": ({"floor": {"slope": 0.2, "rolling_friction": 1e-4}}, 0.3, {}, HEADS),
    "slope, in air": ({"floor": {"slope": 0.2}, "air": AIR}, 0.3, {}, NONE),
    "level, rough": ({"floor": ENERGETIC}, 0.3, {}, HEADS),
    "slope, rough": ({"floor": FED}, 0.3, {}, NONE),
    "slope, may add energy": ({"floor": {"contact": "knurled", "slope": 0.2}}, 0.3, {}, NONE),
    # The barrier is that of the part of gravity along the normal.
    "slope, below the pass": ({"floor": {"slope": 1.0}}, 0.3, {"v": up(0.99 * np.cos(1.0))}, HEADS),
    "slope, above the pass": ({"floor": {"slope": 1.0}}, 0.3, {"v": up(1.01 * np.cos(1.0))}, NONE),
    "slope, fast": (
        {"floor": {"slope": 0.3, "contour_friction": 1e-4}},
        0.1,
        {"v": (30.0, 0.0, 0.0)},
        HEADS,
    ),
    # tan(0.4) > μ = 0.3: a balanced coin slides away flat, of another nothing is known.
    "slope, balanced, held": ({"floor": FED, **WAITS}, 0.0, TURNS, LYING),
    "slope, balanced, sliding": ({"floor": {**FED, "slope": 0.4}, **WAITS}, 0.0, TURNS, LYING),
    "slope, unbalanced, held": ({"coin": IMPERFECT, "floor": FED, **WAITS}, 0.0, TURNS, LYING),
    "slope, unbalanced, sliding": (
        {"coin": IMPERFECT, "floor": {**FED, "slope": 0.4}, **WAITS},
        0.0,
        TURNS,
        NONE,
    ),
    # It topples over its rim from tan(slope) = r/(h/2) = 1/2 on.
    **{
        f"slope, a tall coin at {tan}": (
            {"coin": TALL, "floor": {"contact": "perfectly_rough", "slope": float(np.arctan(tan))}},
            0.0,
            {},
            expected,
        )
        for tan, expected in ((0.49, LYING), (0.51, NONE))
    },
    # Nothing but gravity acts along a smooth floor in vacuum, which turns no coin.
    **{
        f"slope, smooth, pivoting, {name}": (
            {"coin": IMPERFECT, "floor": {"slope": 0.3, "pivoting_friction": 1e-5}, "air": air, **WAITS},
            0.0,
            TURNS,
            expected,
        )
        for name, air, expected in (("vacuum", {}, LYING), ("air", AIR, NONE))
    },
}


@pytest.mark.parametrize(("parts", "tilt", "motion", "expected"), SITUATIONS.values(), ids=SITUATIONS)
def test_a_face_or_the_edge_is_final_where_the_closed_form_says(parts, tilt, motion, expected):
    case = scenario(**parts)
    assert final_face(case.body, case.rules, touching(case.body, tilt, **motion), 0.0) == expected


@pytest.mark.parametrize(("turn", "roll", "held"), [(0, 0, 1), (60, 0, 1), (10, 11, 0.1), (-11, 10, 0.1)])
@pytest.mark.parametrize("is_below", [True, False])
def test_an_upright_coin_is_held_on_its_edge_by_its_weight_against_its_spin(turn, roll, held, is_below):
    """C must rise by about g h²/(8 r); turning adds (J_ξ/m) (turn h/(2 r))²/2, rolling too lowers a pass."""
    by_mass = R**2 / 4 + H**2 / 12
    rise = G * (np.hypot(R, H / 2) - R) + by_mass * (turn * H / (2 * R)) ** 2 / 2
    v = (0.5, 0.0, np.sqrt(2 * rise * (0.98 * held**2 if is_below else 1.02)))
    upright = touching(scenario().body, UPRIGHT, v, (0, turn, roll))
    assert final_face(scenario().body, scenario().rules, upright, 0.0) == (EDGE if is_below else NONE)


@pytest.mark.parametrize("pivoting", [0.0, 1e-2])
@pytest.mark.parametrize("floor", [SMOOTH, {"contact": "coulomb", "friction": 0.2}])
def test_a_flat_coin_lies_unless_its_unbalanced_spin_lifts_it(floor, pivoting):
    """J_⊥ζ takes ω² and its slowing; the weight bears m g (r - |c|) less friction at C's height."""
    case = scenario(coin=IMPERFECT, floor={**floor, "pivoting_friction": pivoting}, **WAITS)
    J, c, mu = case.body.inertia, case.body.center, case.floor.friction
    weight = case.body.mass * G
    borne = weight * (R - np.hypot(c[0], c[1]) - mu * (H / 2 + c[2]))
    fastest = np.sqrt(borne / np.hypot(J[0][2], J[1][2]) - weight * (mu * R + pivoting) / J[2][2])
    for part, expected in ((1 - 1e-6, LYING), (1 + 1e-6, NONE)):
        spinning = touching(case.body, 0.0, w=(0.0, 0.0, part * fastest))
        assert final_face(case.body, case.rules, spinning, 0.0) == expected


@pytest.mark.parametrize("center", [STILL, IMPERFECT["center_of_mass"]])
def test_a_coin_upright_within_rounding_still_needs_its_spin(center):
    body, w = scenario(coin={**ZLOTY, "center_of_mass": center}).body, (0.0, 30.0, 0.0)
    exactly, beyond = (spin_barrier(body, (0.0, sine, 0.0), w) for sine in (1.0, np.nextafter(1.0, 2.0)))
    assert beyond == pytest.approx(exactly, rel=1e-12)
    assert exactly > body.mass * body.gravity * body.radius / 2


def test_an_unbalanced_coin_lies_where_friction_outweighs_the_slope_and_its_arm():
    body = scenario(coin=IMPERFECT, floor={"slope": 0.3}).body
    least = np.tan(0.3) * (1 + 1.5 * np.linalg.norm(body.center) / body.radius)
    assert moments_may_grow(body, 0.99 * least)
    assert not moments_may_grow(body, 1.01 * least)
    assert not moments_may_grow(scenario(coin=IMPERFECT).body, 0.0)


@pytest.mark.parametrize(
    ("floor", "caught", "cannot"),
    [
        (SMOOTH, 0.5, True),
        (SMOOTH, 0.013, False),
        (ROUGH, 0.5, False),
        (ENERGETIC, 0.5, True),
        (FED, 0.5, False),
    ],
)
def test_a_height_is_out_of_reach_of_a_coin_without_the_energy_for_it_that_nothing_feeds(
    floor, caught, cannot
):
    case = scenario(floor=floor, ending={"caught": caught})
    rising = touching(case.body, 0.3, up(5.0))
    assert cannot_be_caught(case.body, case.rules, rising) == cannot
    assert not cannot_be_caught(case.body, scenario(floor=floor).rules, rising)


@pytest.mark.parametrize(
    ("outcome", "ending", "expected"),
    [
        (Outcome.HEADS, Ending.SETTLED, Ending.NOT_CAUGHT),
        (Outcome.EDGE, Ending.AT_REST, Ending.NOT_CAUGHT),
        (Outcome.TAILS, Ending.CAUGHT, Ending.CAUGHT),
        (Outcome.PERPETUAL, Ending.PERIODIC, Ending.PERIODIC),
    ],
)
def test_a_face_on_the_floor_is_no_outcome_where_a_hand_is_to_catch_the_coin(outcome, ending, expected):
    rules = scenario(ending={"caught": 0.3}).rules
    same = (outcome, ending)
    assert unless_caught(scenario().rules, outcome, ending) == same
    other = (Outcome.UNDECIDED, Ending.NOT_CAUGHT)
    assert unless_caught(rules, outcome, ending) == (same if expected == ending else other)


BUDGETS = ("max_impacts", "max_time", "chatter", "no_solution")
BUDGETS += ("contact_steps", "flight_steps", "rolling", "transient")


@pytest.mark.parametrize(
    ("ending", "until", "expected"),
    [
        *product(BUDGETS, [AT_REST], [2.0]),
        ("settled", 5.0, 5.0),
        ("settled", 1.0, 2.0),
        ("settled", 500.0, 100.0),
        ("lying", AT_REST, 62.0),
    ],
)
def test_a_coin_is_followed_for_as_long_as_is_asked_unless_a_budget_ended_its_toss(ending, until, expected):
    rules = scenario(ending={"max_time": 100.0}).rules
    assert followed_until(rules, Ending(ending), 2.0, until) == expected


@pytest.mark.parametrize(
    ("tilt", "checks", "spent", "for_ever"),
    [
        (0.3, 0, HEADS, HEADS),
        (0.3, 4, HEADS, HEADS),
        (UPRIGHT, 3, (Outcome.UNDECIDED, Ending.CONTACT_STEPS), (Outcome.PERPETUAL, Ending.PERIODIC)),
        (UPRIGHT, 4, (Outcome.TRANSIENT, Ending.TRANSIENT), (Outcome.PERPETUAL, Ending.PERIODIC)),
    ],
)
def test_what_meets_no_test_ends_by_its_energy_or_by_what_is_known_of_its_losses(
    tilt, checks, spent, for_ever
):
    """Four checks of the energy suffice to judge the losses; the thin coin upright is settled on no face."""
    case, history = scenario(coin=THIN, **PAPERS), energy_history(1e-12)
    history.energies[len(history.energies) - checks :] = 1.0
    here = touching(case.body, tilt, w=(0.0, 60.0, 0.0) if tilt == UPRIGHT else STILL)
    assert out_of_steps(case.body, case.rules, here, history) == spent
    assert endless(case.body, case.rules, here, history, Ending.PERIODIC) == for_ever
