"""The command line: `cointoss`."""

import json
import os
import signal
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NoReturn

import click

# Only click is imported here: `cointoss --help` answers at once, each command brings what it needs.

_SCENARIO_HELP = (
    "SCENARIO is a TOML file, or the name of a scenario that comes with the package, such as fig24a; "
    "a name that does not exist is answered with all that do."
)


class _Commands(click.Group):
    """Commands whose every failure is one line."""

    def main(self, *args: Any, **extra: Any) -> NoReturn:
        # As an exception, the request to end removes what was written aside.
        signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))
        try:
            status = super().main(*args, **{"prog_name": "cointoss", **extra, "standalone_mode": False})
            if sys.stdout is not None:  # None where the shell has closed it
                sys.stdout.flush()
        except click.UsageError as error:
            command = error.ctx.command_path if error.ctx else "cointoss"
            _refuse(f"{error.format_message().rstrip('.')} (see {command} --help)")
        except click.Abort:
            click.echo("Aborted!", err=True)
            sys.exit(1)
        except OSError as error:
            _lose_stdout()
            _refuse(f"{error.filename or 'standard output'}: can't be written ({error.strerror})", status=1)
        sys.exit(status)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command:
        known = super().get_command(ctx, cmd_name)
        return known or ctx.fail(f"{cmd_name}: no such command; accepted: {', '.join(self.commands)}")


class _Count(click.IntRange):
    """A whole number from 1 on; the message says so where it is no number too."""

    name = "count"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        try:
            return super().convert(value, param, ctx)
        except click.BadParameter:
            self.fail(f"{value}; accepted: an integer >= {self.min} and <= {self.max}", param, ctx)


@click.group(
    cls=_Commands,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    no_args_is_help=False,
)
@click.version_option(package_name="cointoss", prog_name="cointoss")
def main() -> None:
    """Toss a coin by the mechanics of Strzalko et al. (2008) and by MuJoCo, and compare."""


@contextmanager
def _plain_errors(source: str) -> Iterator[None]:
    """Turn the errors of bad input into one line and exit status 2, and warnings into one line each."""
    from compare.files import UnwritableError
    from models.reading import ScenarioError
    from models.records import ApproximationWarning, UnsupportedError

    def tell(message: Warning | str, category: type[Warning], *where: Any, **extra: Any) -> None:
        if issubclass(category, ApproximationWarning):
            _say(f"{source}: {message}")
        else:
            show(message, category, *where, **extra)

    with warnings.catch_warnings():
        warnings.simplefilter("always", ApproximationWarning)
        show, warnings.showwarning = warnings.showwarning, tell
        try:
            yield
        except (ScenarioError, UnwritableError) as error:
            _refuse(str(error))
        except (UnsupportedError, FloatingPointError) as error:
            _refuse(f"{source}: {error}")


def _refuse(message: str, status: int = 2) -> NoReturn:
    _say(message)
    sys.exit(status)


def _say(message: str) -> None:
    shown = "".join(char if char.isprintable() else repr(char)[1:-1] for char in message)
    click.echo(f"cointoss: {shown}", err=True)


