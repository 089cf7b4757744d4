"""The margin of a toss: its change changes the outcome, and a smaller one does not."""

import json

import numpy as np
import pytest

import analytic
from compare.metrics.margin import QUANTITIES, margins
from models.reading import load
from tests.helpers.command_line import cointoss


def by_name(scenario):
    return {margin.quantity.name: margin for margin in margins(scenario)}


def test_every_quantity_has_a_margin_and_what_changes_nothing_has_none():
    found = by_name(load("fig29").replace("floor.restitution", 0.0))
    assert list(found) == [quantity.name for quantity in QUANTITIES]
    assert found["velocity x"].finite is None
    assert 0 < abs(found["height"].change) < 200
    assert 0 < abs(found["spin about ξ"].change) < 20


@pytest.mark.parametrize("name", ["height", "spin about ξ", "attitude about ξ"])
def test_a_change_of_the_margin_changes_the_outcome_and_half_of_it_does_not(name):
    scenario = load("fig29").replace("floor.restitution", 0.3)
    margin = by_name(scenario)[name]
    change = margin.change / margin.quantity.factor
    faces = []
    for part in (0.0, 0.5, 0.999, 1.001):
        release = {
            "height": ("release.position.z", 0.4),
            "spin about ξ": ("release.angular_velocity.xi", 40.0),
            "attitude about ξ": ("release.angles", None),
        }[name]
        value = [0.0, part * change, 0.0] if release[1] is None else release[1] + part * change
        changed = scenario.replace(release[0], value)
        faces.append(analytic.toss(changed).outcome)
    assert faces[0] == faces[1] == faces[2] != faces[3]


def test_a_boundary_that_was_passed_lies_behind():
    scenario = load("fig29").replace("floor.restitution", 0.3)
    ahead = by_name(scenario)["height"].change
    height = 0.4 + 1.1 * ahead / 1e3
    behind = by_name(scenario.replace("release.position.z", height))["height"].change
    assert behind == pytest.approx(-0.1 * ahead, rel=1e-6)


def test_the_command_prints_margins():
    answered = cointoss("toss", "fig29", "--margin")
    assert answered.exit_code == 0
    lines = [line for line in answered.stdout.splitlines() if line.startswith("margin")]
    assert len(lines) == len(QUANTITIES)
    told = json.loads(cointoss("toss", "fig29", "--margin", "--json").stdout)["margin"]
    assert told["velocity x"]["change"] is None
    assert told["height"]["unit"] == "mm"
    assert np.isfinite(told["height"]["change"])
    refused = cointoss("toss", "fig29", "--margin", "--engine", "mujoco")
    assert refused.exit_code == 2
    assert "--margin" in refused.stderr
