"""What all tests share: a back end for offscreen drawing, and reproducible Hypothesis runs."""

import os

import pytest
from hypothesis import settings

from compare.film.back_end import drawing_problem

os.environ.setdefault("MUJOCO_GL", "egl")

settings.register_profile("cointoss", deadline=None, derandomize=True, max_examples=100)
settings.load_profile("cointoss")


@pytest.fixture
def fresh_back_end():
    """Let a test find out anew whether MuJoCo can draw."""
    drawing_problem.cache_clear()
    yield
    drawing_problem.cache_clear()
