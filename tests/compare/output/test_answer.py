"""A toss in lines: sequence, horizon, impacts, contacts, and what it measured of itself."""

import re
from dataclasses import replace

import numpy as np
import pytest

from cointoss import analytic
from cointoss.compare.output.answer import CERTAIN, TRUSTED, as_lines, contact_line
from cointoss.models.reading import load
from tests.helpers.command_line import cointoss

ROW = re.compile(r"^ *(\d+) +\d+\.\d+ +[HT]", re.MULTILINE)


def test_all_impacts_and_contacts_are_printed_where_they_are_asked_for():
    toss = analytic.toss(load("zloty"))
    text = as_lines(toss, whole=True)
    assert ROW.findall(text) == [str(number) for number in range(1, len(toss.impacts) + 1)]
    assert " more" not in text
    assert "..." not in text
    spells = re.findall(r"^contact   from (\S+) s to (\S+) s$", text, re.MULTILINE)
    assert [[float(start), float(end)] for start, end in spells] == toss.contacts.round(6).tolist()
    assert cointoss("toss", "zloty", "--all").stdout == f"{text}\n"


def test_of_many_impacts_the_first_and_the_last_are_printed():
    text = as_lines(analytic.toss(load("zloty").replace("ending.max_impacts", 21)))
    assert ROW.findall(text) == [*"12345678", "20", "21"]
    assert "\n... 11 impacts between: --all prints them, --json all their numbers\n 20 " in text
    text = as_lines(analytic.toss(load("zloty").replace("ending.max_impacts", 20)))
    assert ROW.findall(text) == [str(number) for number in range(1, 21)]


@pytest.mark.parametrize(
    ("name", "is_certain", "bar"),
    [("table", True, " impacts)"), ("fig24a", False, "; the | is the horizon of trust)")],
)
def test_certain_and_trusted_are_explained_where_they_are_said(name, is_certain, bar):
    lines = as_lines(analytic.toss(load(name))).splitlines()
    assert (f"          ({CERTAIN})" in lines) == is_certain
    (trusted,) = (n for n, line in enumerate(lines) if line.startswith("trusted "))
    assert lines[trusted + 1] == f"          (rounding errors, {TRUSTED}{bar}"
    assert max(map(len, lines)) <= 110


def test_where_no_impact_is_trusted_none_is_explained():
    toss = replace(analytic.toss(load("fig24a")), trusted_impacts=0)
    assert TRUSTED not in as_lines(toss)


def test_contacts_are_summed_in_one_line():
    toss = analytic.toss(load("fig24a").replace("ending.max_impacts", 1))
    spells = np.array([(0.1, 0.15), (0.2, toss.end_time)])
    assert contact_line(toss) == ""
    assert contact_line(replace(toss, contacts=spells[:1])) == "from 0.100000 s to 0.150000 s"
    end = f"{toss.end_time - 0.15:.6f} s in all, the last from 0.200000 s to the end"
    assert contact_line(replace(toss, contacts=spells)) == f"2 times, {end}"
    assert f"\ncontact   2 times, {end}\n\n" in as_lines(replace(toss, contacts=spells))


def test_what_rounds_to_zero_has_no_sign():
    toss = analytic.toss(load("fig24a").replace("ending.max_impacts", 1))
    tiny = replace(toss.impacts, impulse=np.array([[-1e-12, 1e-12, 0.01]]))
    assert "   0.00000     0.00000    10.00000" in as_lines(replace(toss, impacts=tiny))
