"""The command line: `cointoss`."""

import json
import os
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any, NoReturn

import click

from compare.output.interruption import Interruption, run_to_exit

# Little is imported here: `cointoss --help` answers at once, each command brings what it needs.

_SCENARIO_HELP = (
    "SCENARIO is a TOML file, or the name of a scenario that comes with the package, such as fig24a. "
    "An unknown name prints the names that exist."
)


class _Commands(click.Group):
    """The commands, each of whose failures is one line."""

    def __call__(self, *args: Any, **extra: Any) -> NoReturn:
        run_to_exit(lambda: self.main(*args, **extra))

    def main(self, *args: Any, **extra: Any) -> NoReturn:
        try:
            status = super().main(*args, **{"prog_name": "cointoss", **extra, "standalone_mode": False})
            if sys.stdout is not None:  # None where the shell has closed it
                sys.stdout.flush()
        except click.UsageError as error:
            command = error.ctx.command_path if error.ctx else "cointoss"
            _refuse(f"{error.format_message().rstrip('.')} (see {command} --help)")
        except click.Abort:  # KeyboardInterrupt
            _refuse("interrupted", status=130)
        except OSError as error:
            _lose_stdout()
            _refuse(f"{error.filename or 'standard output'}: can't be written ({error.strerror})", status=1)
        sys.exit(status)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command:
        known = super().get_command(ctx, cmd_name)
        return known or ctx.fail(f"{cmd_name}: no such command; accepted: {', '.join(self.commands)}")


class _Count(click.IntRange):
    """A whole number within bounds, with one message for what is out of them and what is no number."""

    name = "count"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        try:
            return super().convert(value, param, ctx)
        except click.BadParameter:
            self.fail(f"{value}; accepted: an integer >= {self.min} and <= {self.max}", param, ctx)


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


@click.group(
    cls=_Commands,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    no_args_is_help=False,
)
@click.version_option(package_name="cointoss", prog_name="cointoss")
def main() -> None:
    """Toss a coin by two engines, the analytic one of Strzalko et al. (2008) and MuJoCo, and compare."""


@contextmanager
def _plain_errors(source: str) -> Iterator[None]:
    """Turn the errors of bad input into one line and exit status 2, and warnings into one line each."""
    from compare.film.back_end import BackEndError
    from compare.output.files import UnwritableError
    from compare.output.progress import compile_bar
    from compare.sweep.errors import SweepError
    from models.errors import ScenarioError
    from models.records import ApproximationWarning, UnsupportedError, UnusableEngineError

    reported = set()

    def report(message: Warning | str, category: type[Warning], *where: Any, **extra: Any) -> None:
        if issubclass(category, ApproximationWarning):
            if str(message) not in reported:
                _say(f"{source}: {message}")
            reported.add(str(message))
        else:
            show(message, category, *where, **extra)

    with compile_bar(), warnings.catch_warnings():
        warnings.simplefilter("always", ApproximationWarning)
        show, warnings.showwarning = warnings.showwarning, report
        try:
            yield
        except (ScenarioError, UnwritableError, BackEndError, UnusableEngineError) as error:
            _refuse(str(error))
        except (SweepError, UnsupportedError, FloatingPointError) as error:
            _refuse(f"{source}: {error}")


def _refuse(message: str, status: int = 2) -> NoReturn:
    _say(message)
    sys.exit(status)


def _say(message: str) -> None:
    shown = "".join(char if char.isprintable() else repr(char)[1:-1] for char in message)
    click.echo(f"cointoss: {shown}", err=True)


