"""A scenario as a row of numbers: where each field stands, and what compiled code reads and refuses."""

# Words are integers in the numbers of a scenario.
# pyright: reportArgumentType=false

import math
from collections import namedtuple
from typing import Any

import numpy as np

from cointoss.models.attitude import normalized, quaternion_from_angles
from cointoss.models.barriers import barrier
from cointoss.models.body import NO_CODE, AirLaw, Body, Rules, with_budgets
from cointoss.models.faults import (
    Fault,
    FoundFault,
    fault_of_coin,
    fault_of_floor,
    fault_of_quaternion,
    fault_of_toss,
)
from cointoss.models.fields import FIELDS, PLACES, TABLES, WORDED, Place
from cointoss.models.geometry import contact_velocity, gap, lowest_point
from cointoss.models.kernel.arrays import Array, Codes, Row, Table, copy_into, four, three
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, scale
from cointoss.models.making import MOST_LOSSLESS, Cylinder, make_body, most_impacts, moved_inertia
from cointoss.models.scenario import Scenario
from cointoss.models.state import State, state
from cointoss.models.words import Word

NOT_TOSSED, REFUSED = -1, -2
"""In place of an outcome: of a toss that was not made, and of numbers that make no scenario."""


def fields_of(scenario: Scenario) -> dict[str, float | str]:
    """Return a scenario as a page has it: its fields by their names, numbers in SI."""
    tables = scenario.as_tables()
    found = {name: _value(tables, place) for name, place in PLACES.items()}
    found["ending.until"] = scenario.ending.until
    return {name: value for name, value in found.items() if value is not None}


def row_of(scenario: Scenario) -> Array:
    """Return a scenario as a row of numbers, (n,), in the order of `FIELDS`."""
    given = fields_of(scenario)
    given |= {name: kind(given[name]).value for name, kind in WORDED.items()}
    return np.array([given.get(name, math.nan) for name in FIELDS], dtype=float)


def _value(tables: Any, place: Place) -> float | str | None:
    for step in place:
        if isinstance(step, str) and step not in tables:
            return None
        tables = tables[step]
    return tables


def default_of(place: Place) -> tuple[float | str | None, bool]:
    """Return the default of a field, None for nothing, and whether it has to be given."""
    model: Any = Scenario
    for step in place[:-1]:
        if isinstance(step, str) and step in TABLES:
            model = TABLES[step]
    field = model.model_fields[next(step for step in reversed(place) if isinstance(step, str))]
    if field.is_required():
        return None, True
    value = field.default
    for step in place:
        if isinstance(step, int) and value is not None:
            value = value[step]
    return str(value) if isinstance(value, Word) else value, False


def _first_places() -> tuple[int, ...]:
    found: dict[Place, int] = {}
    return tuple(
        found.setdefault(place[:2], i) if default_of(place) == (None, False) else -1
        for i, place in enumerate(PLACES.values())
    )


FIRST = _first_places()
"""The place of the first number of the list of each field that may be left out; -1 for the other fields."""


EXAMINED = ("fault", "limit", "barrier")
"""Columns of what is said of a scenario: its `Fault`, the number in its sentence, and the least energy with
which the coin turns over [J], NaN of a row that is no scenario's."""
AT = namedtuple("Places", [name.replace(".", "_") for name in FIELDS])(*range(len(FIELDS)))
"""The place of each field in a row by its name, as compiled code reads it: `row[AT.floor_restitution]`."""


@compiled
def foreign_number(row: Array) -> int:
    """Return the place of the first number that no scenario's row has there, -1 where there is none.

    All are finite, but for the parts of a scenario that are left out, which are not a number as a whole.
    """
    for i in range(len(FIRST)):
        is_left_out = FIRST[i] >= 0 and math.isnan(row[FIRST[i]])
        if not (math.isnan(row[i]) if is_left_out else math.isfinite(row[i])):
            return i
    return -1


@compiled
def cylinder_of(row: Array) -> Cylinder:
    """Return the mass and the size of the coin of a row of `FIELDS`."""
    return Cylinder(row[AT.coin_mass], row[AT.coin_radius], row[AT.coin_thickness])


