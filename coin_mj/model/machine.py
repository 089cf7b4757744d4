"""MuJoCo's coin: its model and data, what compiled code sees of them, and how it moves by one step."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import ctypes
from functools import cache
from typing import Any, NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from coin_mj.model.library import mj_euler, mj_forward, mj_reset, mj_runge_kutta, place_of
from coin_mj.model.scene import NO_DAMPING, build, floor_height
from coin_mj.model.settings import ContactSettings, Friction, Realisation, Rebound, friction_of, rebound_of
from coin_mj.model.state import of_mass_center, of_release, to_mass_center
from coin_mj.model.stepping import outlook
from models.body import Body
from models.kernel.compiled import compiled
from models.kernel.vectors import scale
from models.records import Array
from models.scenario import Scenario

_BALLS = 7
_Disable = mujoco.mjtDisableBit
# What a lone coin has no use for. Without a warm start a step depends on nothing but the state.
# Euler's step takes damping as any other force.
_UNUSED = (
    int(_Disable.mjDSBL_ISLAND)
    | int(_Disable.mjDSBL_MIDPHASE)
    | int(_Disable.mjDSBL_WARMSTART)
    | int(_Disable.mjDSBL_EULERDAMP)
)


class Coin(NamedTuple):
    """A coin as compiled code sees it: its numbers, and the memory of MuJoCo's model and data."""

    model: int
    """Address of the mjModel."""
    data: int
    """Address of the mjData."""
    timestep: Array
    """(1,) [s]."""
    solref: Array
    """Of the contact: minus its stiffness [1/s²] and damping [1/s], (2,)."""
    solref_of_slip: Array
    """Of MuJoCo's own friction, as `solref`, (2,); of no use where that is not asked for."""
    margin: Array
    """Height up to which a contact is one, (1,) [m]."""
    rows: NDArray[np.int32]
    """Number of MuJoCo's constraint rows, (1,)."""
    row_arrays: tuple[NDArray[np.int64], ...]
    """Where the arrays of those rows are now: J, position, D, R and reference acceleration; each (1,)."""
    qacc: Array
    """Rate of `qvel`, (6,)."""
    qacc_free: Array
    """And that without the floor, (6,)."""
    qpos: Array
    """Position of B and Euler parameters, (7,)."""
    qvel: Array
    """Velocity of B, space frame, and angular velocity, body frame, (6,)."""
    of_floor: Array
    """Force and moment of the contact, as those of `qvel`, (6,)."""
    of_actuators: Array
    """A part of linear air, as `of_floor`, (6,)."""
    passive: Array
    """Of other air, or the rest of linear air, as `of_floor`, (6,)."""
    applied: Array
    """Of Coulomb's friction, as `of_floor`, (6,)."""
    body: Body
    shape: Body
    """The body with the thickness of its shape."""
    floor: float
    """Height of MuJoCo's floor [m]."""
    rebound: Rebound
    friction: float
    """Coefficient of friction μ of the floor."""
    rubs: bool
    """Whether the friction is Coulomb's force."""
    has_one_step: bool
    """Whether a contact is one step."""
    flight_angle: float
    """Largest turn in a step of flight [rad]."""


class Machine(NamedTuple):
    """MuJoCo's model and data of one coin; they must outlive `coin`, which looks into them."""

    model: mujoco.MjModel
    data: mujoco.MjData
    settings: ContactSettings
    coin: Coin


def machine_of(scenario: Scenario, settings: ContactSettings, thickness: float) -> Machine:
    """Build the MuJoCo coin of a scenario, with the thickness of its shape [m], and put it at its release."""
    rebound, body, mu = (
        rebound_of(scenario.floor.restitution, settings),
        scenario.body,
        friction_of(scenario.floor),
    )
    native = mu if settings.friction == Friction.NATIVE else 0.0
    model = build(scenario, rebound, native, thickness)
    model.opt.disableflags |= _UNUSED
    data = mujoco.MjData(model)
    places, spare = _places(), np.zeros(2)
    data.qpos[:], data.qvel[:] = of_release(body, scenario.release)
    coin = Coin(
        model=model._address,
        data=data._address,
        timestep=_view(model, places.timestep, ctypes.c_double),
        solref=model.pair_solref[0] if native > 0 else model.geom("coin").solref,
        solref_of_slip=model.pair_solreffriction[0] if native > 0 else spare,
        margin=model.pair_margin[:1] if native > 0 else model.geom("coin").margin,
        rows=_view(data, places.rows, ctypes.c_int32),
        row_arrays=tuple(_view(data, place, ctypes.c_int64) for place in places.row_arrays),
        qacc=data.qacc,
        qacc_free=data.qacc_smooth,
        qpos=data.qpos,
        qvel=data.qvel,
        of_floor=data.qfrc_constraint,
        of_actuators=data.qfrc_actuator,
        passive=data.qfrc_passive,
        applied=data.qfrc_applied,
        body=body,
        shape=body._replace(thickness=thickness),
        floor=floor_height(scenario, thickness),
        rebound=rebound,
        friction=mu,
        rubs=settings.friction == Friction.EXPLICIT and mu > 0,
        has_one_step=settings.realisation == Realisation.ONE_STEP,
        flight_angle=settings.flight_angle,
    )
    return Machine(model, data, settings, coin)


