"""Coins tossed by the solvers of Newton on the processor."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from math import hypot, log, pi
from typing import Any

import newton
import numpy as np
import warp
from newton import solvers

from adapters.shared import AIR, THRESHOLD, by_name, friction_of, rotations, rows_at

SPRING = "spring ke = m/(2 dt)^2 with the textbook's damping kd"
ACCELERATION = "spring ke = 1/(2 dt)^2 with the textbook's damping kd, friction at least 0.01"


def model_of(scenario: Any, settings: dict[str, str | float], dt: float) -> newton.Model:
    """Return the model of a coin over a floor; raise NotImplementedError for what is not here."""
    coin, floor, release = scenario.coin, scenario.floor, scenario.release
    friction = friction_of(scenario, (*AIR, THRESHOLD))
    builder = newton.ModelBuilder(gravity=(0, 0, -scenario.gravity))
    shape, e = builder.default_shape_cfg, floor.restitution
    shape.density, shape.restitution = 0.0, e
    shape.mu = max(friction, 0.01 if settings["bounce"] == ACCELERATION else 0.0)
    shape.mu_torsional, shape.mu_rolling = floor.pivoting_friction, floor.rolling_friction
    if settings["bounce"] in (SPRING, ACCELERATION):
        mass = coin.mass if settings["bounce"] == SPRING else 1.0
        shape.ke = mass / (2 * dt) ** 2
        shape.kd = mass * max(-log(e) / hypot(pi, log(e)) if e else 1.0, 1e-6) / dt
    builder.add_ground_plane()
    own = {name: value for name, value in settings.items() if name.startswith("steel:")}
    if own:
        solvers.SolverSteel.register_custom_attributes(builder)
    body = builder.add_body(
        custom_attributes=own,
        mass=coin.mass,
        com=coin.center_of_mass,
        inertia=coin.moments,
        lock_inertia=True,
    )
    builder.add_shape_cylinder(
        body, radius=coin.radius, half_height=max(coin.thickness, float(settings["thinnest shape"])) / 2
    )
    q = np.asarray(release.attitude)
    R = rotations(q[None])[0]
    builder.joint_q[:] = [*(release.position - R @ coin.center_of_mass), *q[1:], q[0]]
    builder.joint_qd[:] = [*release.velocity, *(R @ release.angular_velocity)]
    return builder.finalize()


@dataclass
class Newton:
    """A solver of Newton; what `settings` does not name stays at its default."""

    name: str
    settings: dict[str, str | float]
    solver: Callable[[newton.Model], Any]
    dt: float = 0.002

    def simulate(self, scenario: Any, times: np.ndarray) -> dict[str, np.ndarray]:
        """Return the states at the steps next to the times, (n, 3) and (n, 4); spin in the body frame."""
        with warp.ScopedDevice("cpu"):
            model = model_of(scenario, self.settings, self.dt)
            solver, contacts, control = self.solver(model), model.contacts(), model.control()
            state, after = model.state(), model.state()
            with warp.ScopedCapture() as step:
                model.collide(state, contacts)
                solver.step(state, after, control, contacts, self.dt)
                state.assign(after)
            newton.eval_fk(model, model.joint_q, model.joint_qd, state)
            state.joint_q.assign(model.joint_q)
            state.joint_qd.assign(model.joint_qd)
            rows = rows_at(
                times,
                self.dt,
                lambda: warp.capture_launch(step.graph),
                lambda: (state.body_q.numpy()[0], state.body_qd.numpy()[0]),
            )
        p, q, scalar, v, w = np.split(rows, [3, 6, 7, 10], axis=1)
        quaternion = np.hstack([scalar, q])
        R = rotations(quaternion)
        position, spin = p + R @ np.asarray(scenario.coin.center_of_mass), np.einsum("nij,ni->nj", R, w)
        k = (
            {"stiffness": scenario.coin.mass / (2 * self.dt) ** 2}
            if self.settings["bounce"] == SPRING
            else {}
        )
        return by_name(np.hstack([position, v, quaternion, spin])) | k


def named(what: str, solver: Callable[..., Any], bounce: str = "coefficient", **options: Any) -> Newton:
    """Return an engine of a solver with options of its constructor."""
    words = {name: str(value) for name, value in options.items()}
    settings = {"solver": solver.__name__, "bounce": bounce, "thinnest shape": 1e-5} | words
    return Newton(f"Newton {newton.__version__}, {what}", settings, partial(solver, **options))


as_documented = named("XPBD, as documented", solvers.SolverXPBD, enable_restitution=True)
tuned = named(
    "XPBD, tuned", solvers.SolverXPBD, enable_restitution=True, iterations=20, rigid_contact_relaxation=1.0
)
steel = named("Steel, as documented", solvers.SolverSteel)
steel_tuned = named("Steel, tuned", solvers.SolverSteel, restitution_velocity_threshold=0.0, iterations=50)
steel_tuned.settings["steel:rigid_body_angular_damping"] = 0.0
semi_implicit = named("semi-implicit, as documented", solvers.SolverSemiImplicit, SPRING)
featherstone = named("Featherstone, as documented", solvers.SolverFeatherstone, SPRING)
mujoco = named("MuJoCo, as documented", solvers.SolverMuJoCo, ACCELERATION)
tuned.dt = steel_tuned.dt = 0.001
