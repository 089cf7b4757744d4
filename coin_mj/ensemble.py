"""Many tosses in MuJoCo, on all cores."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from coin_mj.events import toss_coin
from coin_mj.model.air_callback import air_of
from coin_mj.model.machine import machine_of
from coin_mj.model.scene import shape_thickness
from coin_mj.model.settings import ContactSettings, Friction, Realisation
from coin_mj.model.state import put_at
from coin_mj.toss import require_supported, warn_of_approximation
from models.kernel.compiled import compiled
from models.outcomes import Outcomes
from models.records import IMPACT_ROW
from models.releases import Releases, check_releases
from models.scenario import Scenario
from models.tiles import toss_in_tiles

TILE = 32
"""Tosses that a thread makes at a time, with one model."""
MANY = ContactSettings(stiffness=1e10, steps=12, flight_angle=0.25)
"""Of many tosses: a softer spring, fewer and larger steps than those of one."""


def toss_many(
    scenario: Scenario,
    releases: Releases,
    *,
    realisation: Realisation = Realisation.SPRING,
    friction: Friction = Friction.EXPLICIT,
    stiffness: float = MANY.stiffness,
    steps: int = MANY.steps,
    flight_angle: float = MANY.flight_angle,
) -> Outcomes:
    """Toss the coin once from each release, by the event loop of `toss`.

    Each toss is that of `toss` with the same settings, to the bit. By default they are coarser than those of
    one toss: docs/MUJOCO.md says what error they give.

    Args:
        scenario: what to toss; its own release is not used.
        releases: the states at time 0.
        realisation: how a contact gives the restitution.
        friction: who makes the friction of a floor that has one.
        stiffness: of the spring, per unit of effective mass [1/s²].
        steps: in half a period of the spring.
        flight_angle: largest turn of the coin in a step of free flight [rad].

    Returns:
        How each toss ended, in the order of `releases`. The paths are not kept.

    Raises:
        UnsupportedError: as `toss`.
        ValueError: for a release that a scenario with this coin and air would refuse.

    Warns:
        ApproximationWarning: as `toss`.
    """
    require_supported(scenario, realisation)
    warn_of_approximation(scenario)
    check_releases(scenario, releases)
    settings = ContactSettings(
        realisation=realisation,
        friction=friction,
        stiffness=stiffness,
        steps=steps,
        flight_angle=flight_angle,
    )
    thickness, rules = shape_thickness(scenario), scenario.rules

    def toss_tile(*columns: NDArray[Any]) -> None:
        machine = machine_of(scenario, settings, thickness)
        with air_of(machine.model):
            _toss_each(machine.coin, rules, *columns)

    return toss_in_tiles(releases, TILE, toss_tile)


@compiled
def _toss_each(coin, rules, states, outcomes, endings, faces, impacts, end_times):
    rows = np.zeros(1, IMPACT_ROW)
    for i in range(len(states)):
        put_at(coin, states[i])
        n, _, _, _, outcome, ending, end_time = toss_coin(coin, rules, rows, False)
        outcomes[i], endings[i], impacts[i], end_times[i] = outcome.value, ending.value, n, end_time
        faces[i] = rows[0].face if n > 0 else 0