@compiled
def has_inertia(row: Array) -> bool:
    """Return whether a row gives the inertia, which else is the cylinder's."""
    return not math.isnan(row[AT.coin_inertia_xi_xi])


@compiled
def inertia_of(row: Array) -> Matrix:
    """Return J_C of the coin of a row, body frame [kg m²]."""
    if has_inertia(row):
        return (
            three(row, AT.coin_inertia_xi_xi),
            three(row, AT.coin_inertia_eta_xi),
            three(row, AT.coin_inertia_zeta_xi),
        )
    return moved_inertia(cylinder_of(row), three(row, AT.coin_center_of_mass_xi))


@compiled
def body_of(row: Array, exponent: float | None) -> Body:
    """Return the coin of a row.

    Args:
        row: of a scenario.
        exponent: of its air; None for linear air, which is compiled apart.
    """
    air = AirLaw(exponent, row[AT.air_normal], row[AT.air_tangential])
    center = three(row, AT.coin_center_of_mass_xi)
    return make_body(cylinder_of(row), center, inertia_of(row), air, row[AT.gravity], row[AT.floor_slope])


@compiled
def has_linear_air(row: Array) -> bool:
    """Return whether the air of a row is linear in the velocity, or none."""
    return row[AT.air_exponent] == 0 or (row[AT.air_normal] == 0 and row[AT.air_tangential] == 0)


@compiled
def body_in_any_air(row: Row) -> Body:
    """Return the coin of a row, with 0 for the exponent of linear air."""
    return body_of(row, 0.0 if has_linear_air(row) else row[AT.air_exponent])


@compiled
def rules_of(row: Row) -> Rules:
    """Return the `Rules` of a row; words are integers there."""
    caught = math.inf if math.isnan(row[AT.ending_caught]) else row[AT.ending_caught]
    rules = Rules(
        law=int(row[AT.floor_contact]),
        own=NO_CODE,
        restitution=row[AT.floor_restitution],
        restitution_threshold=row[AT.floor_restitution_threshold],
        restitution_speed=row[AT.floor_restitution_speed],
        restitution_exponent=row[AT.floor_restitution_exponent],
        restitution_viscous=row[AT.floor_restitution_viscous],
        restitution_kind=int(row[AT.floor_restitution_kind]),
        friction=row[AT.floor_friction],
        rolling_friction=row[AT.floor_rolling_friction],
        pivoting_friction=row[AT.floor_pivoting_friction],
        contour_friction=row[AT.floor_contour_friction],
        contour_viscosity=row[AT.floor_contour_viscosity],
        viscosity=row[AT.air_viscosity],
        test=int(row[AT.ending_test]),
        max_impacts=MOST_LOSSLESS,
        max_time=row[AT.ending_max_time],
        caught=caught,
    )
    max_impacts = most_impacts(rules)
    if not math.isnan(row[AT.ending_max_impacts]):
        max_impacts = int(row[AT.ending_max_impacts])
    return with_budgets(rules, max_impacts, rules.max_time)


@compiled
def release_of(row: Array) -> State:
    """Return the state at the release of a row; without an attitude the coin is flat, heads up."""
    q = four(row, AT.release_quaternion_e0)
    if not math.isnan(q[0]):
        e = normalized(q)
    elif not math.isnan(row[AT.release_angles_psi]):
        e = quaternion_from_angles(three(row, AT.release_angles_psi))
    else:
        e = quaternion_from_angles((0.0, 0.0, 0.0))
    return state(
        three(row, AT.release_position_x),
        three(row, AT.release_velocity_x),
        e,
        three(row, AT.release_angular_velocity_xi),
    )


@compiled
def write_release(row: Array, y: Array) -> None:
    """Write the state at the release of a row as a state vector, (13,)."""
    release = release_of(row)
    copy_into(y, release.position + release.velocity + release.attitude + release.spin)


