"""The poses of a coin between which a viewer may interpolate: times so dense that it misses by little."""

import numpy as np

from cointoss.models.records import Array, States, Toss, UnsupportedError

MISSES = 1e-3
"""How far a point of the coin may be from its place between two poses [radii]."""
PER_SECOND, MOST = 240, 1_000_000
"""The least number of poses in a second, and the most of a toss."""
LARGEST_TURN = 1.0
"""Between two poses, where places that fit might hide whole turns [rad]."""
BETWEEN = np.array([1, 2, 3]) / 4
"""The parts of the way between two poses at which it is measured what is missed. Of a path with a kink
elsewhere, at most 4/3 of that is missed."""


def keyframes(toss: Toss) -> tuple[States, float]:
    """Return poses of a toss from its start to the end of its path, denser where the coin turns unevenly.

    They lie at all impacts, and else where what is interpolated would miss by more than `MISSES`, as far as
    single precision tells times apart; the last one is up to two of its steps early.

    Returns:
        states: at times of single precision, of which a viewer needs the poses.
        error: how far a point of the coin is at most from its place between two of them [m], where the mass
            centre moves evenly along a line and the coin turns evenly.

    Raises:
        UnsupportedError: for a toss that takes more than `MOST` poses.
    """
    coin, end = toss.scenario.coin, float(np.nextafter(np.float32(toss.path_end), np.float32(0)))
    reach = coin.radius + coin.thickness / 2 + float(np.linalg.norm(coin.center_of_mass))
    even = np.linspace(0, end, min(int(end * PER_SECOND), MOST) + 2)
    events = np.concatenate(
        [toss.impacts.time, toss.later_times, toss.contacts.ravel(), toss.later.contacts.ravel()]
    )
    times = _single(even, np.minimum(events, end))
    while len(times) <= MOST:
        states = toss.sample(times)
        errors = 4 / 3 * np.max([_missed(toss, states, part, reach) for part in BETWEEN], axis=0)
        turns = np.linalg.norm(states.angular_velocity[:-1], axis=1) * np.diff(times)
        wide = (errors > MISSES * coin.radius) | (turns > LARGEST_TURN)
        finer = _single(times, (times[1:] + times[:-1])[wide] / 2)
        if len(finer) == len(times):
            return states, float(errors.max(initial=0.0))
        times = finer
    raise UnsupportedError(
        f"ending.max_time = {toss.scenario.ending.max_time:g}: accepted where poses are written: less, or "
        f"ending.max_impacts (this toss lasts {toss.path_end:g} s and takes more than {MOST:,d} poses)"
    )


def _single(*times: Array) -> Array:
    """Return the times, each once, rounded to single precision, in double precision."""
    return np.unique(np.concatenate(times).astype(np.float32)).astype(float)


def _missed(toss: Toss, states: States, part: float, reach: float) -> Array:
    """Return how far a point of the coin is at most from its place between two states, (n - 1,) [m].

    Args:
        toss: whose states they are.
        states: at n times.
        part: of the way from each to the next.
        reach: of the coin's points from its mass centre [m].
    """
    t, x, e = states.time, states.position, states.quaternion
    true = toss.sample(t[:-1] + part * np.diff(t))
    along = np.sum(e[1:] * e[:-1], axis=1, keepdims=True)
    angle = np.arccos(np.clip(np.abs(along), 0, 1)) / np.pi
    first, second = (each * np.sinc(each * angle) / np.sinc(angle) for each in (1 - part, part))
    turn = first * e[:-1] + np.copysign(second, along) * e[1:]
    moved = np.linalg.norm((1 - part) * x[:-1] + part * x[1:] - true.position, axis=1)
    off = np.minimum(
        np.linalg.norm(turn - true.quaternion, axis=1), np.linalg.norm(turn + true.quaternion, axis=1)
    )
    return moved + 2 * reach * off
