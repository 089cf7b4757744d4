"""A table as somebody wrote it, and as it is read."""

import pytest

from cointoss.compare.fitting.table import read_seen


@pytest.fixture
def read(tmp_path, request):
    """Read the text of a table, by default with the standard deviations that the module of the test has."""

    own = getattr(request.module, "SD", None)

    def read_text(text: str, sd=own):
        path = tmp_path / "seen.csv"
        path.write_text(text, encoding="utf-8")
        return read_seen(path, sd)

    return read_text
