"""The ceilings of statements: what is counted, and what is said of a folder above its own."""

from tests.helpers import ceilings

SOURCE = '''"""A module."""

import math


def half(number: float) -> float:
    """Return the half."""
    if number > 0:
        return number / 2
    x = 3; y = 4
    return math.nan
'''


def test_statements_are_counted_and_not_lines_imports_or_docstrings():
    assert ceilings.statements(SOURCE) == 6
    assert ceilings.statements(SOURCE.replace("; ", "\n    ")) == 6


def test_a_folder_above_its_ceiling_is_named_with_both_numbers(tmp_path):
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / "half.py").write_text(SOURCE)
    counts = {"folder": ceilings.counted("folder", tmp_path)}
    (line,) = ceilings.exceeded({"folder": 5}, counts)
    assert line.startswith("folder: 6 statements, accepted: 5, its ceiling in ceilings.toml; ")
    assert ceilings.exceeded({"folder": 6}, counts) == []


def test_a_ceiling_sinks_to_what_is_there_and_never_rises():
    assert ceilings.sunk({"one": 7, "two": 5}, {"one": 6, "two": 6}).endswith('"one" = 6\n"two" = 5\n')
