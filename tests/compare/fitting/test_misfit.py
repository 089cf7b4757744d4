"""The misfit of a toss: nothing of what was seen is cut off, and attitudes miss by rotations."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from cointoss import Observed, analytic
from cointoss.compare.fitting.misfit import IMPOSSIBLE, Misfit
from cointoss.compare.sweep.axes import Span
from tests.helpers.draws import scenario

COIN = scenario(
    release={"position": [0, 0, 0.3], "angles": [0.3, 0.5, 0.2], "angular_velocity": [12, 3, 5]},
    ending={"test": "lying"},
)
SPANS = (Span(field="floor.restitution", start=0.5, stop=0.9, unit=""),)
TRUE = np.array([[0.8]])


@pytest.mark.parametrize(("after", "most"), [(-0.03, 3), (0.1, COIN.rules.max_impacts)])
def test_a_toss_ends_with_its_last_touch_only_where_the_film_ended_before(after, most):
    toss = analytic.toss(COIN)
    touches = toss.impacts.time[:3]
    at = np.linspace(0.01, touches[-1] + after, 9)
    observed = Observed(
        touch_times=touches,
        touch_sd=1e-3,
        times=at,
        heights=toss.sample(at).position[:, 2],
        height_sd=1e-3,
    )
    misfit = Misfit(scenario=COIN, spans=SPANS, observed=observed)
    assert misfit.most_impacts == most
    assert misfit.residuals(TRUE)[0] == pytest.approx(np.zeros(12), abs=1e-6)


def test_an_attitude_misses_by_the_rotation_to_what_was_seen():
    at = np.array([0.05, 0.1])
    rotations = np.array([[0.3, -0.1, 0.2], [-2.0, 1.5, 0.5]])
    true = Rotation.from_quat(analytic.toss(COIN).sample(at).quaternion, scalar_first=True)
    seen = (true * Rotation.from_rotvec(rotations)).as_quat(scalar_first=True)
    for sign in (1, -1):
        observed = Observed(times=at, quaternions=1.01 * sign * seen, quaternion_sd=0.1)
        missed = Misfit(scenario=COIN, spans=SPANS, observed=observed).residuals(TRUE)[0]
        assert missed == pytest.approx(rotations.ravel() / 0.1, abs=1e-8)


def misses(clock=(), **given):
    """Return the residuals of the true coin, whose release the observer's clock shows as it does."""
    spans = (*SPANS, Span(field="clock", start=0.0, stop=2.0, unit="s")) if clock else SPANS
    return Misfit(scenario=COIN, spans=spans, observed=Observed(**given)).residuals(
        np.array([[0.8, *clock]])
    )[0]


TOSS = analytic.toss(COIN)
TOUCHES, FACES = TOSS.impacts.time[:3], "".join("HT"[face - 1] for face in TOSS.impacts.face[:3])
WRONG = FACES.translate(str.maketrans("HT", "TH"))
AT = np.array([0.03, 0.01, 0.02])
SAMPLED = TOSS.sample(AT)
TILTS = np.arccos(SAMPLED.normal[:, 2])
UP = [(TOSS.sample([at]).normal[0, 2]) for at in TOUCHES]


@pytest.mark.parametrize(
    ("given", "due"),
    [
        (
            {"touch_times": TOUCHES + np.array([0.002, -0.001, 0.0]), "touch_sd": [1e-3, 2e-3, 1e-3]},
            [2.0, -0.5, 0.0],
        ),
        ({"touch_times": TOUCHES[[0, 2]], "touch_numbers": [1, 3], "touch_sd": 1e-3}, [0.0, 0.0]),
        # The clock shows 1.5 s at the release.
        ({"clock": [1.5], "touch_times": TOUCHES + 1.502, "touch_sd": 1e-3}, [2.0, 2.0, 2.0]),
        ({"clock": [1.5], "times": AT + 1.5, "heights": SAMPLED.position[:, 2], "height_sd": 1.0}, [0.0] * 3),
        # A face on the wrong side misses by the normal's vertical part over the sine of a degree or so.
        ({"touch_times": TOUCHES, "touch_sd": 1.0, "faces": FACES}, [0.0] * 6),
        (
            {"touch_times": TOUCHES, "touch_sd": 1.0, "faces": WRONG[0] + "?" + WRONG[2]},
            [0.0, 0.0, 0.0, abs(UP[0]) / 0.02, abs(UP[2]) / 0.02],
        ),
        # Heights and tilts, in any order of their frames.
        (
            {"times": AT, "heights": SAMPLED.position[:, 2] + np.array([1e-3, 0, -2e-3]), "height_sd": 1e-3},
            [1.0, 0.0, -2.0],
        ),
        ({"times": AT, "tilts": TILTS + np.array([0.1, 0.0, -0.2]), "tilt_sd": 0.1}, [1.0, 0.0, -2.0]),
    ],
)
def test_a_residual_is_what_was_seen_less_what_is_shown_in_deviations(given, due):
    assert misses(**given) == pytest.approx(due, abs=1e-6)


def test_a_touch_that_is_not_made_misses_by_ten_deviations_at_least():
    """A flat coin that does not bounce touches once, at the root of 2 · 0.299 m / g."""
    seen = Observed(touch_times=[(2 * 0.299 / 9.81) ** 0.5, 9.0], touch_sd=1.0)
    flat = scenario(release={"position": [0, 0, 0.3]})
    missed = Misfit(scenario=flat, spans=SPANS, observed=seen).residuals(np.array([[0.0]]))[0]
    assert missed[0] == pytest.approx(0, abs=1e-9)
    assert abs(missed[1]) >= 10


@pytest.mark.parametrize(
    ("field", "inside", "outside"),
    [
        ("release.position.z", 0.2, -0.2),
        ("floor.restitution", 0.8, 1.2),
        ("coin.thickness", 2e-3, -2e-3),
        ("coin.center_of_mass.xi", 1e-3, 1.0),
    ],
)
def test_values_that_make_no_scenario_miss_everything_and_are_not_tossed(field, inside, outside):
    observed = Observed(touch_times=analytic.toss(COIN).impacts.time[:2], touch_sd=1.0)
    span = Span(field=field, start=outside, stop=inside, unit="")
    misfit = Misfit(scenario=COIN, spans=(span,), observed=observed)
    missed = misfit.residuals(np.array([[outside], [inside], [np.nan]]))
    assert np.all(missed[[0, 2]] == IMPOSSIBLE)
    assert np.all(np.abs(missed[1]) < 1)
