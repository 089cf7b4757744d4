"""Write a report's folder: the page, the video, the numbers and the paths."""

from pathlib import Path
from typing import Any

from cointoss.compare.output import answer
from cointoss.compare.output.files import written_together
from cointoss.compare.output.plain import json_text
from cointoss.compare.report.compared_tosses import Against, ComparedTosses
from cointoss.compare.report.contents import OF_THE_FILM, names_in, path_name
from cointoss.compare.report.map_section import MapSection
from cointoss.compare.report.page import render, versions
from cointoss.models.stages import stage

BEING_DRAWN = (
    "It is being drawn: reload this page when cointoss has ended. "
    "If that was interrupted, cointoss video --engine {engines} draws the film alone."
)


def write_report(
    comparison: ComparedTosses,
    folder: Path,
    no_video: str | None,
    *,
    maps: MapSection | None = None,
) -> Path:
    """Write everything about the tosses of a scenario, the film last.

    Before the film is drawn the page stands without it.

    Args:
        comparison: of the tosses.
        folder: where to write, made if missing; the files of an earlier report there are replaced, the page
            last, before the film is drawn.
        no_video: why no video can be drawn, or None.
        maps: what the report also shows.

    Returns:
        The page, report.html. Beside it lie toss.mp4, numbers.json, and path-*.csv of each engine.

    Raises:
        UnsupportedError: for a path of too many rows.
        UnwritableError: naming the folder and why.
    """
    engines = [toss.engine for toss in comparison.tosses]
    with written_together(folder, names_in(folder, engines)) as aside, stage("making the report"):
        numbers = {
            "name": comparison.name,
            "versions": versions(),
            "tosses": [answer.as_json(toss) for toss in comparison.tosses],
            "comparisons": {pair.toss.engine: _compared(pair) for pair in comparison.against},
            "absent": comparison.absent,
            **({"map": maps.numbers} if maps else {}),
        }
        (aside / "numbers.json").write_text(json_text(numbers), encoding="utf-8")
        for toss in comparison.tosses:
            path = answer.path_csv(toss.sample(answer.path_times(toss)), toss.scenario)
            (aside / path_name(toss.engine)).write_text(path, encoding="utf-8")

        being_drawn = BEING_DRAWN.format(engines="both" if "mujoco" in engines else "analytic")
        page = render(comparison, no_video=no_video or being_drawn, maps=maps)
        (aside / "report.html").write_text(page, encoding="utf-8")
    if no_video is None:
        with written_together(folder, OF_THE_FILM) as aside:
            from mediapy import compress_image

            from cointoss.compare.film.drawing import Camera
            from cointoss.compare.film.encodings import SMALL
            from cointoss.compare.film.video import write_video

            poster = write_video(comparison.filmed, Camera.CLOSE_UP, SMALL, aside / "toss.mp4")
            film = (aside / "toss.mp4").read_bytes(), compress_image(poster, fmt="jpeg", quality=80)
            (aside / "report.html").write_text(render(comparison, film=film, maps=maps), encoding="utf-8")
    return folder / "report.html"


def _compared(pair: Against) -> dict[str, Any]:
    return {
        "common_prefix": pair.common_prefix,
        "common_horizon": pair.common_horizon,
        "impulse_error": pair.errors,
        "parting_time": pair.together.parting_time,
        "time_difference": pair.differences.time,
        "impulse_difference": pair.differences.impulse,
        "angular_velocity_difference": pair.differences.angular_velocity,
    }
