"""A terminal has one line that is rewritten, a log a line now and then; what is quick says nothing."""

import io
import sys

import pytest

import cointoss.compare.output.progress as progress
from cointoss.compare.commands.common import say
from cointoss.compare.output.progress import Display, progress_shown
from cointoss.models.stages import Stage, Stages, counted, stage, stages


class Terminal(io.StringIO):
    def isatty(self):
        return True


class Desk:
    """A stream, a clock that moves when told, and what a display shows of stages."""

    def __init__(self, *, rewrites):
        self.now, self.stream, self.stages = 0.0, io.StringIO(), Stages()
        self.display = Display(self.stream, rewrites=rewrites, work=self.stages, clock=self.clock)

    def clock(self):
        return self.now

    def begin(self, *name, **counts):
        self.stages.open.append(Stage(*name, **counts, clock=self.clock))
        return self.stages.open[-1]

    def end(self):
        self.display.ended(self.stages.open[-1])
        self.stages.open.pop()

    def wait(self, seconds):
        """Let time pass, with a tick each second; return what is new on the stream."""
        before = len(self.stream.getvalue())
        for _ in range(seconds):
            self.now += 1.0
            self.display.tick()
        return self.stream.getvalue()[before:]


def test_a_log_names_a_stage_after_five_seconds_and_then_every_ten():
    desk = Desk(rewrites=False)
    desk.begin("tossing by MuJoCo", detail=lambda: "0.8 s of the coin's time")
    assert desk.wait(5) == ""
    assert desk.wait(1) == "cointoss: tossing by MuJoCo: 6 s, 0.8 s of the coin's time\n"
    assert desk.wait(10) == ""
    assert desk.wait(1) == "cointoss: tossing by MuJoCo: 17 s, 0.8 s of the coin's time\n"
    desk.end()
    assert desk.wait(30) == ""
    desk.begin("drawing the film", "frames")
    assert desk.wait(2) == "cointoss: drawing the film: 1 s\n"


@pytest.mark.parametrize(
    ("counts", "happens"),
    [
        (
            {"total": 90_000, "done": 10_000},
            [
                (6, "cointoss: map.zarr: 10,000 of 90,000 tosses\n", 20_000),
                (4, "", 30_000),
                (7, "cointoss: map.zarr: 30,000 of 90,000 tosses, about 66 s left\n", 30_000),
            ],
        ),
        (
            {"total": 38_400},
            [
                (3, "", 1_920),  # what takes long at first, such as loading, is in its time
                (3, "cointoss: map.zarr: 1,920 of 38,400 tosses\n", 3_840),
                (11, "3,840 of 38,400 tosses, about 4 min left\n", 3_840),
            ],
        ),
        (
            {"total": 3140},
            [
                (6, "0 of 3,140 tosses\n", 1),
                (1, "", 100),
                (49, "100 of 3,140 tosses\n", 100),
                (11, "100 of 3,140 tosses, about 28 min left\n", 100),
            ],
        ),
    ],
    ids=["at the next line", "after a twentieth and a second report", "of long work after a minute"],
)
def test_a_log_says_how_many_there_are_and_when_it_ends(counts, happens):
    desk = Desk(rewrites=False)
    tossing = desk.begin("map.zarr", "tosses", **counts)
    for seconds, said, done in happens:
        told = desk.wait(seconds)
        assert told.endswith(said) if said else told == ""
        assert ("left" in told) == ("left" in said)
        tossing.progress(done, counts["total"])


def test_parts_of_several_workers_that_come_together_tell_no_time_left():
    desk = Desk(rewrites=False)
    tossing = desk.begin("map.zarr", "tosses", total=80)
    desk.now = 100.0
    for done in range(1, 9):
        desk.now += 0.01
        tossing.progress(done, 80)
    assert tossing.seconds_left is None
    desk.now = 200.0
    tossing.progress(16, 80)
    assert tossing.seconds_left == pytest.approx(64 * 100 / 15, rel=1e-3)


def test_a_stage_within_another_is_named_as_soon_as_it_takes_long():
    desk = Desk(rewrites=False)
    figure = desk.begin("fig28", "parts")
    desk.wait(1)
    figure.progress(1, 5)
    desk.wait(1)
    figure.progress(2, 5)
    assert desk.wait(4) == "cointoss: fig28: 2 of 5 parts, about 15 s left\n"
    desk.begin("tossing by MuJoCo", "tosses").progress(1, 4)
    assert desk.wait(10) == ""
    assert desk.wait(1) == (
        "cointoss: fig28: 2 of 5 parts, about 48 s left; tossing by MuJoCo: 1 of 4 tosses\n"
    )
    desk.stages.open.clear()
    desk.begin("a report")
    desk.begin("tossing by MuJoCo")
    assert desk.wait(5) == ""
    assert desk.wait(1) == "cointoss: a report: 6 s; tossing by MuJoCo: 6 s\n"


def test_what_is_quick_is_not_told_in_a_log():
    desk = Desk(rewrites=False)
    for _ in range(2):
        desk.begin("tossing by MuJoCo")
        desk.wait(2)
        desk.end()
    desk.display.close()
    assert desk.stream.getvalue() == ""


