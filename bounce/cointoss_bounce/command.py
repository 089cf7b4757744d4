"""The commands `bounce` and `solref`: of `mj-bounce`, and of `cointoss` where that is installed."""

import json
import os
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict
from difflib import get_close_matches
from importlib.metadata import version
from importlib.util import find_spec
from io import BytesIO
from pathlib import Path
from typing import Any

import click
from click.core import ParameterSource

from cointoss_bounce.backends import OWN, Backend
from cointoss_bounce.errors import DeepContactWarning, FieldError
from cointoss_bounce.quantities import Given, numbers, quantity

BESIDE = {
    **dict.fromkeys(("--spring", "--backend", "--model"), ("--restitution",)),
    "--steps": ("--spring", "--backend genesis"),
    **dict.fromkeys(("--with", "--integrator", "--solimp"), ("--of",)),
}
"""Options of solref that are accepted only beside one of others."""
_OWN = tuple(f"--backend {name}" for name in OWN)
WITHOUT = {
    "--model": ("--json", "--backend newton", "--backend genesis", *_OWN),
    **dict.fromkeys(("--spring", "--body"), _OWN),
    "--mass": tuple(each for each in _OWN if each != "--backend drake"),
}
"""Options of solref that are accepted only without others."""

MISSING = {
    "model": "MODEL.xml: missing; accepted: an XML file of MuJoCo",
    **dict.fromkeys(("one", "two"), "GEOM: missing; accepted: the name or the number of a geom, twice"),
    "timestep": "--dt: missing; accepted: --dt DT, the model's timestep, such as 0.002 or 2ms",
}
"""What is said where a parameter is missing, by its name."""


class Refusal(click.ClickException):
    """Bad input, in one line."""

    exit_code = 2


class Word(click.Choice):
    """One of some words; a message on another one begins with the word that is most like it."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the word, or refuse the value with what is accepted."""
        if value not in self.choices:
            near = get_close_matches(value, self.choices, n=1)
            meant = f"did you mean {near[0]}? " if near else ""
            self.fail(f"{value}; {meant}accepted: {', '.join(self.choices)}", param, ctx)
        return super().convert(value, param, ctx)


class _Commands(click.Group):
    """The commands, each of whose failures is one line."""

    def main(self, *args: Any, **extra: Any) -> Any:
        try:
            status = super().main(*args, **{**extra, "standalone_mode": False})
        except click.UsageError as error:
            path = error.ctx.command_path if error.ctx else self.name
            lacking = error.param if isinstance(error, click.MissingParameter) else None
            said = MISSING[str(lacking.name)] if lacking else error.format_message().rstrip(".")
            status = _refused(f"{said} (see {path} --help)", 2)
        except click.ClickException as error:
            status = _refused(error.format_message(), error.exit_code)
        except click.Abort:  # KeyboardInterrupt
            status = _refused("interrupted", 130)
        except OSError as error:
            status = _refused(
                f"{error.filename or 'standard output'}: can't be written ({error.strerror})", 1
            )
        sys.exit(status)


def _refused(message: str, status: int) -> int:
    """Print a line to standard error, and return the exit status."""
    shown = "".join(char if char.isprintable() else repr(char)[1:-1] for char in message)
    click.echo(f"mj-bounce: {shown}", err=True)
    return status


@click.group(
    "mj-bounce",
    cls=_Commands,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    invoke_without_command=True,
)
@click.version_option(package_name="cointoss-bounce", prog_name="mj-bounce")
@click.pass_context
def main(ctx: click.Context) -> None:
    """Find settings with which contacts of MuJoCo bounce, and measure how those of a model do."""
    if ctx.invoked_subcommand is None:
        click.echo(ctx.get_help())


