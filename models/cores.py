"""How many cores this process uses."""

import os


class CoresError(ValueError):
    """`COINTOSS_THREADS` is no number of cores."""


def cores_used() -> int:
    """Return how many cores this process uses: `COINTOSS_THREADS`, else those that it may use.

    Raises:
        CoresError: for a variable that is no such number.
    """
    asked = os.environ.get("COINTOSS_THREADS", "")
    if not asked:
        affinity = getattr(os, "sched_getaffinity", None)  # not on every system
        return len(affinity(0)) if affinity is not None else os.cpu_count() or 1
    if not (asked.isdecimal() and int(asked) >= 1):
        raise CoresError(f"COINTOSS_THREADS = {asked!r}: accepted: a whole number >= 1, or unset")
    return int(asked)