def lines(shown):
    """Return what a terminal has shown on its one line, one after the other."""
    return [line.rstrip() for line in shown.replace("\n", "\r").split("\r") if line.strip()]


def test_a_terminal_has_a_bar_with_rate_and_time_left_and_keeps_the_last():
    desk = Desk(rewrites=True)
    tossing = desk.begin("map.zarr", "tosses", total=1920)
    assert desk.wait(2) == ""
    tossing.progress(480, 1920)
    (shown,) = lines(desk.wait(2))
    assert shown.startswith("map.zarr:  25%|")
    assert shown.endswith("| 480/1,920 tosses [00:04<?, 120 tosses/s]")
    tossing.progress(960, 1920)
    assert lines(desk.wait(2))[-1].endswith("| 960/1,920 tosses [00:06<00:08, 160 tosses/s]")
    tossing.progress(1920, 1920)
    desk.end()
    last = desk.stream.getvalue().split("\r")[-1]
    assert "100%" in last
    assert last.endswith("1,920/1,920 tosses [00:06<00:00, 320 tosses/s]\n")


def test_the_line_of_a_terminal_says_what_is_within_and_goes_with_its_stage():
    desk = Desk(rewrites=True)
    desk.begin("fig28", "parts").progress(2, 5)
    desk.begin("tossing by MuJoCo")
    (shown,) = lines(desk.wait(4))
    assert "2/5 parts [00:04<?, 0.5 parts/s; tossing by MuJoCo: 4 s]" in shown
    desk.end()
    desk.begin("tossing by MuJoCo", "tosses").progress(1, 4)
    assert lines(desk.wait(4))[-1].startswith("fig28 2 of 5, tossing by MuJoCo:  25%|")
    desk.display.close()
    assert desk.stream.getvalue().endswith("\r")


@pytest.mark.parametrize("fails", [False, True])
def test_the_line_of_an_uncounted_stage_goes_with_it_before_the_next_text(fails):
    desk = Desk(rewrites=True)
    desk.begin("finding HTTH")
    assert desk.wait(4)
    if fails:
        desk.stages.open.pop()
        desk.display.close()
    else:
        desk.end()
    assert desk.stream.getvalue().endswith(f"\r{' ' * len('finding HTTH: 4 s')}\r")


def test_a_message_stands_on_a_line_of_its_own(monkeypatch):
    desk = Desk(rewrites=True)
    desk.begin("finding HTTH")
    desk.wait(4)
    monkeypatch.setattr(progress, "_displays", [desk.display])
    monkeypatch.setattr(sys, "stderr", desk.stream)
    say("64 tosses show HTTH")
    assert desk.stream.getvalue().endswith("  \rcointoss: 64 tosses show HTTH\n")
    assert "finding HTTH: 5 s" in desk.wait(1)


@pytest.mark.parametrize("rewrites", [True, False])
def test_a_stream_that_nobody_reads_stops_no_work(rewrites):
    desk = Desk(rewrites=rewrites)
    desk.begin("map.zarr", "tosses", total=2).progress(1, 2)
    desk.stream.close()
    for _ in range(9):
        desk.now += 1.0
        desk.display.tick()
    desk.end()
    desk.display.close()


def test_stages_are_open_for_as_long_as_they_last():
    with stage("outer", "parts", total=2) as outer:
        for item in counted("inner", "things", "ab"):
            assert [each.name for each in stages.open] == ["outer", "inner"]
            assert stages.open[-1].done == "ab".index(item)
        outer(1, 2)
        assert (stages.open[0].done, len(stages.open)) == (1, 1)
    with pytest.raises(LookupError), stage("failing"):
        raise LookupError
    assert stages.open == []


@pytest.mark.parametrize(
    ("stream", "in_logs", "shows"),
    [
        (Terminal(), False, True),
        (io.StringIO(), True, True),
        (io.StringIO(), False, False),
        (None, True, False),
    ],
    ids=["terminal", "log", "python's own", "none"],
)
def test_a_command_speaks_to_a_log_python_to_a_terminal_alone(monkeypatch, stream, in_logs, shows):
    begun = []
    monkeypatch.setattr(progress, "Display", lambda *_, **__: begun.append(1) or Desk(rewrites=True).display)
    monkeypatch.setattr(sys, "stderr", stream)
    for switch in ("1", ""):
        monkeypatch.setenv("TQDM_DISABLE", switch)
        with progress_shown(in_logs=in_logs), progress_shown(in_logs=in_logs):
            pass
    assert len(begun) == shows  # the switch forbids the first, and one display is enough


def test_a_stage_of_python_is_shown(monkeypatch):
    shown = []
    monkeypatch.setenv("TQDM_DISABLE", "")
    monkeypatch.setattr(sys, "stderr", Terminal())
    monkeypatch.setattr(progress, "Display", lambda *_, **__: shown.append(1) or Desk(rewrites=True).display)
    with stage("outer"), stage("inner"):
        pass
    assert shown == [1]
