"""Pictures of a toss by MuJoCo's renderer: the coin, and arrows for what the floor does to it."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import itertools
import math
from collections.abc import Sequence
from contextlib import ExitStack
from enum import StrEnum
from typing import NamedTuple

import mujoco
import numpy as np

from cointoss.compare.film.play import Play
from cointoss.compare.film.shadow import add_geom, add_shadow
from cointoss.compare.film.visual_model import build_visual_model
from cointoss.models.records import Array, Ending

IMPULSE_COLOR, FORCE_COLOR = (0.72, 0.10, 0.44), (0.00, 0.45, 0.32)
"""Colours of the arrows: red, green and blue, from 0 to 1."""
LONGEST_NEAR, LONGEST_FAR = 0.23, 0.15
"""Length of the arrow of the toss's largest impulse, in heights of the picture: where the camera follows the
coin, and where it is at rest."""
PUSHES = 0.6
"""The arrow of a force of twice the coin's weight or more, in longest arrows: it is below the coin."""
FAINTEST = 0.6
"""Opacity of a force's arrow where the force is small; it grows with the force."""
THICKEST, THICKNESS = 0.04, 0.15
"""Thickness of an arrow: at most in longest arrows, and in its own length."""
HAND_COLOR, HAND_SIZE = (0.88, 0.68, 0.55), (1.5, 0.1)
"""The palm that catches a coin: its colour, and its radius and half its thickness in the coin's radii."""
HAND_COMES = 0.3, 0.1
"""How long before the catch a hand begins to appear, and how long it takes to appear in full [s]."""
IN_FRONT = 0.6
"""An arrow is drawn in this part of its distance from the camera, before the coin."""
TRAIL_WIDTH, TRAIL_COLOR = 2.0, (0.3, 0.35, 0.4)
"""The path in the pictures of a camera at rest: its width in pixels and its colour."""
MARGIN = 1.1
"""How many times larger the view of a camera at rest is than what it must show."""
FIELD_OF_VIEW = 40.0
"""Vertical field of view of coin.xml's cameras [deg]."""

Color = tuple[float, float, float]


class Camera(StrEnum):
    """From where a toss is looked at; always so far from above that no sky is seen."""

    OVERVIEW = "overview"
    """A camera at rest, from the side; it sees the whole path."""
    CLOSE_UP = "close-up"
    """A camera from the side; it follows the coin."""
    TOP = "top"
    """A camera at rest, from straight above and from afar; it sees the whole path."""


class View(NamedTuple):
    """How a camera looks at what it must show."""

    elevation: float
    """How far it looks down, negative [deg]."""
    aim: float
    """How far below the middle of the picture stands what it aims at, under the captions [heights]."""
    part: float
    """The part of the picture's height that the coin fills, or its whole path where the camera is at rest."""


VIEWS = {
    Camera.OVERVIEW: View(-30.0, aim=0.085, part=0.69),
    Camera.CLOSE_UP: View(-50.0, aim=0.18, part=1 / 3),
    Camera.TOP: View(-90.0, aim=0.15, part=0.54),
}


class Box(NamedTuple):
    """What a camera at rest must see: the coin all along its path, and the floor below."""

    low: Array
    """The lowest coordinates, (3,) [m]."""
    high: Array
    """The highest coordinates, (3,) [m]."""


def box_of(plays: Sequence[Play]) -> Box:
    """Return the box of some tosses of one coin together."""
    paths = np.concatenate([play.states.position for play in plays])
    r = plays[0].toss.scenario.coin.radius
    low, high = paths.min(axis=0) - 2 * r, paths.max(axis=0) + 2 * r
    return Box(np.array([low[0], low[1], -2 * r]), high)


