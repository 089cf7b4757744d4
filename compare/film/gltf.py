"""A toss as a scene of glTF: the coin, a floor, and the path as an animation, in one binary file."""

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np

from cointoss.compare.engines import EngineSettings
from cointoss.compare.film.filmed import followed
from cointoss.compare.film.keyframes import keyframes
from cointoss.compare.output.files import write_bytes
from cointoss.compare.output.style import GRID, LETTERS
from cointoss.models.certificate import turned
from cointoss.models.distribution import versions_of
from cointoss.models.palette import HEADS, TAILS
from cointoss.models.records import Array, Face, Toss
from cointoss.models.scenario import Coin

SEGMENTS = 96
"""Of the rim."""
SKIN = 0.004
"""Half the least thickness that is drawn, and how far letters stand out of a face [radii]."""
AROUND = 4.0
"""How far the floor goes on beyond the path [radii]."""
COLORS = {"rim": "#9aa1ab", "heads": HEADS, "H": "#2a1a00", "tails": TAILS, "T": "#ffffff", "floor": GRID}
"""The materials, and their colours."""
_UPRIGHT = np.array([[-1, 0, 0, 1], [1, 0, 0, 1], [0, 1, -1, 0], [0, 1, 1, 0]]) / 2**0.5
"""Of Euler parameters, scalar first, makes those of glTF, scalar last, in axes with y up."""
_FLOAT, _VERTICES, _JSON, _BIN = 5126, 34962, 0x4E4F534A, 0x004E4942
"""Codes of glTF."""


def write_gltf(path: Path, toss: Toss, settings: EngineSettings | None = None) -> None:
    """Write a .glb file of a toss, `followed` until the coin lies still.

    Raises:
        UnsupportedError: for a toss that takes too many poses, see `keyframes`.
        UnwritableError: naming the file and why.
    """
    write_bytes(path, gltf(toss, followed(toss, settings).longest))


def gltf(toss: Toss, motion: Toss | None = None) -> bytes:
    """Return a toss as the content of a .glb file, glTF 2.0: in metres and seconds, y up, z to the viewer.

    The origin of the node `coin` is the mass centre. Its `extras` say how the toss ended, how far its
    animation misses at most between two poses [m], and for each impact when and where the coin touched, which
    face was up, and the impulse [N s].

    Args:
        toss: by either engine.
        motion: the same toss, followed further; by default the path ends with `toss`.

    Raises:
        UnsupportedError: for a toss that takes too many poses, see `keyframes`.
    """
    motion = motion or toss
    states, error = keyframes(motion)
    places, turns = _y_up(states.position), states.quaternion @ _UPRIGHT
    parts = [*_coin(toss.scenario.coin), _floor(states.position, toss.scenario.coin.radius)]
    *coin, floor = [
        {"attributes": {"POSITION": 3 + 2 * i, "NORMAL": 4 + 2 * i}, "material": i} for i in range(len(parts))
    ]
    moves = {"translation": places, "rotation": turns}
    start = {name: values[0].tolist() for name, values in moves.items()}
    document = {
        "asset": {
            "version": "2.0",
            "generator": f"cointoss {versions_of(['cointoss'])['cointoss']}",
            "extras": {"scenario": toss.scenario.to_toml()},
        },
        "scene": 0,
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [
            {"name": "coin", "mesh": 0, **start, "extras": _told(toss, motion, error)},
            {"name": "floor", "mesh": 1, "rotation": _UPRIGHT[0].tolist()},
        ],
        "meshes": [{"name": "coin", "primitives": coin}, {"name": "floor", "primitives": [floor]}],
        "materials": [_material(name) for name in COLORS],
        "animations": [
            {
                "name": "toss",
                "samplers": [{"input": 0, "output": 1 + i} for i in range(len(moves))],
                "channels": [
                    {"sampler": i, "target": {"node": 0, "path": name}} for i, name in enumerate(moves)
                ],
            }
        ],
    }
    shape = [half for part in parts for half in np.split(part, 2, axis=1)]
    return _binary(document, [states.time[:, np.newaxis], *moves.values()], shape)


def _told(toss: Toss, motion: Toss, error: float) -> dict[str, Any]:
    """Return what the file says of a toss in words and numbers, vectors in the axes of glTF."""
    impacts, center = motion.impacts, np.array(toss.scenario.coin.center_of_mass)
    points = _y_up(impacts.position + turned(impacts.quaternion, impacts.point - center))
    columns = impacts.time, map(Face, impacts.face), points, _y_up(impacts.impulse)
    return {
        "engine": toss.engine,
        "outcome": str(toss.outcome),
        "sequence": toss.sequence,
        "end_time": toss.end_time,
        "interpolation_error": error,
        "impacts": [
            {"time": float(time), "face": face.symbol, "point": point.tolist(), "impulse": impulse.tolist()}
            for time, face, point, impulse in zip(*columns, strict=True)
        ],
    }


