"""Fig. 17: the six laws of contact, drawn from the impacts that they make of one touch."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cointoss import ContactLaw, Impacts, Scenario, analytic, coin_mj, load
from cointoss.coin_mj import Friction, MujocoSettings
from cointoss.study import BLUE, PALE, ROUGH, VERMILION, Array, Progress, rotation_matrix
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.setups.mujoco_impacts import on_floor

MU = load("contact_sliding_friction").floor.friction


@dataclass(frozen=True, kw_only=True)
class LawOfFigure:
    """A contact law of Fig. 17."""

    letter: str
    claim: str
    misfit: Callable[[Array, Array, Array], Array]
    """What its conditions leave over, of v_A before and after (τ, ν, z) and of the impulse over the mass."""
    contact: tuple[float, MujocoSettings] | None
    """Friction and settings of the MuJoCo contact that realises it."""


def _kept(before: Array, after: Array, number: int) -> float:
    return after[number] - before[number]


LAWS = {
    ContactLaw.SHARP_EDGE: LawOfFigure(
        letter="a",
        claim="sharp edge: v_Aν' = 0, v_Aτ' = v_Aτ",
        misfit=lambda v, after, _: np.array([after[1], _kept(v, after, 0)]),
        contact=None,
    ),
    ContactLaw.KNURLED: LawOfFigure(
        letter="b",
        claim="knurled: v_Aν' = v_Aν, v_Aτ' = 0",
        misfit=lambda v, after, _: np.array([after[0], _kept(v, after, 1)]),
        contact=None,
    ),
    ContactLaw.PERFECTLY_ROUGH: LawOfFigure(
        letter="c",
        claim="perfectly rough: v_Aν' = v_Aτ' = 0",
        misfit=lambda _, after, __: after[:2],
        contact=(ROUGH, MujocoSettings()),
    ),
    ContactLaw.SLIP_PRESERVING: LawOfFigure(
        letter="d",
        claim="smooth (1): v_Aν' = v_Aν, v_Aτ' = v_Aτ",
        misfit=lambda v, after, _: after[:2] - v[:2],
        contact=(ROUGH, MujocoSettings(friction=Friction.NATIVE, slip_damping=0.0)),
    ),
    ContactLaw.SMOOTH: LawOfFigure(
        letter="e",
        claim="smooth (2): S_τν = 0",
        misfit=lambda _, __, S: S[:2],
        contact=(0.0, MujocoSettings()),
    ),
    ContactLaw.SLIDING_FRICTION: LawOfFigure(
        letter="f",
        claim="developed friction: S_τν = -μ S_z v_Aτν/v_Aτν",
        misfit=lambda v, _, S: S[:2] + MU * S[2] * v[:2] / np.hypot(v[0], v[1]),
        contact=(MU, MujocoSettings()),
    ),
}


def make(progress: Progress) -> Findings:
    """Let each law act on the first touch of the scenarios `contact_` and compare MuJoCo's contacts."""
    data: Data = {}
    found = Findings(data=data, laws={})
    for done, (name, law) in enumerate(LAWS.items(), start=1):
        case = _one_impact(load(f"contact_{name}"))
        by_law = analytic.toss(case).impacts
        before, after, S = _in_the_floor(by_law)
        misfit = max(
            np.abs(law.misfit(before, after, S / case.coin.mass)).max(),
            abs(after[2] + case.floor.restitution * before[2]),
            np.abs(by_law.velocity_after - by_law.velocity_before - by_law.impulse / case.coin.mass).max(),
        )
        data |= {f"({law.letter}) before": before, f"({law.letter}) after": after}
        data |= {f"({law.letter}) impulse": S}
        shown, errors = "not realisable", {}
        if law.contact is not None:
            mu, settings = law.contact
            by_mujoco = coin_mj.impacts_of(on_floor(case, ContactLaw.COULOMB, mu), settings=settings)
            _, after_mujoco, S_mujoco = _in_the_floor(by_mujoco)
            data |= {f"({law.letter}) after, MuJoCo": after_mujoco}
            data |= {f"({law.letter}) impulse, MuJoCo": S_mujoco}
            apart = float(np.linalg.norm(S_mujoco - S) / np.linalg.norm(S))
            shown = f"{_row(after_mujoco, S_mujoco)}; impulse within {apart:.0e}"
            if name == ContactLaw.SLIDING_FRICTION:
                shown = f"Coulomb's friction: {shown}"
            else:
                errors = {"MuJoCo's error": apart}
        told = {"conditions": law.claim, "row": _row(after, S), "shown": shown}
        found.laws[law.letter] = told | {"misfit": misfit, "errors": errors, "lost": -_gained(by_law)}
        progress(done, len(LAWS))
    S = data["(d) impulse"]
    found.horizontal = np.hypot(S[0], S[1])
    found.over_S_z = found.horizontal / S[2]
    found.slips = [np.hypot(*data[f"(f) {part}"][:2]) for part in ("before", "after", "after, MuJoCo")]
    found.lost_by_coulomb = -_gained_by_coulomb()
    return found


def _gained(impacts: Impacts) -> float:
    """Return the change of energy in the first impact, relative to the energy before it."""
    change = impacts.energy_change[0]
    return float(change / (impacts.energy[0] - change))


def _gained_by_coulomb() -> float:
    case = _one_impact(load("contact_sliding_friction"))
    return _gained(analytic.toss(on_floor(case, ContactLaw.COULOMB, MU)).impacts)


def _one_impact(case: Scenario) -> Scenario:
    return case.replace("ending.max_impacts", 1)


def _in_the_floor(impacts: Impacts) -> tuple[Array, Array, Array]:
    """Return v_A before and after the first impact, and its impulse: along the edge, across it, and up."""
    xi, eta, _ = impacts.point[0]
    R = np.array(rotation_matrix(tuple(impacts.quaternion[0])))
    tau = R @ [-eta, xi, 0] / np.hypot(xi, eta)
    axes = np.array([tau, [-tau[1], tau[0], 0], [0, 0, 1]])
    return (
        axes @ impacts.contact_velocity_before[0],
        axes @ impacts.contact_velocity_after[0],
        axes @ impacts.impulse[0],
    )


def _row(after: Array, S: Array) -> str:
    """Return velocity and impulse as they stand in the table."""
    return f"v_A' = {_triple(after)} m/s, S = {_triple(1e3 * S)} mN s"


def _triple(x: Array) -> str:
    return "(" + ", ".join(f"{number + 0:.3f}" for number in np.round(x, 3)) + ")"


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(9, 5.6))
    panels = picture.subplots(2, 3, sharex=True, sharey=True).flat
    for axes, (name, law) in zip(panels, LAWS.items(), strict=True):
        before, after, S = (data[f"({law.letter}) {part}"] for part in ("before", "after", "impulse"))
        _arrow(axes, before, PALE, 5, "v_A")
        _arrow(axes, after, BLUE, 2, "v_A'")
        _arrow(axes, 1e3 * S, VERMILION, 2, "S [mN s]")
        if law.contact is not None:
            for part, color, unit in (("after", BLUE, 1), ("impulse", VERMILION, 1e3)):
                tip = unit * data[f"({law.letter}) {part}, MuJoCo"]
                axes.plot(tip[0], tip[1], "o", color=color, markersize=9, fillstyle="none")
        title = f"({law.letter}) {str(name).replace('_', ' ')}: S_z = {1e3 * S[2]:.2f} mN s"
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


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
