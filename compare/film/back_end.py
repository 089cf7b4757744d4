"""The back end with which MuJoCo draws: chosen once, and tried in a child process.

Where an OpenGL library is missing, MuJoCo's binding fails late, some of its back ends by ending the process;
and it chooses its back end once, when it is first imported.
"""

import os
import re
import subprocess
import sys
from functools import cache
from importlib import import_module

from cointoss.models.stages import stage

DRAW_ONE_FRAME = """
import mujoco
model = mujoco.MjModel.from_xml_string("<mujoco><worldbody><geom size='1'/></worldbody></mujoco>")
data = mujoco.MjData(model)
mujoco.mj_forward(model, data)
with mujoco.Renderer(model, 16, 16) as renderer:
    renderer.update_scene(data)
    renderer.render()
"""
ADVICE = (
    "video needs an OpenGL library; on Debian or Ubuntu: "
    "apt-get install libegl1 libgl1-mesa-dri libopengl0 (elsewhere: Mesa with EGL)"
)

UNKNOWN = "video can't be drawn here"
TOO_LATE = (
    "video can't be drawn by this process: MuJoCo was imported without MUJOCO_GL, and there is no screen; "
    "accepted: MUJOCO_GL=egl in the environment before Python starts"
)
BACK_ENDS = "accepted as MUJOCO_GL: egl, glfw, osmesa where it is installed, disable, or nothing"


class BackEndError(RuntimeError):
    """MuJoCo's back end for drawing keeps it from being imported; the message says what is accepted."""


def require_mujoco(*engines: str) -> None:
    """Import MuJoCo to compute with.

    Args:
        engines: those that compute; without MuJoCo among them nothing is done. By default it does.

    Raises:
        BackEndError: where MUJOCO_GL names a back end that there is none of, or not here.
    """
    if engines and "mujoco" not in engines:
        return
    try:
        import_module("mujoco")
    # Each back end fails in its own way, from ImportError to AttributeError.
    except Exception as error:
        raise BackEndError(
            f"MUJOCO_GL = {os.environ.get('MUJOCO_GL', '')}: MuJoCo can't be used ({error}); {BACK_ENDS}"
        ) from None


@cache
def drawing_problem() -> str | None:
    """Return None if MuJoCo can draw, else what to install, or what went wrong.

    The first call chooses MuJoCo's back end where the user has not, and draws one frame in a child process;
    the others return what it found. It must come before MuJoCo is first imported, which settles the choice.
    """
    needs_egl = sys.platform == "linux" and "DISPLAY" not in os.environ and not os.environ.get("MUJOCO_GL")
    if needs_egl:
        os.environ["MUJOCO_GL"] = "egl"
    said = drawing_complaint()
    if said is None:
        return TOO_LATE if needs_egl and "mujoco" in sys.modules else None
    # Importing MuJoCo for a back end that is missing would fail too.
    os.environ["MUJOCO_GL"] = "disabled"
    if "invalid value" in said:
        return f"{UNKNOWN} ({said}); {BACK_ENDS}"
    lacks_library = re.search("gl|mesa|signal", said, re.IGNORECASE)
    return f"{ADVICE if lacks_library else UNKNOWN} ({said})"


def drawing_complaint() -> str | None:
    """Return the last thing that a child process says which fails to draw a frame; None where it draws it."""
    # -P: a module of the current folder must not stand in for one of Python's.
    command = [sys.executable, "-P", "-c", DRAW_ONE_FRAME]
    try:
        with stage("checking whether MuJoCo can draw here"):
            tried = subprocess.run(command, capture_output=True, check=False, timeout=120, errors="replace")
    except (OSError, subprocess.TimeoutExpired) as error:
        return str(error)
    if tried.returncode == 0:
        return None
    said = [line for line in tried.stderr.splitlines() if line.strip()]
    return said[-1].strip() if said else f"ended by signal {-tried.returncode}"
