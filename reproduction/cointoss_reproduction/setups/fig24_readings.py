"""Readings of Fig. 24: coins and floors that it may mean, and how far each follows the printed sequences."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from cointoss import ContactLaw, Face, Scenario, load
from cointoss.study import Array, common_prefix, run, state_at_release
from cointoss_reproduction.setups.general_coins import PAPER_OFFSET

PRINTED = {
    "a": "H∘HHH∘HHH∘HHH∘T∘T∘T∘HH",
    "b": "H∘HHH∘HH∘TT∘HHH∘T∘T∘T",
    "c": "H∘HHH∘HHH∘HH∘H∘T∘T∘T∘T",
    "d": "H∘HHH∘TTT∘TTT∘T∘H∘H∘H∘H∘H",
    "e": "H∘HHH∘HHH∘TTT∘HHH∘H∘T∘TT",
    "f": "H∘HHH∘HHHH∘TT∘T∘HHHHH∘TT",
}
"""The sequences of section 5.1; impacts between two ∘ are read as a cluster."""
MARK = "∘"
BEGINNING = "H∘HHH∘"
"""The beginning of all six sequences."""
CLUSTER = 0.03
"""Impacts within this time of each other cannot be distinguished in the scale of Fig. 24 [s]."""
NEARBY = (0.39, 0.41)
"""Random heights of the first of six tosses, to measure agreement by chance [m]."""
APART = 1e-5 * np.arange(6)
"""Heights of the six tosses above the first [m]."""
IMPACTS = 18
"""The number of impacts of the longest printed sequence."""
COINS = {
    "ideal, 2 mm": (2e-3, 0.0),
    "ideal, thin": (0.0, 0.0),
    "imperfect, 2 mm": (2e-3, 1.0),
    "imperfect, thin": (0.0, 1.0),
    "c/10, 2 mm": (2e-3, 0.1),
    "c/10, thin": (0.0, 0.1),
}
"""Thickness [m] and part of the printed offset of the mass centre."""
FRICTIONS = (0.05, 0.1, 0.2, 0.3, 0.5)


@dataclass(frozen=True, kw_only=True)
class Reading:
    """A coin and a floor that Fig. 24 may mean."""

    coin: str
    """The coin: one of `COINS`."""
    law: ContactLaw
    friction: float

    @property
    def name(self) -> str:
        """The reading in words."""
        floor = str(self.law).replace("_", " ")
        return f"{self.coin}, {floor}" + (f" {self.friction:g}" if self.friction else "")

    @property
    def scenario(self) -> Scenario:
        """The toss of Fig. 24(a); the mass centre of a thin coin lies in its plane."""
        thickness, part = COINS[self.coin]
        x, y, z = (part * c for c in PAPER_OFFSET)
        coin = ("coin.thickness", thickness, "coin.center_of_mass", (x, y, z if thickness else 0.0))
        return load("fig24a").replace(*coin, "floor.contact", self.law, "floor.friction", self.friction)


READINGS = tuple(
    Reading(coin=coin, law=law, friction=friction)
    for coin in COINS
    for law in ContactLaw
    for friction in (FRICTIONS if law in (ContactLaw.SLIDING_FRICTION, ContactLaw.COULOMB) else (0.0,))
)


def marked(times: Array, faces: NDArray[np.int8]) -> str:
    """Return the faces up at the touches with marks between clusters, as in `PRINTED`."""
    symbols = [Face(face).symbol for face in faces]
    gaps = [MARK if later - earlier > CLUSTER else "" for earlier, later in pairwise(times)]
    return "".join(symbol + gap for symbol, gap in zip(symbols, [*gaps, ""], strict=True))


def sequences(scenario: Scenario, heights: Iterable[float]) -> list[str]:
    """Return the marked sequences of a toss from other heights [m]."""
    scenario = scenario.replace("ending.max_impacts", IMPACTS)
    body, rules, start, found = scenario.body, scenario.rules, state_at_release(scenario.release), []
    for height in heights:
        start[2] = height
        rows = run(body, rules, start).rows
        found.append(marked(rows["time"], rows["face"]))
    return found


def printed_heights() -> list[float]:
    """Return the heights of (a) to (f) [m]."""
    return [load(f"fig24{letter}").release.position[2] for letter in PRINTED]


@cache
def clustering() -> tuple[Reading, ...]:
    """Return the readings in which the impacts of all six tosses cluster as printed."""
    heights = printed_heights()
    return tuple(one for one in READINGS if clusters_as_printed(sequences(one.scenario, heights)))


def clusters_as_printed(found: Sequence[str]) -> bool:
    """Return whether all sequences begin as all printed ones do, `BEGINNING`."""
    return all(sequence.startswith(BEGINNING) for sequence in found)


def shared(found: Sequence[str]) -> list[int]:
    """Count the leading faces that each sequence shares with its printed one, marks aside."""
    return [
        common_prefix(one.replace(MARK, ""), printed.replace(MARK, ""))
        for one, printed in zip(found, PRINTED.values(), strict=True)
    ]
