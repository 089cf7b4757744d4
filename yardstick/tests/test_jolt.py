"""The adapter of Jolt hands a toss to node, and takes its states."""

import sys

import numpy as np
import pytest

from adapters.jolt import engine as jolt
from tests.helpers.draws import scenario

NODE = """#!/bin/sh
exec {python} -c "
import json, sys
toss = json.load(sys.stdin)
e = toss['quaternion']
sys.exit('no coin') if toss['mass'] > 1 else None
print(json.dumps([[n * toss['dt'], 0, 0, 0, 0, 0, *e, *toss['spin']] for n in toss['steps']]))"
"""


def test_an_adapter_for_node_hands_it_the_toss_and_takes_its_states(tmp_path, monkeypatch):
    """In place of node: a program that moves 1 m/s along x, and keeps attitude and spin."""
    node, release = tmp_path / "node", {"angles": [0.3, 1.1, 0.2], "angular_velocity": [3.0, -2.0, 9.0]}
    node.write_text(NODE.format(python=sys.executable))
    node.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=":")
    case = scenario(release=release)
    found = jolt.tuned.simulate(case, [0, 0.1004, 0.2])
    assert found["position"] == pytest.approx(np.array([[0, 0, 0], [0.1, 0, 0], [0.2, 0, 0]]))
    assert found["quaternion"] == pytest.approx(np.tile(case.release.attitude, (3, 1)))
    assert found["angular_velocity"] == pytest.approx(np.tile(release["angular_velocity"], (3, 1)))
    with pytest.raises(RuntimeError, match=r"^node: no coin$"):
        jolt.tuned.simulate(case.replace("coin.mass", 2), [0])
