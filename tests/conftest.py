"""What all tests share: a back end for offscreen drawing, and reproducible Hypothesis runs."""

import os

from hypothesis import settings

os.environ.setdefault("MUJOCO_GL", "egl")

settings.register_profile("cointoss", deadline=None, derandomize=True, max_examples=100)
settings.load_profile("cointoss")
