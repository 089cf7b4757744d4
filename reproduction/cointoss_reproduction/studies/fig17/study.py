"""Fig. 17: the six laws of contact, drawn from the impacts that they make of one touch."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cointoss import ContactLaw, Impacts, analytic, coin_mj, load
from cointoss.coin_mj import FINE, Friction, MujocoSettings
from cointoss.study import BLUE, PALE, ROUGH, VERMILION, Array, rotation_matrix
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.mujoco_impacts import on_floor

MU = load("contact_sliding_friction").floor.friction


@dataclass(frozen=True, kw_only=True)
class LawOfFigure:
    """A contact law of Fig. 17."""

    law: ContactLaw
    conditions: str
    misfit: Callable[[Array, Array, Array], Array]
    """What its conditions leave over, of v_A before and after (τ, ν, z) and of the impulse over the mass."""
    contact: tuple[float, MujocoSettings] | None = None
    """Friction and settings of the MuJoCo contact that realises it."""


LAWS = {
    "a": LawOfFigure(
        law=ContactLaw.SHARP_EDGE,
        conditions="sharp edge: v_Aν' = 0, v_Aτ' = v_Aτ",
        misfit=lambda v, after, _: np.array([after[1], after[0] - v[0]]),
    ),
    "b": LawOfFigure(
        law=ContactLaw.KNURLED,
        conditions="knurled: v_Aν' = v_Aν, v_Aτ' = 0",
        misfit=lambda v, after, _: np.array([after[0], after[1] - v[1]]),
    ),
    "c": LawOfFigure(
        law=ContactLaw.PERFECTLY_ROUGH,
        conditions="perfectly rough: v_Aν' = v_Aτ' = 0",
        misfit=lambda _, after, __: after[:2],
        contact=(ROUGH, FINE),
    ),
    "d": LawOfFigure(
        law=ContactLaw.SLIP_PRESERVING,
        conditions="smooth (1): v_Aν' = v_Aν, v_Aτ' = v_Aτ",
        misfit=lambda v, after, _: after[:2] - v[:2],
        contact=(ROUGH, MujocoSettings(friction=Friction.NATIVE, slip_damping=0.0)),
    ),
    "e": LawOfFigure(
        law=ContactLaw.SMOOTH,
        conditions="smooth (2): S_τν = 0",
        misfit=lambda _, __, S: S[:2],
        contact=(0.0, FINE),
    ),
    "f": LawOfFigure(
        law=ContactLaw.SLIDING_FRICTION,
        conditions="developed friction: S_τν = -μ S_z v_Aτν/v_Aτν",
        misfit=lambda v, _, S: S[:2] + MU * S[2] * v[:2] / np.hypot(v[0], v[1]),
        contact=(MU, FINE),
    ),
}


def touched(law: LawOfFigure) -> dict[str, float]:
    """Let a law act on the first touch of its scenario `contact_`, and the MuJoCo contact that is alike."""
    case = load(f"contact_{law.law}").replace("ending.max_impacts", 1)
    rubbed = [on_floor(case, ContactLaw.COULOMB, mu) for mu in (MU, law.contact[0] if law.contact else 0.0)]
    impacts = analytic.toss(case).impacts
    vectors = _in_the_floor(impacts)
    before, after, S = vectors.values()
    if law.contact is not None:
        by_mujoco = _in_the_floor(coin_mj.impacts_of(rubbed[1], settings=law.contact[1]))
        vectors |= {f"{part} by MuJoCo": vector for part, vector in by_mujoco.items()}
    misfit = max(
        np.abs(law.misfit(before, after, S / case.coin.mass)).max(),
        abs(after[2] + case.floor.restitution * before[2]),
        np.abs(impacts.velocity_after - impacts.velocity_before - impacts.impulse / case.coin.mass).max(),
    )
    return {
        "misfit": misfit,
        "lost": _lost(impacts),
        "lost_by_coulomb": _lost(analytic.toss(rubbed[0]).impacts),
        **{f"{part} {axis}": x for part, of in vectors.items() for axis, x in zip("τνz", of, strict=True)},
    }


def _lost(impacts: Impacts) -> float:
    """Return the energy that the first impact takes, over the energy before it."""
    change = impacts.energy_change[0]
    return -float(change / (impacts.energy[0] - change))


def _in_the_floor(impacts: Impacts) -> dict[str, Array]:
    """Return v_A before and after the first impact, and its impulse: along the edge, across it, and up."""
    xi, eta, _ = impacts.point[0]
    R = np.array(rotation_matrix(tuple(impacts.quaternion[0])))
    tau = R @ [-eta, xi, 0] / np.hypot(xi, eta)
    axes = np.array([tau, [-tau[1], tau[0], 0], [0, 0, 1]])
    return {
        "before": axes @ impacts.contact_velocity_before[0],
        "after": axes @ impacts.contact_velocity_after[0],
        "impulse": axes @ impacts.impulse[0],
    }


def _vectors(row: Mapping[str, Any], by: str = "") -> list[Array]:
    """Return what `_in_the_floor` found, of a row."""
    return [
        np.array([row[f"{part}{by} {axis}"] for axis in "τνz"]) for part in ("before", "after", "impulse")
    ]


def found(cells: pd.DataFrame) -> dict[str, Any]:
    """Return what the claims name."""
    laws, rows = {}, cells.set_index("law").to_dict("index")
    for letter, row in rows.items():
        law, (_, after, S) = LAWS[str(letter)], _vectors(row)
        shown, errors = "not realisable", {}
        if law.contact is not None:
            _, after_mujoco, S_mujoco = _vectors(row, " by MuJoCo")
            apart = float(np.linalg.norm(S_mujoco - S) / np.linalg.norm(S))
            shown = f"{_row(after_mujoco, S_mujoco)}; impulse within {apart:.0e}"
            errors = {"MuJoCo's error": apart}
        if law.law == ContactLaw.SLIDING_FRICTION:
            shown, errors = f"Coulomb's friction: {shown}", {}
        words = {"conditions": law.conditions, "row": _row(after, S), "shown": shown}
        laws[letter] = {**row, **words, "errors": errors}
    S, (_, after_mujoco, _) = _vectors(rows["d"])[2], _vectors(rows["f"], " by MuJoCo")
    slips = [np.hypot(v[0], v[1]) for v in (*_vectors(rows["f"])[:2], after_mujoco)]
    horizontal = np.hypot(S[0], S[1])
    return {"laws": laws, "slips": slips, "horizontal": horizontal, "over_S_z": horizontal / S[2]}


def _row(after: Array, S: Array) -> str:
    """Return velocity and impulse as they stand in the table."""
    return f"v_A' = {_triple(after)} m/s, S = {_triple(1e3 * S)} mN s"


def _triple(x: Array) -> str:
    return "(" + ", ".join(f"{number + 0:.3f}" for number in np.round(x, 3)) + ")"


def draw(cells: pd.DataFrame) -> Figure:
    """Draw each law's velocities and impulse in the floor."""
    picture = Figure(figsize=(9, 5.6))
    panels = picture.subplots(2, 3, sharex=True, sharey=True).flat
    for axes, row in zip(panels, cells.to_dict("records"), strict=True):
        law, (before, after, S) = LAWS[str(row["law"])], _vectors(row)
        _arrow(axes, before, PALE, 5, "v_A")
        _arrow(axes, after, BLUE, 2, "v_A'")
        _arrow(axes, 1e3 * S, VERMILION, 2, "S [mN s]")
        _, after, S_mujoco = _vectors(row, " by MuJoCo")
        for tip, color in ((after, BLUE), (1e3 * S_mujoco, VERMILION)):
            axes.plot(tip[0], tip[1], "o", color=color, markersize=9, fillstyle="none")
        title = f"({row['law']}) {str(law.law).replace('_', ' ')}: S_z = {1e3 * S[2]:.2f} mN s"
        axes.set_title(title, fontsize=9)
    for axes in picture.axes[3:]:
        axes.set_xlabel("τ, along the edge [m/s]")
    for axes in picture.axes[::3]:
        axes.set_ylabel("ν, across it [m/s]")
    picture.axes[0].legend(fontsize=8, title="in the floor; circles: MuJoCo", title_fontsize=8)
    return picture


def _arrow(axes: Axes, tip: Array, color: str, width: float, label: str) -> None:
    axes.plot([0, tip[0]], [0, tip[1]], color=color, linewidth=width, label=label)
    axes.plot(tip[0], tip[1], "o", color=color, markersize=4)


REPRODUCTION = study(__name__, Cells(touched, {"law": LAWS}), found=found, draw={"figure": draw})
