"""A toss as a video: an overview beside a close-up, in slow motion around the impacts."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import errno
from collections.abc import Callable, Iterator
from pathlib import Path

import imageio_ffmpeg
import mediapy
import mujoco
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from coin_mj.scene import build_painted
from coin_mj.state import of_release
from models.ending import face_up
from models.records import Array, States, Toss
from models.scenario import Release, euler_parameters, vector

FRAMES_PER_SECOND = 30
HEIGHT = 480
OVERVIEW_WIDTH, CLOSE_UP_WIDTH = 320, 640
FAST, SLOW = 1 / 4, 1 / 60
"""Speed of the film far from an impact and at one, relative to the clock."""
SLOW_FOR = 0.03
"""How long before and after an impact the film is slowed down [s]."""
LONGEST = 40.0
"""A longer film is sped up to this length [s]."""


def film_times(toss: Toss) -> tuple[Array, Array]:
    """Choose the times of a toss that the film shows.

    Args:
        toss: what to show.

    Returns:
        times: of the frames, increasing from 0 to the end of the toss, (n,) [s].
        speeds: of the film at these times, relative to the clock, (n,).
    """
    # Film time as the integral of 1/speed over the toss, inverted on a fine grid.
    grid = np.unique(np.concatenate([np.linspace(0, toss.end_time, 20_001), toss.impacts.time]))
    if len(toss.impacts):
        nearest = np.abs(grid[:, None] - toss.impacts.time[None, :]).min(axis=1)
    else:
        nearest = np.full(len(grid), np.inf)
    part = np.clip(nearest / SLOW_FOR, 0, 1)
    speed = SLOW + (FAST - SLOW) * part * part * (3 - 2 * part)
    film = np.concatenate([[0.0], np.cumsum(np.diff(grid) * (1 / speed[1:] + 1 / speed[:-1]) / 2)])
    stretch = max(1.0, film[-1] / LONGEST)
    count = max(2, round(film[-1] / stretch * FRAMES_PER_SECOND))
    times = np.interp(np.linspace(0, film[-1], count), film, grid)
    return times, np.interp(times, grid, speed) * stretch


def frames(toss: Toss) -> Iterator[np.ndarray]:
    """Give the frames of a toss's film, (height, width, 3) of uint8.

    Args:
        toss: by either engine; it is drawn by MuJoCo.
    """
    times, speeds = film_times(toss)
    states = toss.sample(times)
    span = _span(toss, states)
    model = build_painted(toss.scenario, span)
    data = mujoco.MjData(model)
    body = toss.scenario.body
    overview, close_up = _overview(states, span), _close_up(toss)
    font = ImageFont.load_default(size=17)
    with (
        mujoco.Renderer(model, HEIGHT, OVERVIEW_WIDTH) as far,
        mujoco.Renderer(model, HEIGHT, CLOSE_UP_WIDTH) as near,
    ):
        for i, (time, speed) in enumerate(zip(times, speeds, strict=True)):
            x, e = vector(states.position[i]), euler_parameters(states.quaternion[i])
            data.qpos[:], data.qvel[:] = of_release(body, Release(position=x, quaternion=e))
            mujoco.mj_forward(model, data)
            close_up.lookat[:] = states.position[i]
            far.update_scene(data, overview)
            # So far from the light the shadow map is too coarse.
            far.scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = False
            near.update_scene(data, close_up)
            frame = np.concatenate([far.render(), near.render()], axis=1)
            up = face_up(states.normal[i, 2])
            hits = int(np.searchsorted(toss.impacts.time, time, side="right"))
            yield _captioned(
                frame,
                font,
                left=f"{toss.engine}   t = {time:.4f} s",
                right=f"{up.name.lower()} up   impacts: {hits}   speed 1/{1 / speed:.0f}",
            )


def write_video(toss: Toss, path: Path, progress: Callable[[int, int], None]) -> None:
    """Write a toss's film as an mp4 file.

    Args:
        toss: by either engine.
        path: of the file.
        progress: called after each frame with their number so far and in all.

    Raises:
        OSError: if the encoder can't write the file.
    """
    mediapy.set_ffmpeg(imageio_ffmpeg.get_ffmpeg_exe())
    count = len(film_times(toss)[0])
    shape = (HEIGHT, OVERVIEW_WIDTH + CLOSE_UP_WIDTH)
    try:
        with mediapy.VideoWriter(str(path), shape, fps=FRAMES_PER_SECOND, crf=21) as writer:
            for number, frame in enumerate(frames(toss), start=1):
                writer.add_image(frame)
                progress(number, count)
    except (RuntimeError, BrokenPipeError) as error:
        # Ctrl-C ends the encoder too, whose complaint would hide it.
        if isinstance(error.__context__, KeyboardInterrupt | SystemExit):
            raise error.__context__ from None
        told = "" if isinstance(error, BrokenPipeError) else str(error).partition("': ")[2].strip()
        reason = told.splitlines()[-1] if told else "stopped, or the disk is full"
        raise OSError(errno.EIO, f"ffmpeg: {reason}", str(path)) from error


def _span(toss: Toss, states: States) -> float:
    """Size of the scene: the height of the path, or twice its width where that is larger [m]."""
    low, high = states.position.min(axis=0), states.position.max(axis=0)
    width = float(np.hypot(high[0] - low[0], high[1] - low[1]))
    return max(float(high[2]), 2 * width, 8 * toss.scenario.coin.radius)


def _overview(states: States, span: float) -> mujoco.MjvCamera:
    """A camera at rest that sees the whole path."""
    middle = (states.position.min(axis=0) + states.position.max(axis=0)) / 2
    camera = mujoco.MjvCamera()
    camera.lookat[:] = (middle[0], middle[1], 0.45 * span)
    camera.distance, camera.azimuth, camera.elevation = 1.9 * span, 90, -9
    return camera


def _close_up(toss: Toss) -> mujoco.MjvCamera:
    """A camera that follows the coin."""
    camera = mujoco.MjvCamera()
    camera.distance, camera.azimuth, camera.elevation = 7 * toss.scenario.coin.radius, 90, -22
    return camera


def _captioned(
    frame: np.ndarray, font: ImageFont.FreeTypeFont | ImageFont.ImageFont, left: str, right: str
) -> np.ndarray:
    image = Image.fromarray(frame)
    draw = ImageDraw.Draw(image)
    for x, text in ((12, left), (OVERVIEW_WIDTH + 12, right)):
        draw.text((x, 10), text, font=font, fill=(25, 30, 40))
    draw.line([(OVERVIEW_WIDTH, 0), (OVERVIEW_WIDTH, HEIGHT)], fill=(255, 255, 255), width=2)
    return np.asarray(image)
