"""Whether MuJoCo can draw here, found out once, in a child process."""

from importlib import import_module
from unittest.mock import patch

import pytest

from cointoss.compare.film.back_end import ADVICE, TOO_LATE, drawing_problem


@pytest.mark.usefixtures("fresh_back_end")
def test_the_back_end_is_tried_once(monkeypatch):
    with patch("cointoss.compare.film.back_end.drawing_complaint", return_value=None) as tried:
        assert drawing_problem() is None
        monkeypatch.setenv("MUJOCO_GL", "nonsense")
        assert drawing_problem() is None
    assert tried.call_count == 1


@pytest.mark.usefixtures("fresh_back_end")
def test_a_back_end_that_is_chosen_already_is_said_to_be_too_late(monkeypatch):
    monkeypatch.setattr("sys.platform", "linux")
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.setenv("MUJOCO_GL", "")
    import_module("mujoco")
    with patch("cointoss.compare.film.back_end.drawing_complaint", return_value=None):
        assert drawing_problem() == TOO_LATE


@pytest.mark.usefixtures("fresh_back_end")
def test_a_missing_back_end_is_found_in_a_child_process_that_runs_nothing_foreign(here, monkeypatch):
    (here / "random.py").write_text("raise RuntimeError('foreign')")
    monkeypatch.setenv("MUJOCO_GL", "egl")
    monkeypatch.setenv("PYOPENGL_PLATFORM", "osmesa")
    problem = drawing_problem() or ""
    assert problem.startswith(ADVICE)
    assert "PYOPENGL_PLATFORM" in problem
