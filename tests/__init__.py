"""What is so in the environment of all tests, and of what they start, before anything else is imported."""

import os
import sys

if sys.platform == "linux":
    os.environ.setdefault("MUJOCO_GL", "egl")
# A busy machine is slow, and of what is slow the commands speak.
os.environ["TQDM_DISABLE"] = "1"
