"""How far two heads-and-tails sequences agree, and how far they must."""

import analytic
from models.records import Toss
from models.scenario import Release


def common_prefix(a: str, b: str) -> int:
    """Count the leading symbols that two sequences share."""
    n = min(len(a), len(b))
    return next((i for i in range(n) if a[i] != b[i]), n)


def agreement_horizon(toss: Toss, error: float) -> int:
    """Count the leading impacts whose faces two engines share if their impulses differ by `error`.

    The toss is repeated from its first impact with that impulse too large, and too small, by `error`: what
    parts these from the toss is chaos alone, acting on so small a difference.

    Args:
        toss: by the analytic engine.
        error: relative difference of the first impulse.
    """
    impacts, scenario = toss.impacts, toss.scenario
    if len(impacts) < 2:
        return len(impacts)
    shared = len(impacts)
    for part in (error, -error):
        v, w = (
            after + part * (after - before)
            for before, after in (
                (impacts.velocity_before[0], impacts.velocity_after[0]),
                (impacts.angular_velocity_before[0], impacts.angular_velocity_after[0]),
            )
        )
        release = Release(
            position=tuple(impacts.position[0].tolist()),
            velocity=tuple(v.tolist()),
            quaternion=tuple(impacts.quaternion[0].tolist()),
            angular_velocity=tuple(w.tolist()),
        )
        again = analytic.toss(scenario.model_copy(update={"release": release}))
        shared = min(shared, 1 + common_prefix(toss.sequence[1:], again.sequence))
    return shared


def aligned(a: str, b: str) -> list[tuple[str, str]]:
    """Pair two sequences symbol by symbol, "" where one has ended."""
    n = max(len(a), len(b))
    return list(zip((*a, *[""] * (n - len(a))), (*b, *[""] * (n - len(b))), strict=True))
