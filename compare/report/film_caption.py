"""What stands below the film of a report: which tosses it shows, how fast it runs, and where it ends."""

import math
from collections.abc import Container, Sequence

from cointoss.compare.film.filmed import FOLLOWED_FOR, goes_on
from cointoss.models.records import Ending, Toss

COLORS = "Gold with an H is heads, blue with a T is tails."
ARROWS = (
    "Pink arrows are impulses, green arrows the floor’s force in sustained contact; their lengths are "
    "proportional to their sizes, a force’s up to twice the weight."
)


def film_caption(tosses: Sequence[Toss], absent: Container[str] = ()) -> str:
    """Return the caption of a film.

    Args:
        tosses: by one engine or several, side by side.
        absent: the engines that can't toss what the film shows.
    """
    touches = any(len(toss.impacts) or len(toss.contacts) or goes_on(toss) for toss in tosses)
    slope = math.degrees(tosses[0].scenario.floor.slope)
    return " ".join(
        [
            _shown(tosses, absent),
            *([f"It is drawn in the floor’s frame: x is downhill, by {slope:.3g}°."] if slope else []),
            COLORS,
            *_slows(tosses),
            _ends(tosses),
            *([ARROWS] if touches else []),
        ]
    )


def _shown(tosses: Sequence[Toss], absent: Container[str]) -> str:
    if len(tosses) > 1:
        return f"{_all(tosses).capitalize()} tosses at the same times, drawn by MuJoCo."
    but = ", which can’t toss it" if "mujoco" in absent else ""
    return f"The toss by the analytic engine, drawn by MuJoCo{but}."


def _all(tosses: Sequence[Toss]) -> str:
    return "both" if len(tosses) == 2 else "all"


def _slows(tosses: Sequence[Toss]) -> list[str]:
    around = [
        *(["around each strong impact"] if any(len(toss.impacts) for toss in tosses) else []),
        *(["where the coin is caught"] if any(toss.ending == Ending.CAUGHT for toss in tosses) else []),
    ]
    return [f"The film slows down {' and '.join(around)}."] if around else []


def _ends(tosses: Sequence[Toss]) -> str:
    many = len(tosses) > 1
    if any(goes_on(toss) for toss in tosses):
        settled = f"{_all(tosses)} faces are settled" if many else "the face is settled"
        still = "the coins lie still" if many else "the coin lies still"
        return f"It goes on at real speed when {settled}, until {still} or {FOLLOWED_FOR:g} s have passed."
    if all(toss.ending == Ending.CAUGHT for toss in tosses):
        return "It ends with the coin in the hand."
    return f"It ends as the toss{'es do' if many else ' does'}."