@main.command()
@click.argument("model", metavar="MODEL.xml", type=click.Path(path_type=Path))
@click.argument("one", metavar="GEOM")
@click.argument("two", metavar="GEOM")
@click.option("--png", type=click.Path(path_type=Path), help="Draw the restitution over the speed.")
@click.option(
    "--against",
    metavar="PYTHON",
    help="Print the same by the MuJoCo of another Python beside it, line by line.",
)
@click.option("--json", "as_json", is_flag=True, help="Print JSON, in full precision.")
def bounce(model: Path, one: str, two: str, png: Path | None, against: str | None, as_json: bool) -> None:
    """Print how two geoms of your own MuJoCo model bounce off each other.

    GEOM is the name or the number of a geom. They come together at six speeds and eight phases of a step,
    stepped by plain mj_step with the options of the model, without gravity and with it: straight, where the
    joints let one move along the normal while no body turns. Then one comes to rest on the other. Other geoms
    touch nothing meanwhile. The model is read by MuJoCo's own loader and is not changed.
    """
    if not model.is_file():
        raise Refusal(f"{model}: no such file; accepted: an XML file of MuJoCo")
    if png is not None:
        _require_picture(png, model)

    def named(error: FieldError) -> str:
        return f"{model}:" + ("" if error.field == "model" else f" {error.field} {error.value}:")

    with _measuring(named):
        from cointoss_bounce import elsewhere
        from cointoss_bounce.pair import bounce as bounce_of

        found = bounce_of(model, one, two)
        here = elsewhere.told(found)
        there = elsewhere.measured_by(against, str(model), one, two) if against else None
    if png is not None:
        from cointoss_bounce.picture import draw_bounce

        drawn = BytesIO()
        draw_bounce(found).savefig(drawn, format="png", dpi=150)
        png.write_bytes(drawn.getvalue())
    if as_json:
        _print_json(here["found"] | ({"against": there} if there else {}))
    else:
        click.echo(elsewhere.beside(here, there) if there else "\n".join(here["lines"]))
        click.echo(f"\npicture     {png}") if png else None


def _require_picture(png: Path, model: Path) -> None:
    """Refuse the place of a picture that can't be written or is the model's, or where nothing draws it."""
    there = png.exists()
    faults = {
        "another kind of file; accepted: a name that ends in .png": png.suffix.lower() != ".png",
        f"no folder {png.parent}; accepted: a name in a folder that exists": not png.parent.is_dir(),
        "is no file; accepted: a new name or a regular file": there and not png.is_file(),
        "is what is read; accepted: another file": there and png.samefile(model),
        "can't be written; accepted: another name": not os.access(png if there else png.parent, os.W_OK),
        "needs matplotlib; accepted: pip install matplotlib": find_spec("matplotlib") is None,
    }
    for fault in (text for text, is_so in faults.items() if is_so):
        raise Refusal(f"{png}: {fault}")


@main.command()
@click.option(
    "--restitution",
    type=quantity(""),
    metavar="E",
    help="Restitution from 0 to 1: print settings for it.",
)
@click.option(
    "--of",
    "solref",
    type=numbers,
    metavar="SOLREF",
    help='Print the restitution of these settings, such as "0.01 0.37".',
)
@click.option(
    "--dt",
    "timestep",
    type=quantity("s"),
    metavar="DT",
    required=True,
    help="The model's timestep, such as 0.002 or 2ms.",
)
@click.option(
    "--spring", is_flag=True, help="Use a spring that lasts several steps, instead of a bounce in one step."
)
@click.option(
    "--steps", type=click.IntRange(5, 500), help="Steps that the contact of the spring lasts; by default 40."
)
@click.option(
    "--body",
    metavar="BODY",
    help='Body to measure, as in a <geom>, such as "box 0.1 0.1 0.002" (half sizes).',
)
@click.option(
    "--backend",
    type=Word([*map(str, Backend), *OWN]),
    help="Simulator that takes the settings; by default MuJoCo itself. They are printed in its own form.",
)
@click.option(
    "--gravity",
    type=quantity("m/s^2"),
    metavar="G",
    default="9.81",
    show_default=True,
    help='Gravity, for what is measured with weight and at rest, such as "1.62 m/s^2".',
)
@click.option(
    "--mass",
    type=quantity("kg"),
    metavar="M",
    default="10 g",
    show_default=True,
    help='Mass of the body that is measured, such as "5 g".',
)
@click.option("--model", "whole", is_flag=True, help="Print a whole model instead: the body over a plane.")
@click.option(
    "--with",
    "other",
    type=numbers,
    metavar="SOLREF",
    help="solref of the other geom, mixed with that of --of; by default that of --of has priority.",
)
@click.option(
    "--integrator",
    type=Word(["Euler", "RK4", "implicit", "implicitfast", "discrete"]),
    help="With --of: the integrator; by default MuJoCo's, Euler.",
)
@click.option(
    "--solimp",
    metavar="SOLIMP",
    help='With --of: solimp of the same geom; by default "0.9 0.95 0.001".',
)
@click.option("--json", "as_json", is_flag=True, help="Print JSON, in full precision.")
@click.pass_context
def solref(ctx: click.Context, whole: bool, as_json: bool, **options: Any) -> None:
    """Print settings of MuJoCo or another simulator for a restitution, or the restitution of given settings.

    The command measures everything as it runs, on a body that touches a plane at 16 phases of a step.
    """
    typed = _typed(ctx)
    _require_consistent(typed)
    given = {name: value for name, value in options.items() if value not in (None, False)}
    asked = {name: value.value if isinstance(value, Given) else value for name, value in given.items()}
    option_of = {param.name: param.opts[0] for param in ctx.command.params}
    with _measuring(lambda error: f"{typed[option_of[error.field]]}:"):
        from cointoss_bounce import inverse, own_law, recipe
        from cointoss_bounce.solref_lines import solref_lines

        if "solref" in asked:
            found = inverse.solref_of(**asked)
        elif asked.get("backend") in OWN:
            found = own_law.engine_bounce(**asked)
        else:
            found = recipe.solref(**asked)
    if as_json:
        text = {} if isinstance(found, inverse.Rebounds) else {"settings": found.settings}
        _print_json(asdict(found) | text)
    else:
        click.echo(found.model if whole and isinstance(found, recipe.Bounce) else solref_lines(found))


