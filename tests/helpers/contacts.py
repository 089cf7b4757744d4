"""Sustained contact a step at a time, at the tolerance of flights."""

from analytic.contact.following import follow, start_following
from analytic.numerics.tolerances import STEP_ERROR
from models.body import Body
from models.records import Array


def follow_step(body: Body, mu: float, mode: int, y: Array, dt: float):
    """Follow a contact for one step, or to its end; see `analytic.contact.following.follow`."""
    return follow(body, mu, mode, y, dt, STEP_ERROR, start_following(body, mu, mode, y))
