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


def asked_of(path, *more):
    """Return the command's words that make the map at a path."""
    return "basin", path.parent / "coin.toml", "--x", AXES[0], "--y", AXES[1], "--out", path, *more


def not_read(path, what):
    """Check that no way to read a map accepts it, and that each says so in one line."""
    with pytest.raises((MapError, ScenarioError)) as raised:
        cointoss.read_map(path)
    page = path.parent / "page.html"
    answer = refused("explore", path, "--static", page)
    for said in (str(raised.value), answer.removeprefix("cointoss: ")):
        assert said.startswith(f"{path}: ")
        assert what in said
        assert "accepted: " in said
        assert len(said) < 600
    assert not page.exists()


def rewritten(path, change):
    """Change what describes a map."""
    whole = json.loads((path / "zarr.json").read_text())
    change(whole)
    (path / "zarr.json").write_text(json.dumps(whole))


def described(path, name, **entries):
    """Change entries of an array's description."""
    rewritten(path, lambda all_: all_["consolidated_metadata"]["metadata"][name].update(entries))


def regular(*sizes):
    return {"name": "regular", "configuration": {"chunk_shape": list(sizes)}}
