"""A toss in lines: numbers in their units, all of its impacts and contacts; transcripts have the words."""

import re
from dataclasses import replace

import numpy as np
import pytest

from cointoss import analytic
from cointoss.compare.output.answer import as_lines, contact_line, path_times
from cointoss.models import certificate
from cointoss.models.reading import load
from cointoss.models.records import Setting, UnsupportedError
from tests.helpers.command_line import cointoss
from tests.helpers.films import MadePath, made, struck

ROW = re.compile(r"^ *(\d+) +\d+\.\d+ +[HT]", re.MULTILINE)


def test_all_impacts_and_contacts_are_printed_where_they_are_asked_for():
    toss = analytic.toss(load("zloty"))
    text = as_lines(toss, whole=True)
    assert ROW.findall(text) == [str(number) for number in range(1, len(toss.impacts) + 1)]
    spells = re.findall(r"^contact   from (\S+) s to (\S+) s$", text, re.MULTILINE)
    assert [[float(start), float(end)] for start, end in spells] == toss.contacts.round(6).tolist()
    assert cointoss("toss", "zloty", "--all").stdout == f"{text}\n"


def test_the_line_of_an_impact_has_its_numbers_in_the_units_of_the_head():
    """What rounds to zero has no sign."""
    toss = struck()
    tiny = replace(toss.impacts, impulse=np.array([[-1e-12, 1e-12, 2.5e-3]]))
    assert as_lines(replace(toss, impacts=tiny)).splitlines()[-2:] == [
        "  n      t [s]  up  S_x [mN s]  S_y [mN s]  S_z [mN s]    E [mJ]  rim [deg]",
        "  1   0.500000   H     0.00000     0.00000     2.50000    1.2500      60.00",
    ]


def test_a_long_toss_is_printed_by_its_first_impacts_and_its_last():
    times = np.linspace(0.1, 0.9, 25)
    text = as_lines(made(MadePath(position=(0, 0, 0.2)), impacts=[(time, 1e-3) for time in times]))
    assert ROW.findall(text) == [*map(str, range(1, 9)), "24", "25"]
    assert "\n... 15 impacts between: " in text


@pytest.mark.parametrize(
    ("contacts", "line"),
    [
        ([], ""),
        ([(0.25, 0.5)], "from 0.250000 s to 0.500000 s"),
        ([(0.25, 0.5), (0.75, 1.0)], "2 times, 0.500000 s in all, the last from 0.750000 s to the end"),
    ],
)
def test_contacts_are_told_in_a_line(contacts, line):
    assert contact_line(made(MadePath(position=(0, 0, 0.2)), contacts=contacts)) == line


def test_of_each_kind_the_largest_residual_is_told():
    measured = {certificate.LAW: 1e-12, certificate.MOMENTUM: 2e-9, certificate.NORM: 1e-15}
    measured |= {certificate.LANDINGS: 3, certificate.LANDING: 4e-8, certificate.GAP: -2e-7}
    settings = tuple(Setting(name=name, value=value) for name, value in measured.items())
    told = as_lines(replace(struck(), certificate=settings), checked=True)
    residuals = "contact law 2e-09, 3 landings of a second rim 4e-08, |e| 1e-15; smallest gap -2e-07 r"
    assert f"checked   largest residuals: {residuals}\n" in told


def test_a_path_has_rows_each_millisecond_and_at_its_impacts():
    times = path_times(made(MadePath(position=(0, 0, 0.2)), impacts=[(1 / 3, 1e-3)], end=0.99965))
    assert times == pytest.approx(np.sort([*np.arange(1000) / 1000, 1 / 3, 0.99965]))
    with pytest.raises(UnsupportedError, match=r"at most 1000 s \(this toss lasts 1001 s\)"):
        path_times(made(MadePath(position=(0, 0, 0.2)), end=1001.0))
