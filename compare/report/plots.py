"""The report's figures, as SVG."""

import io

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter

from compare.metrics.comparison import PARTED, Comparison
from compare.metrics.trajectories import tilt
from compare.output.style import ANALYTIC, GREEN, GREY, MUJOCO, PALE, PURPLE, STYLE
from models.barriers import barrier
from models.records import Array, States, Toss
from models.scenario import Scenario

COLORS = {"analytic": ANALYTIC, "mujoco": MUJOCO}
LABELS = {"analytic": "analytic", "mujoco": "MuJoCo"}
STYLES = {"analytic": "-", "mujoco": "--"}
POINTS = 3000


def _svg(figure: Figure) -> str:
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None, "Creator": None})
    return text.getvalue()[text.getvalue().index("<svg") :]


def sample_evenly(toss: Toss) -> States:
    """Return a toss's states at even times and on both sides of every impact."""
    before = np.nextafter(toss.impacts.time, 0)
    times = np.unique(np.concatenate([np.linspace(0, toss.end_time, POINTS), toss.impacts.time, before]))
    return toss.sample(times)


def energies(scenario: Scenario, states: States) -> Array:
    """Return the mechanical energy at each state, (n,) [J]."""
    coin = scenario.coin
    w, v = states.angular_velocity, states.velocity
    turning = np.einsum("ni,ij,nj->n", w, coin.inertia_about_C, w) / 2
    return turning + coin.mass * (np.sum(v * v, axis=1) / 2 + scenario.gravity * states.position[:, 2])


def _lines(axes: Axes, tosses: list[tuple[Toss, States]], values: list[Array], scale: float = 1.0) -> None:
    for (toss, states), value in zip(tosses, values, strict=True):
        axes.plot(
            states.time,
            scale * value,
            STYLES[toss.engine],
            color=COLORS[toss.engine],
            label=LABELS[toss.engine],
        )
    axes.set_xlabel("t [s]")


def draw(tosses: list[Toss], comparison: Comparison | None) -> dict[str, str]:
    """Draw the figures of a report.

    Args:
        tosses: by one engine or both.
        comparison: of both, where there are both.

    Returns:
        SVG texts by the names the page knows them by.
    """
    sampled = [(toss, sample_evenly(toss)) for toss in tosses]
    with mpl.rc_context(STYLE):
        figures = {
            "path": _path(sampled),
            "height": _height(sampled),
            "tilt": _tilt(sampled),
            "spin": _spin(sampled),
            "energy": _energy(sampled),
        }
        if comparison is not None:
            figures["apart"] = _apart(comparison)
        return {name: _svg(figure) for name, figure in figures.items()}


def _path(sampled: list[tuple[Toss, States]]) -> Figure:
    figure = Figure(figsize=(5.2, 4.4))
    axes = figure.add_subplot(projection="3d")
    points = np.concatenate([states.position for _, states in sampled]) * 1e3
    for toss, states in sampled:
        x, y, z = 1e3 * states.position.T
        axes.plot(
            x, y, z, STYLES[toss.engine], color=COLORS[toss.engine], label=LABELS[toss.engine], linewidth=1.1
        )
        hits = 1e3 * toss.impacts.position
        axes.plot(hits[:, 0], hits[:, 1], hits[:, 2], ".", color=COLORS[toss.engine], markersize=4)
    middle, reach = (points.min(0) + points.max(0)) / 2, np.ptp(points, axis=0)
    # A path without width, or too far off to have one in floating-point numbers, is drawn as a line.
    radius = 1e3 * sampled[0][0].scenario.coin.radius
    wide = max(reach[0], reach[1], 0.01 * reach[2], 0.1 * radius, 1e-9 * np.abs(middle).max())
    axes.set_xlim(middle[0] - wide / 2, middle[0] + wide / 2)
    axes.set_ylim(middle[1] - wide / 2, middle[1] + wide / 2)
    axes.set_zlim(0, None)
    axes.set_xlabel("x [mm]")
    axes.set_ylabel("y [mm]")
    axes.set_zlabel("z [mm]")
    axes.locator_params(nbins=5)
    axes.legend(loc="upper left")
    return figure


