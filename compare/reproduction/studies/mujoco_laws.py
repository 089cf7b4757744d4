"""Which contact laws MuJoCo's contacts can stand for: impulses of both engines over random impacts."""

import json
import math
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure as Picture

from coin_mj import Friction, Settings
from coin_mj.model.settings import ROUGH
from compare.reproduction.runner import Figure, Made, Progress
from compare.reproduction.setups.mujoco_impacts import (
    by_law,
    by_mujoco,
    draw_touches,
    first,
    on_floor,
    relative_errors,
)
from models.laws import ContactLaw
from models.records import Array

COUNT, SEED = 80, 17
RESTITUTIONS, FRICTION = (0.1, 1.0), 0.2
FRICTIONS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 100.0, 1000.0)
"""That lead to the perfectly rough floor."""
STANDS = 1e-2
"""A law is realised where the median error of its impulses is below this."""

_T = math.pi / math.sqrt(Settings().stiffness)
CONTACTS: dict[str, tuple[float, Settings]] = {
    "frictionless": (0.0, Settings()),
    "Coulomb's force": (FRICTION, Settings()),
    f"Coulomb's force, μ = {ROUGH:g}": (ROUGH, Settings()),
    "own cone": (FRICTION, Settings(friction=Friction.NATIVE)),
    f"own cone, μ = {ROUGH:g}, slip undamped": (
        ROUGH,
        Settings(friction=Friction.NATIVE, slip_damping=0.0),
    ),
    f"own cone, μ = {ROUGH:g}, slip damped": (
        ROUGH,
        Settings(friction=Friction.NATIVE, slip_damping=10 / _T),
    ),
}
"""Coefficient of friction and settings of MuJoCo's contacts, by name."""
NAMES = {law: f"({letter}) {law.label}" for letter, law in zip("abcdef", ContactLaw, strict=False)} | {
    ContactLaw.COULOMB: "coulomb"
}


@dataclass(frozen=True, kw_only=True)
class Fit:
    """How a contact of MuJoCo's meets a law: |S_law - S|/|S_law| over the impacts."""

    median: float
    worst: float


@dataclass(frozen=True, kw_only=True, eq=False)
class Study:
    """Impulses of all laws and of all of MuJoCo's contacts from the same touches [N s]."""

    laws: dict[str, Array]
    """Of the laws, by name, (n, 3)."""
    contacts: dict[str, Array]
    """Of MuJoCo's contacts, by name, (n, 3)."""
    fits: dict[str, dict[str, Fit]]
    """Of each law by each contact."""
    growing: dict[float, Fit]
    """Of the perfectly rough law by Coulomb's force, by its μ."""

    def best(self, law: str) -> str:
        """Give the contact with the smallest median error."""
        return min(self.fits[law], key=lambda name: self.fits[law][name].median)


def study(count: int, seed: int, progress: Callable[[int, int], None] = lambda *_: None) -> Study:
    """Compute the study of `count` random impacts."""
    parts = len(CONTACTS) + len(FRICTIONS) + 1
    cases = draw_touches(np.random.default_rng(seed), count, RESTITUTIONS)
    laws = {
        NAMES[law]: first(by_law(on_floor(case, law, FRICTION) for case in cases), "impulse")
        for law in ContactLaw
    }
    progress(1, parts)

    def of(mu: float, settings: Settings) -> Array:
        return first(
            by_mujoco((on_floor(case, ContactLaw.COULOMB, mu) for case in cases), settings), "impulse"
        )

    contacts = {}
    for number, (name, (mu, settings)) in enumerate(CONTACTS.items(), start=2):
        contacts[name] = of(mu, settings)
        progress(number, parts)
    growing = {}
    for number, mu in enumerate(FRICTIONS, start=len(CONTACTS) + 2):
        growing[mu] = _fit(laws[NAMES[ContactLaw.PERFECTLY_ROUGH]], of(mu, Settings()))
        progress(number, parts)
    fits = {law: {contact: _fit(S_law, S) for contact, S in contacts.items()} for law, S_law in laws.items()}
    return Study(laws=laws, contacts=contacts, fits=fits, growing=growing)


def _fit(S_law: Array, S: Array) -> Fit:
    errors = relative_errors(S_law, S)
    return Fit(median=float(np.median(errors)), worst=float(errors.max()))


