"""One scenario tossed by several engines, how the answers compare, and what shows it."""

from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from html import escape
from os import PathLike
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes

from cointoss.compare.engines import Engine, EngineSettings, label_of, toss
from cointoss.compare.film.back_end import BackEndError, drawing_problem
from cointoss.compare.output.language import listed
from cointoss.compare.output.plots import axes_or_new
from cointoss.compare.output.style import GREY, looks_of
from cointoss.compare.report.compared_tosses import ComparedTosses
from cointoss.compare.report.contents import require_folder, slug_of
from cointoss.compare.report.folder import write_report
from cointoss.compare.report.simulators import simulator_of
from cointoss.compare.report.verdict import verdicts_of
from cointoss.models.reading import ScenarioSource, parse
from cointoss.models.records import UnsupportedError, UnusableEngineError
from cointoss.models.scenario import Scenario
from cointoss.models.sources import scenario_text
from cointoss.models.stages import stage

BOTH = ("analytic", "mujoco")
"""The engines of a comparison by default."""


AFTER = 1.0
"""How long after the end of the analytic toss the states of a user's own engine end [s]."""


class Comparison(ComparedTosses):
    """The tosses of one scenario by the analytic engine and by others, where they can toss it.

    `comparison["mujoco"]` holds the toss of an engine against the analytic one, which is `measure`. How they
    differ is computed when it is first asked for.
    """

    def __repr__(self) -> str:
        """Return the verdicts."""
        return f"<Comparison of {self.name}: {self._verdict}>"

    def _repr_html_(self) -> str:
        """Return the verdicts, and what each toss shows."""
        tosses = "".join(each._repr_html_() for each in self.tosses)
        return f"<div><strong>{escape(f'{self.name}: {self._verdict}')}</strong>{tosses}</div>"

    @property
    def _verdict(self) -> str:
        reasons = [f"{reason}." for reason in self.absent.values()]
        return " ".join([*(verdict.text for verdict in verdicts_of(self)), *reasons])

    def plot(self, ax: Axes | None = None) -> Axes:
        """Plot the heights of the mass centre over time, and lines up to which the faces must agree.

        Args:
            ax: where to draw, by default in a new figure of pyplot.

        Returns:
            The axes.
        """
        axes = axes_or_new(ax)
        names = [each.engine for each in self.tosses]
        looks, several = looks_of(names), len(self.against) > 1
        for each, look in zip(self.tosses, looks, strict=True):
            each.plot(axes, color=look.color, linestyle=look.line, label=each.engine)
        for pair, look in zip(self.against, looks[1:], strict=True):
            if pair.common_horizon_time is not None:
                color, whose = (look.color, f" of {label_of(pair.toss.engine)}") if several else (GREY, "")
                label = f"up to here the faces{whose} must agree"
                axes.axvline(pair.common_horizon_time, color=color, linestyle=":", label=label)
        axes.set_title(f"{self.name}, by {listed(names)}")
        axes.legend()
        return axes

    def report(self, out: str | PathLike[str]) -> Path:
        """Write the report that `cointoss compare` writes, and return its page.

        Args:
            out: its folder, made if missing; an earlier report there is replaced.

        Raises:
            OSError: naming the folder and why.
        """
        require_folder(Path(out), self.name, [each.engine for each in self.tosses])
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
        filmed, form = self.filmed, ENCODINGS[path.suffix.lower()].form
        with written_whole(path) as aside:
            write_video(filmed, Camera.CLOSE_UP, form, aside)
        return path


def compare(
    scenario: ScenarioSource,
    engines: Sequence[Any] = BOTH,
    *,
    settings: Mapping[str, EngineSettings] | None = None,
) -> Comparison:
    """Toss a scenario by several engines, and compare them with the analytic engine.

    Args:
        scenario: what to toss, or its path or name.
        engines: "analytic", "mujoco", or any engine that simulates: an object with a function
            `simulate(scenario, times)`, or its name, as in `cointoss_yardstick.conform`; it needs that
            package. The analytic engine comes first, and is added where it is missing.
        settings: of our engines, by their names; by default those of one toss.

    Returns:
        The tosses and how they differ, and why an engine can't toss the scenario.

    Raises:
        ScenarioError: for a scenario, a file or a name that can't be used.
        TypeError: for an object that is no engine, and for settings of another engine.
        UnusableEngineError: for an engine that can't be started, that fails, or whose answer is impossible,
            and for two engines with the same name.
        ValueError: for settings of an engine that is not asked.
    """
    drawing_problem()  # Its back end is chosen before MuJoCo is imported, for a film.
    if isinstance(scenario, Scenario):
        return compared(scenario, scenario.to_toml(), "scenario", engines, settings)
    text = scenario_text(scenario)
    return compared(parse(text, str(scenario)), text, Path(scenario).stem, engines, settings)


def compared(
    scenario: Scenario,
    text: str,
    name: str,
    engines: Sequence[Any] = BOTH,
    settings: Mapping[str, EngineSettings] | None = None,
) -> Comparison:
    """Toss a scenario by several engines; the arguments are as of `compare`.

    Args:
        scenario: what to toss.
        text: the text it was read from.
        name: what to call it.
        engines: the engines.
        settings: of ours.
    """
    chosen = settings or {}
    asked = [engine for engine in engines if engine != Engine.ANALYTIC]
    with ExitStack() as stack:
        others = [
            each if each == Engine.MUJOCO else stack.enter_context(simulator_of(each)) for each in asked
        ]
        names = ["analytic", *(str(each) if isinstance(each, str) else each.name for each in others)]
        if len({slug_of(each) for each in names} - {""}) < len(names):
            raise UnusableEngineError(
                f"engines: {', '.join(names)}, accepted: names that differ in letters or digits"
            )
        if not chosen.keys() <= set(names):
            raise ValueError(f"settings: of {', '.join(chosen)}, accepted: of {', '.join(names)}")
        measure = toss(scenario, settings=chosen.get(Engine.ANALYTIC))
        tosses, absent = [measure], {}
        for each, called in zip(others, names[1:], strict=True):
            try:
                if isinstance(each, str):
                    tosses.append(toss(scenario, each, settings=chosen.get(called)))
                else:
                    with stage(f"tossing by {called}"):
                        tosses.append(each.toss(scenario, measure.end_time + AFTER))
            except UnsupportedError as error:
                absent[called] = str(error)
    return Comparison(name=name, text=text, tosses=tuple(tosses), absent=absent, settings=chosen)
