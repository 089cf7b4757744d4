"""Write a report's folder: the page, the video, the numbers and the paths."""

import json
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from compare import answer
from compare.comparison import Comparison, compare
from compare.files import write_text, written_whole
from compare.report import plots
from compare.report.page import Page, render, versions
from models.records import Array, Toss
from models.scenario import Scenario

PATH_ROWS_PER_SECOND = 1000


def write_report(
    scenario: Scenario,
    scenario_text: str,
    name: str,
    folder: Path,
    no_video: str | None,
    progress: Callable[[int, int], None],
) -> Path:
    """Toss a scenario by both engines and write everything about it.

    Args:
        scenario: what to toss.
        scenario_text: the text it was read from.
        name: what to call it.
        folder: where to write; it exists.
        no_video: why no video can be drawn, or None.
        progress: called after each frame of the video with their number so far and in all.

    Returns:
        The page, report.html. Beside it lie toss.mp4, numbers.json, and path-*.csv of each engine.

    Raises:
        UnsupportedError: for what the analytic engine doesn't model.
    """
    answered = compare(scenario)
    comparison = answered if isinstance(answered, Comparison) else None
    analytic, not_realisable = (comparison.analytic, None) if comparison else answered  # pyright: ignore
    tosses = [analytic, *([comparison.mujoco] if comparison else [])]

    write_text(
        folder / "numbers.json",
        json.dumps(_numbers(name, tosses, comparison, not_realisable), indent=1, allow_nan=False),
    )
    for toss in tosses:
        states = toss.sample(answer.path_times(toss, PATH_ROWS_PER_SECOND))
        write_text(folder / f"path-{toss.engine}.csv", answer.path_csv(states))

    video = None
    if comparison and no_video is None:
        from coin_mj.video import write_video

        with written_whole(folder / "toss.mp4") as aside:
            write_video(comparison.mujoco, aside, progress)
        video = (folder / "toss.mp4").read_bytes()

    page = Page(
        name=name,
        scenario=scenario,
        scenario_text=scenario_text,
        analytic=analytic,
        comparison=comparison,
        not_realisable=not_realisable,
        figures=plots.draw(tosses, comparison),
        video=video,
        no_video=no_video or not_realisable,
    )
    write_text(folder / "report.html", render(page))
    return folder / "report.html"


def _numbers(
    name: str, tosses: list[Toss], comparison: Comparison | None, not_realisable: str | None
) -> dict[str, Any]:
    numbers: dict[str, Any] = {
        "name": name,
        "versions": versions(),
        "tosses": [
            {**answer.as_json(toss), "certificate": [asdict(setting) for setting in toss.certificate]}
            for toss in tosses
        ],
    }
    if comparison is None:
        return {**numbers, "not_realisable": not_realisable}
    together = comparison.together
    return {
        **numbers,
        "comparison": {
            "common_prefix": comparison.common_prefix,
            "horizon": comparison.horizon,
            "impulse_error": _finite(comparison.errors),
            "parting_time": together.parting_time,
            "time_difference": _finite(comparison.differences.time),
            "impulse_difference": _finite(comparison.differences.impulse),
            "angular_velocity_difference": _finite(comparison.differences.angular_velocity),
        },
    }


def _finite(numbers: Array) -> list[float | None]:
    """Give numbers for JSON, which has none that are infinite: null stands for those."""
    return [float(number) if np.isfinite(number) else None for number in numbers]
