"""A map on disk as a stranger may have changed it, and the check that nothing accepts it."""

import json

import pytest

import cointoss
from cointoss.compare.sweep.errors import MapError
from cointoss.models.errors import ScenarioError
from tests.helpers.command_line import refused

X, Y = "release.angular_velocity.eta", "release.position.z"
AXES = (f"{X}=20:60:12", f"{Y}=0.2:0.6:10")
CHUNKS = {X: "c/0", Y: "c/0", "outcome": "c/0/0", "impacts": "c/0/0", "margin": "c/0/0"}
GIGABYTES = 1 << 40
NO_MAP = "is no map of cointoss ("


def is_refused(path, what=NO_MAP):
    """Check that no way to read or to continue a map accepts it, and that each says so in one line."""
    with pytest.raises((MapError, ScenarioError)) as raised:
        cointoss.read_map(path)
    page = path.parent / "page.html"
    asked = path.parent / "coin.toml", "--x", AXES[0], "--y", AXES[1], "--margin", "height", "--out", path
    answers = [refused("explore", path, "--static", page), refused("basin", *asked, "--resume")]
    assert str(raised.value).startswith(f"{path}: ")
    for answer in answers:
        assert answer.startswith(f"cointoss: {path}: ")
        assert answer.count(str(path)) == 1
        assert "accepted: " in answer
        assert len(answer) < 600
    assert what in str(raised.value)
    assert what in answers[0]
    assert not page.exists()
    return answers[1]


def described(path, name):
    """Change entries of an array's description, there and where the map repeats it."""

    def change(**entries):
        for file, part in ((path / name / "zarr.json", False), (path / "zarr.json", True)):
            whole = json.loads(file.read_text())
            (whole["consolidated_metadata"]["metadata"][name] if part else whole).update(entries)
            file.write_text(json.dumps(whole))

    return change


def regular(*sizes):
    return {"name": "regular", "configuration": {"chunk_shape": list(sizes)}}