def _lose_stdout() -> None:
    """Send what standard output could not take nowhere, or Python would complain of it again at its end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)


@main.command(epilog=_SCENARIO_HELP)
@click.argument("scenario")
@click.option(
    "--engine",
    type=click.Choice(["analytic", "mujoco"]),
    default="analytic",
    show_default=True,
    help="Which engine.",
)
@click.option(
    "--contact",
    type=click.Choice(["spring", "one_step"]),
    help="How MuJoCo realises the restitution; a spring by default.",
)
@click.option("--max-impacts", type=_Count(1, 1_000_000), help="Stop after so many impacts.")
@click.option("--json", "as_json", is_flag=True, help="Answer in JSON, in full precision.")
@click.option("--trajectory", type=click.Path(path_type=Path), help="Write the path to this .csv file too.")
def toss(
    scenario: str,
    engine: str,
    contact: str | None,
    max_impacts: int | None,
    as_json: bool,
    trajectory: Path | None,
) -> None:
    """Toss one coin and print its impacts."""
    if contact is not None and engine != "mujoco":
        raise click.UsageError(f"--contact {contact}: accepted: only beside --engine mujoco")
    with _plain_errors(scenario):
        from compare import answer
        from compare.engines import Engine
        from compare.engines import toss as toss_by
        from compare.files import is_stream, require_file, write_text
        from models.reading import load

        described = load(scenario)
        if trajectory is not None and not is_stream(trajectory):
            require_file(trajectory, ".csv", scenario)
        if max_impacts is not None:
            ending = described.ending.model_copy(update={"max_impacts": max_impacts})
            described = described.model_copy(update={"ending": ending})
        result = toss_by(Engine(engine), described, contact or "spring")
        if trajectory is not None:
            times = answer.path_times(result)
            write_text(trajectory, answer.path_csv(result.sample(times)))
        click.echo(
            json.dumps(answer.as_json(result), indent=1, allow_nan=False)
            if as_json
            else answer.as_lines(result)
        )


@main.command(epilog=_SCENARIO_HELP)
@click.argument("scenario")
@click.option(
    "--out", type=click.Path(path_type=Path), required=True, help="Folder for the report; made if missing."
)
def compare(scenario: str, out: Path) -> None:
    """Toss one coin by both engines and write a side-by-side report with video."""
    with _plain_errors(scenario):
        from compare.report.contents import require_folder
        from models.reading import parse, scenario_text

        text = scenario_text(scenario)
        described = parse(text, scenario)
        require_folder(out, scenario)

        from compare.graphics import drawing_problem

        problem = drawing_problem()

        from compare.report.folder import write_report

        page = write_report(described, text, Path(scenario).stem, out, problem, _progress("video", "frames"))
        click.echo(page)


@main.command(epilog=_SCENARIO_HELP)
@click.argument("scenario")
@click.option("--out", type=click.Path(path_type=Path), required=True, help="The mp4 file to write.")
def video(scenario: str, out: Path) -> None:
    """Film one toss in MuJoCo, in slow motion around the impacts."""
    with _plain_errors(scenario):
        from compare.files import require_file, written_whole
        from models.reading import load

        described = load(scenario)
        require_file(out, ".mp4", scenario)

        from compare.graphics import drawing_problem

        problem = drawing_problem()
        if problem is not None:
            _refuse(problem)

        import coin_mj
        from coin_mj.video import write_video

        result = coin_mj.toss(described)
        with written_whole(out) as aside:
            write_video(result, aside, _progress("video", "frames"))
        click.echo(out)


@main.command()
@click.argument("names", nargs=-1, metavar="[NAME ...]")
@click.option(
    "--out",
    type=click.Path(path_type=Path),
    help="Folder for the results; made if missing. NAME lies in NAME/.",
)
@click.pass_context
def reproduce(ctx: click.Context, names: tuple[str, ...], out: Path | None) -> None:
    """Compute figures and studies anew, write their data and pictures, and check what they claim.

    Without NAME, list what can be reproduced. Exit status 1: a claim does not hold.
    """
    from compare import reproduction
    from compare.graphics import drawing_problem

    known = reproduction.names()
    for name in names:
        if name not in known:
            ctx.fail(f"{name}: no such figure; accepted: {', '.join(known)}")
    if "MUJOCO_GL" in os.environ:
        # MuJoCo can't even be imported for a back end that is missing; this turns it off.
        drawing_problem()
    if not names and out is None:
        width = max(map(len, known)) + 2
        for name in known:
            figure = reproduction.find(name)
            click.echo(f"{name:{width}}{figure.title} ({figure.seconds:g} s)")
        return
    if not names or out is None:
        ctx.fail(f"accepted: NAME ... --out DIR, NAME one of: {', '.join(known)}; or neither, for a list")
    with _plain_errors(str(out)):
        for name in names:
            reproduction.folder_of(name, out)
        failed = []
        for name in names:
            made = reproduction.reproduce(name, out, _progress(name, "parts"))
            click.echo(made.text)
            failed += [f"{name}: {claim}" for claim in made.failed]
    for claim in failed:
        click.echo(f"cointoss: {claim}: not so", err=True)
    sys.exit(1 if failed else 0)


def _progress(what: str, parts: str) -> Callable[[int, int], None]:
    """Give a function that shows on the terminal how far a job is, in its `parts`."""

    def show(done: int, count: int) -> None:
        if sys.stderr.isatty():
            click.echo(f"\r{what}: {done}/{count} {parts}", err=True, nl=done == count)

    return show
