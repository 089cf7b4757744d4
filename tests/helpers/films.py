"""Tosses made by formulas, and pictures of them."""

import re
import subprocess
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

import imageio_ffmpeg
import numpy as np

from cointoss.compare.film.drawing import Drawer, box_of
from cointoss.compare.film.filmed import Filmed
from cointoss.compare.film.play import play_of
from cointoss.models.records import IMPACT_ROW, Array, Ending, Face, Impacts, Outcome, States, Toss, TrustEnd
from tests.helpers.draws import ZLOTY, scenario

FLAT, TURNED = (1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0)
UPRIGHT = (0.5**0.5, 0.5**0.5, 0.0, 0.0)


@dataclass(frozen=True, kw_only=True)
class MadePath:
    """A path at constant attitude: position + velocity t + acceleration t²/2, from `start` on."""

    position: tuple[float, float, float]
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    acceleration: tuple[float, float, float] = (0.0, 0.0, 0.0)
    quaternion: tuple[float, float, float, float] = FLAT
    start: float = 0.0
    force: tuple[float, float, float] = (0.0, 0.0, ZLOTY["mass"] * 9.81)

    def floor_force(self, times: Array) -> Array:
        return np.tile(self.force, (len(times), 1))

    def sample(self, times: Array) -> States:
        x, v, a = (np.array(part) for part in (self.position, self.velocity, self.acceleration))
        t = np.maximum(times - self.start, 0.0)[:, None]
        return States(
            time=times.copy(),
            position=x + v * t + a * t * t / 2,
            velocity=np.where(t > 0, v + a * t, 0.0) if self.start else v + a * t,
            quaternion=np.tile(self.quaternion, (len(times), 1)),
            angular_velocity=np.zeros((len(times), 3)),
        )


def made(
    path,
    *,
    impacts=(),
    contacts=(),
    end=1.0,
    engine="mujoco",
    outcome=Outcome.HEADS,
    ending=Ending.SETTLED,
    **parts,
):
    """Make a toss: a path, impacts as (time, S_z) below the coin, and sustained contacts."""
    rows = np.zeros(len(impacts), IMPACT_ROW)
    for row, (time, S_z) in zip(rows, impacts, strict=True):
        row["time"], row["impulse"], row["face"] = time, (0, 0, S_z), Face.HEADS
        row["position"] = path.sample(np.array([time])).position[0]
        row["quaternion"] = path.quaternion
        row["point"] = (0, 0, -ZLOTY["thickness"] / 2)
    return Toss(
        engine=engine,
        scenario=scenario(**parts),
        impacts=Impacts.from_rows(rows),
        contacts=np.array(contacts, dtype=float).reshape(-1, 2),
        outcome=outcome,
        ending=ending,
        end_time=end,
        outcome_certain=None,
        other_outcome=None,
        trusted_impacts=0,
        trust_end=TrustEnd.ERRORS if impacts else TrustEnd.NONE,
        certificate=(),
        path=path,
    )


def struck():
    """Return a toss with one impact, 60° along the rim, of which each number is told in units of its own."""
    toss = made(MadePath(position=(0, 0, 0.2)), impacts=[(0.5, 2.5e-3)], ending=Ending.LYING)
    point = ZLOTY["radius"] * np.array([[0.5, 0.75**0.5, 0.0]])
    energies = {"energy": np.array([1.25e-3]), "energy_change": np.array([-5e-4])}
    return replace(toss, impacts=replace(toss.impacts, point=point, **energies))


def shown(toss):
    """Film a toss up to its ending."""
    return Filmed(toss=toss, motion=toss)


def drawn(toss, times, camera, *, height=48, width=64, box=None):
    """Draw a toss at some times."""
    play = play_of(shown(toss), np.array(times))
    with Drawer(play, camera, box or box_of([play]), height=height, width=width) as drawer:
        return [drawer.draw(i).astype(int) for i in range(len(times))]


class Written(NamedTuple):
    """A film in a file, played from its first frame to its last."""

    codec: str
    size: tuple[int, int]
    """Width and height."""
    rate: float
    """Frames a second."""
    frames: int


def film_written(path: Path) -> Written:
    """Return what ffmpeg tells of a film that it plays to the end."""
    play = [imageio_ffmpeg.get_ffmpeg_exe(), "-hide_banner", "-i", str(path), "-f", "null", "-"]
    told = subprocess.run(play, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=True).stderr
    stream = re.search(r"Video: (\w+).*?, (\d+)x(\d+).*?, ([\d.]+) fps", told)
    assert stream, told
    codec, width, height, rate = stream.groups()
    frames = re.findall(r"frame= *(\d+)", told)[-1]
    return Written(codec, (int(width), int(height)), float(rate), int(frames))


def golden(picture):
    return (picture[..., 0] > picture[..., 2] + 60) & (picture[..., 1] > picture[..., 2] + 30)


def blue(picture):
    return picture[..., 2] > picture[..., 0] + 60


def pink(picture):
    return (picture[..., 0] > picture[..., 1] + 60) & (picture[..., 2] > picture[..., 1] + 30)


def green(picture):
    return (picture[..., 1] > picture[..., 0] + 50) & (picture[..., 1] > picture[..., 2] + 15)


def center(mask):
    """Give the mean row and column of a mask that is not empty."""
    assert mask.any()
    return np.argwhere(mask).mean(axis=0)
