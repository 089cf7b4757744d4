"""How the paper's claims are measured, on cases whose answer is known."""

from types import SimpleNamespace

import numpy as np
import pytest

from cointoss.analytic.runs import run
from cointoss.analytic.toss import toss
from cointoss.models.attitude import rotation_matrix
from cointoss.models.batch import PLACE, states_of
from cointoss.models.laws import EndingTest
from cointoss.models.parts import Release
from cointoss.models.records import Ending, Outcome
from cointoss_reproduction.setups import fig24_readings
from cointoss_reproduction.setups.estimates import quotient
from cointoss_reproduction.setups.general_coins import CoinClass
from cointoss_reproduction.setups.hands import HEIGHTS, SPINS, states_of_hands
from cointoss_reproduction.setups.planar_maps import case, faces_after, planar_rows, touched_faces
from cointoss_reproduction.setups.uncertain_shares import ACCURACIES, slope_between
from cointoss_reproduction.studies.accuracy_and_stripes import study as accuracy_and_stripes
from cointoss_reproduction.studies.fig27 import study as fig27
from cointoss_reproduction.studies.fig31 import study as fig31
from cointoss_reproduction.studies.heads_in_a_ball import study as heads_in_a_ball
from cointoss_reproduction.studies.standing_coins import study as standing_coins
from cointoss_reproduction.studies.standing_coins.standing import standing
from cointoss_reproduction.studies.stop_test import study as stop_test
from cointoss_reproduction.studies.uniform_starts import study as uniform_starts


def test_hands_keep_their_habit():
    drawn = states_of_hands(np.random.default_rng(1), 50, 40, spread=0.02, aside=10.0)
    spin = drawn[:, 11].reshape(50, 40)
    assert np.all(spin.std(axis=1) / spin.mean(axis=1) < 0.035)
    assert spin.mean(axis=1).std() > 8
    exact = states_of_hands(np.random.default_rng(1), 500, aside=10.0)
    assert HEIGHTS[0] <= exact[:, 2].min() < exact[:, 2].max() <= HEIGHTS[1]
    assert SPINS[0] <= exact[:, 11].min() < exact[:, 11].max() <= SPINS[1]
    assert np.abs(exact[:, [10, 12]]).max() <= 10


def test_spread_over_cells_is_that_of_stripes_and_none_of_chance():
    rng = np.random.default_rng(2)
    z, w = rng.uniform(size=(2, 40_000))
    striped = np.floor(8 * z) % 2 == 0
    assert uniform_starts.spread_over_cells(z, w, striped, 8) == pytest.approx(0.5)
    assert uniform_starts.spread_over_cells(z, w, striped, 4) < 0.02
    assert uniform_starts.spread_over_cells(z, w, rng.uniform(size=40_000) < 0.5, 32) < 0.03


@pytest.mark.parametrize("alpha", [1.0, 0.4])
def test_the_exponent_of_uncertain_tosses_is_found_within_its_interval(alpha):
    scatter = np.random.default_rng(3).lognormal(sigma=0.2, size=(10, len(ACCURACIES)))
    found = slope_between(np.array(ACCURACIES) ** alpha * scatter, np.ones(scatter.shape), 3, 6)
    assert found.low < alpha < found.high
    assert 0.01 < found.high - found.low < 0.3


def test_touched_faces_are_those_of_single_tosses():
    scenario = case(air=True)
    faces = touched_faces(scenario, np.array([0.25, 0.41, 0.55]), np.array([25.0, 41.0, 57.0]), 15)
    release = Release(position=(0.0, 0.0, 0.41), angular_velocity=(41.0, 0.0, 0.0))
    whole = toss(scenario.replace("release", release))
    told = [*whole.impacts.face.tolist(), *[int(whole.outcome)] * 15][:15]
    assert len(whole.impacts) < 15
    assert faces[1].tolist() == told


