"""Which contact laws MuJoCo's contacts can realise: impulses of both engines over random impacts."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from cointoss import ContactLaw
from cointoss.coin_mj import Friction, MujocoSettings, Realisation
from cointoss.study import BLUE, GREEN, GREY, ROUGH, VERMILION, Array, Progress, paragraphs, stepping, table
from cointoss_reproduction.frame.recorded import recorded
from cointoss_reproduction.setups.mujoco_impacts import (
    by_law,
    by_mujoco,
    draw_touches,
    first,
    on_floor,
    relative_errors,
)
from cointoss_reproduction.setups.mujoco_study import Spread, draw_spreads, spread

COUNT, SEED = 80, 17
RESTITUTIONS, FRICTION = (0.1, 1.0), 0.2
FRICTIONS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 100.0, 1000.0)
"""That lead to the perfectly rough floor."""
REALISED = 1e-2
"""A law is realised where the median error of its impulses is below this."""

_T = math.pi / math.sqrt(MujocoSettings().stiffness)
CONTACTS: dict[str, tuple[float, MujocoSettings]] = {
    "frictionless": (0.0, MujocoSettings()),
    "Coulomb's force": (FRICTION, MujocoSettings()),
    f"Coulomb's force, μ = {ROUGH:g}": (ROUGH, MujocoSettings()),
    "native cone": (FRICTION, MujocoSettings(friction=Friction.NATIVE)),
    f"native cone, μ = {ROUGH:g}, slip undamped": (
        ROUGH,
        MujocoSettings(friction=Friction.NATIVE, slip_damping=0.0),
    ),
    f"native cone, μ = {ROUGH:g}, slip damped": (
        ROUGH,
        MujocoSettings(friction=Friction.NATIVE, slip_damping=10 / _T),
    ),
}
"""Coefficient of friction and settings of MuJoCo's contacts, by name."""
_IN_ONE = Realisation.ONE_STEP
ONE_STEP: dict[str, tuple[float, MujocoSettings]] = {
    "frictionless": (0.0, MujocoSettings(contact=_IN_ONE)),
    "Coulomb's force": (FRICTION, MujocoSettings(contact=_IN_ONE)),
    f"Coulomb's force, μ = {ROUGH:g}": (ROUGH, MujocoSettings(contact=_IN_ONE)),
    "native cone": (FRICTION, MujocoSettings(contact=_IN_ONE, friction=Friction.NATIVE)),
    f"native cone, μ = {ROUGH:g}, slip undamped": (
        ROUGH,
        MujocoSettings(contact=_IN_ONE, friction=Friction.NATIVE, slip_damping=0.0),
    ),
}
"""As `CONTACTS`, each within one step."""
NAMES = {law: f"({letter}) {law}" for letter, law in zip("abcdef", ContactLaw, strict=False)} | {
    ContactLaw.COULOMB: "coulomb"
}
MADE = (ContactLaw.SMOOTH, ContactLaw.PERFECTLY_ROUGH, ContactLaw.SLIP_PRESERVING, ContactLaw.COULOMB)
"""The laws that MuJoCo realises."""


@dataclass(frozen=True, kw_only=True, eq=False)
class LawFits:
    """Impulses of all laws and of all of MuJoCo's contacts from the same touches [N s]."""

    laws: dict[str, Array]
    """Of the laws, by name, (n, 3)."""
    contacts: dict[str, Array]
    """Of MuJoCo's contacts, by name, (n, 3)."""
    fits: dict[str, dict[str, Spread]]
    """|S_law - S|/|S_law| of each law by each contact."""
    one_step: dict[str, dict[str, Spread]]
    """As `fits`, by the contacts of one step."""
    growing: dict[float, Spread]
    """Of the perfectly rough law by Coulomb's force, by its μ."""

    def best(self, law: str) -> str:
        """Return the contact with the smallest median error."""
        return min(self.fits[law], key=lambda name: self.fits[law][name].median)


