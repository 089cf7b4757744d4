"""Coins tossed by MuJoCo Warp on the processor."""

from dataclasses import dataclass
from importlib.metadata import version
from math import hypot, log, pi
from operator import attrgetter
from typing import Any

import mujoco
import mujoco_warp
import numpy as np
import warp

MODEL = """<mujoco>
  <option timestep="{dt}" gravity="0 0 -{gravity}" {option}/>
  <worldbody>
    <geom name="floor" type="plane" size="0 0 1"/>
    <body><freejoint/><inertial pos="{C}" mass="{coin.mass}" fullinertia="{J}"/>
      <geom name="coin" type="cylinder" size="{coin.radius} {half}"/></body>
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


def model_of(scenario: Any, settings: dict[str, str | float], dt: float) -> mujoco.MjModel:
    """Return the model of a coin over a floor; raise NotImplementedError for what is not here."""
    coin, floor = scenario.coin, scenario.floor
    laws = {"smooth": 0.0, "coulomb": floor.friction, "perfectly_rough": 1e3}
    for name in ("air.normal", "air.tangential", "floor.restitution_threshold"):
        if value := attrgetter(name)(scenario):
            raise NotImplementedError(f"{name}: {value}, accepted: 0")
    if floor.contact not in laws:
        raise NotImplementedError(f"floor.contact: {floor.contact}, accepted: {', '.join(laws)}")
    friction = [*[laws[floor.contact]] * 2, floor.pivoting_friction, *[floor.rolling_friction] * 2]
    J = np.asarray(coin.moments)[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    rows = {"C": coin.center_of_mass, "J": J, "friction": friction}
    words = settings | {name: " ".join(map(str, values)) for name, values in rows.items()}
    words |= {
        "coin": coin,
        "half": max(coin.thickness, float(settings["thinnest shape"])) / 2,
        "gravity": scenario.gravity,
        "dt": dt,
    }
    words["condim"] = 6 if any(friction[2:]) else 3 if any(friction) else 1
    words["contact"] = contact_of(settings, floor.restitution, dt)
    cone = 'cone="elliptic"' if any(friction) and settings["bounce"] == ONE_STEP else ""
    return mujoco.MjModel.from_xml_string(MODEL.format(**words | {"option": f"{settings['option']} {cone}"}))


def rotations(q: np.ndarray) -> np.ndarray:
    """Return the rotation matrices of quaternions, (n, 3, 3)."""
    cross = np.cross(np.eye(3), q[:, None, 1:])
    return np.eye(3) + 2 * (q[:, :1, None] * cross + cross @ cross)


@dataclass
class MujocoWarp:
    """MuJoCo Warp with a contact and options; what `settings` does not name stays at its default."""

    name: str
    settings: dict[str, str | float]
    dt: float = 0.002

    def simulate(self, scenario: Any, times: np.ndarray) -> dict[str, np.ndarray]:
        """Return the states at the steps next to the times, (n, 3) and (n, 4); spin in the body frame."""
        C, release, rows, done = np.asarray(scenario.coin.center_of_mass), scenario.release, [], 0
        w, R = np.asarray(release.angular_velocity), rotations(np.atleast_2d(release.attitude))[0]
        with warp.ScopedDevice("cpu"):
            plain = model_of(scenario, self.settings, self.dt)
            model, data = mujoco_warp.put_model(plain), mujoco_warp.make_data(plain)
            with warp.ScopedCapture() as step:
                mujoco_warp.step(model, data)
            data.qpos.assign(np.array([[*release.position - R @ C, *release.attitude]], np.float32))
            data.qvel.assign(np.array([[*release.velocity - R @ np.cross(w, C), *w]], np.float32))
            for due in np.rint(np.asarray(times) / self.dt).astype(int):
                for _ in range(due - done):
                    warp.capture_launch(step.graph)
                done = due
                rows.append(np.concatenate([data.qpos.numpy()[0], data.qvel.numpy()[0]]))
        q, v = np.split(np.array(rows, float), [7], axis=1)
        R, w = rotations(q[:, 3:]), v[:, 3:]
        position, velocity = q[:, :3] + R @ C, v[:, :3] + np.einsum("nij,nj->ni", R, np.cross(w, C))
        return {"position": position, "velocity": velocity, "quaternion": q[:, 3:], "angular_velocity": w}


VERSION = f"MuJoCo Warp {version('mujoco-warp')}"
DEFAULT: dict[str, str | float] = {
    "bounce": SPRING,
    "option": "",
    "precision": "float32",
    "thinnest shape": 1e-5,
}
RIGID = {"bounce": ONE_STEP, "solimp": "0.9999 0.9999 0.001 0.5 2"}
as_documented = MujocoWarp(f"{VERSION}, as documented", DEFAULT)
as_documented_rk4 = MujocoWarp(f"{VERSION}, as documented, RK4", DEFAULT | {"option": 'integrator="RK4"'})
IMPLICIT = {"option": 'integrator="implicitfast"'}
tuned = MujocoWarp(f"{VERSION}, tuned", DEFAULT | RIGID | IMPLICIT, 0.001)
