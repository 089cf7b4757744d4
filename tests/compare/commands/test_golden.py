"""What commands print and write, all of it, against transcripts that a person reads."""

import pytest

from tests.helpers.golden import GOLDEN, assert_alike, replayed


@pytest.mark.slow_after_first
@pytest.mark.parametrize("name", [path.stem for path in sorted(GOLDEN.glob("*.txt"))])
def test_commands_print_and_write_what_their_transcript_has(name):
    golden = (GOLDEN / f"{name}.txt").read_text(encoding="utf-8")
    assert_alike(replayed(golden), golden)
