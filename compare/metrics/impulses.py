"""How two engines differ at their matched impacts."""

from dataclasses import dataclass

import numpy as np

from cointoss import analytic
from cointoss.models.attitude import rotation_matrix
from cointoss.models.geometry import gap
from cointoss.models.labelled import ReadOnlyArrays
from cointoss.models.records import Array, Impacts, Toss


@dataclass(frozen=True, kw_only=True, eq=False)
class Differences(ReadOnlyArrays):
    """Differences of impacts matched by their number, of a against b; arrays are read-only."""

    time: Array
    """Time of the touches, a - b, (n,) [s]."""
    impulse: Array
    """|S_a - S_b|/|S_a|, (n,)."""
    angular_velocity: Array
    """|ω_a' - ω_b'|/|ω_a'| after the impact, (n,); infinite where only ω_b' turns."""


def match(a: Impacts, b: Impacts) -> Differences:
    """Match the impacts of two tosses by their number, up to the last that both have."""
    n = min(len(a), len(b))
    return Differences(
        time=a.time[:n] - b.time[:n],
        impulse=_relative(a.impulse[:n], b.impulse[:n]),
        angular_velocity=_relative(a.angular_velocity_after[:n], b.angular_velocity_after[:n]),
    )


def errors_of_impacts(toss: Toss) -> Array:
    """Return the error of each impulse against the impact law, from the very state in which the coin touched.

    Unlike the difference of matched impacts, this error carries nothing over from earlier impacts: it is the
    error that the engine makes in this impact alone.

    Returns:
        |S_law - S|/|S_law|, (n,); infinite where there is no impact by the law.
    """
    impacts, scenario, body = toss.impacts, toss.scenario, toss.scenario.body
    law = np.empty((len(impacts), 3))
    for i in range(len(impacts)):
        x, y, z = impacts.position[i].tolist()
        # MuJoCo's shape of a thin coin has a thickness: where it touches the floor, the coin itself is below.
        below = min(gap(body, z, rotation_matrix(impacts.quaternion[i])[2]), 0.0)
        release = {
            "position": (x, y, z - below),
            "velocity": impacts.velocity_before[i],
            "quaternion": impacts.quaternion[i],
            "angular_velocity": impacts.angular_velocity_before[i],
        }
        again = analytic.toss(scenario.replace("release", release, "ending.max_impacts", 1))
        law[i] = again.impacts.impulse[0] if len(again.impacts) else 0.0
    return _relative(law, impacts.impulse)


def _relative(a: Array, b: Array) -> Array:
    apart, size = np.linalg.norm(a - b, axis=1), np.linalg.norm(a, axis=1)
    return np.divide(apart, size, out=np.where(apart > 0, np.inf, 0.0), where=size > 0)
