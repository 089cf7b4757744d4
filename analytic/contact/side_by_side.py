"""A step of sustained contact of four coins, each in a lane of vectors: the same to the bit as by itself."""

import numpy as np

from cointoss.analytic.contact.automaton import flow_in_lanes, project_in_lanes
from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.contact.integrator import END_ROW, NEW_ROW, ROWS
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.flight.runge_kutta import end_point, error_sums, stage_point
from cointoss.analytic.flight.state_vector import STATE_SIZE, normalise
from cointoss.analytic.numerics.tableau import STAGES
from cointoss.models.body import Body
from cointoss.models.kernel.arrays import Cube
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.lanes import WIDTH, in_lanes

START_ROW, NUMBERS_ROW = ROWS, ROWS + 1
"""Rows of the work space, after those of `contact_work`: the states at the start, and numbers."""
RIM, LONGEST, LENGTH, SHORT, INSIDE, LEFT, SUM_5, SUM_3 = range(8)
"""Columns there: of each coin the rim; the longest step, the length of this one, and one that is short; the
least margin at the stages and that at the end; and the `error_sums`."""


@compiled
def lanes_work() -> Cube:
    """Return the work space of a step of four coins, (17, 13, 4)."""
    return np.empty((NUMBERS_ROW + 1, STATE_SIZE, WIDTH))


@compiled
def step_in_lanes(body: Body, friction: FloorFriction, mode: int, work: Cube) -> None:
    """Advance four coins by a step of contact, each by its own length; see `integrator.step_of_length`.

    Args:
        body: the coin.
        friction: of the floor.
        mode: number of the `Mode`, one of `automaton.IN_LANES`.
        work: see `lanes_work`; it has states and slopes at the start, rims and lengths, and gets the rest.
    """
    stages = in_lanes(work)
    y, y_new, numbers = stages[START_ROW], stages[NEW_ROW], stages[NUMBERS_ROW]
    contact, dt, inside = SustainedContact(body, friction, mode, numbers[RIM]), numbers[LENGTH], np.inf
    for stage in range(1, STAGES):
        stage_point(y, dt, stages, stage, y_new)
        inside = min(inside, flow_in_lanes(contact, y_new, stages[stage]))
    end_point(y, dt, stages, y_new)
    normalise(y_new)
    project_in_lanes(contact, y_new)
    numbers[INSIDE], numbers[LEFT] = inside, flow_in_lanes(contact, y_new, stages[END_ROW])
    numbers[SUM_5], numbers[SUM_3] = error_sums(body, y, stages)
