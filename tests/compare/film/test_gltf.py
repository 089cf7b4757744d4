"""A toss as a file of glTF, read back by pygltflib: coin, poses, impacts, and the error that it states."""

from typing import Any

import numpy as np
import pytest
from pygltflib import ARRAY_BUFFER, FLOAT, GLTF2
from scipy.spatial.transform import Rotation, Slerp

import cointoss
from cointoss.compare.film import keyframes
from cointoss.compare.film.filmed import followed
from cointoss.compare.film.gltf import gltf
from cointoss.models.palette import HEADS, TAILS
from tests.helpers.command_line import printed

UPRIGHT = Rotation.from_euler("x", -90, degrees=True)
"""From axes with z up to those with y up, x kept."""
SIZES = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}
TOSSES = {
    "analytic": ("table", "analytic"),
    "MuJoCo": ("table", "mujoco"),
    "mass centre aside": (
        cointoss.load("table").replace("coin.center_of_mass", [1e-3, -5e-4, 2e-4]),
        "analytic",
    ),
    # In a quarter of the time between two of the even poses it turns once, and hardly falls.
    "whole turns": (
        cointoss.load("fig24a").replace(
            *("gravity", 1e-3, "release.angular_velocity", [0, 0, 2080 * np.pi], "ending.max_time", 0.05),
            *("release.position", [0, 0, 0.2], "air", {}),
        ),
        "analytic",
    ),
}


class Shown:
    """A toss that is shown, and its file as pygltflib has it."""

    def __init__(self, motion, content):
        self.motion, self.coin = motion, motion.scenario.coin
        self.file: Any = GLTF2.load_from_bytes(content)
        (animation,) = self.file.animations
        by_path = {one.target.path: animation.samplers[one.sampler] for one in animation.channels}
        self.times = self.numbers(by_path["translation"].input)[:, 0]
        self.places, turns = (self.numbers(by_path[path].output) for path in ("translation", "rotation"))
        self.turns = Rotation.from_quat(turns)
        self.nodes = {node.name: node for node in self.file.nodes}

    def numbers(self, index):
        accessor = self.file.accessors[index]
        assert accessor.componentType == FLOAT
        start, size = self.file.bufferViews[accessor.bufferView].byteOffset, SIZES[accessor.type]
        held = np.frombuffer(self.file.binary_blob(), "<f4", accessor.count * size, start)
        return held.reshape(accessor.count, size).astype(float)

    def part(self, name):
        """Return the vertices of the part of a material from B in radii, and their normals."""
        (primitive,) = (
            one
            for mesh in self.file.meshes
            for one in mesh.primitives
            if self.file.materials[one.material].name == name
        )
        points, normals = map(self.numbers, (primitive.attributes.POSITION, primitive.attributes.NORMAL))
        return (points + self.coin.center_of_mass) / self.coin.radius, normals

    def states(self, times):
        """Return the places and turns of the toss itself in axes with y up."""
        found = self.motion.sample(times)
        turns = Rotation.from_quat(found.quaternion.copy(), scalar_first=True)
        return UPRIGHT.apply(found.position.copy()), UPRIGHT * turns


@pytest.fixture(scope="module", params=TOSSES)
def shown(request):
    toss = cointoss.toss(*TOSSES[request.param])
    motion = followed(toss).longest
    return Shown(motion, gltf(toss, motion))


def test_each_pose_is_that_of_the_toss(shown):
    """To a millionth of a radius: single precision tells apart 8e-9 m at these heights, and turns by 1e-7."""
    assert np.diff(shown.times).min() > 0
    assert (shown.times[0], shown.times[-1]) == (0, pytest.approx(shown.motion.path_end, rel=2e-7))
    places, turns = shown.states(shown.times)
    assert np.abs(places - shown.places).max() <= 1e-6 * shown.coin.radius
    assert (turns.inv() * shown.turns).magnitude().max() <= 1e-6
    assert shown.nodes["coin"].translation == pytest.approx(shown.places[0], abs=1e-8)
    assert (turns[0].inv() * Rotation.from_quat(shown.nodes["coin"].rotation)).magnitude() <= 1e-6


def test_between_two_poses_the_coin_is_missed_by_no_more_than_the_file_says(shown):
    error, radius = shown.nodes["coin"].extras["interpolation_error"], shown.coin.radius
    times = np.sort(np.random.default_rng(0).uniform(0, shown.times[-1], 20_000))
    places, turns = shown.states(times)
    between = np.stack([np.interp(times, shown.times, along) for along in shown.places.T], axis=1)
    points = [radius * point - shown.coin.center_of_mass for point in shown.part("rim")[0][::60]]
    turning = Slerp(shown.times, shown.turns)(times)
    missed = [between + turning.apply(point) - places - turns.apply(point) for point in points]
    largest = np.linalg.norm(missed, axis=-1).max()
    assert error / 10 < largest <= error + 1e-6 * radius
    assert error <= keyframes.MISSES * radius


