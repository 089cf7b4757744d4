"""A toss in lines: all of its impacts and contacts, and zeros without a sign; transcripts have the rest."""

import re
from dataclasses import replace

import numpy as np

from cointoss import analytic
from cointoss.compare.output.answer import as_lines
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


def test_what_rounds_to_zero_has_no_sign():
    toss = analytic.toss(load("fig24a").replace("ending.max_impacts", 1))
    tiny = replace(toss.impacts, impulse=np.array([[-1e-12, 1e-12, 0.01]]))
    assert "   0.00000     0.00000    10.00000" in as_lines(replace(toss, impacts=tiny))
