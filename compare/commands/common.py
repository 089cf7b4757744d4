"""What several commands share: options, kinds of values, and failures of one line."""

import stat
import sys
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

import click

from cointoss.compare.output.accepted import Written
from cointoss.compare.output.language import in_options
from cointoss.compare.output.plain import json_text
from cointoss.models.devices import DeviceError, DeviceWarning
from cointoss.models.errors import meant

SCENARIO_HELP = (
    "SCENARIO is a TOML file, or the name of a scenario that comes with the package, such as fig24a. "
    "cointoss scenarios lists the names, and copies a scenario's file for you to change."
)


ARGUMENTS = {
    "SCENARIO": "a TOML file, or a name that cointoss scenarios lists, such as fig24a",
    "MODEL.xml": "an XML file of MuJoCo",
    "ENGINE": "an engine, such as analytic or package.module:name",
    "GEOM": "the name or the number of a geom, twice",
    "MAP.zarr": "a map that cointoss basin made",
    "OBSERVED.csv": "a CSV file with the times of touches, or with frames of a film",
    "COUNTS.csv": "a CSV file with counts of flips",
}
"""What the arguments of commands take."""


class Place(click.Path):
    """The path of a file or a folder; an empty one, as of a variable that is not set, is refused."""

    def __init__(self) -> None:
        """Take any path."""
        super().__init__(path_type=Path)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the path, or refuse what is empty, or where the place is not as it must be."""
        if value == "":
            self.fail("an empty name; accepted: a path", param, ctx)
        path: Any = super().convert(value, param, ctx)
        if ctx is not None and not ctx.resilient_parsing:  # it is resilient while a shell completes a word
            self.check(path, ctx)
        return path

    def check(self, path: Path, ctx: click.Context) -> None:
        """Refuse a place that is not as it must be."""


class ReadPlace(Place):
    """The path of what a command reads; one where there is no such thing is refused at once.

    A parameter of this type is eager: its path is known where that of what is written is checked.
    """

    def __init__(self, accepted: str, kind: str = "file") -> None:
        """Keep what is accepted, and whether it is a file or a folder."""
        super().__init__()
        self._accepted, self._kind = accepted, kind

    def check(self, path: Path, ctx: click.Context) -> None:  # noqa: ARG002
        """Refuse a place where there is no such thing."""
        try:
            is_such = stat.S_ISDIR(path.stat().st_mode) == (self._kind == "folder")
        except (FileNotFoundError, NotADirectoryError):
            refuse(f"{path}: no such {self._kind}; accepted: {self._accepted}")
        except OSError as error:
            refuse(f"{path}: can't be read ({error.strerror})")
        if not is_such:
            refuse(f"{path}: is no {self._kind}; accepted: {self._accepted}")


class WrittenPlace(Place):
    """The path of what a command writes; a place that can't be written is refused at once."""

    def __init__(self, place: Written) -> None:
        """Keep what the place must be."""
        super().__init__()
        self._place = place

    def check(self, path: Path, ctx: click.Context) -> None:
        """Refuse a place that can't be written, or that is read."""
        from cointoss.compare.output import files

        read = [each for each in ctx.params.values() if isinstance(each, Path)]
        try:
            match self._place:
                case Written(kind="folder"):
                    files.require_folder(path, ())
                case Written(suffixes, "map"):
                    files.require_name(path, suffixes)
                case Written(suffixes, kind) if kind == "file" or not files.is_stream(path):
                    files.require_file(path, suffixes, ctx.params.get("scenario"), *read)
        except files.UnwritableError as error:
            refuse(str(error))


class CountType(click.IntRange):
    """A whole number within bounds, with one message for what is out of them and what is no number."""

    name = "count"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """Return the number, or refuse the value with what is accepted."""
        try:
            return super().convert(value, param, ctx)
        except click.BadParameter:
            self.fail(f"{value}; accepted: an integer >= {self.min} and <= {self.max}", param, ctx)


class ChoiceType(click.Choice):
    """One of some words; a message on another one begins with the word that is most like it."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the word, or refuse the value with what is accepted."""
        if value not in self.choices:
            self.fail(f"{value}; {meant(value, self.choices)}accepted: {', '.join(self.choices)}", param, ctx)
        return super().convert(value, param, ctx)