def _height(sampled: list[tuple[Toss, States]]) -> Figure:
    figure = Figure(figsize=(5.2, 4.4))
    axes = figure.add_subplot()
    _lines(axes, sampled, [states.position[:, 2] for _, states in sampled], 1e3)
    for toss, _ in sampled:
        axes.plot(
            toss.impacts.time, 1e3 * toss.impacts.position[:, 2], ".", color=COLORS[toss.engine], markersize=5
        )
    axes.set_ylabel("height of the mass centre z [mm]")
    axes.set_ylim(0, None)
    axes.legend(loc="upper right")
    return figure


def _tilt(sampled: list[tuple[Toss, States]]) -> Figure:
    figure = Figure(figsize=(5.2, 3.4))
    axes = figure.add_subplot()
    _lines(axes, sampled, [np.degrees(tilt(states)) for _, states in sampled])
    axes.axhline(90, color=GREY, linewidth=0.8)
    axes.set_ylabel("tilt of the normal from the vertical [deg]")
    axes.set_yticks([0, 45, 90, 135, 180], ["heads 0", "45", "90", "135", "tails 180"])
    axes.set_ylim(-3, 183)
    return figure


def _spin(sampled: list[tuple[Toss, States]]) -> Figure:
    figure = Figure(figsize=(5.2, 3.4))
    axes = figure.add_subplot()
    _lines(axes, sampled, [np.linalg.norm(states.angular_velocity, axis=1) for _, states in sampled])
    for toss, states in sampled:
        axes.plot(states.time, states.angular_velocity[:, 2], ":", color=COLORS[toss.engine], linewidth=1.2)
    axes.set_ylabel("spin |ω|, and ω_ζ dotted [rad/s]")
    axes.legend(loc="upper left")
    return figure


def _energy(sampled: list[tuple[Toss, States]]) -> Figure:
    figure = Figure(figsize=(5.2, 3.4))
    axes = figure.add_subplot()
    scenario = sampled[0][0].scenario
    _lines(axes, sampled, [energies(scenario, states) for _, states in sampled], 1e3)
    body = scenario.body
    barriers = {1e3 * barrier(body, side) for side in (1.0, -1.0)}
    for level in barriers:
        axes.axhline(level, color=GREY, linewidth=0.8)
    axes.text(
        0.01,
        min(barriers),
        "least energy to turn over",
        transform=axes.get_yaxis_transform(),
        va="top",
        color=GREY,
    )
    axes.set_yscale("log")
    axes.yaxis.set_major_formatter(FuncFormatter(lambda level, _: f"{level:g}"))
    axes.yaxis.set_minor_formatter(
        FuncFormatter(lambda level, _: f"{level:g}" if f"{level:.0e}"[0] in "25" else "")
    )
    axes.set_ylim(bottom=0.5 * min(barriers))
    axes.set_ylabel("energy [mJ]")
    axes.legend(loc="upper right")
    return figure


def _apart(comparison: Comparison) -> Figure:
    figure = Figure(figsize=(5.2, 3.4))
    axes = figure.add_subplot()
    together, radius = comparison.together, comparison.scenario.coin.radius
    # Zero has no place on a logarithmic axis; rounding is drawn at the axis's foot.
    foot = 1e-16
    axes.semilogy(
        together.time, np.maximum(together.distance / radius, foot), color=GREEN, label="distance / r"
    )
    axes.semilogy(
        together.time,
        np.maximum(together.attitude_angle, foot),
        color=PURPLE,
        linewidth=1.1,
        label="angle [rad]",
    )
    for time in comparison.analytic.impacts.time:
        axes.axvline(time, color=PALE, linewidth=0.5)
    axes.axhline(PARTED, color=GREY, linewidth=0.8)
    across = axes.get_yaxis_transform()
    axes.text(0.01, PARTED, f"{PARTED:g} r", transform=across, va="bottom", color=GREY)
    axes.set_ylim(foot, 1e3)
    axes.set_xlabel("t [s]")
    axes.set_ylabel("difference of the engines")
    axes.legend(loc="lower right")
    return figure
