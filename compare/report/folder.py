"""Write a report's folder: the page, the video, the numbers and the paths."""

import io
import json
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np

from compare.engines import EngineSettings
from compare.metrics.comparison import Comparison, compare
from compare.output import answer
from compare.output.files import written_together
from compare.report.contents import FILES, OF_THE_FILM
from compare.report.map_section import MapSection
from compare.report.page import Film, Page, render, versions
from models.records import Array, Toss
from models.scenario import Scenario
from models.stages import stage

BEING_DRAWN = (
    "It is being drawn: reload this page when cointoss has ended. "
    "If that was interrupted, cointoss video --engine {engines} draws the film alone."
)


def write_report(
    scenario: Scenario,
    scenario_text: str,
    name: str,
    folder: Path,
    no_video: str | None,
    *,
    mujoco: EngineSettings | None = None,
    maps: MapSection | None = None,
) -> Path:
    """Toss a scenario by both engines and write everything about it, the film last.

    Before the film is drawn the page stands without it.

    Args:
        scenario: what to toss.
        scenario_text: the text it was read from.
        name: what to call it.
        folder: where to write, made if missing; an earlier report there is replaced as a whole before the
            film is drawn.
        no_video: why no video can be drawn, or None.
        mujoco: MuJoCo's settings, by default those of one toss.
        maps: what the report also shows.

    Returns:
        The page, report.html. Beside it lie toss.mp4, numbers.json, and path-*.csv of each engine.

    Raises:
        UnsupportedError: for what the analytic engine doesn't model, and a path of too many rows.
        UnwritableError: naming the folder and why.
    """
    with written_together(folder, FILES) as aside, stage("making the report"):
        answered = compare(scenario, mujoco)
        comparison = answered if isinstance(answered, Comparison) else None
        analytic, not_realisable = (comparison.analytic, None) if comparison else answered  # pyright: ignore
        tosses = [analytic, *([comparison.mujoco] if comparison else [])]
        numbers = _numbers(name, tosses, comparison, not_realisable) | ({"map": maps.numbers} if maps else {})
        (aside / "numbers.json").write_text(json.dumps(numbers, indent=1, allow_nan=False), encoding="utf-8")
        for toss in tosses:
            states = toss.sample(answer.path_times(toss))
            (aside / f"path-{toss.engine}.csv").write_text(answer.path_csv(states), encoding="utf-8")

        being_drawn = BEING_DRAWN.format(engines="both" if comparison else "analytic")
        page = Page(
            name=name,
            scenario=scenario,
            scenario_text=scenario_text,
            analytic=analytic,
            comparison=comparison,
            not_realisable=not_realisable,
            film=None,
            no_video=no_video or being_drawn,
            maps=maps,
        )
        (aside / "report.html").write_text(render(page), encoding="utf-8")
    if no_video is None:
        with written_together(folder, OF_THE_FILM) as aside:
            from compare.film.drawing import Camera
            from compare.film.encodings import SMALL
            from compare.film.filmed import followed
            from compare.film.video import write_video

            settings = {"analytic": None, "mujoco": mujoco}
            shown = [followed(toss, settings[toss.engine]) for toss in tosses]
            with stage("drawing the film", "frames") as progress:
                poster = write_video(shown, Camera.CLOSE_UP, SMALL, aside / "toss.mp4", progress)
            film = Film((aside / "toss.mp4").read_bytes(), _jpeg(poster))
            with_film = replace(page, film=film, no_video=None)
            (aside / "report.html").write_text(render(with_film), encoding="utf-8")
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


def _jpeg(picture: np.ndarray) -> bytes:
    """Return a picture, (height, width, 3) of uint8, as the bytes of a JPEG file."""
    from PIL import Image

    written = io.BytesIO()
    Image.fromarray(picture).save(written, format="jpeg", quality=80)
    return written.getvalue()


def _finite(numbers: Array) -> list[float | None]:
    """Return numbers for JSON, with null for those that are not finite."""
    return [float(number) if np.isfinite(number) else None for number in numbers]