def _typed(ctx: click.Context) -> dict[str, str]:
    """Return the options that were typed, each with its value."""
    default = ParameterSource.DEFAULT, ParameterSource.DEFAULT_MAP
    params = [each for each in ctx.command.params if ctx.get_parameter_source(str(each.name)) not in default]
    values = {param.opts[0]: ctx.params[str(param.name)] for param in params}
    return {
        option: option if value is True else f"{option} {value.text if isinstance(value, Given) else value}"
        for option, value in values.items()
    }


def _require_consistent(typed: dict[str, str]) -> None:
    """Refuse options of solref that don't go together."""
    there = {*typed, *typed.values()}
    if len(there & {"--restitution", "--of"}) != 1:
        raise click.UsageError("--restitution and --of: accepted: one of them")
    for option, text in typed.items():
        others = BESIDE.get(option, ())
        if others and not there & {*others}:
            raise click.UsageError(f"{text}: accepted: only beside {' or '.join(others)}")
        for other in (each for each in WITHOUT.get(option, ()) if each in there):
            raise click.UsageError(f"{text}: accepted: only without {other}")


@contextmanager
def _measuring(named: Callable[[FieldError], str]) -> Iterator[None]:
    """Import MuJoCo; make one line of what is refused then, and of each warning.

    Args:
        named: what is wrong, as the user gave it.
    """
    try:
        import mujoco  # noqa: F401
    except Exception as error:  # its back ends for drawing fail in ways of their own
        raise Refusal(
            f"MUJOCO_GL = {os.environ.get('MUJOCO_GL', '')}: MuJoCo can't be used ({error}); accepted as "
            "MUJOCO_GL: egl, glfw, osmesa where it is installed, disable, or nothing"
        ) from None
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always", DeepContactWarning)
        try:
            yield
        except FieldError as error:
            raise Refusal(f"{named(error)} accepted: {error.accepted}") from None
    ctx = click.get_current_context()
    for each in warned:
        click.echo(f"{ctx.find_root().info_name}: {ctx.info_name}: {each.message}", err=True)


def _print_json(found: dict[str, Any]) -> None:
    """Print an answer as JSON in full precision, with the versions of what made it."""
    versions = {name: version(name) for name in ("cointoss-bounce", "mujoco-core", "numpy")}
    text = json.dumps({**found, "versions": versions}, default=lambda array: array.tolist())
    # Null stands for what is infinite or NaN, which JSON has not.
    click.echo(json.dumps(json.loads(text, parse_constant=lambda _: None), indent=1))
