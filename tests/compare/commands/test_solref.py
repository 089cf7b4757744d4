"""`cointoss solref` prints settings with their error."""

import json
import math
import re

import pytest

from tests.helpers.command_line import cointoss


def test_settings_for_a_bounce_are_printed_with_their_error():
    shown = cointoss("solref", "--restitution", 0.8, "--dt", 0.002).stdout
    assert '<option timestep="0.002" integrator="implicitfast"><flag diagexact="enable"/></option>' in shown
    assert 'solref="0 -900.0" solimp="0.9999 0.9999 0.001 0.5 2" priority="1"' in shown
    assert re.search(r"^error +\de-1\d at worst.*\n +\de-0\d with weight, at 2 m/s", shown, re.MULTILINE)
    spring = cointoss("solref", "--restitution", 0.8, "--dt", 0.002, "--spring", "--json")
    found = json.loads(spring.stdout)
    assert (found["integrator"], found["solref"][0]) == ("RK4", pytest.approx(-((math.pi / 0.08) ** 2)))
    assert 1e-4 < found["error"] < 1e-2
    whole = cointoss("solref", "--restitution", 0.5, "--dt", 0.001, "--model").stdout
    assert whole.startswith("<mujoco>")
    assert whole.endswith("</mujoco>\n")
