"""Files are whole or not there: which are accepted, and what cannot be written."""

import errno
import itertools
import os
import re
import sys
from pathlib import Path

import pytest

from cointoss.compare.output.files import (
    PREFIX,
    UnwritableError,
    aside_in,
    require_file,
    write_text,
    written_together,
)
from tests.helpers.command_line import in_a_shell, python


def test_a_replaced_file_keeps_its_mode_and_a_link_its_place_and_a_failed_write_leaves_both(tmp_path):
    path, link = tmp_path / "path.csv", tmp_path / "link.csv"
    path.write_text("old")
    path.chmod(0o640)
    link.symlink_to(path)
    write_text(link, "new")
    with pytest.raises(UnicodeEncodeError):
        write_text(link, "newer, up to what can't be encoded: \ud800")
    assert (path.read_text(), path.stat().st_mode & 0o777) == ("new", 0o640)
    assert link.is_symlink()
    assert set(tmp_path.iterdir()) == {path, link}


NAMES = ("page.html", "b.txt", "c.txt", "d.txt")
OLD = dict.fromkeys(NAMES[1:], "old")


def write_anew(folder, meanwhile=lambda: None):
    """Write page.html to c.txt together, in place of b.txt to d.txt."""
    with written_together(folder, NAMES) as aside:
        meanwhile()
        for name in NAMES[:3]:
            (aside / name).write_text("new")


@pytest.fixture
def earlier(tmp_path):
    """A folder with b.txt to d.txt."""
    for name in OLD:
        (tmp_path / name).write_text("old")
        (tmp_path / name).chmod(0o640)
    return tmp_path


def held(folder):
    return {path.name: path.is_file() and path.read_text() for path in folder.iterdir()}


def test_files_of_a_folder_are_replaced_and_what_else_is_there_stays(earlier):
    (earlier / "notes.txt").write_text("mine")
    write_anew(earlier, meanwhile=lambda: (earlier / "later.txt").write_text("mine"))
    mine = {"notes.txt": "mine", "later.txt": "mine"}
    assert held(earlier) == dict.fromkeys(NAMES[:3], "new") | mine
    assert (earlier / "b.txt").stat().st_mode & 0o777 == 0o640


@pytest.mark.parametrize("makes", [False, True])
def test_a_new_folder_appears_when_all_its_files_are_written(tmp_path, makes):
    """Unless another program makes it meanwhile."""
    new, was_there = tmp_path / "deep" / "new", []
    write_anew(new, meanwhile=lambda: new.mkdir(parents=True) if makes else was_there.append(new.exists()))
    assert (held(new), held(new.parent)) == (dict.fromkeys(NAMES[:3], "new"), {"new": False})
    assert new.stat().st_mode == new.parent.stat().st_mode
    assert not any(was_there)


def test_a_folder_in_the_place_of_one_file_leaves_all_as_they_were(earlier):
    (earlier / "c.txt").unlink()
    for meanwhile in ((earlier / "c.txt").mkdir, lambda: None):
        with pytest.raises(UnwritableError, match=r"c\.txt: is a folder"):
            write_anew(earlier, meanwhile)
        assert held(earlier) == OLD | {"c.txt": False}


@pytest.mark.parametrize("moved", range(3))
def test_a_full_disk_leaves_each_file_whole_and_the_page_to_the_last(earlier, monkeypatch, moved):
    calls, replace = itertools.count(), Path.replace

    def fail(*paths):
        if next(calls) == moved:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return replace(*paths)

    monkeypatch.setattr(Path, "replace", fail)
    with pytest.raises(UnwritableError, match="No space left on device"):
        write_anew(earlier)
    assert held(earlier) == OLD | dict.fromkeys(NAMES[1 : 1 + moved], "new")


def test_what_a_killed_process_left_is_removed_and_what_a_live_one_writes_is_not(tmp_path):
    script = (
        "import os, signal, sys; from pathlib import Path\n"
        "from cointoss.compare.output.files import written_together, written_whole\n"
        "folder = Path(sys.argv[1])\n"
        "with written_whole(folder / 'one') as a, written_together(folder, ()):\n"
        "    a.write_text('half')\n"
        "    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    with aside_in(tmp_path) as live:
        python("-c", script, tmp_path)
        assert len([*tmp_path.glob(f"{PREFIX}*")]) == 3
        write_text(tmp_path / "two", "whole")
        assert {path.name for path in tmp_path.iterdir()} == {live.name, "two"}
        assert live.is_dir()


def test_a_device_and_a_name_that_is_too_long_are_refused(tmp_path):
    """A folder and what is read-only are rows of refusals.toml."""
    os.mkfifo(tmp_path / "pipe.csv")
    for name, reason in (("pipe.csv", "a device"), (300 * "a" + ".csv", "name too long")):
        with pytest.raises(UnwritableError, match=reason):
            require_file(tmp_path / name, (".csv",), "fig24a")
    require_file(tmp_path / "NEW.CSV", (".csv",), "fig24a")
    require_file(tmp_path / (251 * "a" + ".csv"), (".csv",), "fig24a")


@pytest.mark.parametrize(
    ("stream", "goes", "written"),
    [
        ("/dev/stdout", "> out", "first\nsecond\nthird\n"),
        ("/dev/stdout", "| cat > out", "first\nsecond\nthird\n"),
        ("/dev/fd/3", "3>&1 > /dev/null | cat > out", "second\n"),
    ],
)
def test_a_stream_is_written_to_directly(tmp_path, stream, goes, written):
    script = (
        "from pathlib import Path; from cointoss.compare.output.files import write_text; "
        f"print('first'); write_text(Path('{stream}'), 'second\\n'); print('third')"
    )
    done = in_a_shell(f'"{sys.executable}" -c "{script}" {goes}', tmp_path)
    assert ((tmp_path / "out").read_text(), done.stderr) == (written, "")


@pytest.mark.slow_after_first
@pytest.mark.parametrize(
    ("command", "status", "named"),
    [
        ("cointoss toss fig24a --max-impacts 1 > /dev/full", 1, "standard output"),
        ("cointoss --help > /dev/full", 1, "standard output"),
        ("ln -s /dev/full full; cointoss toss fig24a --max-impacts 1 --trajectory full", 2, "full"),
        (
            "ulimit -f 1; cointoss toss fig24a --max-impacts 1 --trajectory path.csv",
            2,
            "path.csv",
        ),
    ],
)
def test_what_cannot_be_written_is_one_line(tmp_path, command, status, named):
    done = in_a_shell(f"{command}; echo $?", tmp_path)
    assert done.stdout.endswith(f"{status}\n")
    assert re.fullmatch(rf"cointoss: {re.escape(named)}: can't be written \(.*\n", done.stderr)
    assert {path.name for path in tmp_path.iterdir()} <= {"full"}
