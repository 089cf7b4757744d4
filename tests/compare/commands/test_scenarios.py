"""The files of the scenarios that come with the package."""

import pytest

from cointoss.models.sources import named_text
from tests.helpers.command_line import cointoss, refused


@pytest.mark.parametrize("name", ["table", "fig24b"])
def test_a_file_is_printed_and_copied_to_begin_with(name, tmp_path):
    mine = tmp_path / "mine.toml"
    copied = cointoss("scenarios", name, "--copy", mine)
    assert (copied.exit_code, copied.stdout, copied.stderr) == (0, f"{mine}\n", "")
    assert [path.name for path in tmp_path.iterdir()] == ["mine.toml"]
    assert mine.read_text(encoding="utf-8") == cointoss("scenarios", name).stdout == named_text(name)


def test_what_is_there_is_not_overwritten(tmp_path):
    mine = tmp_path / "mine.toml"
    mine.symlink_to(tmp_path / "nothing")
    said = f"cointoss: {mine}: exists; accepted: a new name\n"
    assert refused("scenarios", "table", "--copy", mine) == said
    mine.unlink()
    mine.write_text("mine")
    assert refused("scenarios", "table", "--copy", mine) == said
    assert mine.read_text() == "mine"
