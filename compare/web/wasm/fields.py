"""The fields of a scenario in a page's words: what each accepts, and its default."""

from typing import Any

from cointoss.models.describing import accepted, ends_of
from cointoss.models.fields import UNITS, WORDED, WORDS, Place
from cointoss.models.rows import default_of
from cointoss.models.scenario import Scenario
from cointoss.models.units import printed_unit


def described(name: str, place: Place) -> dict[str, Any]:
    """Return what a page has to know of a field to check a value, in the package's own words.

    Args:
        name: of the field.
        place: of it in a scenario file, see `cointoss.models.fields.PLACES`.
    """
    default, is_required = default_of(place)
    ends = ends_of(place, Scenario)
    texts = {problem: accepted(place, Scenario, problem) for problem in ("type", "finite", "bounds")}
    if is_required:
        texts["missing"] = accepted(place[:2], Scenario, "missing")
    return {
        "name": name,
        "shown": "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in place)[1:],
        "word": WORDS.get(name, name),
        "unit": printed_unit(UNITS.get(name, "")),
        "default": default,
        "words": WORDED[name].by_value() if name in WORDED else None,
        "whole": name == "ending.max_impacts",
        "least": ends.get("ge"),
        "most": ends.get("le"),
        "accepted": texts,
    }
