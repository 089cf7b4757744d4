"""Which contact laws MuJoCo's contacts can realise: impulses of both engines over random impacts."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from cointoss import ContactLaw, Scenario
from cointoss.coin_mj import FINE, Friction, MujocoSettings, Realisation
from cointoss.study import BLUE, GREEN, GREY, ROUGH, VERMILION, Array
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.mujoco_impacts import (
    by_law,
    by_mujoco,
    draw_touches,
    first,
    on_floor,
    relative_errors,
    spread,
)

COUNT, SEED = 80, 17
RESTITUTIONS, FRICTION = (0.1, 1.0), 0.2
FRICTIONS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 100.0, 1000.0)
"""The frictions that approach the perfectly rough floor."""
REALISED = 1e-2
"""A law is realised where the median error of its impulses is below this."""
NATIVE = MujocoSettings(friction=Friction.NATIVE)
Contact = tuple[float, MujocoSettings]
CONTACTS: dict[str, Contact] = {
    "frictionless": (0.0, FINE),
    "Coulomb's force": (FRICTION, FINE),
    f"Coulomb's force, μ = {ROUGH:g}": (ROUGH, FINE),
    "native cone": (FRICTION, NATIVE),
    f"native cone, μ = {ROUGH:g}, slip undamped": (ROUGH, replace(NATIVE, slip_damping=0.0)),
    f"native cone, μ = {ROUGH:g}, slip damped": (
        ROUGH,
        replace(NATIVE, slip_damping=10 / (math.pi / math.sqrt(FINE.stiffness))),
    ),
}
"""Coefficient of friction and settings of MuJoCo's contacts, by name; the last by a spring alone."""
LAWS = {f"({letter}) {law}": law for letter, law in zip("abcdef", ContactLaw, strict=False)} | {
    "coulomb": ContactLaw.COULOMB
}
MADE = [name for name in LAWS if name[:3] in ("(c)", "(d)", "(e)", "cou")]
"""The laws that MuJoCo realises."""


@cache
def _touches(count: int, seed: int) -> list[Scenario]:
    return draw_touches(np.random.default_rng(seed), count, RESTITUTIONS)


@cache
def _impulses(made: ContactLaw | Contact, count: int, seed: int) -> Array:
    """Return the impulses by a law, or by one of MuJoCo's contacts, from the same touches, (n, 3) [N s]."""
    if isinstance(made, ContactLaw):
        found = by_law(on_floor(case, made, FRICTION) for case in _touches(count, seed))
    else:
        mu, settings = made
        rubbed = (on_floor(case, ContactLaw.COULOMB, mu) for case in _touches(count, seed))
        found = by_mujoco(rubbed, settings)
    return first(found, "impulse")


def fit(
    realisation: Realisation, contact: Contact, count: int = COUNT, seed: int = SEED
) -> Iterator[dict[str, Any]]:
    """Yield the spread of |S_law - S|/|S_law| of each law by a contact."""
    mu, settings = contact
    if realisation == Realisation.ONE_STEP and settings.slip_damping:
        return
    S = _impulses((mu, replace(settings, contact=realisation)), count, seed)
    for name, law in LAWS.items():
        yield {"law": name, **spread(relative_errors(_impulses(law, count, seed), S))}


def grown(friction: float, count: int = COUNT, seed: int = SEED) -> dict[str, float]:
    """Return the spread of the perfectly rough law by Coulomb's force of a friction."""
    rough = _impulses(ContactLaw.PERFECTLY_ROUGH, count, seed)
    return spread(relative_errors(rough, _impulses((friction, FINE), count, seed)))


def pushed(made: ContactLaw | Contact, count: int = COUNT, seed: int = SEED) -> pd.DataFrame:
    """Return the impulses by a law or a contact, touch by touch [N s]."""
    return pd.DataFrame(_impulses(made, count, seed), columns=[*"xyz"]).reset_index(names="touch")


def nearest(cells: pd.DataFrame) -> dict[str, Mapping[Any, Any]]:
    """Return, by law, the fit by the spring's contact with the smallest median error."""
    springs = [row for row in cells.to_dict("records") if row["realisation"] == Realisation.SPRING]
    return {
        law: min((row for row in springs if row["law"] == law), key=lambda row: row["median"]) for law in LAWS
    }


def found(cells: pd.DataFrame) -> dict[str, float]:
    """Return what the claims name: errors of the nearest contacts."""
    errors = {law: best["median"] for law, best in nearest(cells).items()}
    return {
        "realised": max(errors[law] for law in MADE),
        "others": min(errors["(a) sharp_edge"], errors["(b) knurled"]),
    }


def draw(cells: pd.DataFrame) -> Figure:
    """Draw MuJoCo's impulses over the law's, each law by the contact nearest to it."""
    picture = Figure(figsize=(12, 6.6))
    panels = picture.subplots(2, 4).flat
    for axes, (law, best) in zip(panels, nearest(cells).items(), strict=False):
        S_law, S = (
            1e3 * cells.loc[cells["made"] == made, ["x", "y", "z"]] for made in (law, best["contact"])
        )
        for column, color in zip("xyz", (VERMILION, GREEN, BLUE), strict=True):
            label = f"$S_{column}$"
            axes.plot(S_law[column], S[column], ".", color=color, markersize=4, label=label)
        ends = [min(S_law.min().min(), S.min().min()), max(S_law.max().max(), S.max().max())]
        axes.plot(ends, ends, color=GREY, linewidth=0.7)
        by = "by" if best["median"] < REALISED else "not; nearest:"
        axes.set_title(f"{law}\n{by} {best['contact']}", fontsize=8.5)
        axes.set(xlabel="by the law [mN s]", ylabel="by MuJoCo [mN s]")
    picture.axes[0].legend()
    grow, rows = picture.axes[-1], cells[cells["friction"].notna()]
    for name, style in (("median", "o-"), ("worst", "s--")):
        grow.plot(rows["friction"], rows[name], style, label=name)
    grow.set_title("perfectly rough, as μ grows", fontsize=8.5)
    grow.set(xscale="log", yscale="log", xlabel="μ of Coulomb's force", ylabel="error of the impulse")
    grow.legend()
    return picture


REPRODUCTION = study(
    __name__,
    Cells(fit, {"realisation": tuple(Realisation), "contact": CONTACTS}),
    Cells(grown, {"friction": FRICTIONS}),
    Cells(pushed, {"made": {**LAWS, **CONTACTS}}),
    found=found,
    draw={"impulses": draw},
)
