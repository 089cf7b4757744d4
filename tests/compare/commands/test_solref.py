"""`cointoss solref` prints settings with their error."""

import json
import math
import re

import pytest

from tests.helpers.command_line import cointoss


def test_settings_for_a_bounce_are_printed_with_their_error():
    shown = cointoss("solref", "--restitution", 0.8, "--dt", 0.002).stdout
    assert '<option timestep="0.002" integrator="implicitfast"><flag diagexact="enable"/></option>' in shown
    assert 'condim="1" solref="-250.0 -899.75" solimp="0.9999 0.9999 0.001 0.5 2" priority="1"' in shown
    assert re.search(r"^error +5e-04 at worst.*\n +\de-0\d with weight at 2 m/s", shown, re.MULTILINE)
    spring = cointoss("solref", "--restitution", 0.8, "--dt", 0.002, "--spring", "--json")
    found = json.loads(spring.stdout)
    assert (found["integrator"], found["solref"][0]) == ("RK4", pytest.approx(-((math.pi / 0.08) ** 2)))
    assert 1e-4 < found["error"] < 1e-2
    whole = cointoss("solref", "--restitution", 0.5, "--dt", 0.001, "--model").stdout
    assert whole.startswith("<mujoco>")
    assert whole.endswith("</mujoco>\n")


def test_what_a_body_does_at_rest_and_in_flight_is_printed():
    shown = cointoss("solref", "--restitution", 0.8, "--dt", 0.002).stdout
    assert "rest        lies still, 3.92 um deep; n times as deep under n times its weight\n" in shown
    assert (
        "on several points 1/4 to 2 times (1 - d) g/k = 3.92 um, by its shape: --body measures it\n" in shown
    )
    assert "3e-03 with weight at 2 m/s; at v up to 5e-04 + 0.35 g DT/v, while 2 g DT/v" in shown
    assert 'solref="0 -900.0" would be exact, and sink 1.09 um/s at rest\n' in shown
    assert re.search(r"^flight +a brick at 10 turns a second loses 10 % of its energy", shown, re.MULTILINE)
    warp = cointoss("solref", "--restitution", 0.8, "--dt", 0.002, "--backend", "warp").stdout
    assert warp.startswith('<option timestep="0.002" integrator="implicitfast"/>\n')


def test_a_thin_body_is_warned_of():
    thin = cointoss("solref", "--restitution", 0.8, "--dt", 0.002, "--spring", "--body", "box 0.1 0.1 0.002")
    assert "box 0.1 0.1 0.002: a contact at 2 m/s is 46.5 mm deep, and the body is 4 mm thick" in thin.stderr


def test_a_formula_that_fails_is_marked():
    shown = cointoss("solref", "--of", "0.005 0.1", "--dt", 0.002).stdout
    assert "by formula 0.431 mm, which fails here, in a contact of 1 step" in shown
    soft = cointoss("solref", "--of", "0.5 0.05", "--dt", 0.002).stdout
    assert "above 0.43 m/s deeper than half of this ball of 20 mm" in soft
    assert "491 um deep; n times as deep under n times its weight; by formula 491 um deep" in soft


def test_given_settings_are_turned_round():
    asked = ("solref", "--of", "0.01 0.37", "--with", "0.02 1", "--dt", 0.002)
    shown = cointoss(*asked).stdout
    assert 'mixed       solref="0.015 0.685" solimp="0.9 0.95 0.001 0.5 2"\n' in shown
    assert "by formula 0.2155" in shown
    found = json.loads(cointoss(*asked, "--integrator", "RK4", "--solimp", "0.9999 0.9999", "--json").stdout)
    assert "mujoco" in found["versions"]
    assert found["integrator"] == "RK4"
    assert found["formula"]["restitution"] == pytest.approx(0.2155, abs=1e-4)


def test_an_ellipsoid_has_its_article():
    shown = cointoss("solref", "--restitution", 0.8, "--dt", 0.002, "--body", "ellipsoid 0.1 0.1 0.05").stdout
    assert "of an ellipsoid 0.1 0.1 0.05 that touches" in shown