class Drawer(ExitStack):
    """Draws one toss; it holds an OpenGL context until its `with` statement ends."""

    def __init__(self, play: Play, camera: Camera, box: Box, *, height: int, width: int) -> None:
        """Prepare to draw.

        Args:
            play: the toss at the times of the frames.
            camera: from where.
            box: what a camera at rest sees.
            height: of the pictures [pixels].
            width: of the pictures [pixels].
        """
        scenario, r = play.toss.scenario, play.toss.scenario.coin.radius
        self._play = play
        self._follows = camera == Camera.CLOSE_UP
        self._aim = VIEWS[camera].aim
        self._camera, view = _aimed(camera, box, r, width / height)
        self._longest = (LONGEST_NEAR if self._follows else LONGEST_FAR) * view
        far = float(np.linalg.norm(box.high - box.low)) + view
        self._model = build_visual_model(scenario, extent=far, tile=max(2 * r, view / 12))
        if self._camera.orthographic:
            self._model.vis.global_.fovy = view
        self._model.vis.global_.offwidth, self._model.vis.global_.offheight = width, height
        self._data = mujoco.MjData(self._model)
        super().__init__()
        self._renderer = self.enter_context(mujoco.Renderer(self._model, height, width))

    def draw(self, i: int) -> np.ndarray:
        """Draw the picture at one of the times, (height, width, 3) of uint8."""
        self._data.qpos[:] = self._play.qpos[i]
        mujoco.mj_forward(self._model, self._data)
        if self._follows:
            self._camera.lookat[:] = self._play.states.position[i]
        self._renderer.update_scene(self._data, self._camera)
        # What a camera sees moves up, and so the coin in its picture down.
        for eye in self._renderer.scene.camera:
            up = self._aim * (eye.frustum_top - eye.frustum_bottom)
            eye.frustum_top, eye.frustum_bottom = eye.frustum_top + up, eye.frustum_bottom + up
        add_shadow(self._renderer.scene, self._data, self._play.toss.scenario.coin)
        if not self._follows:
            for start, end in itertools.pairwise(self._play.states.position[: i + 1]):
                self._add(mujoco.mjtGeom.mjGEOM_LINE, TRAIL_WIDTH, start, end, TRAIL_COLOR, 0.6)
        self._add_hand(i)
        self._add_arrows(i)
        return self._renderer.render()

    def _add_hand(self, i: int) -> None:
        """Add the hand to which a caught coin comes down, under the coin as it is caught."""
        play, r = self._play, self._play.toss.scenario.coin.radius
        if play.toss.ending != Ending.CAUGHT:
            return
        before, fades_in = HAND_COMES
        alpha = min(1.0, (play.times[i] - play.toss.end_time + before) / fades_in)
        comes_down = np.all(play.states.position[i:, 2] >= play.states.position[-1, 2])
        if alpha > 0 and comes_down:
            below = play.lowest_points[-1, 2] - HAND_SIZE[1] * r
            add_geom(
                self._renderer.scene,
                mujoco.mjtGeom.mjGEOM_CYLINDER,
                (*HAND_COLOR, alpha),
                size=(r * HAND_SIZE[0], r * HAND_SIZE[1], 0.0),
                at=(*play.states.position[-1, :2], below),
            )

    def _add_arrows(self, i: int) -> None:
        play = self._play
        for shown in play.impulses(i):
            self._add_arrow(shown.point, shown.impulse / play.largest_impulse, IMPULSE_COLOR, shown.freshness)
        if play.forces[i].any():
            weight = play.toss.scenario.coin.mass * play.toss.scenario.gravity
            part = play.forces[i] / (2 * weight)
            part /= max(1.0, float(np.linalg.norm(part)))
            size = float(np.linalg.norm(part))
            # It pushes from below: it ends at the point where the floor supports the coin.
            start = play.lowest_points[i] - PUSHES * self._longest * part
            self._add_arrow(start, PUSHES * part, FORCE_COLOR, FAINTEST + (1 - FAINTEST) * size)

    def _add_arrow(self, start: Array, part: Array, color: Color, alpha: float) -> None:
        """Add an arrow that is `part` of the longest, (3,)."""
        start, end = self._in_front(start), self._in_front(start + self._longest * part)
        thickness = min(THICKNESS * float(np.linalg.norm(end - start)), THICKEST * self._longest)
        # MuJoCo draws an arrow at half the length that it is given.
        self._add(mujoco.mjtGeom.mjGEOM_ARROW, thickness, start, 2 * end - start, color, alpha)

    def _in_front(self, place: Array) -> Array:
        """Bring a place nearer to the camera in its line of sight, where the coin does not hide it."""
        left, right = self._renderer.scene.camera
        if self._camera.orthographic:
            return place - self._longest * np.array(left.forward)
        eye = (np.array(left.pos) + np.array(right.pos)) / 2
        return eye + IN_FRONT * (place - eye)

    def _add(
        self, kind: mujoco.mjtGeom, thickness: float, start: Array, end: Array, color: Color, alpha: float
    ) -> None:
        mujoco.mjv_connector(
            add_geom(self._renderer.scene, kind, (*color, alpha)), kind, thickness, start, end
        )


def _aimed(camera: Camera, box: Box, r: float, aspect: float) -> tuple[mujoco.MjvCamera, float]:
    """Aim a camera; give it, and the height that it sees where it looks [m]."""
    aimed, view, tangent = mujoco.MjvCamera(), VIEWS[camera], math.tan(math.radians(FIELD_OF_VIEW / 2))
    aimed.azimuth, aimed.elevation = 90.0, view.elevation
    aimed.lookat[:] = (box.low + box.high) / 2
    if camera == Camera.CLOSE_UP:
        seen = 2 * r / view.part * max(1.0, 1 / aspect)
        aimed.distance = seen / 2 / tangent
        return aimed, seen
    # The box's corners from its middle: to the right, to the back, up.
    x, y, z = (np.array(list(itertools.product((-1, 1), repeat=3))) * (box.high - box.low) / 2).T
    c, s = math.cos(math.radians(view.elevation)), math.sin(math.radians(view.elevation))
    above, nearer = z * c - y * s, -y * c - z * s
    half = np.maximum(np.abs(above) / view.part, np.abs(x) / aspect)
    if camera == Camera.TOP:
        # From afar: a near camera would show a higher coin larger.
        aimed.distance, aimed.orthographic = np.ptp(nearer), 1
        return aimed, 2 * MARGIN * half.max()
    aimed.distance = MARGIN * float(np.max(nearer + half / tangent))
    return aimed, 2 * aimed.distance * tangent