@dataclass(frozen=True)
class Given:
    """A number and how it was typed."""

    text: str
    value: float

    def __str__(self) -> str:
        """Return it as it was typed."""
        return self.text


class TextType(click.ParamType):
    """A text that a function reads, which raises ValueError with what is accepted."""

    def __init__(self, name: str, read: Callable[[str], Any]) -> None:
        """Keep the name of what is read, as help shows it, and what reads it."""
        self.name, self._read = name, read

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return what the text says, or refuse it with what is accepted."""
        if not isinstance(value, str):
            return value
        try:
            return self._read(value)
        except ValueError as error:
            self.fail(f"{value}; accepted: {error}", param, ctx)


def quantity(unit: str) -> TextType:
    """Return the type of a number in SI, or with its unit; `unit` is that of the values, as pint has it."""

    def read(text: str) -> Given:
        from cointoss.models.units import in_si

        try:
            return Given(text, float(text))
        except ValueError:
            return Given(text, in_si(text, unit))

    return TextType("quantity", read)


@contextmanager
def naming_options(options: Mapping[str, tuple[str, object]]) -> Iterator[None]:
    """Name the option, and what was typed for it, in what is wrong with a field.

    Args:
        options: for each field the option, and what was typed.
    """
    from cointoss.models.errors import FieldError

    try:
        yield
    except FieldError as error:
        option, typed = options[error.field]
        refuse(f"{option} {typed}: accepted: {error.accepted}")


@contextmanager
def plain_errors(source: str) -> Iterator[None]:
    """Turn the errors of bad input into one line and exit status 2, and warnings into one line each."""
    from cointoss.compare.film.back_end import BackEndError
    from cointoss.compare.fitting.errors import ObservationError
    from cointoss.compare.output.files import UnwritableError
    from cointoss.compare.sweep.errors import MapError, SweepError
    from cointoss.models.cores import CoresError, cores_used
    from cointoss.models.errors import ScenarioError
    from cointoss.models.kernel.base_folder import EngineMissingError
    from cointoss.models.records import ApproximationWarning, UnsupportedError, UnusableEngineError
    from cointoss.models.stages import progress_shown
    from cointoss.models.unlikely import UnitWarning
    from cointoss.models.unused import UnusedFieldWarning

    told, reported = (ApproximationWarning, DeviceWarning, UnitWarning, UnusedFieldWarning), set()

    def report(message: Warning | str, category: type[Warning], *where: Any, **extra: Any) -> None:
        if issubclass(category, told):
            if str(message) not in reported:
                say(f"{source}: {message}")
            reported.add(str(message))
        else:
            show(message, category, *where, **extra)

    with progress_shown(in_logs=True), warnings.catch_warnings():
        for kind in told:
            warnings.simplefilter("always", kind)
        show, warnings.showwarning = warnings.showwarning, report
        try:
            cores_used()
            yield
        except (
            CoresError,
            ScenarioError,
            ObservationError,
            MapError,
            UnwritableError,
            BackEndError,
            UnusableEngineError,
            EngineMissingError,
            DeviceError,
        ) as error:
            refuse(str(error))
        except (SweepError, UnsupportedError, FloatingPointError) as error:
            refuse(f"{source}: {error}")


def print_json(found: Mapping[str, Any], *engines: str) -> None:
    """Print an answer as JSON in full precision, with the versions of what made it.

    Args:
        found: the answer; null stands for what is infinite or NaN, which JSON has not.
        engines: by which it was made.
    """
    from cointoss.compare.engines import Engine

    versions = {name: text for engine in engines for name, text in Engine(engine).versions.items()}
    click.echo(json_text({**found, "versions": versions}))


def refuse(message: str, status: int = 2) -> NoReturn:
    """Say why in one line, and end with an exit status."""
    say(message)
    sys.exit(status)


def say(message: str) -> None:
    """Print a line to standard error: keywords as options, and what would split it escaped."""
    from cointoss.models.stages import clear_line

    clear_line()
    shown = "".join(char if char.isprintable() else repr(char)[1:-1] for char in in_options(message))
    click.echo(f"cointoss: {shown}", err=True)
