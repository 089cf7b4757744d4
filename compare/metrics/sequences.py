"""How far two heads-and-tails sequences agree, and how far they must."""

from cointoss import analytic
from cointoss.models.attitude import rotation_matrix
from cointoss.models.entries import turn_each
from cointoss.models.geometry import gap
from cointoss.models.records import Array, Toss
from cointoss.models.scenario import Scenario, euler_parameters

TOUCHING = 1e-9
"""The height above the floor of a coin that is to touch at once, over r."""
SAFETY = 2.0
"""The horizon assumes errors larger than those measured by this factor."""


def common_prefix(a: str, b: str) -> int:
    """Count the leading symbols that two sequences share."""
    n = min(len(a), len(b))
    return next((i for i in range(n) if a[i] != b[i]), n)


def agreement_horizon(toss: Toss, errors: Array, late: Array | None = None) -> int:
    """Count the leading impacts whose faces an engine with these `errors` in its impulses must share.

    The toss is repeated from each of its impacts in turn, with that impulse too large, and too small, by
    `SAFETY` times the largest error up to there: only chaos separates these from the toss. After an impulse
    that is wrong by its whole size, no face must be shared.

    Args:
        toss: by the analytic engine.
        errors: relative errors of the other engine's leading impulses, (n,).
        late: how early or late the other engine's touches may be, (n,) [s]; the toss is repeated from each
            touch in an attitude that much earlier, and later, too.
    """
    impacts, scenario = toss.impacts, toss.scenario
    shared = min(len(impacts), len(errors))
    for i in range(shared):
        if i >= shared:
            break
        error = SAFETY * errors[: i + 1].max()
        if error >= 1:
            return i + 1
        for part in (error, -error):
            spin, spin_after = impacts.angular_velocity_before[i], impacts.angular_velocity_after[i]
            release = {
                "position": impacts.position[i],
                "velocity": _beyond(impacts.velocity_before[i], impacts.velocity_after[i], part),
                "quaternion": impacts.quaternion[i],
                "angular_velocity": _beyond(spin, spin_after, part),
            }
            most = max(shared - i - 1, 1)
            again = analytic.toss(scenario.replace("release", release, "ending.max_impacts", most))
            shared = min(shared, i + 1 + common_prefix(toss.sequence[i + 1 :], again.sequence))
        for span in () if late is None else (late[: i + 1].max(), -late[: i + 1].max()):
            again = analytic.toss(
                _touching_at(toss, i, span).replace("ending.max_impacts", max(shared - i, 1))
            )
            shared = min(shared, i + common_prefix(toss.sequence[i:], again.sequence))
    return shared


def _touching_at(toss: Toss, i: int, late: float) -> Scenario:
    """Return a scenario that begins at an impact of a toss, in the attitude so much later [s]."""
    impacts, body = toss.impacts, toss.scenario.body
    w = impacts.angular_velocity_before[i]
    attitudes = impacts.quaternion[i : i + 1].copy()
    turn_each(attitudes, late * w[None, :])
    attitude = euler_parameters(attitudes[0])
    x, y, z = impacts.position[i].tolist()
    release = {
        "position": (x, y, z - gap(body, z, rotation_matrix(attitude)[2]) + TOUCHING * body.radius),
        "velocity": impacts.velocity_before[i],
        "quaternion": attitude,
        "angular_velocity": w,
    }
    return toss.scenario.replace("release", release)


def _beyond(before: Array, after: Array, part: float) -> Array:
    return after + part * (after - before)
