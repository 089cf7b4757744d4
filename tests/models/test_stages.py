"""A terminal has one line that is rewritten, a log a line now and then; what is quick says nothing."""

import io
import sys
import threading

import pytest

from cointoss.compare.commands.common import say
from cointoss.models import stages
from cointoss.models.stages import ProgressLine, Stage, at_work, counted, line_of, stage
from tests.helpers.processes import HANGS


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.fixture
def clock(monkeypatch):
    """A clock that moves when a test says so."""
    now = [0.0]
    monkeypatch.setattr(stages, "perf_counter", lambda: now[0])
    return now


@pytest.mark.parametrize(
    ("counts", "happens"),
    [
        ({"total": 90_000, "done": 10_000}, [(6, "?", 20_000), (10, "?", 30_000), (18, "01:12", 40_000)]),
        # What takes long at first, such as loading, is in the first report.
        ({"total": 38_400}, [(4, "?", 1_920), (6, "?", 3_840), (17, "03:54", 3_840)]),
        ({"total": 3140}, [(6, "?", 1), (7, "?", 100), (56, "?", 100), (67, "31:13", 100)]),
        # Parts of several workers come together.
        ({"total": 80}, [(100, "?", 1), (100.01, "?", 2), (100.09, "?", 9), (200, "14:47", 16)]),
    ],
    ids=["resumed", "a twentieth and a second report", "long work after a minute", "bursts"],
)
def test_the_time_that_is_left_is_told_when_it_can_be_known(clock, counts, happens):
    tossing = Stage("map.zarr", "tosses", **counts)
    for seconds, left, done in happens:
        clock[0] = seconds
        said = line_of([tossing], 0)
        assert f"{tossing.done}/{counts['total']} [" in said
        assert f"<{left}, " in said
        tossing.progress(done, counts["total"])


def test_a_line_has_what_is_done_and_not_what_waits_for_it(clock):
    figure, report = Stage("fig28", "parts", total=5, done=2), Stage("a report")
    inner = Stage("tossing", detail=lambda: "0.8 s of the coin's time")
    clock[0] = 3.0
    assert line_of([report], 99) == line_of([], 99) == ""
    clock[0] = 4.0
    assert line_of([report], 99) == "a report: 4 s"
    assert line_of([report, inner], 99) == "tossing: 4 s, 0.8 s of the coin's time"
    assert line_of([report, inner], 9) == "tossing: "
    shown = line_of([figure, inner], 0)
    assert shown == "fig28:  40% 2/5 [00:04<?, ?parts/s]; tossing: 4 s, 0.8 s of the coin's time"
    assert line_of([report, figure, Stage("new")], 99).startswith("fig28:  40%|█")


def test_the_line_of_a_terminal_is_one_and_goes_before_a_message(monkeypatch):
    display = ProgressLine(Terminal())
    monkeypatch.setattr(stages, "_shown", [display])
    monkeypatch.setattr(sys, "stderr", display.stream)
    for line in ("finding: 4 s", "f: 5 s"):
        display.draw(line)
    say("64 tosses show HTTH")
    shown = display.stream.getvalue()
    assert shown == "\rfinding: 4 s\rf: 5 s      \r      \rcointoss: 64 tosses show HTTH\n"


@pytest.mark.parametrize("stream", [Terminal(), io.StringIO()])
def test_a_stream_that_nobody_reads_stops_no_work(stream):
    display = ProgressLine(stream)
    stream.close()
    display.draw("finding: 4 s")
    display.draw("")


def test_stages_are_open_for_as_long_as_they_last():
    with stage("outer", "parts", total=2) as outer:
        for item in counted("inner", "things", "ab"):
            assert [each.name for each in at_work] == ["outer", "inner"]
            assert at_work[-1].done == "ab".index(item)
        outer(1, 2)
        assert (at_work[0].done, len(at_work)) == (1, 1)
    with pytest.raises(LookupError), stage("failing"):
        raise LookupError
    assert at_work == []


@pytest.mark.parametrize(
    ("stream", "asked", "said"),
    [
        (Terminal(), None, "\rinner: 9 s\r          \r"),
        (Terminal(), False, ""),
        (io.StringIO(), True, "cointoss: inner: 9 s\n"),
        (io.StringIO(), None, ""),
        (None, True, None),
    ],
    ids=["terminal", "not asked", "log", "python's own", "none"],
)
def test_a_log_is_told_what_is_asked_for_and_a_terminal_all(monkeypatch, clock, stream, asked, said):
    drawn = threading.Event()
    monkeypatch.setenv("TQDM_DISABLE", "")
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setattr(stages, "LOGGED", 0.01)
    monkeypatch.setattr(
        ProgressLine, "draw", lambda *a, own=ProgressLine.draw: own(*a) or (a[1] and drawn.set())
    )
    with stage("outer", shown=asked), stage("inner"):
        clock[0] = 9.0
        assert drawn.wait(HANGS if said else 0.3) == bool(said)
    assert stream is None or set(stream.getvalue().splitlines(True)) == set(said.splitlines(True))


def test_a_display_that_is_forbidden_shows_nothing(monkeypatch):
    monkeypatch.setenv("TQDM_DISABLE", "1")
    monkeypatch.setattr(sys, "stderr", Terminal())
    with stage("outer", shown=True):
        assert stages._shown == []


def test_two_that_work_side_by_side_have_one_line(monkeypatch):
    monkeypatch.setenv("TQDM_DISABLE", "")
    monkeypatch.setattr(sys, "stderr", Terminal())
    with stage("building one engine", shown=True), stage("building another", shown=True):
        assert len(stages._shown) == 1