@compiled
def put_at(coin, y):
    """Put the coin into a state, as new: nothing is left of what MuJoCo kept of an earlier toss.

    Args:
        coin: MuJoCo's.
        y: position and velocity of C (space), Euler parameters and angular velocity (body), (13,).
    """
    mj_reset(coin.model, coin.data)
    x, v = (y[0], y[1], y[2]), (y[3], y[4], y[5])
    e, w = (y[6], y[7], y[8], y[9]), (y[10], y[11], y[12])
    x_B, v_B = of_mass_center(coin.body, x, v, e, w)
    set_motion(coin, x_B + e + v_B + w)


@compiled
def set_motion(coin, motion):
    """Put the coin into a state: qpos and qvel, (13,)."""
    for i in range(7):
        coin.qpos[i] = motion[i]
    for i in range(6):
        coin.qvel[i] = motion[7 + i]


@compiled
def motion_of(coin):
    """Give qpos and qvel, a tuple of 13."""
    q, v = coin.qpos, coin.qvel
    return q[0], q[1], q[2], q[3], q[4], q[5], q[6], v[0], v[1], v[2], v[3], v[4], v[5]


@compiled
def state_of(coin):
    """Give position and velocity of C (space), Euler parameters and angular velocity (body)."""
    return to_mass_center(coin.body, coin.qpos, coin.qvel)


@compiled
def momentum_of(coin):
    """Give the momentum, space frame, (3,) [N s]."""
    return scale(coin.body.mass, state_of(coin)[1])


@compiled
def other_force(coin):
    """Give weight and drag, space frame, (3,) [N], after `forward`."""
    f, g = coin.of_actuators, coin.passive
    return f[0] + g[0], f[1] + g[1], f[2] + g[2] - coin.body.mass * coin.body.gravity


@compiled
def forward(coin):
    """Compute the accelerations of the present state; give the floor's force along z [N]."""
    mj_forward(coin.model, coin.data)
    return coin.of_floor[2]


@compiled
def advance(coin, dt):
    """Advance by dt [s] with RK4, after `forward`."""
    coin.timestep[0] = dt
    mj_runge_kutta(coin.model, coin.data, 4)


@compiled
def push(coin, dt):
    """Advance by dt [s] in an impact with the integrator of the realisation, after `forward`."""
    if coin.has_one_step:
        coin.timestep[0] = dt
        # It takes the forces that `forward` found.
        mj_euler(coin.model, coin.data)
    else:
        advance(coin, dt)


@compiled
def look(coin):
    """Look at the present state; see `stepping.Outlook`."""
    return outlook(coin.shape, coin.floor, coin.flight_angle, coin.qpos, coin.qvel)


@compiled
def set_margin(coin, margin):
    """Let a contact be one up to a height [m]."""
    coin.margin[0] = margin


@compiled
def set_spring(coin, stiffness, damping, slip_damping):
    """Set the contact's stiffness [1/s²] and damping [1/s], and the damping of MuJoCo's friction [1/s]."""
    coin.solref[0], coin.solref[1] = -stiffness, -damping
    # A damping of 0 would be that of the normal motion.
    coin.solref_of_slip[0], coin.solref_of_slip[1] = 0.0, -max(slip_damping, NO_DAMPING)


@compiled
def keep(coin, time, pressed, knots):
    """Keep the present state as a knot of the path.

    Args:
        coin: MuJoCo's.
        time: now [s].
        pressed: whether the coin is in contact.
        knots: the path so far, (time, pressed, qpos, qvel) each; none where the path is not kept.
    """
    if len(knots) > 0:
        knots.append(knot_of(coin, time, pressed))


@compiled
def knot_of(coin, time, pressed):
    """Give the present state as a knot, (15,); see `keep`."""
    when = (time, 1.0 if pressed else 0.0)
    return when + motion_of(coin)


def _view(struct: Any, place: int, kind: Any) -> NDArray[Any]:
    """Give a scalar field as an array that looks into it, (1,)."""
    return np.frombuffer((kind * 1).from_address(struct._address + place), dtype=kind)


class _Places(NamedTuple):
    """Where fields lie in an mjModel and an mjData [bytes]."""

    timestep: int
    rows: int
    row_arrays: tuple[int, ...]


@cache
def _places() -> _Places:
    balls = "".join(f'<body pos="{3 * i} 0 0"><freejoint/><geom size="1"/></body>' for i in range(_BALLS))
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><worldbody><geom type="plane" size="0 0 1" condim="1"/>{balls}</worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    data.qpos[2::7] = 0.9
    model.geom_condim[:] = 1
    mujoco.mj_forward(model, data)
    # ncon, ne, nf, nl and nefc stand side by side.
    counts = (ctypes.c_int32 * 5)(_BALLS, 0, 0, 0, _BALLS)
    arrays = (data.efc_J, data.efc_pos, data.efc_D, data.efc_R, data.efc_aref)
    model.opt.timestep = 0.123456789
    return _Places(
        timestep=place_of(model, ctypes.c_double(model.opt.timestep)),
        rows=place_of(data, counts) + 4 * ctypes.sizeof(ctypes.c_int32),
        row_arrays=tuple(place_of(data, ctypes.c_int64(array.ctypes.data)) for array in arrays),
    )
