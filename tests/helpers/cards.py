"""A stand-in for a card: it tosses on the CPU two of three rows, and hands the third over."""

import numpy as np

from cointoss.analytic import many
from cointoss.models.body import NO_CODE
from cointoss.models.kernel import cuda


class StandInCard(cuda.GraphicsCard):
    """A card that tosses every row but each third one, and fails after some calls."""

    def __init__(self, calls: int) -> None:
        self.name, self.left, self.given = "Stand-in", calls, list[int]()

    def toss(self, rows, limits, wanted, found):
        """Toss rows as `toss_on_device` does; a call that fails has tossed the first of them."""
        self.given.append(len(rows))
        self.left -= 1
        kept = np.flatnonzero(np.arange(len(rows) if self.left >= 0 else 1) % 3 != 2)
        made = found[kept]
        many.toss_some(rows[kept], NO_CODE, limits, wanted, made)
        found[kept] = made
        if self.left < 0:
            raise cuda.CardError("the card was lost")


def with_card(monkeypatch, *, calls=1_000_000) -> StandInCard:
    """Put a stand-in in the place of the first card, and return it."""
    made = StandInCard(calls)
    monkeypatch.setattr(cuda, "card", lambda: made)
    monkeypatch.setattr(many, "toss_on_device", lambda card, *others: card.toss(*others))
    return made


def without_card(monkeypatch, error=None) -> list[int]:
    """Let there be no card, and return a list that grows each time that one is asked for."""
    asked = list[int]()

    def card():
        asked.append(1)
        raise error or cuda.CardError("no NVIDIA driver was found")

    monkeypatch.setattr(cuda, "card", card)
    return asked
