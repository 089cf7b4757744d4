"""Where a coin comes to rest, as a record and as columns of many tosses."""

from dataclasses import dataclass

from cointoss.models.words import Word

REST = ("rest_reason", "rest_time", "rest_x", "rest_y", "rest_heading", "rest_path", "rest_error")
"""The columns of what is known of the rest of many coins; what there is none of is NaN."""


class RestReason(Word):
    """That a coin comes to rest, or why none was found."""

    AT_REST = 0
    UNDECIDED = 1
    CAUGHT = 2
    FRICTIONLESS = 3
    SLOPE = 4
    MOVING = 5


SENTENCES = {
    RestReason.AT_REST: "The coin comes to rest.",
    RestReason.UNDECIDED: "A budget ended the toss, or its contact law goes no further.",
    RestReason.CAUGHT: "A hand caught the coin.",
    RestReason.FRICTIONLESS: "Nothing stops the coin: the floor has no friction, and there is no air.",
    RestReason.SLOPE: "Friction cannot hold the coin on this slope.",
    RestReason.MOVING: (
        "The coin still moves a minute after its toss, at [ending] max_time, when its steps are spent, "
        "or where its contact law goes no further."
    ),
}
"""What each reason means."""


@dataclass(frozen=True, kw_only=True)
class Rest:
    """Where and when a coin comes to rest; all in the space frame, of the coin's centre B."""

    time: float
    """The time at which it is at rest [s]."""
    x: float
    """The place of B along x [m]."""
    y: float
    """The place of B along y [m]."""
    heading: float
    """The angle from x to ξ of a coin that lies, to ζ of one on its edge, counterclockwise seen from above,
    from -π to π [rad]."""
    path: float
    """The length of the path of B over the floor, seen from above, from the first touch on [m]."""
    error: float | None
    """Estimate of how far the engine's own errors displace a point of the rim [m]; no bound. None where a
    neighbour of the toss, which differs by such errors, does not come to rest."""