def test_the_coin_has_two_faces_with_their_letters_and_a_rim_that_face_outwards(shown):
    half = shown.coin.thickness / 2 / shown.coin.radius
    areas = {}
    for name, side in {"rim": 0, "heads": 1, "H": 1, "tails": -1, "T": -1}.items():
        points, normals = shown.part(name)
        a, b, c = (points[i::3] for i in range(3))
        across = np.cross(b - a, c - a)
        areas[name] = np.linalg.norm(across, axis=1).sum() / 2
        assert (np.sum(across * normals[::3], axis=1) > 0).all()
        if side:
            assert normals == pytest.approx(np.broadcast_to([0, 0, side], normals.shape))
            # A letter stands out where a depth of 24 bits sees it.
            out = side * points[:, 2] - half
            assert (out > 1e-3).all() if name in "HT" else out == pytest.approx(0 * out, abs=1e-6)
        else:
            assert normals[:, :2] == pytest.approx(points[:, :2], abs=1e-5)
            assert np.ptp(points[:, 2]) == pytest.approx(2 * half, abs=1e-6)
    # A polygon of 96 sides lacks a thousandth of the circle; a letter is made of bars.
    assert areas["heads"] == areas["tails"] == pytest.approx(np.pi, rel=1e-3)
    assert areas["rim"] == pytest.approx(4 * np.pi * half, rel=1e-3)
    bars = {"H": 2 * 0.2 * 1.0 + 0.68 * 0.2, "T": 0.88 * 0.2 + 0.2 * 1.0}
    assert {name: areas[name] for name in bars} == pytest.approx(bars, rel=1e-5)


def test_the_faces_have_their_colours_in_linear_parts(shown):
    for name, color in {"heads": HEADS, "tails": TAILS, "T": "#ffffff"}.items():
        (material,) = (one for one in shown.file.materials if one.name == name)
        linear = np.array(material.pbrMetallicRoughness.baseColorFactor[:3])
        parts = np.where(linear > 0.0031308, 1.055 * linear ** (1 / 2.4) - 0.055, 12.92 * linear)
        assert (255 * parts).round().astype(int).tolist() == list(bytes.fromhex(color[1:]))


def test_the_impacts_are_told_in_the_same_axes(shown):
    told, impacts = shown.nodes["coin"].extras["impacts"], shown.motion.impacts
    assert [(one["time"], one["face"]) for one in told] == [*zip(impacts.time, impacts.sequence, strict=True)]
    assert [one["impulse"] for one in told] == [
        pytest.approx(S, abs=1e-12) for S in UPRIGHT.apply(impacts.impulse.copy()).reshape(-1, 3)
    ]
    # The point that touches is on the floor, which is the plane y = 0.
    assert all(abs(one["point"][1]) < 1e-6 * shown.coin.radius for one in told)
    assert all(
        np.linalg.norm(one["point"] - UPRIGHT.apply(place)) < 1.1 * shown.coin.radius
        for one, place in zip(told, impacts.position.copy(), strict=True)
    )


def test_the_floor_lies_under_the_whole_path(shown):
    (primitive,) = shown.file.meshes[shown.nodes["floor"].mesh].primitives
    turn = Rotation.from_quat(shown.nodes["floor"].rotation)
    points = turn.apply(shown.numbers(primitive.attributes.POSITION))
    assert turn.apply(shown.numbers(primitive.attributes.NORMAL)) == pytest.approx(
        np.tile([0, 1, 0], (6, 1)), abs=1e-7
    )
    assert np.abs(points[:, 1]).max() < 1e-7
    around = shown.coin.radius
    assert (points.min(axis=0) < shown.places.min(axis=0) - around)[[0, 2]].all()
    assert (points.max(axis=0) > shown.places.max(axis=0) + around)[[0, 2]].all()


def test_the_file_says_what_was_tossed_and_its_vertices_are_marked():
    toss = cointoss.toss("table")
    file = Shown(toss, toss.to_gltf()).file
    assert cointoss.parse(file.asset.extras["scenario"], "here") == cointoss.load("table")
    told = file.nodes[0].extras
    assert [told[name] for name in ("engine", "outcome", "end_time", "sequence")] == [
        *("analytic", "heads", toss.end_time, toss.sequence)
    ]
    targets = [view.target for view in file.bufferViews]
    assert targets == [None] * 3 + [ARRAY_BUFFER] * (len(targets) - 3)


@pytest.mark.parametrize(
    "words",
    [
        "toss fig24a --engine analytic",
        "toss fig24a --engine mujoco",
        "find fig24a --outcome tails --vary height=0.2:0.4 --tosses 32",
    ],
)
def test_a_command_writes_the_toss_beyond_its_end(tmp_path, words):
    target = tmp_path / "toss.GLB"
    printed(*words.split(), "--gltf", target)
    found = Shown(cointoss.toss("fig24a"), target.read_bytes())
    told = found.nodes["coin"].extras
    assert found.times[-1] > told["end_time"]
    assert told["outcome"] == ("tails" if "tails" in words else "heads")
    side = {"heads": 1, "tails": -1}[told["outcome"]]
    assert side * found.turns[-1].apply([0, 0, 1])[1] > 0.9