def test_a_ball_has_its_radius_in_twelve_dimensions():
    scenario = case(air=True)
    r, g, radius = scenario.coin.radius, scenario.gravity, 0.01
    rows = heads_in_a_ball.ball_about(scenario, 0.4, 40.0, radius, 4000, np.random.default_rng(4))
    position, velocity, quaternion, spin = np.split(states_of(rows), [3, 6, 10], axis=1)
    size = np.sqrt(
        np.sum((position - [0, 0, 0.4]) ** 2, axis=1) / r**2
        + np.sum(velocity**2, axis=1) / (g * r)
        + 4 * np.sum(quaternion[:, 1:] ** 2, axis=1)
        + np.sum((spin - [40.0, 0, 0]) ** 2, axis=1) * r / g
    )
    # The angle of a turn differs from twice its sine's half by a part in 10⁵.
    assert size.max() < radius * (1 + 1e-4)
    # Half of a ball's volume lies beyond 0.5^(1/12) of its radius.
    assert np.mean(size > 0.5 ** (1 / 12) * radius) == pytest.approx(0.5, abs=0.04)


def test_a_boundary_is_found_to_rounding():
    scenario = case(air=True)
    z = heads_in_a_ball.boundary_above(scenario, 0.33, 37.0)
    beyond = np.array([z, np.nextafter(z, 1)])
    faces = faces_after(planar_rows(scenario, beyond, np.full(2, 37.0)), 50)
    assert faces[0] != faces[1]


def test_a_stripe_on_a_soft_floor_is_as_wide_as_its_map_shows():
    line = np.linspace(0.2, 0.6, 4001)
    faces = faces_after(planar_rows(case(air=True), line, np.full_like(line, 55.0)), 0)
    changes = line[np.flatnonzero(np.diff(faces))]
    low, high = changes[:2]
    middle = (low + high) / 2
    # A ladder of ten steps in a decade finds each end at most a quarter too far.
    (width,) = accuracy_and_stripes.stripe_widths("soft floor", np.array([middle]), np.array([55.0]))
    assert high - low - 2e-4 < width < 1.3 * (high - low)


def test_the_printed_sequences_of_fig_24_have_94_faces_and_begin_alike():
    assert sum(len(text.replace(fig24_readings.MARK, "")) for text in fig24_readings.PRINTED.values()) == 94
    assert fig24_readings.clusters_as_printed(list(fig24_readings.PRINTED.values()))
    assert sum(fig24_readings.shared(list(fig24_readings.PRINTED.values()))) == 94
    assert fig24_readings.shared(["T"] * 6) == [0] * 6
    assert len({reading.name for reading in fig24_readings.READINGS}) == len(fig24_readings.READINGS) == 90


def test_impacts_are_marked_where_a_flight_is_seen():
    faces = np.array([1, 1, 2, 2], dtype=np.int8)
    assert fig24_readings.marked(np.array([0.3, 0.7, 0.71, 1.1]), faces) == "H∘HT∘T"


@pytest.mark.parametrize("stripes", [3000, 300_000])
def test_stripes_are_counted_by_twins_as_far_as_they_are_wide(monkeypatch, stripes):
    """Their boundaries lie at random: twins as far apart as many equal stripes would look alike."""
    boundaries = np.sort(np.random.default_rng(4).uniform(*fig31.HEIGHTS, stripes))

    def alternating(rows, _impacts):
        return np.searchsorted(boundaries, rows[:, PLACE["release.position.z"]]) % 2

    monkeypatch.setattr(fig31, "faces_after", alternating)
    *_, (_, coarser, _), (_, seen, growth) = fig31._boundaries(
        case(air=True), np.random.default_rng(5), 40_000, 2
    )
    assert seen.low < stripes < seen.high
    assert growth.high < fig31.CONVERGED
    grown = quotient(seen, coarser)
    assert grown.low < growth.value < grown.high


def test_where_every_step_is_wider_than_the_stripes_no_number_is_taken_as_counted(monkeypatch):
    monkeypatch.setattr(
        fig31,
        "faces_after",
        lambda rows, _: np.sin(1e4 * np.sin(1e15 * rows[:, PLACE["release.position.z"]])) > 0,
    )
    found = fig31._boundaries(case(air=True), np.random.default_rng(5), 40_000, 2)
    assert min(growth.low for _, _, growth in found) > 5


