"""A swapped argument of a compiled function is an error of types.

Each call below swaps two. Nothing runs them: pyright asks for every `ignore` here, and refuses one that it
does not need, so that a function which lost its types fails lint.
"""

# pyright: reportUnnecessaryTypeIgnoreComment=true

from cointoss.analytic.air.force import force_and_moment
from cointoss.analytic.flight.flying import fly
from cointoss.analytic.flight.turning import Turning, turn
from cointoss.analytic.impact.laws import ImpactPoint, delassus, impulse
from cointoss.coin_mj.model.mujoco_coin import MujocoCoin
from cointoss.coin_mj.steps.constrained_step import IMPACT, contact_step
from cointoss.models.attitude import Quaternion
from cointoss.models.body import Body, Rules
from cointoss.models.ending import settled_face
from cointoss.models.geometry import contact_velocity
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.vectors import Matrix, Vector, apply
from cointoss.models.state import State, state


def swap_records(body: Body, rules: Rules, y: Array, now: State, A: ImpactPoint) -> None:
    """Swap coin, floor, state and contact point."""
    settled_face(rules, body, now, 0.0)  # pyright: ignore[reportArgumentType]
    fly(y, body, 1.0, False)  # pyright: ignore[reportArgumentType]
    impulse(body, rules, A, 0.5)  # pyright: ignore[reportArgumentType]
    settled_face(body, rules, y, 0.0)  # pyright: ignore[reportArgumentType]


def swap_vectors(body: Body, R: Matrix, v: Vector, w: Vector, e: Quaternion) -> None:
    """Swap vectors, matrices and Euler parameters."""
    contact_velocity(body, v, R, w, v)  # pyright: ignore[reportArgumentType]
    apply(v, R)  # pyright: ignore[reportArgumentType]
    delassus(body, v, R)  # pyright: ignore[reportArgumentType]
    force_and_moment(v, body, w)  # pyright: ignore[reportArgumentType]
    state(v, v, w, e)  # pyright: ignore[reportArgumentType]


def swap_numbers(coin: MujocoCoin, turning: Turning, y: Array) -> None:
    """Swap numbers and records or arrays."""
    contact_step(coin, 1e-3, IMPACT)  # pyright: ignore[reportArgumentType]
    turn(turning, 1.0, y, 1.0, y)  # pyright: ignore[reportArgumentType]
