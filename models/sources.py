"""The text of a scenario: that of a file, or of one that comes with the package."""

from os import PathLike
from pathlib import Path

from cointoss.models.bounded import TooLargeError, read_bounded
from cointoss.models.errors import ScenarioError, meant

MOST_BYTES = 1 << 16
"""The largest size of a scenario's file [bytes]."""
ACCEPTED = "a TOML file, or a name that cointoss scenarios lists, such as fig24a"
_HOME = Path(__file__).with_name("scenarios")


def named_scenarios() -> list[str]:
    """Return the names of the scenarios that come with the package."""
    return sorted(entry.stem for entry in _HOME.iterdir() if entry.suffix == ".toml")


def title_of(name: str) -> str:
    """Return what a scenario of the package is, from its first line.

    Args:
        name: one of `named_scenarios`.
    """
    first, _, _ = named_text(name).partition("\n")
    return first.removeprefix("# ").removesuffix(".").replace(" of Strzalko et al. 2008", "").rstrip(",")


def named_text(name: str) -> str:
    """Return the text of the file of one of `named_scenarios`."""
    return (_HOME / f"{name}.toml").read_text(encoding="utf-8")


def scenario_text(source: str | PathLike[str]) -> str:
    """Return the text of a scenario file, or of a scenario of the package by its name.

    Raises:
        ScenarioError: if there is no such file, it can't be read as text, or `source` is of another type.
    """
    if not isinstance(source, str | PathLike):
        way_out = "; Scenario(**tables) makes one of a dict" if isinstance(source, dict) else ""
        raise ScenarioError(
            f"scenario: of type {type(source).__name__}, accepted: a Scenario, the path of its file, or a "
            f"name such as fig24a{way_out}"
        )
    names = named_scenarios()
    path, source = Path(source), str(source)
    try:
        if not source:
            raise FileNotFoundError
        if source in names and (not path.exists() or path.is_dir()):
            return named_text(source)
        return plain_text(path, source)
    except OSError as error:
        wrong = (
            "no such file" if isinstance(error, FileNotFoundError) else f"can't be read ({error.strerror})"
        )
        hint = meant(source.removesuffix(".toml"), names)
        raise ScenarioError(f"{source or '(no name)'}: {wrong}; {hint}accepted: {ACCEPTED}") from None


def plain_text(path: Path, source: str) -> str:
    """Return the text of a small file in UTF-8, each line ended by a newline.

    Raises:
        ScenarioError: if it is too large or no text.
        OSError: if it can't be read.
    """
    try:
        text = read_bounded(path, MOST_BYTES).decode("utf-8-sig")
    except TooLargeError as error:
        raise ScenarioError(f"{source}: {error}; accepted: at most {MOST_BYTES} bytes of text") from None
    except UnicodeDecodeError as error:
        raise ScenarioError(
            f"{source}: {error.reason} at byte {error.start}; accepted: a text file in UTF-8"
        ) from None
    return text.replace("\r\n", "\n").replace("\r", "\n")
