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
ABOVE = "remove as many, or raise it where others of its sum sink by as much"


def test_statements_are_counted_and_not_lines_imports_or_docstrings(tmp_path):
    for name, text in {
        "half.py": SOURCE,
        "page.js": "let one\nlet two\n",
        "library.min.js": "let three\n",
    }.items():
        (tmp_path / name).write_text(text)
    assert ceilings.counted(".", tmp_path) == ceilings.statements(SOURCE.replace("; ", "\n    ")) == 6
    assert ceilings.lines(".", tmp_path) == 2


def test_what_is_above_its_ceiling_or_sum_is_named_with_both_numbers():
    counts = {"houses": {"folder": 6}}
    assert ceilings.exceeded({"sums": {"houses": 4}, "houses": {"folder": 5}}, counts) == [
        f"folder: 6, accepted: 5, its ceiling in ceilings.toml; {ABOVE}",
        "houses: ceilings of 5 in all, accepted: 4, their sum in ceilings.toml",
    ]
    assert ceilings.exceeded({"sums": {"houses": 6}, "houses": {"folder": 6}}, counts) == []


def test_a_ceiling_and_a_sum_sink_to_what_is_there_and_never_rise():
    now = {"sums": {"houses": 13}, "houses": {"one": 7, "two/three": 5}}
    found = ceilings.sunk(now, {"houses": {"one": 6, "two/three": 6}})
    assert found.endswith('[sums]\nhouses = 11\n\n[houses]\n"one" = 6\n"two/three" = 5\n')
    before = "diff --git a b\n+houses = 5\n"
    history = f"diff --git a b\n+# Granted: some\n-houses = 5\n+houses = 12\n{before}"
    assert ceilings.risen({"houses": 12}, history) == []
    history = f"diff --git a b\n-houses = 12\n+houses = 11\n{history}"
    assert ceilings.risen({"houses": 11}, history) == []
    assert ceilings.risen({"houses": 12}, history) == [
        "houses: a sum of 12, accepted: 11, which it was; a sum never rises"
    ]
