"""`cointoss video` and the film of a report: panels, interruptions, encoders that fail."""

import os
import signal
import sys
from unittest.mock import patch

import imageio_ffmpeg
import pytest
from PIL import Image

from cointoss.compare.film.drawing import Drawer
from cointoss.compare.film.encodings import ENCODINGS, Format
from cointoss.compare.report.contents import FILES
from cointoss.models.sources import scenario_text
from tests.helpers.command_line import cointoss, in_a_shell, printed
from tests.helpers.films import film_written
from tests.helpers.processes import answered, started, wait_until


@pytest.fixture
def small_films(monkeypatch):
    """Films of the size of a stamp, of two frames a second."""
    monkeypatch.setitem(ENCODINGS, ".mp4", ENCODINGS[".mp4"]._replace(form=Format(64, 48, 2)))


@pytest.fixture
def short(tmp_path):
    """A scenario that ends at its first impact."""
    source = tmp_path / "short.toml"
    source.write_text(scenario_text("fig24a") + "\n[ending]\nmax_impacts = 1\n")
    return source


@pytest.mark.slow
def test_where_a_film_is_interrupted_the_report_stands_without_it(tmp_path, short):
    # Frames that take their time, so that the film is met unfinished.
    script = (
        "import time\nfrom cointoss.compare.film import drawing\n"
        "draw = drawing.Drawer.draw\n"
        "drawing.Drawer.draw = lambda *frame: time.sleep(0.2) or draw(*frame)\n"
        "from cointoss.compare.cli import main; main()"
    )
    command = ("compare", short, "--out", "new/report")
    with started("-c", script, *command, cwd=tmp_path, start_new_session=True) as filming:
        wait_until(filming, lambda: list(tmp_path.rglob("toss.mp4")))
        os.killpg(filming.pid, signal.SIGINT)  # the encoder is stopped too, as by Ctrl-C
        _, told = answered(filming)
    assert (filming.returncode, told) == (130, "cointoss: interrupted by SIGINT\n")
    assert {path.name for path in (tmp_path / "new/report").iterdir()} == set(FILES) - {"toss.mp4"}


@pytest.mark.parametrize(
    ("engine", "camera"), [("analytic", "overview"), ("mujoco", "top"), ("both", "close-up")]
)
@pytest.mark.usefixtures("small_films")
def test_a_film_has_one_panel_for_each_toss(tmp_path, short, engine, camera):
    film = tmp_path / "film.mp4"
    with patch("cointoss.compare.film.video.Drawer", side_effect=Drawer) as drawers:
        answered = printed("video", short, "--engine", engine, "--camera", camera, "--out", film)
    assert answered == f"{film}\n"
    engines = ["analytic", "mujoco"] if engine == "both" else [engine]
    assert [call.args[0].toss.engine for call in drawers.call_args_list] == engines
    assert {call.args[1] for call in drawers.call_args_list} == {camera}
    assert {call.kwargs["width"] for call in drawers.call_args_list} == {64 // len(engines)}
    assert film_written(film).frames >= 2
    assert {path.name for path in tmp_path.iterdir()} == {"short.toml", "film.mp4"}


@pytest.mark.usefixtures("small_films")
def test_an_interrupted_film_leaves_what_was_there(tmp_path, short):
    film = tmp_path / "film.mp4"
    film.write_text("an earlier film")
    with patch("cointoss.compare.film.video.written", side_effect=KeyboardInterrupt):
        answered = cointoss("video", short, "--out", film)
    assert answered.exit_code == 130
    assert answered.stderr.strip() == "cointoss: interrupted"
    assert film.read_text() == "an earlier film"
    assert {path.name for path in tmp_path.iterdir()} == {"short.toml", "film.mp4"}


@pytest.mark.slow
def test_a_film_that_cannot_be_written_is_one_line(tmp_path, short):
    small = (
        "from cointoss.compare.film.encodings import ENCODINGS as e, Format; "
        "e['.mp4'] = e['.mp4']._replace(form=Format(64, 48, 4)); from cointoss.__main__ import main; main()"
    )
    command = f'"{sys.executable}" -c "{small}" video short.toml --out film.mp4'
    done = in_a_shell(f"ulimit -c 0 -f 1; {command}; echo $?", tmp_path)
    assert done.stdout == "2\n"
    assert done.stderr.startswith("cointoss: film.mp4: can't be written (ffmpeg: ")
    assert len(done.stderr.splitlines()) == 1
    assert list(tmp_path.iterdir()) == [short]


@pytest.mark.usefixtures("small_films")
def test_what_an_encoder_says_that_no_longer_reads_is_waited_for(tmp_path, short, monkeypatch):
    encoder = tmp_path / "encoder"
    encoder.write_text("#!/bin/sh\nexec 0<&-\nsleep 1\necho '[mp4 @ 0x55d0] no such codec' >&2\nexit 1\n")
    encoder.chmod(0o755)
    monkeypatch.setattr(imageio_ffmpeg, "get_ffmpeg_exe", lambda: str(encoder))
    answered = cointoss("video", short, "--out", tmp_path / "film.mp4")
    assert answered.exit_code == 2
    assert answered.stderr.endswith("film.mp4: can't be written (ffmpeg: [mp4] no such codec)\n")
    assert set(tmp_path.iterdir()) == {encoder, short}


def test_the_command_writes_a_poster(tmp_path, monkeypatch):
    monkeypatch.setitem(ENCODINGS, ".gif", ENCODINGS[".gif"]._replace(form=Format(64, 48, 4, longest=2.0)))
    text = scenario_text("fig24a").replace("0.40001", "0.05") + "\n[ending]\nmax_impacts = 1\n"
    (tmp_path / "short.toml").write_text(text)
    film, poster = tmp_path / "film.GIF", tmp_path / "film.png"
    said = cointoss("video", tmp_path / "short.toml", "--out", film, "--poster", poster)
    assert (said.exit_code, said.stdout) == (0, f"{film}\n"), said.stderr
    assert film.read_bytes().startswith(b"GIF89a")
    with Image.open(poster) as picture:
        assert picture.size == (64, 48)
