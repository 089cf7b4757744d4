"""Where a coin comes to rest: by closed forms on both engines, and why it does not."""

from math import hypot, nan, pi, remainder, sqrt
from typing import Any

import numpy as np
import pytest

import cointoss
from cointoss import analytic, load, toss_many
from cointoss.compare.engines import Engine
from cointoss.compare.output.answer import rest_as_json
from cointoss.models.attitude import rotation_matrix
from tests.helpers.draws import scenario

G, R, H, MU, V, W = 9.81, 1.25e-2, 2e-3, 0.05, 0.5, 40.0
COIN = {"mass": 5e-3, "radius": R, "thickness": H}
STOP, WAY = V / (MU * G), V**2 / (2 * MU * G)
DROP, DELTA, PIVOT = 0.05, 2e-4, 1e-3
FALL = sqrt(2 * DROP / G)


def on(release, ending=None, coin=None, **floor):
    """Return a coin that starts flat on a Coulomb floor if nothing else is said."""
    return scenario(
        coin={**COIN, **(coin or {})},
        floor={"contact": "coulomb", "friction": MU, "restitution": 0.5, **floor},
        release={"position": [0, 0, H / 2], **release},
        ending=ending or {},
    )


def resting(case, engine="analytic", **how) -> Any:
    """Return a toss that is followed to where its coin rests."""
    return cointoss.toss(case, engine, rest=True, **how)


SLIDES, SPINS = on({"velocity": [V, 0, 0]}), {"angular_velocity": [0, 0, W]}
ROLLS = {
    **{"position": [0, 0, R], "angles": [0, pi / 2, 0]},
    **{"velocity": [0.3, 0, 0], "angular_velocity": [0, 0, -0.3 / R]},
}
DROPPED = {"position": [0, 0, H / 2 + DROP], "velocity": [V, 0, 0]}
TURNED, PIVOTED = 3 * R * W**2 / (8 * MU * G), (R * W) ** 2 / (4 * PIVOT * G)
RESTS = {
    "slides aslant": (
        on({"velocity": [0.6 * V, 0.8 * V, 0], "angles": [0.5, 0, 0]}),
        {"time": STOP, "x": 0.6 * WAY, "y": 0.8 * WAY, "heading": 0.5, "path": WAY},
    ),
    "pivots, heads up: to the left": (
        on(SPINS, friction=0.0, pivoting_friction=PIVOT),
        {"x": 0, "heading": remainder(PIVOTED, 2 * pi), "path": 0},
    ),
    "pivots, tails up: to the right": (
        on({**SPINS, "angles": [0, pi, 0]}, friction=0.0, pivoting_friction=PIVOT),
        {"x": 0, "heading": -remainder(PIVOTED, 2 * pi), "path": 0},
    ),
    "rolls on its edge, its normal along -y": (
        on(ROLLS, rolling_friction=DELTA),
        {"x": 0.3**2 / 2 * 1.5 * R / (DELTA * G), "heading": -pi / 2},
    ),
    "has backspin on its edge, of which friction takes all, and its speed": (
        on({**ROLLS, "velocity": [V, 0, 0], "angular_velocity": [0, 0, 2 * V / R]}),
        {"x": WAY, "heading": -pi / 2, "path": WAY},
    ),
    "bounces flat, whose touches know no friction, and slides": (
        on(DROPPED),
        {
            "time": 3 * FALL + STOP,
            "x": V * 3 * FALL + WAY,
            "heading": 0,
            "path": V * 2 * FALL + WAY,
        },
    ),
}
# Below 1e-3 √(g/r) our resistance to rolling dies away with the spin. MuJoCo's coin creeps to its rest for
# some milliseconds, and its last bounces are a contact with friction.
NEAR = {Engine.ANALYTIC: 2e-4, Engine.MUJOCO: 5e-3}


@pytest.mark.parametrize("engine", Engine)
@pytest.mark.parametrize("name", RESTS)
def test_a_coin_rests_where_the_closed_form_says(name, engine):
    case, expected = RESTS[name]
    toss = resting(case, engine)
    found = {one: getattr(toss.rest, one) for one in expected}
    assert found == pytest.approx(expected, rel=NEAR[engine], abs=1e-6)
    assert toss.rest.time == toss.path_end
    assert toss.rest.error < 1e-4


