"""The names of the quantities of a release along which a toss has a margin."""

LETTERS = {"xi": "ξ", "eta": "η", "zeta": "ζ"}
"""The Greek letters of the body's axes."""
NAMES = (
    "height",
    *(f"velocity {axis}" for axis in "xyz"),
    *(f"{what} about {axis}" for what in ("attitude", "spin") for axis in LETTERS),
)
"""The names, their axes in Latin letters."""


def latin_name(name: str) -> str:
    """Return the name of a quantity, its axis in Latin letters.

    Args:
        name: with its axis in Greek or Latin letters.

    Raises:
        ValueError: saying what is accepted.
    """
    for latin, greek in LETTERS.items():
        name = name.replace(greek, latin)
    if name not in NAMES:
        raise ValueError(", ".join(NAMES))
    return name
