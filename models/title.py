"""What a toss is in a few words: the scenario's name, the coin, and where it is released."""

from collections.abc import Collection

from cointoss.models.scenario import Scenario


def title_of_toss(scenario: Scenario, name: str, *, varied: Collection[str] = ()) -> str:
    """Return such a title as "fig24a: 2 g, 25 mm, from 40 cm", with the coin's diameter.

    Args:
        scenario: of the toss.
        name: of the scenario; empty where it has none.
        varied: fields that differ between tosses, which the title does not give.
    """
    coin, z = scenario.coin, scenario.release.position[2]
    parts = {
        "coin.mass": _mass(coin.mass),
        "coin.radius": _length(2 * coin.radius),
        "release.position.z": f"from {_length(z)}",
    }
    coin_in_words = ", ".join(part for field, part in parts.items() if field not in varied)
    return ": ".join(part for part in (name, coin_in_words) if part)


def _length(metres: float) -> str:
    unit, factor = ("m", 1) if abs(metres) >= 1 else ("cm", 100) if abs(metres) >= 0.1 else ("mm", 1000)
    return f"{factor * metres:.6g} {unit}"


def _mass(kilograms: float) -> str:
    return f"{kilograms:.6g} kg" if kilograms >= 1 else f"{1000 * kilograms:.6g} g"