def test_friction_of_the_face_stops_a_spin():
    rest = resting(on(SPINS)).rest
    due = (3 * R * W / (4 * MU * G), remainder(TURNED, 2 * pi))
    assert (rest.time, rest.heading) == pytest.approx(due, rel=1e-6)


def test_the_place_is_that_of_the_coin_s_centre():
    """Of an unbalanced coin the path has it at C."""
    case = on({"velocity": [V, 0, 0], **SPINS}, coin={"center_of_mass": [2e-3, 1e-3, 0]})
    toss = resting(case)
    rest, states = toss.rest, toss.sample(toss.rest.time)
    Rm = np.array(rotation_matrix(tuple(states.quaternion[0])))
    place = states.position[0] - Rm @ case.coin.center_of_mass
    due = (*place[:2], np.arctan2(Rm[1, 0], Rm[0, 0]))
    assert (rest.x, rest.y, rest.heading) == pytest.approx(due, abs=1e-12)


SMOOTH = {"contact": "smooth", "friction": 0.0}


@pytest.mark.parametrize("engine", Engine)
@pytest.mark.parametrize(
    ("case", "reason"),
    [
        (on({"velocity": [V, 0, 0]}, **SMOOTH), "frictionless"),
        (on({"velocity": [V, 0, 0]}, slope=0.1), "slope"),
        (on({"velocity": [V, 0, 0]}, {"max_time": 0.2}), "moving"),
        (on(DROPPED, {"max_impacts": 1}), "undecided"),
        (on(DROPPED, {"caught": 0.03}), "caught"),
        (on({"position": [0, 0, DROP]}, **SMOOTH), "at_rest"),
    ],
)
def test_where_a_coin_does_not_rest_there_is_a_reason(case, reason, engine):
    toss = resting(case, engine)
    assert (toss.rest_reason, toss.rest is None) == (reason, reason != "at_rest")


def test_a_coin_whose_steps_are_spent_is_not_at_rest():
    assert resting(load("table"), settings=analytic.AnalyticSettings(contact_steps=2)).rest_reason == "moving"


def test_an_error_is_about_that_of_the_engine():
    """Of a coin that wobbles to rest finer steps are as far off as is said, and MuJoCo's at most so far."""
    table, fine = load("table"), analytic.AnalyticSettings(contact_tolerance=1e-12)
    tosses = resting(table), resting(table, settings=fine), resting(table, "mujoco")
    ours, finer, theirs = (toss.rest for toss in tosses)
    assert ours.error / 100 < hypot(ours.x - finer.x, ours.y - finer.y) < 10 * ours.error
    assert hypot(ours.x - theirs.x, ours.y - theirs.y) < theirs.error < 5e-3
    dropped = on({"position": [0, 0, 0.016], "angles": [0, 0.5, 0]}, rolling_friction=DELTA)
    assert resting(dropped, "mujoco").rest.error > 0


@pytest.mark.parametrize("engine", Engine)
def test_many_rest_as_one_does_and_a_store_has_them(engine, tmp_path):
    vary = {"contact": ["coulomb", "smooth"], "release.velocity.x": [[0.1], [0.2]], "restitution": 0.5}
    ds = toss_many(SLIDES, vary, engine=engine, rest=True)
    for at in np.ndindex(ds.outcome.shape):
        here = ds[dict(zip(ds.outcome.dims, at, strict=True))]
        given = [part for name, one in here.coords.items() for part in (name, one.item())]
        case = ds.cointoss.scenario.replace(*given)
        said = rest_as_json(resting(case, engine, settings=engine.package.MANY))
        assert here.rest_reason == said["rest_reason"]
        for name in ("time", "x", "y", "heading", "path", "error"):
            expected = nan if said["rest"] is None else said["rest"][name]
            assert np.array_equal(here[f"rest_{name}"], expected, equal_nan=True), name
    for resume in (False, True):
        kept = toss_many(SLIDES, vary, engine=engine, rest=True, out=tmp_path / "a.zarr", resume=resume)
        assert all(kept.cointoss.words[name].equals(ds[name]) for name in ds.data_vars)


def test_what_is_no_scenario_rests_nowhere():
    ds = toss_many(SLIDES, {"restitution": [0.5, 1.5]}, rest=True, errors="keep")
    assert ds.rest_reason.values.tolist() == ["at_rest", "refused"]
    assert np.isnan(ds.rest_x.values).tolist() == [False, True]
    assert "rest_x" not in toss_many(SLIDES, {"restitution": [0.5]})
