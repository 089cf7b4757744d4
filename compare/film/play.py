"""A toss as a film shows it: the coin at the times of the frames, and what the floor does to it then."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.film.filmed import Filmed
from cointoss.models.attitude import rotation_matrix
from cointoss.models.records import Array, Ending, States, Toss

SHOWN_FOR = 0.015
"""How long after an impact its impulse is shown [s]."""
_STILL = (Ending.LYING, Ending.STANDING, Ending.AT_REST)
WEAKEST = 0.02
"""An impulse below this part of its toss's largest is not shown."""


class Shown(NamedTuple):
    """An impulse of the floor on the coin that is still shown."""

    point: Array
    """The point at which it acted, space frame, (3,) [m]."""
    impulse: Array
    """S, space frame, (3,) [N s]."""
    freshness: float
    """A number that falls from 1 at the impact to 0 when it is shown no more."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Play:
    """A toss at the times of a film's frames."""

    filmed: Filmed
    times: Array
    """The times of the motion; after its end it stays as it ended, (n,) [s]."""
    states: States
    """The states of the coin at these times, (n,)."""
    forces: Array
    """The floor's forces in sustained contacts; 0 elsewhere and on a still coin; space frame, (n, 3) [N]."""
    largest_impulse: float
    """The largest impulse of the toss [N s]."""
    qpos: Array
    """MuJoCo's coordinates of the coin at these times, (n, 7)."""
    lowest_points: Array
    """The coin's lowest points at these times, space frame, (n, 3) [m]."""

    @property
    def toss(self) -> Toss:
        """The motion that is shown."""
        return self.filmed.motion

    def impulses(self, i: int) -> list[Shown]:
        """Return the impulses of the impacts of the last `SHOWN_FOR` before one of the times.

        There are none on a coin that lies or stands still.
        """
        impacts, time = self.toss.impacts, self.times[i]
        if _is_still(self.toss, time):
            return []
        first, last = np.searchsorted(impacts.time, (time - SHOWN_FOR, time), side="right")
        size, center = np.linalg.norm(impacts.impulse[first:last], axis=1), self.toss.scenario.body.center
        return [
            Shown(
                point=impacts.position[k]
                + np.array(rotation_matrix(impacts.quaternion[k])) @ (impacts.point[k] - center),
                impulse=impacts.impulse[k],
                freshness=1 - (time - impacts.time[k]) / SHOWN_FOR,
            )
            for k in first + np.flatnonzero(size > WEAKEST * self.largest_impulse)
        ]


def _is_still(motion: Toss, times: Array) -> NDArray[np.bool_]:
    """Return at which times the coin moves no more, (n,)."""
    return (times >= motion.end_time) & (motion.ending in _STILL)


def play_of(filmed: Filmed, times: Array) -> Play:
    """Sample a toss for a film.

    Args:
        filmed: by either engine.
        times: of the frames, from 0 on, (n,) [s].
    """
    motion = filmed.motion
    times = np.minimum(times, motion.end_time)
    moves = ~_is_still(motion, times)
    forces = np.zeros((len(times), 3))
    forces[moves] = motion.floor_force(times[moves])
    states = motion.sample(times)
    return Play(
        filmed=filmed,
        times=times,
        states=states,
        forces=forces,
        largest_impulse=float(np.linalg.norm(motion.impacts.impulse, axis=1).max(initial=0.0)),
        qpos=states.to_mujoco(motion.scenario)[0],
        lowest_points=states.lowest_points(motion.scenario),
    )
