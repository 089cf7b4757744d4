"""MuJoCo's coin: its model and data, and what compiled code knows of them."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import math
from dataclasses import replace
from typing import NamedTuple

import mujoco

from cointoss.coin_mj.model.library import functions, require_no_contact_filter
from cointoss.coin_mj.model.memory import OF_ROWS, in_contact, joint_addresses, offset_of, require_layout
from cointoss.coin_mj.model.mujoco_coin import Addresses, MujocoCoin
from cointoss.coin_mj.model.scene import build, floor_height, shape_thickness
from cointoss.coin_mj.model.settings import (
    Friction,
    MujocoSettings,
    Realisation,
    friction_of,
    rebound_of,
    resolved,
)
from cointoss.coin_mj.model.state import of_release
from cointoss.models.body import Body, is_ideal, resists
from cointoss.models.contour import Contour
from cointoss.models.entries import body_in_any_air, largest_restitution
from cointoss.models.rows import row_of
from cointoss.models.scenario import Scenario

_Disable = mujoco.mjtDisableBit
# What a lone coin has no use for. Without a warm start a step depends on nothing but the state.
# Euler's step takes damping as any other force.
_UNUSED = (
    int(_Disable.mjDSBL_ISLAND)
    | int(_Disable.mjDSBL_MIDPHASE)
    | int(_Disable.mjDSBL_WARMSTART)
    | int(_Disable.mjDSBL_EULERDAMP)
)

UNSYMMETRIC = 0.65
"""Largest turn in a step of flight of a coin that is no balanced symmetric top [rad]: it keeps less nearly to
the frame of its step, see `cointoss.coin_mj.steps.turning_frame`."""
LONG = 4.0
"""Ratio of the moments of inertia above which a coin is a rod: it turns end over end as about one moment."""
SMALLEST_INERTIA = 1e-12
"""Below it MuJoCo's compiler, which accepts 1e-15, is given another unit of mass [kg m²]."""


class Machine(NamedTuple):
    """MuJoCo's model and data of one coin; they must outlive `coin`, which looks into them."""

    model: mujoco.MjModel
    data: mujoco.MjData
    settings: MujocoSettings
    """The settings as `resolved` returns them."""
    mass_unit: float
    """Unit of masses, forces and energies in MuJoCo: a power of 2, so that no digit changes [kg]."""
    coin: MujocoCoin
    plastic: MujocoCoin
    """The same coin where a touch is plastic: one step with χ = 0, which no spring has."""


def machine_of(
    scenario: Scenario, settings: MujocoSettings, thickness: float | None = None, softer: float = 1.0
) -> Machine:
    """Return the MuJoCo coin of a scenario at its release.

    Args:
        scenario: what to toss.
        settings: how MuJoCo realises the floor, made `resolved`.
        thickness: of the coin's shape, by default `shape_thickness` [m].
        softer: then softened by this part, see `MujocoSettings.softened`.

    Raises:
        UnusableEngineError: if MuJoCo's user filters contacts.
        LayoutError: if MuJoCo's memory is not laid out as it describes.
    """
    require_no_contact_filter()
    require_layout(*in_contact())
    thickness = thickness or shape_thickness(scenario)
    floor, unit = scenario.floor, _mass_unit(scenario.body)
    rate = math.sqrt(scenario.gravity / scenario.coin.radius)
    settings = resolved(settings, largest_restitution(scenario.rules), rate).softened(softer)
    scenario = scenario if unit == 1 else _in_mass_unit(scenario, unit)
    rebound, body, mu = (
        rebound_of(floor.restitution, settings),
        body_in_any_air(row_of(scenario)),
        friction_of(floor),
    )
    native = mu if settings.friction == Friction.NATIVE else 0.0
    model = build(scenario, rebound, native, thickness)
    model.opt.disableflags |= _UNUSED
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = of_release(body, scenario.release)
    coin = MujocoCoin(
        mujoco=functions(),
        address=_addresses(model, data, has_pair=native > 0),
        joint=joint_addresses(data),
        body=body,
        shape=shape_of(body, thickness),
        floor_height=floor_height(scenario, thickness),
        rebound=rebound,
        friction=mu,
        rolling_friction=floor.rolling_friction,
        pivoting_friction=floor.pivoting_friction,
        contour=Contour(floor.contour_friction, floor.contour_viscosity, scenario.air.viscosity),
        is_balanced=not any(scenario.coin.center_of_mass),
        has_explicit_friction=settings.friction == Friction.EXPLICIT and mu > 0,
        resists=resists(scenario.rules),
        has_one_step=settings.contact == Realisation.ONE_STEP,
        flight_angle=settings.flight_angle if is_ideal(body) else min(settings.flight_angle, UNSYMMETRIC),
    )
    one_step = replace(settings, contact=Realisation.ONE_STEP, step=rebound.step)
    plastic = coin._replace(rebound=rebound_of(0.0, one_step), has_one_step=True)
    return Machine(model, data, settings, unit, coin, plastic)


def shape_of(body: Body, thickness: float) -> Body:
    """Return the body with the thickness of its shape [m], for the search of its touches.

    How a rod turns about its own axis hardly moves its ends, and its small moment of inertia there would make
    all bounds on their motion useless. For these bounds a rod has the largest moment there too, and half of
    it for the smallest: their ω̃ is then above |ω|, and their ω⊥ grows at the rate ω̃, as that of a rod may.
    """
    largest = body.inertia_largest
    across, other, (x, y, _) = body.inertia
    if largest <= LONG * body.inertia_smallest or min(across[0], other[1]) < largest / 2:
        return body._replace(thickness=thickness)
    return body._replace(
        thickness=thickness, inertia=(across, other, (x, y, largest)), inertia_smallest=largest / 2
    )


def _mass_unit(body: Body) -> float:
    """Return a power of 2 in which no moment of inertia is too small for MuJoCo; 1 where none is [kg]."""
    smallest = body.inertia_smallest
    return 1.0 if smallest > SMALLEST_INERTIA else math.ldexp(0.5, math.frexp(smallest / SMALLEST_INERTIA)[1])


def _in_mass_unit(scenario: Scenario, unit: float) -> Scenario:
    """Return a scenario with masses and coefficients of the air in another unit of mass [kg]."""
    coin, air = scenario.coin, scenario.air
    inertia = coin.inertia and [[moment / unit for moment in row] for row in coin.inertia]
    return scenario.replace(
        *("coin.mass", coin.mass / unit, "coin.inertia", inertia),
        *("air.normal", air.normal / unit, "air.tangential", air.tangential / unit),
        *("air.viscosity", air.viscosity / unit),
    )


def _addresses(model: mujoco.MjModel, data: mujoco.MjData, *, has_pair: bool) -> Addresses:
    """Return where their fields lie; a contact with friction has its settings from a pair of geoms."""
    geom = model.geom("coin")
    spring, slip, margin = (
        (model.pair_solref, model.pair_solreffriction, model.pair_margin)
        if has_pair
        else (geom.solref, None, geom.margin)
    )
    fields = ("time", "nefc", *OF_ROWS)
    return Addresses(
        model=model._address,
        data=data._address,
        timestep=model._address + offset_of("mjModel", "opt.timestep"),
        solref=spring.ctypes.data,
        solreffriction=0 if slip is None else slip.ctypes.data,
        margin=margin.ctypes.data,
        xmat=data.body("coin").xmat.ctypes.data,
        **{name: data._address + offset_of("mjData", name) for name in fields},
    )