def test_the_slope_of_a_curve_that_jumps_once_falls_with_the_steps_fitted():
    curve = np.append(0.0, np.full(40, 2.0))
    steps = np.arange(1, 41)
    assert fig27._slopes(curve) == pytest.approx(6 * 2.0 / ((steps + 1) * (steps + 2)))
    assert fig27._steps_of(fig27._slopes(curve), 12 / (20 * 21)) == 19


def test_neighbours_on_a_circle_have_near_images_where_there_is_a_map():
    angles = [1.0]
    for _ in range(2000):
        angles.append((angles[-1] + 1.2345 + 0.3 * np.sin(angles[-1])) % (2 * np.pi) - np.pi)
    apart, images = fig27._neighbours(np.array(angles))
    assert np.all(images < 1.3 * apart + 1e-9)
    random = np.random.default_rng(7).uniform(-np.pi, np.pi, 2000)
    assert np.median(fig27._neighbours(random)[1]) == pytest.approx(np.pi / 2, abs=0.1)


@pytest.mark.parametrize(
    ("outcome", "ending", "turned", "counted"),
    [
        (Outcome.HEADS, Ending.PAPER, False, [1, 0, 0, 0]),
        (Outcome.HEADS, Ending.PAPER, True, [1, 1, 1, 0]),
        (Outcome.TAILS, Ending.PAPER, False, [1, 1, 1, 0]),
        (Outcome.EDGE, Ending.PAPER, False, [1, 1, 1, 1]),
        (Outcome.PERPETUAL, Ending.PAPER, False, [1, 0, 1, 0]),
        (Outcome.PERPETUAL, Ending.PAPER, True, [1, 1, 1, 0]),
        (Outcome.TAILS, Ending.LYING, False, [0, 0, 0, 0]),
    ],
)
def test_a_named_face_is_left_where_another_comes_up_later(monkeypatch, outcome, ending, turned, counted):
    ends = [(outcome, Ending.SETTLED, 0.3), *[(Outcome.HEADS, ending, 0.2)] * 2]
    names = ("outcome", "ending", "end_time")
    answers = iter([SimpleNamespace(**dict(zip(names, np.array(end)[:, None], strict=True))) for end in ends])
    monkeypatch.setattr(stop_test, "toss_rows", lambda *_, **__: next(answers))
    monkeypatch.setattr(stop_test, "turns_over", lambda *_: turned)
    found = next(stop_test.stopped(False, False, False, False, ideals=1))
    assert [found[name] for name in ("named", "left", "maybe", "edges")] == counted


@pytest.mark.parametrize(
    ("rough", "start", "test", "comes_back"),
    [(True, (100, 10), EndingTest.PAPER, False), (False, (400, 10), EndingTest.PAPER_SMOOTH, True)],
)
def test_a_face_named_in_sustained_contact_is_left_there(rough, start, test, comes_back):
    """These coins slide where a face is named, and turn over without an impact; one of them turns back."""
    kind = CoinClass(thick=False, imperfect=True, air=True, coulomb=rough)
    body, rules, release = kind.scenario.body, kind.scenario.rules, kind.starts(start[0])[start[1]]
    stopped, whole = (run(body, rules._replace(test=each), release) for each in (test, EndingTest.RIGOROUS))
    assert any(first < stopped.end_time < last for first, last in whole.contacts)
    assert whole.rows["time"][-1] < stopped.end_time
    assert (stopped.outcome == whole.outcome) == comes_back
    times = (stopped.end_time, whole.end_time)
    assert stop_test.turns_over(body, rules, release, stopped.outcome, *times)
    assert not stop_test.turns_over(body, rules, release, stopped.outcome, times[0], times[0] + 1e-3)


def test_coins_that_stand_on_their_edge_come_below_m_g_r():
    """Where they are at rest C lies below B, and so lower than r."""
    found = stop_test.unasked(False, others=80)
    assert found == {"of": 80, "standing": 4, "below": 4}


def general_coin(*, thick):
    kind = CoinClass(thick=thick, imperfect=False, air=True, coulomb=False)
    return kind, kind.scenario.replace("floor.restitution", standing_coins.CHI)


