"""One scenario tossed by both engines, and how the answers compare."""

from dataclasses import dataclass
from functools import cached_property
from html import escape
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from compare.engines import Engine, EngineSettings
from compare.film.back_end import BackEndError, drawing_problem
from compare.film.filmed import Filmed, followed
from compare.metrics.impulses import Differences, errors_of_impacts, match
from compare.metrics.sequences import agreement_horizon, common_prefix
from compare.metrics.trajectories import attitude_angle, distance, parting_time
from models.plots import axes_or_new
from models.reading import ScenarioSource, parse, scenario_text
from models.records import Array, Toss, UnsupportedError
from models.scenario import Scenario
from models.stages import stage

if TYPE_CHECKING:
    from models.plots import Axes

TIMES = 2400
PARTED = 0.1
"""Two paths have parted when they are further apart than this part of the radius."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Together:
    """Both paths at the same times, as far as both tosses last; arrays are read-only."""

    time: Array
    """(n,) [s]."""
    distance: Array
    """Between the mass centres, (n,) [m]."""
    attitude_angle: Array
    """Of the rotation from one attitude to the other, (n,) [rad]."""
    parting_time: float | None
    """When the distance first exceeds `PARTED` r [s]."""

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        for array in (self.time, self.distance, self.attitude_angle):
            array.setflags(write=False)


@dataclass(frozen=True, kw_only=True, eq=False)
class Comparison:
    """The tosses of one scenario by both engines, or by the analytic one alone where MuJoCo can't toss it.

    How they differ is computed when it is first asked for; without a toss by MuJoCo it raises
    `UnsupportedError`.
    """

    name: str
    """Of the scenario."""
    text: str
    """The scenario's TOML."""
    analytic: Toss
    mujoco: Toss | None
    not_realisable: str | None = None
    """Why MuJoCo can't toss the scenario, where it can't."""
    settings: EngineSettings
    """MuJoCo's."""

    @property
    def scenario(self) -> Scenario:
        """What was tossed."""
        return self.analytic.scenario

    @property
    def tosses(self) -> tuple[Toss, ...]:
        """The tosses there are, the analytic first."""
        return (self.analytic,) if self.mujoco is None else (self.analytic, self.mujoco)

    @property
    def both(self) -> tuple[Toss, Toss]:
        """The analytic toss and MuJoCo's."""
        if self.mujoco is None:
            raise UnsupportedError(self.not_realisable)
        return self.analytic, self.mujoco

    @cached_property
    def differences(self) -> Differences:
        """Of the impacts, MuJoCo against analytic."""
        a, b = self.both
        return match(a.impacts, b.impacts)

    @cached_property
    def together(self) -> Together:
        """Both paths at the same times."""
        a, b = self.both
        times = np.linspace(0, min(a.end_time, b.end_time), TIMES)
        path_a, path_b = a.sample(times), b.sample(times)
        apart = distance(path_a, path_b)
        return Together(
            time=times,
            distance=apart,
            attitude_angle=attitude_angle(path_a, path_b),
            parting_time=parting_time(times, apart, PARTED * self.scenario.coin.radius),
        )

    @cached_property
    def common_prefix(self) -> int:
        """Leading symbols of the sequences that agree."""
        a, b = self.both
        return common_prefix(a.sequence, b.sequence)

    @cached_property
    def errors(self) -> Array:
        """Relative error of each of MuJoCo's impulses: see `errors_of_impacts`, (n,), read-only."""
        errors = errors_of_impacts(self.both[1])
        errors.setflags(write=False)
        return errors

    @cached_property
    def horizon(self) -> int:
        """Leading symbols that must agree: within MuJoCo's own horizon, and that of its errors."""
        a, b = self.both
        return min(b.trusted_impacts, agreement_horizon(a, self.errors))

    @property
    def horizon_time(self) -> float | None:
        """The time of the last impact whose face must be shared, where others follow [s]."""
        a, b = self.both
        follows = self.horizon < max(len(a.impacts), len(b.impacts))
        return float(a.impacts.time[self.horizon - 1]) if 0 < self.horizon and follows else None

    def __repr__(self) -> str:
        """Return the verdict."""
        return f"<Comparison of {self.name}: {self._verdict}>"

    def _repr_html_(self) -> str:
        """Return the verdict, and what each toss shows."""
        tosses = "".join(toss._repr_html_() for toss in self.tosses)
        return f"<div><strong>{escape(f'{self.name}: {self._verdict}')}</strong>{tosses}</div>"

    @property
    def _verdict(self) -> str:
        from compare.report.verdict import verdict_of

        reason = "" if self.mujoco else f" {self.not_realisable}."
        return f"{verdict_of(self).text}{reason}"

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Plot the heights of the mass centre over time, and a line up to which the faces must agree.

        Args:
            ax: where to draw, by default in a new figure of pyplot.

        Returns:
            The axes.
        """
        from compare.output.style import ANALYTIC, GREY, MUJOCO

        axes = axes_or_new(ax)
        for toss, color, style in zip(self.tosses, (ANALYTIC, MUJOCO), ("-", "--"), strict=False):
            toss.plot(axes, color=color, linestyle=style, label=toss.engine)
        if self.mujoco and self.horizon_time is not None:
            axes.axvline(
                self.horizon_time, color=GREY, linestyle=":", label="up to here the faces must agree"
            )
        axes.set_title(f"{self.name}, by {' and '.join(toss.engine for toss in self.tosses)}")
        axes.legend()
        return axes

    def filmed(self) -> list[Filmed]:
        """Return the tosses as films show them: on, beyond their endings, until the coin lies still."""
        settings = {"analytic": None, "mujoco": self.settings}
        return [followed(toss, settings[toss.engine]) for toss in self.tosses]

    def report(self, out: str | PathLike[str]) -> Path:
        """Write the report that `cointoss compare` writes, and return its page.

        Args:
            out: its folder, made if missing; an earlier report there is replaced.

        Raises:
            OSError: naming the folder and why.
        """
        from compare.report.contents import require_folder
        from compare.report.folder import write_report

        require_folder(Path(out), self.name)
        return write_report(self, Path(out), drawing_problem())

    def film(self, out: str | PathLike[str]) -> Path:
        """Write the film that `cointoss video` draws, and return its path.

        Args:
            out: the file, .mp4, .webm or .gif; one that is there is replaced.

        Raises:
            BackEndError: where MuJoCo can't draw; the message says what to do.
            OSError: naming the file and why.
        """
        from compare.film.drawing import Camera
        from compare.film.encodings import ENCODINGS
        from compare.film.video import write_video
        from compare.output.files import require_file, written_whole

        path = Path(out)
        require_file(path, tuple(ENCODINGS), self.name)
        problem = drawing_problem()
        if problem is not None:
            raise BackEndError(problem)
        filmed, form = self.filmed(), ENCODINGS[path.suffix.lower()].form
        with written_whole(path) as aside, stage("drawing the film", "frames") as progress:
            write_video(filmed, Camera.CLOSE_UP, form, aside, progress)
        return path


def compare(scenario: ScenarioSource, mujoco: EngineSettings | None = None) -> Comparison:
    """Toss a scenario by both engines.

    Args:
        scenario: what to toss, or its path or name.
        mujoco: MuJoCo's settings, by default those of one toss.

    Returns:
        Both tosses and how they differ; or, where MuJoCo can't toss the scenario, the analytic toss and why.

    Raises:
        ScenarioError: for a scenario, a file or a name that can't be used.
        TypeError: for settings that are none of MuJoCo's.
    """
    drawing_problem()  # Its back end is chosen before MuJoCo is imported, for a film.
    if isinstance(scenario, Scenario):
        return compared(scenario, scenario.to_toml(), "scenario", mujoco)
    text = scenario_text(scenario)
    return compared(parse(text, str(scenario)), text, Path(scenario).stem, mujoco)


def compared(scenario: Scenario, text: str, name: str, mujoco: EngineSettings | None = None) -> Comparison:
    """Toss a scenario by both engines.

    Args:
        scenario: what to toss.
        text: the text it was read from.
        name: what to call it.
        mujoco: MuJoCo's settings, by default those of one toss.
    """
    analytic, engine = Engine.ANALYTIC.package.toss(scenario), Engine.MUJOCO.package
    settings, toss, why = engine.FINE if mujoco is None else mujoco, None, None
    try:
        toss = engine.toss(scenario, settings=settings)
    except UnsupportedError as error:
        why = str(error)
    return Comparison(
        name=name, text=text, analytic=analytic, mujoco=toss, not_realisable=why, settings=settings
    )
