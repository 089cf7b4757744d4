"""Where coins come to rest: rows of numbers with their errors, and as a toss says it."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from cointoss.models.fields import FIELDS
from cointoss.models.kernel.arrays import Array
from cointoss.models.records import Toss
from cointoss.models.resting_place import REST, Rest, RestReason
from cointoss.models.rows import AT

_MOTION = [i for i, field in enumerate(FIELDS) if field.startswith(("release.velocity", "release.angular"))]


def with_errors(rows: Array, follow: Callable[[Array, Array, bool], None], change: float) -> Array:
    """Return where coins come to rest, and how far each is from a neighbour that differs by errors, (n, 7).

    Args:
        rows: of the scenarios, (n, m).
        follow: writes where the coins of some rows come to rest, by the columns of `REST`, into a table of
            NaN, (n, 7); and does so with larger errors where asked.
        change: of the neighbours' velocity and spin, and of their height above all touches, relative.
    """
    rests = np.full((len(rows), len(REST)), np.nan)
    follow(rows, rests, False)
    at_rest = rests[:, 0] == RestReason.AT_REST
    near, others = rows[at_rest], np.full((at_rest.sum(), len(REST)), np.nan)
    height, radius = near[:, AT.release_position_z], near[:, AT.coin_radius]
    height[height > 2 * np.hypot(radius, near[:, AT.coin_thickness])] *= 1 + change
    near[:, _MOTION] *= 1 + change
    follow(near, others, True)
    _, _, x, y, heading, _, _ = (rests[at_rest] - others).T
    turned = np.abs((heading + np.pi) % (2 * np.pi) - np.pi)
    rests[at_rest, -1] = np.hypot(x, y) + radius * turned
    return rests


def with_rest(toss: Toss, rests: Array) -> Toss:
    """Return a toss that says where its coin comes to rest, from that row of `REST`, (1, 7)."""
    code, *numbers = (None if math.isnan(one) else one for one in rests[0].tolist())
    named: Any = dict(zip((name.removeprefix("rest_") for name in REST[1:]), numbers, strict=True))
    reason = RestReason(int(code or 0))
    return replace(toss, rest=Rest(**named) if reason == RestReason.AT_REST else None, rest_reason=reason)
