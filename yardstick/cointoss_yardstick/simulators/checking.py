"""Whether an engine's answer can be what it says: its shape, its order, its frames, its beginning."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from cointoss import Scenario, States
from cointoss.study import Array, rotation_matrix, state_at_release

WIDTHS = {"position": 3, "velocity": 3, "quaternion": 4, "angular_velocity": 3}
ROUNDING = 1e-4
"""The error allowed in a state, relative to its size: single precision leaves 1e-7, and a quaternion that is
not normalised 1e-5."""


def checked_states(scenario: Scenario, times: Array, dt: float | None, answer: Mapping[str, Any]) -> States:
    """Return an engine's answer as states.

    Args:
        scenario: that was asked for.
        times: that were asked for, (n,) [s].
        dt: the engine's step, within which a state may be off its time [s].
        answer: arrays by name.

    Raises:
        ValueError: naming the quantity, the time, and what is accepted.
    """
    columns = {name: np.array(answer[name], dtype=float, order="C") for name in WIDTHS}
    for name, column in columns.items():
        if column.shape != (len(times), WIDTHS[name]):
            raise ValueError(
                f"{name}: shape {column.shape}, accepted: {(len(times), WIDTHS[name])}, a row for each time"
            )
        wrong = ~np.isfinite(column).all(axis=1)
        if wrong.any():
            k = int(np.argmax(wrong))
            raise ValueError(f"{name} at t = {times[k]:.6g} s: {column[k]}, accepted: numbers")
    if "time" in answer:
        _require_times(np.asarray(answer["time"]), times, dt)
    told = [np.asarray(answer[name]) for name in ("impact_time", "impact_impulse") if name in answer]
    if told and not (
        len(told) == 2
        and len(told[1]) == len(told[0])
        and told[1].size == 3 * told[0].size
        and np.isfinite(told[1]).all()
        and np.all(np.diff(told[0], prepend=0.0) >= 0)
    ):
        raise ValueError(
            "impact_time: accepted: times in order, and impact_impulse with three numbers for each"
        )
    if not np.asarray(answer.get("stiffness", 1.0)) > 0:
        raise ValueError(f"stiffness: {answer['stiffness']} N/m, accepted: a number above 0")
    norms = np.linalg.norm(columns["quaternion"], axis=1)
    wrong = np.abs(norms - 1) > ROUNDING * 10
    if wrong.any():
        k = int(np.argmax(wrong))
        raise ValueError(f"quaternion at t = {times[k]:.6g} s: norm {norms[k]:.4g}, accepted: 1")
    columns["quaternion"] /= norms[:, None]
    states = States(time=np.array(times), **columns)
    _require_release(scenario, states)
    return states


def _require_times(given: Array, asked: Array, dt: float | None) -> None:
    if given.shape != asked.shape:
        raise ValueError(f"time: shape {given.shape}, accepted: {asked.shape}")
    back = np.diff(given) < 0
    if back.any():
        raise ValueError(
            f"time: {given[1:][back][0]:.6g} s after {given[:-1][back][0]:.6g} s, accepted: times in order"
        )
    late = np.abs(given - asked) > (dt or 0) / 2 + 1e-9
    if late.any():
        raise ValueError(
            f"time: {given[late][0]:.6g} s for {asked[late][0]:.6g} s, accepted: the times asked for"
        )


def _require_release(scenario: Scenario, states: States) -> None:
    """Refuse states whose first is not the release, in its frames; say what it seems to be instead."""
    x, v, e, w = np.split(state_at_release(scenario.release), (3, 6, 10))
    body = scenario.body
    lowest = float(states.lowest_points(scenario)[0, 2])
    if lowest < -0.1 * body.radius:
        raise ValueError(
            f"position at t = 0: the coin starts {-1e3 * lowest:.3g} mm below the floor, accepted: {x}"
        )
    R, size = np.array(rotation_matrix(tuple(e.tolist()))), np.linalg.norm(w)
    limited = w * (np.linalg.norm(states.angular_velocity[0]) / (size or 1.0))
    expected = {
        "quaternion": (
            e,
            {"the scalar is last": np.roll(e, -1), "it turns from space to body": e * [1, -1, -1, -1]},
        ),
        "position": (x, {"it is that of the geometric centre": x - R @ np.array(body.center)}),
        "velocity": (v, {"it is in the body frame": R.T @ v}),
        "angular_velocity": (w, {"it is in the space frame": R @ w, "it is limited, or damped": limited}),
    }
    for name, (right, seems) in expected.items():
        given = getattr(states, name)[0]
        if not _alike(given, right, name):
            why = next((f"; {said}" for said, other in seems.items() if _alike(given, other, name)), "")
            raise ValueError(
                f"{name} at t = 0: {_told(given)}{why}, accepted: that of the release, {_told(right)}"
            )


def _alike(a: Array, b: Array, name: str) -> bool:
    if name == "quaternion" and a @ b < 0:
        a = -a
    return bool(
        np.linalg.norm(a - b)
        <= ROUNDING * (1 + np.linalg.norm(b)) * (10 if name == "angular_velocity" else 1)
    )


def _told(vector: Array) -> str:
    return f"({', '.join(f'{part:.4g}' for part in vector)})"
