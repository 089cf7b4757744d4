"""How often a hand's tosses of a coin show heads, along a field."""

from cointoss.compare.shares.shares import shares
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.devices import Device
from cointoss.models.hand import Hand
from cointoss.models.records import Array, Outcome
from cointoss.models.scenario import Scenario


def heads_along(
    scenario: Scenario,
    field: str,
    values: tuple[float, float, int],
    hand: Hand,
    tosses: int,
    seed: int,
    device: Device | str,
) -> tuple[Array, Array, float]:
    """Return the values of a field, how likely heads is up at each, and the fewest tosses behind this.

    Args:
        scenario: whose coin is tossed, until it rests or is caught.
        field: of the scenario, or of the hand, that varies.
        values: the first, the last and their number.
        hand: that tosses.
        tosses: of each value.
        seed: of the releases.
        device: that tosses.

    Raises:
        SweepError: where no toss of a value ends on a face.
        KeyboardInterrupt: where the tosses are interrupted.
    """
    found = shares(scenario, {field: values}, hand=hand, tosses=tosses, seed=seed, device=device)
    if not found.attrs["complete"]:
        raise KeyboardInterrupt
    counted = found["count"]
    heads, tails = (counted.sel(outcome=str(one)).to_numpy() for one in (Outcome.HEADS, Outcome.TAILS))
    on_a_face = heads + tails
    if not on_a_face.all():
        name = field.rpartition(".")[2]
        raise SweepError(
            f"tosses: {tosses} of each {name}, of some of which none ends on a face; accepted: more"
        )
    return counted[field].to_numpy(), (heads + 1 / 2) / (on_a_face + 1), float(on_a_face.min())