def compute(progress: Progress, count: int = COUNT, seed: int = SEED) -> LawFits:
    """Return the impulses of `count` random impacts."""
    step = stepping(progress, len(CONTACTS) + len(ONE_STEP) + len(FRICTIONS) + 1)
    cases = draw_touches(np.random.default_rng(seed), count, RESTITUTIONS)
    laws = step(
        {
            NAMES[law]: first(by_law(on_floor(case, law, FRICTION) for case in cases), "impulse")
            for law in ContactLaw
        }
    )

    def of(mu: float, settings: MujocoSettings) -> Array:
        return first(
            by_mujoco((on_floor(case, ContactLaw.COULOMB, mu) for case in cases), settings), "impulse"
        )

    contacts, in_one = (
        {name: step(of(*given)) for name, given in kinds.items()} for kinds in (CONTACTS, ONE_STEP)
    )
    rough = laws[NAMES[ContactLaw.PERFECTLY_ROUGH]]
    growing = {mu: step(_fit(rough, of(mu, MujocoSettings()))) for mu in FRICTIONS}
    fits, one_step = (
        {law: {contact: _fit(S_law, S) for contact, S in made.items()} for law, S_law in laws.items()}
        for made in (contacts, in_one)
    )
    return LawFits(laws=laws, contacts=contacts, fits=fits, one_step=one_step, growing=growing)


def _fit(S_law: Array, S: Array) -> Spread:
    return spread(relative_errors(S_law, S))


def measures(found: LawFits) -> dict[str, Any]:
    """Return what the claims name."""
    best = {law: found.fits[NAMES[law]][found.best(NAMES[law])].median for law in ContactLaw}
    return {
        "realised": max(best[law] for law in MADE),
        "hundredth": REALISED / 100,
        "others": min(best[law] for law in (ContactLaw.SHARP_EDGE, ContactLaw.KNURLED)),
        "native": found.fits["coulomb"]["native cone"].median,
    }


def tables(found: LawFits) -> str:
    """Return the tables, in Markdown."""

    def cell(law: str, contact: str, fit: Spread) -> str:
        said = f"{fit.median:.0e} ({fit.worst:.0e})"
        return f"**{said}**" if contact == found.best(law) and fit.median < REALISED else said

    fits = [
        [law, *(cell(law, name, fit) for name, fit in by_contact.items())]
        for law, by_contact in found.fits.items()
    ]
    in_one = [
        [law, *(f"{fit.median:.0e} ({fit.worst:.0e})" for fit in by_contact.values())]
        for law, by_contact in found.one_step.items()
    ]
    growing = [[f"{mu:g}", f"{fit.median:.0e}", f"{fit.worst:.0e}"] for mu, fit in found.growing.items()]
    return paragraphs(
        f"|S_law - S|/|S_law| of {len(next(iter(found.laws.values())))} random impacts, median (worst); "
        f"restitution {RESTITUTIONS[0]:g} to {RESTITUTIONS[1]:g}, friction {FRICTION:g} unless named",
        table(["law", *CONTACTS], fits),
        "The same, each contact within one step:",
        table(["law", *ONE_STEP], in_one),
        "Coulomb's force against the perfectly rough law:",
        table("μ | median | worst", growing),
    )


def draw(found: LawFits) -> Figure:
    """Draw MuJoCo's impulses over the law's, each law by the contact nearest to it."""
    picture = Figure(figsize=(12, 6.6))
    axes = picture.subplots(2, 4)
    for place, (law, S_law) in zip(axes.flat, found.laws.items(), strict=False):
        best = found.best(law)
        S = found.contacts[best]
        for column, color in enumerate((VERMILION, GREEN, BLUE)):
            x, y, label = 1e3 * S_law[:, column], 1e3 * S[:, column], f"$S_{'xyz'[column]}$"
            place.plot(x, y, ".", color=color, markersize=4, label=label)
        ends = [1e3 * min(S_law.min(), S.min()), 1e3 * max(S_law.max(), S.max())]
        place.plot(ends, ends, color=GREY, linewidth=0.7)
        realised = found.fits[law][best].median < REALISED
        place.set_title(f"{law}\n{'by' if realised else 'not; nearest:'} {best}", fontsize=8.5)
        place.set(xlabel="by the law [mN s]", ylabel="by MuJoCo [mN s]")
    axes.flat[0].legend()
    grow = axes.flat[-1]
    draw_spreads(grow, found.growing)
    grow.set_title("perfectly rough, as μ grows", fontsize=8.5)
    grow.set(xscale="log", yscale="log", xlabel="μ of Coulomb's force", ylabel="error of the impulse")
    grow.legend()
    return picture


REPRODUCTION = recorded(__name__, compute, measures=measures, tables=tables, draw={"impulses": draw})