@pytest.mark.parametrize("thick", [False, True])
@pytest.mark.parametrize("L", [(0.0, 0.0), (0.3, 0.0), (0.2, -0.1)])
def test_a_coin_stands_at_the_top_of_its_potential(thick, L):
    """At rest at the lean found its floor holds it there; L is in √(m² g r³)."""
    body = general_coin(thick=thick)[1].body
    m, g, r, h = body.mass, body.gravity, body.radius, body.thickness
    J, J_normal = body.inertia[0][0], body.inertia[2][2]
    L_z, L_normal = (part * np.sqrt(m**2 * g * r**3) for part in L)

    def upright(x):
        """Return the state that turns steadily at the angle x."""
        y = np.zeros(13)
        tilt = np.pi / 2 - x
        y[6:10] = np.cos(tilt / 2), np.sin(tilt / 2), 0, 0
        up = rotation_matrix(y[6:10])[2]
        y[2] = r * np.cos(x) + h / 2 * abs(np.sin(x))
        y[10:13] = 0, (L_z - L_normal * up[2]) / (J * up[1]), L_normal / J_normal
        return y

    x = np.linspace(1e-3, 0.7, 7000)
    states = np.array([upright(angle) for angle in x])
    near = standing(body, states)
    spinning = (L_z - L_normal * np.sin(x)) ** 2 / (2 * J * np.cos(x) ** 2)
    energy = m * g * states[:, 2] + spinning + L_normal**2 / (2 * J_normal)
    top = int(np.argmax(energy))
    # Of the thin coin without spin about its normal the top is upright, at an end of these angles.
    assert near.lean[0] == pytest.approx(x[top], abs=1.1e-3)
    assert near.energy[0] == pytest.approx(energy[top] / (m * g * r), rel=1e-6)
    assert near.lack[top] < 1e-6
    assert near.lack[-1] == pytest.approx((energy[top] - energy[-1]) / (m * g * r), rel=1e-5)
    if not any(L):
        assert near.rate[0] == pytest.approx(np.sqrt(m * g * np.hypot(r, h / 2) / J))


def test_a_coin_spun_too_fast_about_the_vertical_has_no_top():
    body = general_coin(thick=False)[1].body
    y = np.zeros(13)
    y[2], y[6:10], y[11] = body.radius, (np.sqrt(0.5), np.sqrt(0.5), 0, 0), 1.01 * 2 * np.sqrt(9.81 / 0.0125)
    assert standing(body, y[None]).lack == np.inf
    y[11] *= 0.9
    assert standing(body, y[None]).lack < 1e-9


@pytest.mark.parametrize("quantity", list(standing_coins.SPANS))
def test_a_general_coin_on_a_boundary_in_air_comes_to_stand(quantity):
    kind, scenario = general_coin(thick=False)
    found = None
    for start in kind.starts(20)[10:]:
        found = found or standing_coins.boundary_on(scenario, start, quantity)
    assert found is not None
    assert set(found.outcomes) == {Outcome.HEADS, Outcome.TAILS}
    low, high = found.places
    assert high == np.nextafter(low, np.inf)
    for place in found.places:
        assert standing_coins.nearest(*standing_coins.followed(found, place))[0] < standing_coins.STANDS
    away = standing_coins.nearest(*standing_coins.followed(found, low - standing_coins.SPANS[quantity] / 40))
    assert away[0] > standing_coins.STANDS


def test_a_quantity_of_a_release_varies_alone():
    start = CoinClass(thick=False, imperfect=False, air=True, coulomb=False).starts(1)[0]
    assert np.flatnonzero(standing_coins.at(start, "height", 0.5) - start).tolist() == [2]
    assert np.flatnonzero(standing_coins.at(start, "spin", 50.0) - start).tolist() == [11]
    turned, before = (
        np.array(rotation_matrix(y[6:10])) for y in (standing_coins.at(start, "tilt", 0.1), start)
    )
    assert turned @ before.T == pytest.approx(
        np.array([[1, 0, 0], [0, np.cos(0.1), -np.sin(0.1)], [0, np.sin(0.1), np.cos(0.1)]])
    )


@pytest.mark.slow
def test_the_side_on_which_a_flat_coin_lands_first_may_decide_its_face():
    found = standing_coins.beside_flat_landings(60)
    assert len(found) == 60
    differing = [one["off"] for one in found if one["differs"]]
    assert 6 < len(differing) < 36
    assert np.median(differing) > 0.1