def _y_up(vectors: Array) -> Array:
    """Return vectors of the space frame, (n, 3), in the axes of glTF: x, z, -y."""
    return vectors[:, [0, 2, 1]] * [1.0, 1.0, -1.0]


def _coin(coin: Coin) -> list[Array]:
    """Return rim, heads, H, tails and T: rows of a vertex, from C in body axes, and its normal."""
    angles = np.linspace(0, 2 * np.pi, SEGMENTS, endpoint=False)
    ring = np.column_stack([np.cos(angles), np.sin(angles)])
    half = max(coin.thickness / 2 / coin.radius, SKIN)
    parts = [_wall(ring, half)]
    for letter, side in ("H", 1), ("T", -1):
        boxes = [_flat(_rectangle(*box), side * (half + SKIN), side) for box in LETTERS[letter]]
        parts += [_flat(ring, side * half, side), np.concatenate(boxes)]
    center = [*coin.center_of_mass, 0, 0, 0]
    return [part * ([coin.radius] * 3 + [1] * 3) - center for part in parts]


def _rectangle(x: float, y: float, width: float, height: float) -> Array:
    """Return the corners of a rectangle, given half its sizes, (4, 2)."""
    return np.array([x, y]) + np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]]) * [width, height]


def _flat(outline: Array, height: float, side: int) -> Array:
    """Return the triangles of a convex polygon, (k, 2), that faces up, or down where `side` is -1."""
    after = np.arange(1, len(outline) - 1)
    corners = outline[np.column_stack([0 * after, after, after + 1])[:, ::side].ravel()]
    return np.column_stack([corners, np.broadcast_to([height, 0, 0, side], (len(corners), 4))])


def _wall(ring: Array, half: float) -> Array:
    """Return the triangles of a cylinder's wall, from -half to half."""
    along = (ring, -half), (after := np.roll(ring, -1, axis=0), -half), (after, half), (ring, half)
    a, b, c, d = (np.column_stack([xy, np.full(len(xy), z), xy, np.zeros(len(xy))]) for xy, z in along)
    return np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 6)


def _floor(path: Array, radius: float) -> Array:
    """Return the floor under a path, which goes on around it, in the space frame."""
    low, high = path.min(axis=0)[:2] - AROUND * radius, path.max(axis=0)[:2] + AROUND * radius
    return _flat(_rectangle(*(low + high) / 2, *(high - low) / 2), 0.0, 1)


def _material(name: str) -> dict[str, Any]:
    """Return a material, whose colour glTF has in linear parts."""
    parts = [int(COLORS[name][i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return {
        "name": name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [*linear, 1.0],
            "metallicFactor": 0.0,
            "roughnessFactor": 0.5,
        },
    }


def _binary(document: dict[str, Any], motion: list[Array], shape: list[Array]) -> bytes:
    """Return a .glb file of a document and its numbers, an accessor each, those of the motion first."""
    arrays = [each.astype("<f4") for each in (*motion, *shape)]
    sizes = [each.nbytes for each in arrays]
    starts = np.cumsum([0, *sizes]).tolist()
    targets = [{}] * len(motion) + [{"target": _VERTICES}] * len(shape)
    document = {
        **document,
        "buffers": [{"byteLength": starts[-1]}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": start, "byteLength": size, **target}
            for start, size, target in zip(starts, sizes, targets, strict=False)
        ],
        "accessors": [
            {
                "bufferView": i,
                "componentType": _FLOAT,
                "count": len(each),
                "type": {1: "SCALAR", 3: "VEC3", 4: "VEC4"}[each.shape[1]],
                "min": each.min(axis=0).tolist(),
                "max": each.max(axis=0).tolist(),
            }
            for i, each in enumerate(arrays)
        ],
    }
    text = json.dumps(document, allow_nan=False).encode()
    text += b" " * (-len(text) % 4)
    held = b"".join(each.tobytes() for each in arrays)
    chunks = b"".join(
        struct.pack("<2I", len(chunk), kind) + chunk for kind, chunk in ((_JSON, text), (_BIN, held))
    )
    return struct.pack("<4s2I", b"glTF", 2, 12 + len(chunks)) + chunks