def _lose_stdout() -> None:
    """Discard what standard output could not take, or Python would report it again at its end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)


_contact = click.option(
    "--contact",
    type=click.Choice(["spring", "one_step"]),
    help="How MuJoCo realises the restitution; by default by a spring.",
)


@main.command(epilog=_SCENARIO_HELP)
@click.argument("scenario")
@click.option(
    "--engine",
    type=click.Choice(["analytic", "mujoco"]),
    default="analytic",
    show_default=True,
    help="The engine.",
)
@_contact
@click.option("--max-impacts", type=_Count(1, 30_000_000), help="Stop after this number of impacts.")
@click.option(
    "--contact-steps",
    type=_Count(1, 1_000_000_000),
    help="Stop after this number of steps of sustained contact; by default an engine's own.",
)
@click.option("--json", "as_json", is_flag=True, help="Print JSON, in full precision.")
@click.option("--trajectory", type=click.Path(path_type=Path), help="Also write the path to this .csv file.")
@click.option(
    "--margin", is_flag=True, help="Also find the least changes of the release that change the outcome."
)
def toss(
    scenario: str,
    engine: str,
    contact: str | None,
    max_impacts: int | None,
    contact_steps: int | None,
    as_json: bool,
    trajectory: Path | None,
    margin: bool,
) -> None:
    """Toss one coin and print its impacts."""
    if margin and engine != "analytic":
        raise click.UsageError(f"--margin --engine {engine}: accepted: only by the analytic engine")
    if contact is not None and engine != "mujoco":
        raise click.UsageError(f"--contact {contact}: accepted: only beside --engine mujoco")
    with _plain_errors(scenario):
        from compare.engines import Engine
        from compare.film.back_end import require_mujoco
        from compare.output import answer
        from compare.output.files import is_stream, require_file, write_text
        from compare.output.progress import elapsed_time
        from models.reading import load

        described = load(scenario)
        if engine == Engine.MUJOCO:
            require_mujoco()
        if trajectory is not None and not is_stream(trajectory):
            require_file(trajectory, ".csv", scenario)
        if max_impacts is not None:
            described = described.replace("ending.max_impacts", max_impacts)
        package = Engine(engine).package
        given = {"contact": contact, "contact_steps": contact_steps}
        chosen = {name: value for name, value in given.items() if value is not None}
        with elapsed_time("still tossing; Ctrl-C ends it, --max-impacts N a toss sooner"):
            result = package.toss(described, settings=replace(package.FINE, **chosen))
        if trajectory is not None:
            times = answer.path_times(result)
            write_text(trajectory, answer.path_csv(result.sample(times)))
        extra = []
        if margin:
            from compare.metrics.margin import margins

            extra = margins(described)
        if as_json:
            told = {item.quantity.name: {"change": item.finite, "unit": item.quantity.unit} for item in extra}
            whole = {**answer.as_json(result), **({"margin": told} if margin else {})}
            click.echo(json.dumps(whole, indent=1, allow_nan=False))
        else:
            click.echo("\n".join([answer.as_lines(result), *(item.line for item in extra)]))


@main.command(epilog=_SCENARIO_HELP)
@click.argument("scenario")
@click.option(
    "--out", type=click.Path(path_type=Path), required=True, help="Folder of the report; made if missing."
)
@click.option("--no-video", is_flag=True, help="Draw no video, which takes longest.")
def compare(scenario: str, out: Path, no_video: bool) -> None:
    """Toss one coin by both engines and write a report.

    The report shows both tosses side by side, with a video. The page is there before the video is drawn.
    """
    with _plain_errors(scenario):
        from compare.report.contents import require_folder
        from models.reading import parse, scenario_text

        text = scenario_text(scenario)
        described = parse(text, scenario)
        require_folder(out, scenario)

        from compare.film.back_end import drawing_problem

        problem = "None was asked for; cointoss video draws one." if no_video else drawing_problem()

        from compare.output.progress import bar
        from compare.report.folder import write_report

        with bar("video", "frames") as progress:
            page = write_report(described, text, Path(scenario).stem, out, problem, progress)
        click.echo(page)


@main.command(epilog=_SCENARIO_HELP)
@click.argument("scenario")
@click.option("--out", type=click.Path(path_type=Path), required=True, help="The .mp4 file to write.")
@click.option(
    "--engine",
    type=click.Choice(["analytic", "mujoco", "both"]),
    default="mujoco",
    show_default=True,
    help="The engine that tosses; both: side by side.",
)
@click.option(
    "--camera",
    type=click.Choice(["overview", "close-up", "top"]),
    default="close-up",
    show_default=True,
    help="Where the camera is; close-up follows the coin.",
)
def video(scenario: str, out: Path, engine: str, camera: str) -> None:
    """Film one toss, drawn by MuJoCo.

    The film slows down around the impacts.
    """
    with _plain_errors(scenario):
        from compare.output.files import require_file, written_whole
        from models.reading import load

        described = load(scenario)
        require_file(out, ".mp4", scenario)

        from compare.film.back_end import drawing_problem

        problem = drawing_problem()
        if problem is not None:
            _refuse(problem)

        from compare.engines import Engine
        from compare.film.drawing import Camera
        from compare.film.video import FULL, write_video
        from compare.output.progress import bar

        engines = list(Engine) if engine == "both" else [Engine(engine)]
        tosses = [each.package.toss(described) for each in engines]
        with written_whole(out) as aside, bar("video", "frames") as progress:
            write_video(tosses, Camera(camera), FULL, aside, progress)
        click.echo(out)


@main.command(epilog=_SCENARIO_HELP)
@click.argument("scenario")
@click.option(
    "--x",
    required=True,
    metavar="FIELD=START:STOP:N",
    help="The field that varies along x, and its N values.",
)
@click.option("--y", required=True, metavar="FIELD=START:STOP:N", help="The field that varies along y.")
@click.option(
    "--out", type=click.Path(path_type=Path), required=True, help="The Zarr store to write, MAP.zarr."
)
@click.option("--engine", type=click.Choice(["analytic", "mujoco"]), help="The engine; by default analytic.")
@click.option(
    "--compare",
    "both",
    is_flag=True,
    help="Make the map by both engines, MuJoCo's as MAP-mujoco.zarr, and compare the two.",
)
@_contact
@click.option(
    "--after",
    type=_Count(0, 999_999),
    help="Map the face at the touch after this number of impacts; 0: at the first touch.",
)
@click.option(
    "--margin",
    metavar="QUANTITY",
    help="Also map the smallest change of this quantity of the release that changes a pixel's outcome: "
    "height, velocity x (y, z), attitude about xi (eta, zeta) or spin about xi (eta, zeta).",
)
@click.option("--resume", is_flag=True, help="Continue an existing map.")
@click.option("--overwrite", is_flag=True, help="Replace an existing map.")
@click.option("--scheduler", metavar="ADDRESS", help="Address of a Dask scheduler on whose workers to toss.")
@click.option("--png", type=click.Path(path_type=Path), help="Also draw the map to this .png file.")
@click.option(
    "--palette",
    type=click.Choice(["safe", "paper"]),
    help="safe (the default): gold and blue, for the colour-blind too; paper: black and white.",
)
@click.option("--boundaries", is_flag=True, help="Colour the pixels at a boundary.")
@click.option("--size", type=_Size(), metavar="WIDTHxHEIGHT", help="Size of the picture in inches.")
@click.option("--dpi", type=_Count(10, 2400), help="Pixels per inch of the picture.")
@click.option(
    "--report",
    type=click.Path(path_type=Path),
    help="Folder of a report as by `cointoss compare`, with both maps; requires --compare.",
)
def basin(
    scenario: str,
    x: str,
    y: str,
    out: Path,
    engine: str | None,
    both: bool,
    contact: str | None,
    after: int | None,
    margin: str | None,
    resume: bool,
    overwrite: bool,
    scheduler: str | None,
    png: Path | None,
    palette: str | None,
    boundaries: bool,
    size: tuple[float, float] | None,
    dpi: int | None,
    report: Path | None,
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
    if margin is not None and (both or engine == "mujoco"):
        beside = "--compare" if both else f"--engine {engine}"
        raise click.UsageError(f"--margin {margin} {beside}: accepted: only by the analytic engine alone")
    if report is not None and not both:
        raise click.UsageError(f"--report {report}: accepted: only beside --compare")
    if png is None and report is None and (palette or boundaries or size or dpi):
        raise click.UsageError(
            "--palette, --boundaries, --size and --dpi: accepted: only beside --png or --report"
        )
    with _plain_errors(scenario):
        from compare.basins.picture_style import DPI, Palette, PictureStyle
        from compare.engines import Engine
        from compare.output.progress import bar
        from compare.sweep.job import Job, make
        from models.reading import scenario_text

        job = Job(
            source=scenario,
            text=scenario_text(scenario),
            x=x,
            y=y,
            out=out,
            engine=None if both else Engine(engine or "analytic"),
            contact=contact or "spring",
            after=after,
            margin=margin,
            resume=resume,
            overwrite=overwrite,
            scheduler=scheduler,
            png=png,
            style=PictureStyle(
                palette=Palette(palette or "safe"), boundaries=boundaries, size=size, dpi=dpi or DPI
            ),
            report=report,
        )
        with bar("video", "frames") as progress:
            for result in make(job, _watched, progress, _say):
                click.echo(result)


class _Quantity(click.ParamType):
    """A number in SI, or with its unit."""

    name = "quantity"

    def __init__(self, unit: str) -> None:
        self.unit = unit

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        from models.units import in_si

        try:
            return float(value)
        except ValueError:
            pass
        try:
            return in_si(value, self.unit)
        except ValueError as error:
            self.fail(f"{value}; accepted: {error}", param, ctx)


@main.command(epilog=_SCENARIO_HELP)
@click.argument("scenario")
@click.option("--height", type=_Quantity("m"), default="1 m", show_default=True, help="Of the release.")
@click.option("--speed", type=_Quantity("m/s"), default="2 m/s", show_default=True, help="Upwards.")
@click.option(
    "--spin",
    type=_Quantity("rad/s"),
    default="120 rad/s",
    show_default=True,
    help="Rate at which the coin's normal goes round the angular momentum.",
)
@click.option(
    "--psi",
    type=_Quantity("rad"),
    default="90 deg",
    show_default=True,
    help="Angle between normal and angular momentum; less than 90 deg: the coin wobbles.",
)
@click.option("--psi-scatter", type=_Quantity("rad"), default="0 deg", show_default=True, help="Its scatter.")
@click.option(
    "--scatter",
    type=_Quantity(""),
    default="10 %",
    show_default=True,
    help="Standard deviation of height, speed and spin.",
)
@click.option("--tosses", type=_Count(1, 10_000_000), default=1000, show_default=True, help="How many.")
@click.option("--seed", type=_Count(0, 2**32), default=0, show_default=True, help="Of the releases.")
@click.option(
    "--engine",
    type=click.Choice(["analytic", "mujoco"]),
    default="analytic",
    show_default=True,
    help="The engine.",
)
@click.option("--json", "as_json", is_flag=True, help="Print JSON, in full precision.")
def hands(
    scenario: str,
    tosses: int,
    seed: int,
    engine: str,
    as_json: bool,
    **hand: float,
) -> None:
    """Toss a scenario's coin many times as a hand does, and count the side that was up at first.

    The coin is released flat; the scenario's own release is not used. Intervals are of 99 %.
    """
    with _plain_errors(scenario):
        import numpy as np

        from compare.engines import Engine
        from compare.film.back_end import require_mujoco
        from compare.metrics.first_side import TOUCHES, first_side
        from compare.output.progress import elapsed_time
        from compare.reproduction.estimates import share
        from models.hand import Hand
        from models.reading import load
        from models.releases import check_releases

        described = load(scenario)
        if engine == Engine.MUJOCO:
            require_mujoco()
        try:
            start = Hand(**hand).releases(described.body, np.random.default_rng(seed), tosses)
            check_releases(described, start)
        except ValueError as error:
            _refuse(f"{scenario}: {error}")
        with elapsed_time("still tossing; fewer --tosses are sooner"):
            found = first_side(described, start, Engine(engine))
        shares = {f"touch {n + 1}": share(up) for n, up in zip(TOUCHES, found.touches, strict=True)}
        if len(found.at_rest):
            shares["at rest"] = share(found.at_rest)
        if as_json:
            told = {"hand": hand, "tosses": tosses, "seed": seed, "engine": engine}
            click.echo(json.dumps({**told, "same_side": {k: asdict(v) for k, v in shares.items()}}, indent=1))
            return
        for name, one in shares.items():
            click.echo(f"{name:9} {one.value:7.2%} [{one.low:.2%}, {one.high:.2%}] of {one.count:,d} tosses")


@main.command()
@click.argument("names", nargs=-1, metavar="[NAME ...]")
@click.option(
    "--out",
    type=click.Path(path_type=Path),
    help="Folder of the results, each in its reproduction/NAME/; made if missing.",
)
@click.option("--quick", is_flag=True, help="Compute the smaller version of each that has one.")
@click.pass_context
def reproduce(ctx: click.Context, names: tuple[str, ...], out: Path | None, quick: bool) -> None:
    """Compute the paper's figures and the studies anew.

    Each NAME writes its data and pictures and checks its claims; `all` computes all figures of the paper and
    writes REPRODUCTION.md and gallery.html. Without NAME, list the names. Exit status 1: a claim comes out
    otherwise than known.
    """
    from compare.film.back_end import drawing_problem, require_mujoco
    from compare.output.files import require_folder
    from compare.output.progress import bar
    from compare.reproduction import gallery, runner
    from compare.reproduction.claim import unexpected

    with _plain_errors("reproduce"):
        # Figures may hold stills: the back end is chosen before MuJoCo is imported.
        if names and not os.environ.get("MUJOCO_GL"):
            drawing_problem()
        require_mujoco()
    known = runner.names()
    pages = names == ("all",)
    if pages:
        names = tuple(gallery.of_paper())
    for name in names:
        if name not in known:
            ctx.fail(f"{name}: no such name; accepted: {', '.join(known)}")
    if not names and out is None:
        width = max(map(len, known)) + 2
        for name in known:
            found = runner.find(name)
            place = f"{found.paper}: " if found.paper else ""
            click.echo(f"{name:{width}}{place}{found.title} ({found.seconds:g} s)")
        return
    if not names or out is None:
        ctx.fail(
            f"accepted: NAME ... --out DIR, NAME one of: {', '.join(known)}, or all; or neither, for a list"
        )
    with _plain_errors(str(out)):
        require_folder(out, gallery.PAGES if pages else ())
        for name in names:
            runner.require_writable(name, out)
        failed = []
        for name in names:
            with bar(name, "parts") as progress:
                result = runner.reproduce(name, out, progress, quick=quick)
            click.echo(result.text)
            failed += [f"{name}: {claim}" for claim in unexpected(result.claims, quick=quick)]
        if pages:
            gallery.write(out, names, quick=quick)
    for claim in failed:
        click.echo(f"cointoss: {claim}: another verdict than the known one", err=True)
    sys.exit(1 if failed else 0)


@contextmanager
def _watched(name: str, done: int, count: int) -> Iterator[Callable[[int], None]]:
    """Yield a function to report tosses to; show their number, rate and time left on the terminal."""
    from compare.output.progress import bar

    kept = done

    def more(tosses: int) -> None:
        nonlocal kept
        kept += tosses
        progress(kept, count)

    try:
        with bar(name, "tosses", done=done) as progress:
            progress(kept, count)
            yield more
    except Interruption as interruption:
        interruption.message = f"{name}: {kept} of {count} tosses are saved; --resume continues"
        raise
