"""The names under which a person may speak of a scenario's fields."""

import difflib
from collections.abc import Collection

from cointoss.models.fields import WORDED, WORDS

SPIN = "release.spin"
"""The size of ω about the scenario's own axis of rotation [rad/s]: it stands for the components of ω."""
MOST_LISTED = 11
"""Fields of a table that a message lists."""
_ALIKE = 0.7
"""From this similarity on one name may be meant by another; "tilt" and "until" have 0.67."""
_ALIASES = {"height": "release.position.z", "spin": SPIN}


def full_name(name: str, known: Collection[str]) -> str:
    """Return the field of a name: the name itself, the one field that ends with it, or what it is called.

        full_name("restitution", UNITS), full_name("position.z", UNITS), full_name("height", UNITS)

    Args:
        name: of a field, or a part of it.
        known: the fields.

    Raises:
        LookupError: for another name; the message says which may be meant, and which are accepted.
    """
    if name in known:
        return name
    if _ALIASES.get(name) in known:
        return _ALIASES[name]
    ends = [field for field in known if field.endswith(f".{name}") or WORDS.get(field) == name]
    if len(ends) == 1:
        return ends[0]
    raise LookupError(_accepted(name, list(known), ends))


def _accepted(name: str, known: list[str], ends: list[str]) -> str:
    """Return the field that a wrong name may mean, and those that are accepted: of its name, or others."""
    tables = list(dict.fromkeys(field.partition(".")[0] for field in known if "." in field))
    table = name.partition(".")[0]
    of_table = [field for field in known if table in tables and field.startswith(f"{table}.")]
    components = [field for field in known if field.startswith(f"{name}.")]
    near = [] if ends or components or name in WORDED else _near(name, known, of_table)
    whole = [f"numbers of {', '.join(tables)}, and gravity"]
    others = of_table if 0 < len(of_table) <= MOST_LISTED else whole
    hint = f"did you mean {near[0]}? " if near else ""
    return f"{hint}accepted: {', '.join(dict.fromkeys([*(ends or components), *others]))}"


def _near(name: str, known: list[str], of_table: list[str]) -> list[str]:
    """Return the field whose name is like a wrong one: of its table, or by its last part; none if none is."""
    rest = {field.partition(".")[2] or field: field for field in of_table or known}
    if near := difflib.get_close_matches(name.partition(".")[2] or name, rest, n=1, cutoff=_ALIKE):
        return [rest[near[0]]]
    last = {field.rpartition(".")[2]: field for field in known}
    near = difflib.get_close_matches(name, [*last, *_ALIASES], n=1, cutoff=_ALIKE)
    return [last.get(word, _ALIASES.get(word, "")) for word in near]
