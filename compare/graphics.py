"""Whether MuJoCo can draw here, found out in a child process.

Where an OpenGL library is missing, MuJoCo's binding fails late, some of its back ends by ending the process;
and it chooses its back end once, when it is first imported.
"""

import os
import subprocess
import sys

_DRAW_ONE_FRAME = """
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


def drawing_problem() -> str | None:
    """Choose MuJoCo's back end where the user has not, and draw one frame in a child process.

    Call it before MuJoCo is first imported.

    Returns:
        None if drawing works, else what to install.
    """
    if sys.platform == "linux" and "DISPLAY" not in os.environ:
        os.environ.setdefault("MUJOCO_GL", "egl")
    tried = subprocess.run(
        [sys.executable, "-c", _DRAW_ONE_FRAME], capture_output=True, check=False, timeout=120
    )
    if tried.returncode == 0:
        return None
    # Without the library, importing MuJoCo for EGL would fail too.
    if os.environ.get("MUJOCO_GL") == "egl":
        os.environ["MUJOCO_GL"] = "disabled"
    return ADVICE
