"""MuJoCo's coin as compiled code sees it: numbers alone."""

from typing import NamedTuple

from cointoss.coin_mj.model.addresses import numbers_at
from cointoss.coin_mj.model.settings import Rebound
from cointoss.models.body import Body
from cointoss.models.contour import Contour
from cointoss.models.kernel.address import call_c
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import inlined


class Functions(NamedTuple):
    """The addresses of MuJoCo's own functions, by their names; each takes an mjModel and an mjData."""

    mj_resetData: int
    mj_Euler: int
    mj_kinematics: int
    mj_comPos: int
    mj_makeM: int
    mj_factorM: int
    mj_collision: int
    mj_makeConstraint: int
    mj_projectConstraint: int
    mj_referenceConstraint: int
    mj_comVel: int
    mj_fwdAcceleration: int
    mj_fwdConstraint: int
    mj_rne: int
    """Newton-Euler's forces; takes whether with accelerations, and where the forces go, (nv,), too."""
    mj_solveM: int
    """Solves M x = y for several y; takes x, y and their number, too."""


class Addresses(NamedTuple):
    """Where an mjModel, an mjData, and some of their fields lie."""

    model: int
    data: int
    time: int
    """The time of mjData, for those who wait [s]; no step reads it."""
    timestep: int
    solref: int
    """The solref of the normal force: minus the contact's stiffness [1/s²] and damping [1/s]."""
    solreffriction: int
    """The solref of MuJoCo's own friction: the same two numbers; 0 where that friction is not asked for."""
    margin: int
    """Height up to which a contact is one [m]."""
    xmat: int
    """The rotation matrix of the coin, (3, 3)."""
    nefc: int
    """Number of constraint rows."""
    efc_J: int
    """The address at which the address of this array of the rows is now, as of the next ones."""
    efc_pos: int
    efc_D: int
    efc_R: int
    efc_aref: int


class Joint(NamedTuple):
    """MuJoCo's arrays of the free joint: qpos, (7,), and the others, (6,)."""

    qpos: Array
    qvel: Array
    qacc: Array
    qacc_smooth: Array
    qfrc_constraint: Array
    qfrc_actuator: Array
    qfrc_passive: Array
    qfrc_bias: Array
    qfrc_applied: Array


JointAddresses = NamedTuple("JointAddresses", [(name, int) for name in Joint._fields])  # pyright: ignore[reportArgumentType]
"""Where these arrays lie."""


class MujocoCoin(NamedTuple):
    """A coin as compiled code sees it: MuJoCo's memory, and the numbers of coin, floor and steps."""

    mujoco: Functions
    address: Addresses
    joint: JointAddresses
    body: Body
    shape: Body
    """The body with the thickness of its shape, and bounds of its inertia for its flight, see `shape_of`."""
    floor_height: float
    """The height of MuJoCo's floor [m]."""
    rebound: Rebound
    friction: float
    """Coefficient of friction μ of the floor."""
    rolling_friction: float
    """δ of the floor [m]."""
    pivoting_friction: float
    """p of the floor [m]."""
    contour: Contour
    """The losses of the contact point that runs round the rim."""
    is_balanced: bool
    """Whether C is B: then the free joint's mass matrix never changes."""
    has_explicit_friction: bool
    """Whether the friction is Coulomb's force."""
    resists: bool
    """Whether floor or air resist rolling, pivoting or the run of the contact point round the rim."""
    has_one_step: bool
    """Whether a contact is one step."""
    flight_angle: float
    """Largest turn in a step of flight [rad]."""


@inlined
def joint_of(coin: MujocoCoin) -> Joint:
    """Return MuJoCo's arrays of the free joint."""
    at = coin.joint
    return Joint(
        numbers_at(at.qpos, (7,)),
        numbers_at(at.qvel, (6,)),
        numbers_at(at.qacc, (6,)),
        numbers_at(at.qacc_smooth, (6,)),
        numbers_at(at.qfrc_constraint, (6,)),
        numbers_at(at.qfrc_actuator, (6,)),
        numbers_at(at.qfrc_passive, (6,)),
        numbers_at(at.qfrc_bias, (6,)),
        numbers_at(at.qfrc_applied, (6,)),
    )


@inlined
def run(coin: MujocoCoin, function: int) -> None:
    """Run one of the `Functions` that take nothing but model and data."""
    call_c(function, (coin.address.model, coin.address.data))
