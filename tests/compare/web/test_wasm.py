"""Building the engine for a browser: what is refused, in a line; tests/site tests what it makes."""

import numpy as np
import pytest

import cointoss
from cointoss.analytic.by_rows import NO_TRUST
from cointoss.analytic.entries import examine, toss_each
from cointoss.compare.web.wasm import build as building
from cointoss.compare.web.wasm import carried
from cointoss.compare.web.wasm.build import _leb128, main
from cointoss.compare.web.wasm.carried import engine_bytes, made_of, sources
from cointoss.models.answers import ANSWER, REFUSED
from cointoss.models.faults import Fault
from cointoss.models.fields import FIELDS
from cointoss.models.records import Outcome, UnusableEngineError
from cointoss.models.rows import EXAMINED, foreign_number, row_of
from tests.helpers.draws import scenario


@pytest.mark.parametrize("content", [b"", b"cointoss{", b'cointoss{"version": "1"}', b"\0asm" + bytes(100)])
def test_a_file_of_other_sources_is_not_carried(content, monkeypatch, tmp_path):
    assert made_of(content) == ""
    monkeypatch.setattr(carried.resources, "files", lambda _: tmp_path)
    with pytest.raises(UnusableEngineError):
        engine_bytes()
    (tmp_path / "engine.wasm").write_bytes(content)
    with pytest.raises(UnusableEngineError):
        engine_bytes()
    about = f'{{"sources": "{sources()}"}}'
    (tmp_path / "engine.wasm").write_bytes(whole := content + b"cointoss" + about.encode())
    assert engine_bytes() == whole


def test_numbers_are_written_seven_bits_a_byte():
    assert [_leb128(number) for number in (0, 127, 128, 300)] == [b"\0", b"\x7f", b"\x80\1", b"\xac\2"]


@pytest.mark.parametrize("arguments", [[], ["a.wasm", "b.so", "c.so"]])
def test_one_file_is_named(arguments, capsys):
    assert main(arguments) == 2
    assert capsys.readouterr().err == "usage: python -m cointoss.compare.web.wasm.build FILE [LIBRARY]\n"


def test_the_library_of_the_engine_is_the_beginning_of_the_file(tmp_path):
    (tmp_path / "bare.so").write_bytes(b"\0asm")
    assert main([str(tmp_path / "engine.wasm"), str(tmp_path / "bare.so")]) == 0
    made = (tmp_path / "engine.wasm").read_bytes()
    assert made.startswith(b"\0asm\0")
    assert made_of(made) == sources()


def test_a_file_of_these_sources_is_not_built_again(monkeypatch, tmp_path):
    file = tmp_path / "engine.wasm"
    monkeypatch.setattr(building, "build", lambda out: out.write_bytes(b"new"))
    kept = f'cointoss{{"sources": "{sources()}"}}'.encode()
    for content, left in ((kept, kept), (b"old", b"new")):
        file.write_bytes(content)
        assert main([str(file)]) == 0
        assert file.read_bytes() == left


LEFT_OUT = (
    *("coin.inertia.", "release.angles.", "release.quaternion."),
    *("ending.max_impacts", "ending.caught", "ending.until"),
)
"""Fields that a scenario may leave out, as NaN."""


ANGLES = [f"release.angles.{name}" for name in ("psi", "theta", "phi")]


def test_a_row_with_a_number_that_no_scenario_has_is_no_scenario():
    row = row_of(cointoss.load("fig24a"))
    assert foreign_number(row) == -1
    changes = [
        (i, value)
        for i, name in enumerate(FIELDS)
        for value in (np.inf, -np.inf, np.nan)
        if value == value or not name.startswith(LEFT_OUT) or (name in ANGLES and row[i] == row[i])
    ]
    rows, places = np.tile(row, (len(changes), 1)), [i for i, _ in changes]
    rows[np.arange(len(rows)), places] = [value for _, value in changes]
    answers, told = np.empty((len(rows), len(ANSWER))), np.empty(len(EXAMINED))
    toss_each(rows, NO_TRUST, answers)
    assert (answers[:, 0] == REFUSED).all()
    assert (answers[:, 1:] == -1).all()
    for one, place in zip(rows, places, strict=True):
        examine(one, told)
        assert told[0] == Fault.ROW
        # A list is named by its first number, which says whether it is there.
        assert FIELDS[int(told[1])].rpartition(".")[0] == FIELDS[place].rpartition(".")[0]


def test_a_release_without_an_attitude_is_flat_with_heads_up():
    flat = scenario(release={"position": [0, 0, 0.3], "angular_velocity": [0, 5, 0]})
    rows = np.array([row_of(flat), row_of(flat.replace("release.angles", [0, 0, 0]))])
    assert np.isnan(rows[0]).sum() == np.isnan(rows[1]).sum() + 3
    answers, told = np.empty((2, len(ANSWER))), np.empty(len(EXAMINED))
    examine(rows[0], told)
    assert told[0] == Fault.NONE
    toss_each(rows, NO_TRUST, answers)
    assert answers[0].tolist() == answers[1].tolist()
    assert answers[0, 0] in (Outcome.HEADS, Outcome.TAILS)
