"""A study run, what it says of a table, and what a page of docs/ shows of it."""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import pandas as pd
import pytest

from cointoss_reproduction import studies
from cointoss_reproduction.frame import runner
from cointoss_reproduction.frame.claim import unexpected
from cointoss_reproduction.frame.files import folder_of
from cointoss_reproduction.frame.result import Result
from cointoss_reproduction.frame.saving import save

DOCS = Path(__file__).parents[2] / "docs"


def unseen(done: int, whole: int) -> None:
    """Hear of a study's progress, and tell nobody."""
    assert done <= whole


def fake(monkeypatch: pytest.MonkeyPatch, folder: Path, name: str, code: str, said: str) -> None:
    """Put a study beside the real ones, until the test ends.

    Args:
        monkeypatch: of the test.
        folder: of such studies, made if missing.
        name: of the study.
        code: of its module.
        said: its TOML file.
    """
    place = folder / name
    place.mkdir(parents=True, exist_ok=True)
    for file, text in (("__init__.py", ""), ("study.py", code), ("study.toml", said)):
        (place / file).write_text(text)
    # A module that is written twice in a second would be taken from its bytecode.
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    monkeypatch.setattr(studies, "__path__", [*studies.__path__, str(folder)])
    for module in (f"{studies.__name__}.{name}", f"{studies.__name__}.{name}.study"):
        sys.modules.pop(module, None)


def result_of(study: str, cells: pd.DataFrame) -> Result:
    """Return the tables and claims of a study that found these cells; they are saved and read again."""
    with TemporaryDirectory() as folder:
        save(Path(folder), Result(claims=(), data=cells), {})
        read = runner.find(study).read
        assert read is not None
        return read(Path(folder))


def missed(study: str, cells: pd.DataFrame) -> tuple[str, ...]:
    """Return the claims of a study that found these cells whose verdict is not the known one."""
    return unexpected(result_of(study, cells).claims)


def saved(study: str) -> Path:
    """Return the folder of what a study saved beside its page."""
    return folder_of(study, DOCS)
