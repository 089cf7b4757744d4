"""Releases of a coin from states of MuJoCo's free joint."""

import numpy as np
from numpy.typing import ArrayLike

from cointoss.models.attitude import normalized
from cointoss.models.batch import STATE, refused, rows_from_states, scenario_of_row
from cointoss.models.entries import states_of_joint
from cointoss.models.errors import ScenarioError, shown
from cointoss.models.faults import NORM_ERROR
from cointoss.models.kernel.arrays import Array
from cointoss.models.reading import ScenarioSource, scenario_of


def release_fields(qpos: ArrayLike, qvel: ArrayLike, scenario: ScenarioSource) -> dict[str, Array]:
    """Return releases from states of the coin's free joint, as `cointoss.toss_many` takes them.

        cointoss.toss_many("fig24a", coin_mj.release_fields(data.qpos, data.qvel, "fig24a"))

    Args:
        qpos: B in space and Euler parameters, scalar first, (7,) or (n, 7).
        qvel: velocity of B in space and ω in the body frame, (6,) or (n, 6).
        scenario: of the coin, whose mass centre may lie off B.

    Returns:
        Position and velocity of C, Euler parameters and ω by field, (n,) each.

    Raises:
        ValueError: for other shapes, and for Euler parameters whose norm is not 1 within 1e-3.
        ScenarioError: for a release that this coin can't have.
    """
    described = scenario_of(scenario)
    joint, motion = _table("qpos", qpos, 7), _table("qvel", qvel, 6)
    if len(joint) != len(motion):
        raise ValueError(f"qvel: shape {motion.shape}, accepted: ({len(joint)}, 6)")
    off = ~(np.abs(np.linalg.norm(joint[:, 3:], axis=1) - 1) <= NORM_ERROR)
    if off.any():
        i = int(np.argmax(off))
        accepted = f"four numbers of norm 1 within {NORM_ERROR:g}"
        raise ValueError(f"qpos: row {i}: Euler parameters {joint[i, 3:].tolist()}, accepted: {accepted}")
    joint[:, 3:] = [normalized((e[0], e[1], e[2], e[3])) for e in joint[:, 3:].tolist()]
    states = states_of_joint(described.body, np.hstack([joint, motion]))
    rows = rows_from_states(described, states)
    for i in np.flatnonzero(refused(rows, STATE)):
        try:
            scenario_of_row(rows[i])
        except ScenarioError as error:
            raise ScenarioError(f"{error} (row {i})") from None
    return dict(zip(STATE, states.T.copy(), strict=True))


def _table(name: str, given: ArrayLike, columns: int) -> Array:
    """Return what is given as a table of so many columns, which is a copy."""
    accepted = f"accepted: numbers, ({columns},) or (n, {columns})"
    try:
        table = np.atleast_2d(np.array(given, dtype=float))
    except (TypeError, ValueError):
        raise ValueError(f"{name}: {shown(given)}, {accepted}") from None
    if table.ndim != 2 or table.shape[1] != columns:
        raise ValueError(f"{name}: shape {table.shape}, {accepted}")
    return table
