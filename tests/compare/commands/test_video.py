"""`cointoss video`: a panel for each toss, a poster, and an encoder that fails."""

from unittest.mock import patch

import imageio_ffmpeg
import pytest
from PIL import Image

from cointoss.compare.film.drawing import Drawer
from cointoss.compare.film.encodings import ENCODINGS, Format
from cointoss.models.sources import scenario_text
from tests.helpers.command_line import cointoss, printed
from tests.helpers.films import film_written


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


@pytest.mark.parametrize(
    ("engine", "camera"), [("analytic", "overview"), ("mujoco", "top"), ("both", "close-up")]
)
@pytest.mark.usefixtures("small_films")
def test_a_film_has_one_panel_for_each_toss(tmp_path, short, engine, camera):
    film, poster = tmp_path / "film.MP4", tmp_path / "film.png"
    asked = ("--engine", engine, "--camera", camera, "--out", film, "--poster", poster)
    with patch("cointoss.compare.film.video.Drawer", side_effect=Drawer) as drawers:
        assert printed("video", short, *asked) == f"{film}\n"
    engines = ["analytic", "mujoco"] if engine == "both" else [engine]
    drawn = [
        (call.args[0].toss.engine, call.args[1], call.kwargs["width"]) for call in drawers.call_args_list
    ]
    assert drawn == [(name, camera, 64 // len(engines)) for name in engines]
    assert film_written(film).frames >= 2
    with Image.open(poster) as picture:
        assert picture.size == (64, 48)
    assert set(tmp_path.iterdir()) == {short, film, poster}


@pytest.mark.usefixtures("small_films")
def test_what_an_encoder_says_that_no_longer_reads_is_waited_for_and_the_earlier_film_stays(
    tmp_path, short, monkeypatch
):
    encoder, film = tmp_path / "encoder", tmp_path / "film.mp4"
    film.write_text("an earlier film")
    encoder.write_text("#!/bin/sh\nexec 0<&-\nsleep 1\necho '[mp4 @ 0x55d0] no such codec' >&2\nexit 1\n")
    encoder.chmod(0o755)
    monkeypatch.setattr(imageio_ffmpeg, "get_ffmpeg_exe", lambda: str(encoder))
    answered = cointoss("video", short, "--out", film)
    assert answered.exit_code == 2
    assert answered.stderr.endswith("film.mp4: can't be written (ffmpeg: [mp4] no such codec)\n")
    assert film.read_text() == "an earlier film"
    assert set(tmp_path.iterdir()) == {encoder, film, short}
