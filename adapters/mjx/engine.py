"""Coins tossed by MJX, MuJoCo in JAX, one at a time on the processor."""

from dataclasses import dataclass
from importlib.metadata import version
from math import hypot, log, pi
from operator import attrgetter
from typing import Any

import jax
import jax.numpy as jnp
import mujoco
import numpy as np
from jax import lax
from mujoco import mjx

MODEL = """<mujoco>
  <option timestep="{dt}" gravity="0 0 -{gravity}" {option}/>
  <worldbody>
    <geom name="floor" type="plane" size="0 0 1"/>
    <body><freejoint/><inertial pos="{C}" mass="{m}" fullinertia="{J}"/>
      <geom name="coin" type="cylinder" size="{r} {half}"/></body>
  </worldbody>
  <contact><pair geom1="floor" geom2="coin" condim="{condim}" friction="{friction}" {contact}/></contact>
</mujoco>"""
SPRING = "spring of time constant 2 dt, damped as the textbook says"
ONE_STEP = "damper -(1 + restitution)/dt, which reverses the velocity in one step"
ROWS = 256
"""Number of states that a compiled call returns."""


def contact_of(settings: dict[str, str | float], e: float, dt: float) -> str:
    """Return the attributes of a contact of restitution e: a textbook spring, or a damper of one step."""
    if settings["bounce"] == SPRING:
        return f'solref="{-1 / (2 * dt) ** 2} {log(e) / hypot(pi, log(e)) / dt if e else -1 / dt}"'
    friction = f'solreffriction="0 {-1 / dt}"'
    return f'solref="{-1e-3 / dt**2} {-(1 + e) / dt}" {friction} solimp="{settings["solimp"]}"'


def model_of(scenario: Any, settings: dict[str, str | float], dt: float) -> mujoco.MjModel:
    """Return the model of a coin over a floor; raise NotImplementedError for what is not here."""
    coin, floor = scenario.coin, scenario.floor
    laws = {"smooth": 0.0, "coulomb": floor.friction, "perfectly_rough": 1e3}
    for name in ("air.normal", "air.tangential", "floor.restitution_threshold"):
        if value := attrgetter(name)(scenario):
            raise NotImplementedError(f"{name}: {value}, accepted: 0")
    if floor.contact not in laws:
        raise NotImplementedError(f"floor.contact: {floor.contact}, accepted: {', '.join(laws)}")
    L = float(settings["units per metre"])
    friction = [*[laws[floor.contact]] * 2, floor.pivoting_friction * L, *[floor.rolling_friction * L] * 2]
    J = np.asarray(coin.moments)[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]] * L**2
    rows = {"C": np.asarray(coin.center_of_mass) * L, "J": J, "friction": friction}
    words = settings | {name: " ".join(map(str, values)) for name, values in rows.items()}
    words |= {
        "m": coin.mass,
        "r": coin.radius * L,
        "half": max(coin.thickness, float(settings["thinnest shape"])) / 2 * L,
    }
    words |= {"gravity": scenario.gravity * L, "dt": dt}
    words["condim"] = 6 if any(friction[2:]) else 3 if any(friction) else 1
    words["contact"] = contact_of(settings, floor.restitution, dt)
    cone = 'cone="elliptic"' if any(friction) and settings["bounce"] == ONE_STEP else ""
    return mujoco.MjModel.from_xml_string(MODEL.format(**words | {"option": f"{settings['option']} {cone}"}))


def rotations(q: np.ndarray) -> np.ndarray:
    """Return the rotation matrices of quaternions, (n, 3, 3)."""
    cross = np.cross(np.eye(3), q[:, None, 1:])
    return np.eye(3) + 2 * (q[:, :1, None] * cross + cross @ cross)


@jax.jit
def advanced(
    model: mjx.Model, data: mjx.Data, numbers: jax.Array
) -> tuple[mjx.Data, tuple[jax.Array, jax.Array]]:
    """Return the state after those numbers of steps, and positions and velocities after each of them."""

    def row(data: mjx.Data, n: jax.Array) -> tuple[mjx.Data, tuple[jax.Array, jax.Array]]:
        data = lax.fori_loop(0, n, lambda _, data: mjx.step(model, data), data)
        return data, (data.qpos, data.qvel)

    return lax.scan(row, data, numbers)


@dataclass
class Mjx:
    """MJX with a contact and options; what `settings` does not name stays at its default."""

    name: str
    settings: dict[str, str | float]
    dt: float = 0.002

    def simulate(self, scenario: Any, times: np.ndarray) -> dict[str, np.ndarray]:
        """Return the states at the steps next to the times, (n, 3) and (n, 4); spin in the body frame."""
        C, release, states = np.asarray(scenario.coin.center_of_mass), scenario.release, []
        w, R = np.asarray(release.angular_velocity), rotations(np.atleast_2d(release.attitude))[0]
        L = float(self.settings["units per metre"])
        with jax.enable_x64(self.settings["precision"] == "float64"):
            model = mjx.put_model(model_of(scenario, self.settings, self.dt))
            q = jnp.array([*L * (release.position - R @ C), *release.attitude])
            v = jnp.array([*L * (release.velocity - R @ np.cross(w, C)), *w])
            data = mjx.make_data(model).replace(qpos=q, qvel=v)
            numbers = np.diff(np.rint(np.asarray(times) / self.dt).astype(np.int32), prepend=0)
            for chunk in np.split(
                np.pad(numbers, (0, -len(numbers) % ROWS)), range(ROWS, len(numbers), ROWS)
            ):
                data, rows = advanced(model, data, jnp.array(chunk))
                states.append(np.concatenate(rows, axis=1))
        q, v = np.split(np.concatenate(states)[: len(numbers)].astype(float), [7], axis=1)
        R, w = rotations(q[:, 3:]), v[:, 3:]
        position, velocity = q[:, :3] / L + R @ C, v[:, :3] / L + np.einsum("nij,nj->ni", R, np.cross(w, C))
        return {"position": position, "velocity": velocity, "quaternion": q[:, 3:], "angular_velocity": w}


VERSION = f"MJX {version('mujoco-mjx')}"
DEFAULT: dict[str, str | float] = {
    "thinnest shape": 1e-5,
    "bounce": SPRING,
    "option": "",
    "precision": "float32",
    "units per metre": 1,
}
RIGID = {
    "bounce": ONE_STEP,
    "solimp": "0.9999 0.9999 0.001 0.5 2",
    "precision": "float64",
    "units per metre": 1000,
}
as_documented = Mjx(f"{VERSION}, as documented", DEFAULT)
as_documented_rk4 = Mjx(f"{VERSION}, as documented, RK4", DEFAULT | {"option": 'integrator="RK4"'})
tuned = Mjx(f"{VERSION}, tuned", DEFAULT | RIGID, 0.001)
