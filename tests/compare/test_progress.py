"""While functions are compiled, the terminal says so; a job's rate leaves out the time that this takes."""

import io
import re
import sys
import time

import pytest

from compare.output.progress import bar, compile_bar, elapsed_time
from models.kernel.compiled import CompiledFunction
from models.kernel.compiling import compiling


class Terminal(io.StringIO):
    def isatty(self):
        return True


def compile_two():
    inner = CompiledFunction(lambda x: x + 1.0)
    outer = CompiledFunction(lambda x: inner(x) * 2.0)
    assert outer(1.0) == 4.0


def test_the_terminal_says_what_is_compiled(monkeypatch):
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    with compile_bar(after=0.0):
        compile_two()
        compile_two()
    shown = terminal.getvalue()
    assert shown.count("cointoss: compiling, once") == 1
    assert " functions" in shown
    assert shown.endswith("\r")
    assert not compiling.watchers
    assert not compiling.now


@pytest.mark.parametrize(
    ("stream", "after"),
    [(Terminal(), 600.0), (io.StringIO(), 0.0), (None, 0.0)],
    ids=["quick", "file", "none"],
)
def test_nothing_is_said_of_what_is_quick_nor_but_to_a_terminal(monkeypatch, stream, after):
    monkeypatch.setattr(sys, "stderr", stream)
    with compile_bar(after=after):
        compile_two()
    assert stream is None or stream.getvalue() == ""


def test_the_terminal_says_for_how_long_a_job_has_run(monkeypatch):
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    with elapsed_time("still tossing", after=1.2):
        time.sleep(2.7)
    shown = terminal.getvalue().split("\r")
    assert "still tossing: 00:02" in shown
    assert shown[-1] == ""


@pytest.mark.parametrize(("stream", "after"), [(Terminal(), 600.0), (io.StringIO(), 0.0), (None, 0.0)])
def test_nothing_is_said_of_a_job_that_is_quick_nor_but_to_a_terminal(monkeypatch, stream, after):
    monkeypatch.setattr(sys, "stderr", stream)
    with elapsed_time("still tossing", after=after):
        time.sleep(0.05)
    assert stream is None or stream.getvalue() == ""


def test_the_clock_of_a_bar_goes_on_within_a_part(monkeypatch):
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    with bar("map", "tosses") as progress:
        progress(0, 100)
        time.sleep(2.7)
        assert re.search("00:0[12]<", terminal.getvalue())


def test_a_rate_leaves_out_the_time_to_compile(monkeypatch):
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    with bar("tosses", "tosses") as progress:
        progress(0, 100)
        with compiling.one():
            time.sleep(3.0)
        progress(50, 100)
        progress(100, 100)
    last = terminal.getvalue().split("\r")[-1]
    assert "100/100 [00:00<00:00" in last, last
