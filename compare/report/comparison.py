"""One scenario tossed by both engines, how the answers compare, and what shows it."""

from html import escape
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from cointoss.compare.engines import Engine, EngineSettings
from cointoss.compare.film.back_end import BackEndError, drawing_problem
from cointoss.compare.output.plots import axes_or_new
from cointoss.compare.output.style import ANALYTIC, GREY, MUJOCO
from cointoss.compare.report.compared_tosses import ComparedTosses
from cointoss.compare.report.contents import require_folder
from cointoss.compare.report.folder import write_report
from cointoss.compare.report.verdict import verdict_of
from cointoss.models.reading import ScenarioSource, parse, scenario_text
from cointoss.models.records import UnsupportedError
from cointoss.models.scenario import Scenario
from cointoss.models.stages import stage

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class Comparison(ComparedTosses):
    """The tosses of one scenario by both engines, or by the analytic one alone where MuJoCo can't toss it.

    How they differ is computed when it is first asked for; without a toss by MuJoCo it raises
    `UnsupportedError`.
    """

    def __repr__(self) -> str:
        """Return the verdict."""
        return f"<Comparison of {self.name}: {self._verdict}>"

    def _repr_html_(self) -> str:
        """Return the verdict, and what each toss shows."""
        tosses = "".join(toss._repr_html_() for toss in self.tosses)
        return f"<div><strong>{escape(f'{self.name}: {self._verdict}')}</strong>{tosses}</div>"

    @property
    def _verdict(self) -> str:
        reason = "" if self.mujoco else f" {self.not_realisable}."
        return f"{verdict_of(self).text}{reason}"

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Plot the heights of the mass centre over time, and a line up to which the faces must agree.

        Args:
            ax: where to draw, by default in a new figure of pyplot.

        Returns:
            The axes.
        """
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

    def report(self, out: str | PathLike[str]) -> Path:
        """Write the report that `cointoss compare` writes, and return its page.

        Args:
            out: its folder, made if missing; an earlier report there is replaced.

        Raises:
            OSError: naming the folder and why.
        """
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
        from cointoss.compare.film.drawing import Camera
        from cointoss.compare.film.encodings import ENCODINGS
        from cointoss.compare.film.video import write_video
        from cointoss.compare.output.files import require_file, written_whole

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
