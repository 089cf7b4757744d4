"""Engines that are right but for one fault, by the hint that each earns."""

from operator import attrgetter
from typing import Any

import numpy as np

from cointoss import Engine
from cointoss.study import rotation_matrix, state_at_release
from cointoss_yardstick.simulators.simulator import Own

STATE = ("position", "velocity", "quaternion", "angular_velocity")
TWO_BODIES = {
    "is multiplied by itself, as where both bodies have it": lambda x: x * x,
    "is halved, as by the mean with a body that has 0": lambda x: x / 2,
    "is the mean with 1, which another body has": lambda x: (1 + x) / 2,
    "is its own square root, as by the geometric mean with a body that has 1": lambda x: x**0.5,
}


class Planted:
    """The analytic engine with a fault in the scenarios that it tosses, or in the states that it shows."""

    def __init__(self, before: Any = lambda case: case, after: Any = lambda *_: {}, dt: Any = None) -> None:
        """Plant a fault.

        Args:
            before: the scenario that is tossed, of the one that is asked for.
            after: the columns that are shown in place of others, of the scenario, the times and the states.
            dt: the step [s].
        """
        self.before, self.after, self.dt = before, after, dt

    def simulate(self, case: Any, times: Any) -> dict[str, Any]:
        """Return the states, of which the first are right."""
        told = Own(Engine.ANALYTIC).simulate(self.before(case), times)
        right = {name: told[name].copy() for name in STATE}
        wrong = right | self.after(case, times[:, None], right)
        for name, first in zip(STATE, np.split(state_at_release(case.release), [3, 6, 10]), strict=True):
            wrong[name][0] = first
        return wrong


def of(field: str, law: Any) -> Planted:
    """Return an engine that tosses with another value of a field."""
    return Planted(lambda case: case.replace(field, law(attrgetter(field)(case))))


def spun(law: Any) -> Planted:
    """Return an engine that shows another angular velocity, a law of the right one, the first and times."""
    return Planted(after=lambda _, t, right: {STATE[3]: law(right[STATE[3]], right[STATE[3]][0], t)})


def up(case: Any) -> float:
    """Return how high the lowest point is at the release [m]."""
    n_z, coin = abs(rotation_matrix(case.release.attitude)[2][2]), case.coin
    return case.release.position[2] - coin.radius * (1 - n_z**2) ** 0.5 - coin.thickness / 2 * n_z


def touching(height: Any) -> Planted:
    """Return an engine whose coin touches and lies where its lowest point has a height, by scenario [m]."""
    return Planted(
        lambda case: case.replace(
            "release.position.z", case.release.position[2] - min(height(case), up(case))
        ),
        lambda case, _, right: {"position": right["position"] + [0, 0, height(case)]},
    )


def resting(depth: float, **more: float) -> Planted:
    """Return an engine whose coin lies deep where it is released on the floor [m]."""
    return Planted(
        after=lambda case, _, right: (
            more | {"position": right["position"] - [0, 0, depth * (case.release.position[2] < 2e-3)]}
        )
    )


TURN = np.cos(np.pi / 360) * np.eye(4) + np.sin(np.pi / 360) * np.kron([[1, 0], [0, -1]], [[0, 1], [-1, 0]])
"""By which attitudes, as rows, are turned by 1° about ξ."""
PLANTS = {
    "the floor, or a margin around the coin, is at +1 mm, not at 0": touching(lambda _: 1e-3),
    "the floor, or a margin around the coin, is at -0.2 mm, not at 0": Planted(
        after=lambda _, __, right: {"position": right["position"] - [0, 0, 2e-4]}
    ),
    "the shape that touches is not the coin's cylinder: flat it touches at 0, tilted by 45° at -8.55 mm": (
        touching(
            lambda case: (case.coin.thickness / 2 - case.release.position[2] + up(case)) * (up(case) > 1e-4)
        )
    ),
    "the contact yields: the coin touches at 0, and lies at -0.3 mm": resting(3e-4),
    "gravity is off by -0.01 m/s²": of("gravity", lambda g: g - 0.01),
    "the velocity comes 5e-05 s early, as half a step off, and the position does not": Planted(
        after=lambda case, t, right: {
            "velocity": right["velocity"] - [0, 0, case.gravity / 2] * (t[1] - t[0])
        }
    ),
    "the states come 0.0001 s late": Planted(
        after=lambda _, __, right: {name: np.roll(column, 1, axis=0) for name, column in right.items()}
    ),
    "the velocity is damped by 0.04/s": Planted(
        after=lambda case, t, right: {
            "velocity": right["velocity"] - 0.02 * t * (right["velocity"][0] + right["velocity"]),
            "position": right["position"]
            - 0.04 / 6 * t**2 * (2 * right["velocity"][0] + right["velocity"]) * (up(case) > 0.5),
        }
    ),
    "the attitudes are turned by 1°": Planted(
        after=lambda _, __, right: {"quaternion": right["quaternion"] @ TURN}
    ),
    **{
        f"the angular velocity is limited to {most} rad/s": spun(
            lambda w, *_, most=most: w * np.minimum(1, most / (np.linalg.norm(w, axis=1) + 1e-99))[:, None]
        )
        for most in (500, 100)
    },
    "the angular velocity is damped by 0.0498/s": spun(lambda w, _, t: w * np.exp(-0.05 * t)),
    **{
        f"the gyroscopic moment ω × J ω {words}": Planted(
            lambda case, mixed=mixed: case.replace(
                "coin.inertia", np.diag(mixed @ np.diag(case.coin.moments)).tolist()
            )
        )
        for words, mixed in {
            "is missing": np.array([[1, 0, 0], [0, 1, 0], [1, 0, 0]]),
            "has the wrong sign": np.array([[1, 0, 0], [0, 1, 0], [2, 0, -1]]),
        }.items()
    },
    "the spin that a touch makes has the wrong sign": spun(lambda w, first, _: 2 * first - w),
    "a touch makes no spin": spun(lambda w, first, _: 0 * w + first),
    **{
        f"nothing rebounds below a speed, between {words} m/s": of(
            "floor.restitution_threshold", lambda _, v=v: v
        )
        for words, v in {
            "1.4 and 2.8": 2.0,
            "0.7 and 1.4": 1.0,
            "0.35 and 0.7": 0.5,
            "0.18 and 0.35": 0.2,
        }.items()
    },
    **{
        f"the {name} {words}": of(f"floor.{name}", law)
        for name in ("restitution", "friction")
        for words, law in TWO_BODIES.items()
    },
}
"""The engines by their hints."""
UNNAMED = {
    "a spin shown a part too small": spun(lambda w, *_: 0.95 * w),
    "half the thickness": of("coin.thickness", lambda thickness: thickness / 2),
    "a tenth less thickness": of("coin.thickness", lambda thickness: 0.9 * thickness),
    "less restitution": of("floor.restitution", lambda chi: 0.97 * chi),
}
"""Engines whose fault has the pattern of no cause."""
