"""The states of a sustained contact between its ends, and the floor's force there."""

import numpy as np

from cointoss.analytic.contact.automaton import flow
from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.contact.integrator import END_ROW, accepted_step, contact_work, step_of_length
from cointoss.analytic.flight.equations_of_motion import flight_in, write_rate
from cointoss.analytic.flight.state_vector import STATE_SIZE, state_of, velocity_of
from cointoss.models.kernel.arrays import copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, scale, subtract
from cointoss.models.records import Array


@compiled
def sample_contact(
    contact: SustainedContact, start: Array, start_time: float, times: Array, tolerance: float, states: Array
) -> None:
    """Write the states of one contact at `times` into `states`.

    Args:
        contact: the contact, its rim that of `start`.
        start: state at the start of the contact, (13,).
        start_time: its time [s].
        times: increasing, none before start_time, (n,) [s].
        tolerance: error allowed in a step, relative to the scales of the coin.
        states: where they go, (n, 13).
    """
    stages, y, y_new = contact_work(contact, start), start.copy(), np.empty(STATE_SIZE)
    elapsed = 0.0
    made, dt, _ = accepted_step(contact, y, np.inf, tolerance, stages, y_new)
    for i in range(len(times)):
        # The steps are those of `step_contact`: a time between them changes none.
        while made > 0 and times[i] - start_time > elapsed + made:
            elapsed += made
            copy_into(y, y_new)
            copy_into(stages[0], stages[END_ROW])
            made, dt, _ = accepted_step(contact, y, dt, tolerance, stages, y_new)
        step_of_length(contact, y, times[i] - start_time - elapsed, stages, states[i])


@compiled
def floor_force(contact: SustainedContact, y: Array) -> Vector:
    """Return the floor's force, of both rims where a coin is upright, space frame, (3,) [N].

    It is what the rate of change in contact has more than that of free flight.

    Args:
        contact: the contact, its rim that of y.
        y: state, (13,).
    """
    free, held = np.empty(STATE_SIZE), np.empty(STATE_SIZE)
    write_rate(contact.body, flight_in(contact.body, state_of(y), True), free)
    flow(contact, y, held)
    return scale(contact.body.mass, subtract(velocity_of(held), velocity_of(free)))
