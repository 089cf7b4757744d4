"""The tolerances of the analytic engine: what counts as touching, as slow, as upright, and why."""

from cointoss.models import rest

STEP_ERROR = 1e-13
"""Error allowed in one step of the integrator, relative to the scales of the coin."""

CONTACT_STEP_ERROR = 1e-9
"""Error allowed in a step of sustained contact, by default. Contacts come after the horizon of trust: what
comes before them has made errors far larger than those of their own steps."""

TOUCH = 1e-14
"""A gap below this part of the radius is zero within rounding."""
CLOSED_TOUCH = 2e-15
"""A gap below this part of the radius is zero where the flight is in closed form, whose rounding is less."""
SINK = 1e-13
"""Each of three causes may lower the gap by this part of the radius in a step forced at a grazing point."""
TIME_STEP = 2.3e-16
"""Time of flight has no finer step than this part of it."""
CHATTERING = 1e-2
"""Impacts chatter when in the time of all still to come the coin turns by less than this angle times the sine
of its tilt [rad]. Contact has their impulse and mean force: it errs by the third power of the angle."""

SLOW = rest.SLOW
"""Relative to √(g r): slower slip is stopped where friction can hold it, and is incipient elsewhere, where
friction would turn it in the time slip/(μ g). A sliding point goes on sliding down to half of this speed."""
BORDER = 1e-6
"""Friction holds a stuck point up to this part beyond the limit at which it starts to hold one: otherwise a
coin at the limit would start and stop for ever."""
ON_EDGE = 1e-3
"""A thick coin is on its edge where it leans by less than this part of h/(2 r), which tips it over, and turns
off its edge by less than this part of h/(2 r) √(g/r)."""
STEADY = 0.25
"""A coin that rocks on its edge is said to stand if its rocking cannot lift it beyond this part of the lean
that tips it over."""
