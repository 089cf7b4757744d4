"""A study run, and what it says of a record of numbers."""

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from cointoss.compare.reproduction import runner
from cointoss.compare.reproduction.claim import unexpected
from cointoss.compare.reproduction.result import Result
from cointoss.compare.reproduction.saving import save


def unseen(done: int, whole: int) -> None:
    """Hear of a study's progress, and tell nobody."""
    assert done <= whole


def result_of(study: str, record: Any) -> Result:
    """Return the tables and claims of a study that found this record; it is saved and read again."""
    with TemporaryDirectory() as folder:
        save(Path(folder), Result(claims=(), data=record), {})
        read = runner.find(study).read
        assert read is not None
        return read(Path(folder))


def missed(study: str, record: Any) -> tuple[str, ...]:
    """Return the claims of a study that found this record whose verdict is not the known one."""
    return unexpected(result_of(study, record).claims)
