"""The coin over a floor as MuJoCo's model, for the engines that read one."""

from math import hypot, log, pi
from typing import Any

import mujoco
import numpy as np

from adapters.shared import THRESHOLD, by_name, friction_of, rotations

MODEL = """<mujoco>
  <option timestep="{dt}" gravity="0 0 -{gravity}" {option}><flag {flag}/></option>
  <worldbody>
    <geom name="floor" type="plane" size="0 0 1"/>
    <body><freejoint/><inertial pos="{C}" mass="{m}" fullinertia="{J}"/>
      <geom name="coin" type="cylinder" size="{r} {half}"/></body>
  </worldbody>
  <contact><pair geom1="floor" geom2="coin" condim="{condim}" friction="{friction}" {contact}/></contact>
</mujoco>"""
SPRING = "spring of time constant 2 dt, damped as the textbook says"
ONE_STEP = "damper -(1 + restitution)/dt, which reverses the velocity in one step"


def contact_of(settings: dict[str, str | float], e: float, dt: float) -> str:
    """Return the attributes of a contact of restitution e: a textbook spring, or a damper of one step."""
    if settings["bounce"] == SPRING:
        return f'solref="{-1 / (2 * dt) ** 2} {log(e) / hypot(pi, log(e)) / dt if e else -1 / dt}"'
    friction = f'solreffriction="0 {-1 / dt}"'
    return f'solref="{-1e-3 / dt**2} {-(1 + e) / dt}" {friction} solimp="{settings["solimp"]}"'


def model_of(scenario: Any, settings: dict[str, str | float], dt: float, *refused: str) -> mujoco.MjModel:
    """Return the model.

    Args:
        scenario: what is tossed.
        settings: `bounce`, `option`, `thinnest shape` [m], and perhaps `flag`, `solimp`, `units per metre`.
        dt: the step [s].
        refused: fields of the scenario that must be 0, beside the threshold of restitution.

    Raises:
        NotImplementedError: naming a field, its value and what is accepted.
    """
    coin, floor, L = scenario.coin, scenario.floor, float(settings.get("units per metre", 1))
    slides = friction_of(scenario, (*refused, THRESHOLD))
    friction = [slides, slides, floor.pivoting_friction * L, *[floor.rolling_friction * L] * 2]
    J = np.asarray(coin.moments)[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]] * L**2
    rows = {"C": np.asarray(coin.center_of_mass) * L, "J": J, "friction": friction}
    words = {"flag": ""} | settings | {name: " ".join(map(str, values)) for name, values in rows.items()}
    words |= {"m": coin.mass, "r": coin.radius * L, "gravity": scenario.gravity * L, "dt": dt}
    words["half"] = max(coin.thickness, float(settings["thinnest shape"])) / 2 * L
    words["condim"] = 6 if any(friction[2:]) else 3 if any(friction) else 1
    words["contact"] = contact_of(settings, floor.restitution, dt)
    if any(friction) and settings["bounce"] == ONE_STEP and "cone" not in str(settings["option"]):
        words["option"] = f'{settings["option"]} cone="elliptic"'
    return mujoco.MjModel.from_xml_string(MODEL.format(**words))


def joint_of(scenario: Any, L: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    """Return qpos and qvel of the coin's joint at the release, with L units per metre, (7,) and (6,)."""
    C, release = np.asarray(scenario.coin.center_of_mass), scenario.release
    R, w = rotations(np.atleast_2d(release.attitude))[0], np.asarray(release.angular_velocity)
    v = release.velocity - R @ np.cross(w, C)
    return np.array([*L * (release.position - R @ C), *release.attitude]), np.array([*L * v, *w])


def states_of(scenario: Any, rows: np.ndarray, L: float = 1.0) -> dict[str, np.ndarray]:
    """Return the coin's states by name, of rows of qpos and qvel with L units per metre, (n, 13)."""
    C, (x, q, v, w) = np.asarray(scenario.coin.center_of_mass), np.split(rows, [3, 7, 10], axis=1)
    R = rotations(q)
    velocity = v / L + np.einsum("nij,nj->ni", R, np.cross(w, C))
    return by_name(np.hstack([x / L + R @ C, velocity, q, w]))