@compiled
def roll_each(rows: Table) -> None:
    """Set the coin of each row on the floor, its lowest point at rest there: its height and its velocity.

    Rows that are no scenario's for a number that is missing stay as they are.
    """
    for i in range(len(rows)):
        row = rows[i]
        if foreign_number(row) >= 0:
            continue
        body, release = body_in_any_air(row), release_of(row)
        A, _ = lowest_point(body, release.R[2], release.spin)
        row[AT.release_position_z] = -gap(body, 0.0, release.R[2])
        v = contact_velocity(body, release.R, (0.0, 0.0, 0.0), release.spin, A)
        copy_into(row[AT.release_velocity_x : AT.release_velocity_x + 3], scale(-1.0, v))


@compiled
def write_attitudes(rows: Table, attitudes: Table) -> None:
    """Write the Euler parameters at the release of each row, (n, 4)."""
    for i in range(len(rows)):
        copy_into(attitudes[i], release_of(rows[i]).attitude)


@compiled
def fault_of_parts(row: Row) -> FoundFault:
    """Return what is wrong with the coin, the floor or the attitude of a row, each for itself."""
    center = three(row, AT.coin_center_of_mass_xi)
    found = fault_of_coin(cylinder_of(row), center, inertia_of(row), has_inertia(row))
    if found.fault == Fault.NONE:
        found = fault_of_floor(
            int(row[AT.floor_contact]),
            int(row[AT.floor_restitution_kind]),
            row[AT.floor_rolling_friction],
            row[AT.floor_pivoting_friction],
            row[AT.floor_contour_friction],
            row[AT.floor_contour_viscosity],
        )
    q = four(row, AT.release_quaternion_e0)
    if found.fault == Fault.NONE and not math.isnan(q[0]):
        found = fault_of_quaternion(q)
    return found


@compiled
def fault_of(body: Body, row: Row) -> FoundFault:
    """Return what is wrong with the scenario of a row, whose coin is `body`."""
    found = fault_of_parts(row)
    return found if found.fault != Fault.NONE else fault_of_toss(body, rules_of(row), release_of(row))


@compiled
def bodies_alike(first: Array, second: Array) -> bool:
    """Return whether two rows have the same coin, air and gravity."""
    return _alike(first, second, 0, AT.floor_restitution) and _alike(
        first, second, AT.floor_slope, AT.floor_slope + 1
    )


@compiled
def floors_alike(first: Array, second: Array) -> bool:
    """Return whether the floors of two rows have the same contact law and friction."""
    return _alike(first, second, AT.floor_contact, AT.floor_slope)


@compiled
def _alike(first: Array, second: Array, start: int, end: int) -> bool:
    for i in range(start, end):
        if not (first[i] == second[i] or (math.isnan(first[i]) and math.isnan(second[i]))):
            return False
    return True


@compiled
def run_end(rows: Table, first: int) -> int:
    """Return the place after the last of the rows from `first` on that have one coin, air and gravity."""
    end = first + 1
    while end < len(rows) and bodies_alike(rows[first], rows[end]):
        end += 1
    return end


@compiled
def examine_each(rows: Table, faults: Codes) -> None:
    """Write the `Fault` of each row, 0 of a scenario's.

    Args:
        rows: of numbers, each within its bounds where it is finite, (n, m).
        faults: where they go, (n,).
    """
    first = 0
    while first < len(rows):
        end, body = run_end(rows, first), body_in_any_air(rows[first])
        for i in range(first, end):
            is_foreign = foreign_number(rows[i]) >= 0
            faults[i] = Fault.ROW.value if is_foreign else fault_of(body, rows[i]).fault.value
        first = end


@compiled
def examine(row: Row, answer: Row) -> None:
    """Say whether a row is a scenario.

    Args:
        row: of numbers, each within its bounds where it is finite.
        answer: where it goes, (3,), see `EXAMINED`.
    """
    place = foreign_number(row)
    if place >= 0:
        copy_into(answer, (float(Fault.ROW.value), float(place), math.nan))
    else:
        body = body_in_any_air(row)
        found, least = fault_of(body, row), min(barrier(body, 1.0), barrier(body, -1.0))
        copy_into(answer, (float(found.fault.value), found.limit, least))
