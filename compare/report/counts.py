"""Why the engines of a comparison count different numbers of impacts."""

import math
from collections.abc import Sequence

from cointoss.compare.output.language import listed
from cointoss.models.records import Toss

OF_A_SPRING = ": MuJoCo’s contact is a spring, and lets go of the floor at other moments than a rigid one"


def counts_sentence(tosses: Sequence[Toss]) -> str:
    """Return why counts of impacts differ where a coin stays on the floor; empty where they need no reason.

    Args:
        tosses: by one engine or several, the analytic first.
    """
    counts = [len(toss.impacts) for toss in tosses]
    if len(set(counts)) == 1 or not any(len(toss.contacts) for toss in tosses):
        return ""
    starts = [toss.contacts[:1, 0].min(initial=math.inf) for toss in tosses]
    before = [int((each.impacts.time <= start).sum()) for each, start in zip(tosses, starts, strict=True)]
    after = [count - first for count, first in zip(counts, before, strict=True)]
    said = []
    if len(set(before)) > 1:
        said.append(
            f"Until the coin first stays on the floor the engines count {listed(before)} impacts: bounces "
            "that die out have no last one, and each engine takes the smallest for contact."
        )
    if any(after):
        spring = any(toss.engine == "mujoco" for toss in tosses)
        said.append(
            f"{'After that' if said else 'Once the coin has been in contact'} they count {listed(after)}"
            f"{OF_A_SPRING if spring else ''}."
        )
    return " ".join(said)
