"""`cointoss basin`: a map of outcomes."""

from pathlib import Path
from typing import Any

import click

from cointoss.compare.commands.common import (
    SCENARIO_HELP,
    CountType,
    Place,
    contact_option,
    no_video_option,
    plain_errors,
    say,
)
from cointoss.compare.commands.names import axis_option, scenario_argument


class _Size(click.ParamType):
    """Width and height in inches, as in 6x4.5."""

    name = "size"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[float, float]:
        try:
            width, height = (float(part) for part in value.split("x"))
        except ValueError:
            width = height = 0.0
        if not (1 <= width <= 100 and 1 <= height <= 100):
            self.fail(
                f"{value}; accepted: WIDTHxHEIGHT in inches, each from 1 to 100, as in 6x4.5", param, ctx
            )
        return width, height


@click.command(epilog=SCENARIO_HELP)
@scenario_argument
@axis_option("--x", "The field that varies along x, and its N values.")
@axis_option("--y", "The field that varies along y.")
@click.option(
    "--out",
    type=Place(),
    required=True,
    metavar="MAP.zarr",
    help="The Zarr store to write.",
)
@click.option("--engine", type=click.Choice(["analytic", "mujoco"]), help="The engine; by default analytic.")
@click.option(
    "--compare",
    "both",
    is_flag=True,
    help="Make the map by both engines, MuJoCo's as MAP-mujoco.zarr, and compare the two.",
)
@contact_option
@click.option(
    "--after",
    type=CountType(0, 999_999),
    help="Map the face at the touch after this number of impacts; 0: at the first touch.",
)
@click.option(
    "--margin",
    metavar="QUANTITY",
    help="Also map the smallest change of this quantity of the release that changes a pixel's outcome: "
    "height, velocity x (y, z), attitude about xi (eta, zeta) or spin about xi (eta, zeta).",
)
@click.option(
    "--trust",
    is_flag=True,
    help="Also find which pixels the engine's own errors may have decided.",
)
@click.option("--resume", is_flag=True, help="Continue a map; begin it where there is none.")
@click.option("--overwrite", is_flag=True, help="Replace an existing map.")
@click.option("--scheduler", metavar="ADDRESS", help="Address of a Dask scheduler on whose workers to toss.")
@click.option("--png", type=Place(), help="Also draw the map to this .png file.")
@click.option(
    "--palette",
    type=click.Choice(["safe", "paper"]),
    help="safe (the default): gold and blue, for the colour-blind too; paper: black and white.",
)
@click.option("--boundaries", is_flag=True, help="Colour the pixels at a boundary.")
@click.option("--size", type=_Size(), metavar="WIDTHxHEIGHT", help="Size of the picture in inches.")
@click.option("--dpi", type=CountType(10, 2400), help="Pixels per inch of the picture.")
@click.option(
    "--report",
    type=Place(),
    help="Folder of a report as by `cointoss compare`, with both maps; requires --compare.",
)
@no_video_option
def basin(
    scenario: str,
    engine: str | None,
    both: bool,
    contact: str | None,
    margin: str | None,
    trust: bool,
    resume: bool,
    overwrite: bool,
    png: Path | None,
    palette: str | None,
    boundaries: bool,
    size: tuple[float, float] | None,
    dpi: int | None,
    report: Path | None,
    no_video: bool,
    **asked: Any,
) -> None:
    """Map the outcome over two fields of a scenario.

    Each pixel is one toss. FIELD is a dotted path into the scenario, with components by name:
    release.position.z, release.angular_velocity.xi, floor.restitution. START and STOP are in SI or carry
    a unit; both are included.
    """
    if resume and overwrite:
        raise click.UsageError("--resume and --overwrite: accepted: one of them")
    if both and engine is not None:
        raise click.UsageError("--engine and --compare: accepted: one of them")
    if contact is not None and not (both or engine == "mujoco"):
        raise click.UsageError(f"--contact {contact}: accepted: only beside --engine mujoco or --compare")
    if both or engine == "mujoco":
        beside = "--compare" if both else f"--engine {engine}"
        for kept in ([] if margin is None else [f"--margin {margin}"]) + ["--trust"] * (trust and not both):
            raise click.UsageError(f"{kept} {beside}: accepted: only by the analytic engine alone")
    if report is not None and not both:
        raise click.UsageError(f"--report {report}: accepted: only beside --compare")
    if no_video and report is None:
        raise click.UsageError("--no-video: accepted: only beside --report")
    if png is None and report is None and (palette or boundaries or size or dpi):
        raise click.UsageError(
            "--palette, --boundaries, --size and --dpi: accepted: only beside --png or --report"
        )
    with plain_errors(scenario):
        from cointoss.models.stages import stage

        with stage("getting ready"):  # what is imported takes long on a busy machine
            from cointoss.compare.basins.picture_style import DPI, Palette, PictureStyle
            from cointoss.compare.engines import Engine
            from cointoss.compare.sweep.job import Job, make
            from cointoss.models.reading import scenario_text

        job = Job(
            source=scenario,
            text=scenario_text(scenario),
            engine=None if both else Engine(engine or "analytic"),
            contact=contact or "spring",
            margin=margin,
            trust=trust,
            resume=resume,
            overwrite=overwrite,
            png=png,
            style=PictureStyle(
                palette=Palette(palette or "safe"), boundaries=boundaries, size=size, dpi=dpi or DPI
            ),
            report=report,
            no_video=no_video,
            **asked,
        )
        for result in make(job, say):
            click.echo(result)
