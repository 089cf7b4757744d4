"""How far two heads-and-tails sequences agree, and how far they must."""

from cointoss import analytic
from cointoss.models.records import Array, Toss

SAFETY = 2.0
"""The horizon supposes errors so many times larger than those measured."""


def common_prefix(a: str, b: str) -> int:
    """Count the leading symbols that two sequences share."""
    n = min(len(a), len(b))
    return next((i for i in range(n) if a[i] != b[i]), n)


def agreement_horizon(toss: Toss, errors: Array) -> int:
    """Count the leading impacts whose faces must be shared by an engine that makes `errors` in its impulses.

    The toss is repeated from each of its impacts in turn, with that impulse too large, and too small, by
    `SAFETY` times the largest error up to there: only chaos separates these from the toss. After an impulse
    that is as wrong as none, no face must be shared.

    Args:
        toss: by the analytic engine.
        errors: relative errors of the other engine's leading impulses, (n,).
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
    return shared


def _beyond(before: Array, after: Array, part: float) -> Array:
    return after + part * (after - before)