def check(found: Study) -> tuple[str, ...]:
    """Give the claims that the numbers don't bear out."""
    best = {law: found.fits[law][found.best(law)].median for law in found.laws}
    claims = {
        "MuJoCo stands for the smooth, the perfectly rough, the slip-preserving and Coulomb's law": all(
            best[NAMES[law]] < STANDS / 100
            for law in (
                ContactLaw.SMOOTH,
                ContactLaw.PERFECTLY_ROUGH,
                ContactLaw.SLIP_PRESERVING,
                ContactLaw.COULOMB,
            )
        ),
        "MuJoCo stands for neither the sharp edge nor the knurled one": all(
            best[NAMES[law]] > STANDS for law in (ContactLaw.SHARP_EDGE, ContactLaw.KNURLED)
        ),
        "MuJoCo's own cone with one damping is not Coulomb's law": found.fits["coulomb"]["own cone"].median
        > 1e-3,
    }
    return tuple(claim for claim, holds in claims.items() if not holds)


def text(found: Study) -> str:
    """Give the tables."""
    lines = [
        f"|S_law - S|/|S_law| of {len(next(iter(found.laws.values())))} random impacts, median (worst); "
        f"restitution {RESTITUTIONS[0]:g} to {RESTITUTIONS[1]:g}, friction {FRICTION:g} where none is named",
        "",
        "| law | " + " | ".join(CONTACTS) + " |",
        "|---|" + "---|" * len(CONTACTS),
    ]
    for law, fits in found.fits.items():
        best = found.best(law)
        cells = [
            ("**{}**" if name == best and fit.median < STANDS else "{}").format(
                f"{fit.median:.0e} ({fit.worst:.0e})"
            )
            for name, fit in fits.items()
        ]
        lines.append(f"| {law} | " + " | ".join(cells) + " |")
    lines += [
        "",
        "Coulomb's force against the perfectly rough law:",
        "",
        "| μ | median | worst |",
        "|---|---|---|",
    ]
    lines += [f"| {mu:g} | {fit.median:.0e} | {fit.worst:.0e} |" for mu, fit in found.growing.items()]
    return "\n".join(lines)


def run(folder: Path, progress: Progress) -> Made:
    """Make the study; write numbers.json and impulses.png; give its tables and the claims that fail."""
    found = study(COUNT, SEED, progress)
    numbers: dict[str, Any] = {
        "fits": {law: {name: asdict(fit) for name, fit in fits.items()} for law, fits in found.fits.items()},
        "growing": {f"{mu:g}": asdict(fit) for mu, fit in found.growing.items()},
        "laws": {law: S.tolist() for law, S in found.laws.items()},
        "contacts": {name: S.tolist() for name, S in found.contacts.items()},
    }
    (folder / "numbers.json").write_text(json.dumps(numbers, indent=1, allow_nan=False), encoding="utf-8")
    draw(found).savefig(folder / "impulses.png", dpi=80)
    return Made(text=text(found), failed=check(found))


def draw(found: Study) -> Picture:
    """Draw MuJoCo's impulses over the law's, each law by the contact nearest to it."""
    with mpl.rc_context({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False}):
        picture = Picture(figsize=(12, 6.6), layout="constrained")
        axes = picture.subplots(2, 4)
        for place, (law, S_law) in zip(axes.flat, found.laws.items(), strict=False):
            best = found.best(law)
            S = found.contacts[best]
            for column, color in enumerate(("#D55E00", "#009E73", "#0072B2")):
                label = "xyz"[column]
                place.plot(
                    1e3 * S_law[:, column],
                    1e3 * S[:, column],
                    ".",
                    color=color,
                    markersize=4,
                    label=f"$S_{label}$",
                )
            ends = [1e3 * min(S_law.min(), S.min()), 1e3 * max(S_law.max(), S.max())]
            place.plot(ends, ends, color="#5b6675", linewidth=0.7)
            stands = found.fits[law][best].median < STANDS
            place.set_title(f"{law}\n{'by' if stands else 'not; nearest:'} {best}", fontsize=8.5)
            place.set_xlabel("by the law [mN s]")
            place.set_ylabel("by MuJoCo [mN s]")
        axes.flat[0].legend(frameon=False)
        grow = axes.flat[-1]
        mu = list(found.growing)
        grow.loglog(mu, [fit.median for fit in found.growing.values()], "o-", label="median")
        grow.loglog(mu, [fit.worst for fit in found.growing.values()], "s--", label="worst")
        grow.set_title("perfectly rough, as μ grows", fontsize=8.5)
        grow.set_xlabel("μ of Coulomb's force")
        grow.set_ylabel("error of the impulse")
        grow.legend(frameon=False)
    return picture


FIGURE = Figure(
    title="which of the paper's contact laws MuJoCo's contacts can stand for",
    seconds=60,
    files=("numbers.json", "impulses.png"),
    run=run,
)
