"""Whether a geom lies still on another: closed forms of its depth and its creep, and what cannot rest."""

from dataclasses import replace

import numpy as np
import pytest

from cointoss_bounce import bounce, pair_rest
from cointoss_bounce.approach import Pair
from cointoss_bounce.pair_rest import PairRest, rest_between
from cointoss_bounce.recipe import recipe_of
from cointoss_bounce.rest_lines import rest_lines
from cointoss_bounce.unlogged import unlogged
from two_geoms import ALONG_AXES, DT, FLOOR, HARD, SET, ball, model

ROUGH = f'{HARD.geom} condim="3" priority="1"'
SPRING = recipe_of(0.8, DT, 40)
BLOCK = '<geom name="b" type="box" size="0.1 0.1 0.05" {}/>'
BOX = f'<body pos="0 0 1"><freejoint/>{BLOCK}</body>'
STIFFNESS, DAMPING = (-number for number in HARD.solref)
LEFT = 1e-4 * 9.81
"""The part of its weight that the contact leaves to a body, over its mass [m/s²]."""
MESH = '<asset><mesh name="m" vertex="-.1 -.1 0 .1 -.1 0 0 .1 0 0 0 .15"/></asset>'
FIELD = '<asset><hfield name="h" nrow="6" ncol="6" size="1 1 0.1 0.1"/></asset>'


def found(bodies, more="", cone="pyramidal", integrator="implicitfast"):
    given = model(bodies, integrator, more)
    given.opt.cone = ("pyramidal", "elliptic").index(cone)
    return rest_between(Pair(given, 0, 1))


def rest(*described, **options):
    answer = found(*described, **options)
    assert isinstance(answer, PairRest), answer
    return answer


@pytest.mark.parametrize(
    ("body", "share", "points"),
    [
        (ball(ROUGH), 2 / 7, 1),
        (BOX.format(ROUGH), 1, 4),
        (BOX.replace("<freejoint/>", "".join(ALONG_AXES) + '<joint type="ball"/>').format(ROUGH), 1, 4),
    ],
    ids=["ball", "box", "box on slides"],
)
def test_it_lies_still_and_creeps_as_the_damping_of_friction_says(body, share, points):
    """A ball rolls down, and its friction carries 2/7 of the slope's pull; four points carry a box."""
    lying = rest(FLOOR + body, cone="elliptic")
    assert (lying.hop, lying.sinking, lying.drift, lying.rocking) == (0, 0, 0, 0)
    assert lying.depth == pytest.approx(LEFT / STIFFNESS / points, rel=1e-3)
    assert lying.slip == pytest.approx(share * LEFT * lying.slope / DAMPING / points, rel=2e-3)


def test_it_creeps_down_a_plane_that_is_tilted():
    tilted = FLOOR.replace("/>", ' euler="0 10 0"/>')
    lying = rest(tilted + BOX.format(ROUGH), cone="elliptic")
    assert lying.drift == pytest.approx(LEFT * np.sin(np.radians(10)) / DAMPING / 4, rel=2e-3)
    assert lying.slope == 0


def test_without_a_stiffness_it_sinks_and_on_the_hardest_spring_it_hops():
    damped = 'solref="0 -900" solimp="0.9999 0.9999 0.001" condim="1" priority="1"'
    sinking = rest(FLOOR + ball(damped))
    assert sinking.sinking == pytest.approx(LEFT / 900, rel=1e-3)
    assert (sinking.hop, sinking.slope) == (0, 0)
    at_once = rest(FLOOR + ball(damped.replace("-900", f"{-1 / DT}")))
    assert at_once.sinking == pytest.approx(LEFT * DT, rel=1e-3)
    stiff, damping = SPRING.solref
    hard = f'solref="{stiff} {damping}" solimp="0.9999 0.9999 0.001" condim="1" priority="1"'
    assert rest(FLOOR + ball(hard), integrator="RK4").hop > 2e-5


def test_a_mesh_lies_still_and_a_ball_wanders_over_the_prisms_of_a_flat_height_field():
    mesh = f'<body pos="0 0 1"><freejoint/><geom name="b" type="mesh" mesh="m" {ROUGH}/></body>'
    lying = rest(FLOOR + mesh, MESH)
    assert (lying.hop, lying.drift, lying.rocking) == (0, 0, 0)
    wandering = rest('<geom name="a" type="hfield" hfield="h"/>' + ball(ROUGH), FIELD)
    assert wandering.depth == pytest.approx(LEFT / STIFFNESS, rel=1e-2)
    assert wandering.drift > 1e-5
    assert wandering.slope == 0


def test_a_ball_whose_mass_centre_is_off_its_middle_rocks():
    tumbler = ball(ROUGH).replace(
        "<geom", '<inertial pos="0.02 0 -0.05" mass="1" diaginertia="0.004 0.004 0.004"/><geom'
    )
    lying = rest(FLOOR + tumbler)
    assert np.arctan2(0.02, 0.05) < lying.rocking < 1
    assert not lying.rolls


def test_an_ellipsoid_that_rocks_neither_hops_nor_sinks():
    """Its middle rises and sinks by 0.7 mm as it rolls to and fro."""
    egg = (
        BOX.replace('1">', '1" euler="0 10 0">')
        .replace("box", "ellipsoid")
        .replace("0.05", "0.08")
        .format(ROUGH)
    )
    rocking = rest(FLOOR + egg)
    assert (rocking.hop, rocking.sinking, rocking.rolls) == (0, 0, False)
    assert rocking.rocking > 0.1


def test_what_rolls_or_creeps_down_a_slope_does_not_lie_still():
    tilted = FLOOR.replace("/>", ' euler="0 10 0"/>')
    rolling, creeping = (bounce(model(tilted + body), "b", "a") for body in (ball(ROUGH), BOX.format(ROUGH)))
    assert isinstance(rolling.rest, PairRest)
    assert (rolling.rest.rolls, rolling.rest.rocking) == (True, 0)
    assert rolling.rest.drift > 1
    assert "rest        rolls away, " in rest_lines(rolling)
    assert "none, but it turns" in rest_lines(rolling)
    assert "rest        moves along the other geom, " in rest_lines(creeping)
    assert rest_lines(creeping).endswith("rocking     none")
    for sinking, told in (2e-6, "sinks 2 um/s, 5 um deep"), (-2e-6, "rises 2 um/s, 5 um deep"):
        moving = replace(rolling.rest, sinking=sinking, depth=5e-6)
        assert f"rest        {told}" in rest_lines(replace(rolling, rest=moving))


@pytest.mark.parametrize(
    ("bodies", "why"),
    [
        (ball(SET, "0 0 2").replace('"b"', '"a"') + ball(SET), "both are on free bodies"),
        ('<geom name="a" type="box" size="0.1 1 1" pos="1 0 1"/>' + ball(SET), "nothing presses"),
    ],
    ids=["two free bodies", "a wall"],
)
def test_what_nothing_presses_together_is_told(bodies, why):
    assert why in str(found(bodies))


def test_a_coin_that_rises_and_falls_by_a_hundredth_of_its_depth_does_not_hop(monkeypatch):
    """MuJoCo's default contact holds it on a box, in which its middle is 0.11 mm deep by plain steps."""
    monkeypatch.setattr(pair_rest, "STEPS", 2000)
    monkeypatch.setattr(pair_rest, "LOOKED_AT", 500)
    coin = '<geom name="b" type="cylinder" size="0.012 0.001" mass="0.005"/>'
    bodies = '<geom name="a" type="box" size="0.4 0.4 0.025"/>' + BOX.replace(BLOCK, coin)
    lying = rest(bodies)
    assert (lying.hop, lying.sinking) == (0, 0)
    assert lying.depth == pytest.approx(1.1e-4, rel=0.15)
    monkeypatch.setattr(pair_rest, "HOP", 0)
    monkeypatch.setattr(pair_rest, "SINK", 0)
    moving = rest(bodies)
    assert 0.005 < moving.hop / lying.depth < 0.02
    assert moving.sinking != 0


def test_what_rolls_off_the_other_on_a_slope_has_no_slip():
    lying = rest('<geom name="a" type="box" size="0.05 0.05 0.05"/>' + ball(ROUGH))
    assert (lying.slope, np.isnan(lying.slip)) == (0.01, True)


def test_what_falls_off_is_told():
    off = '<geom name="a" type="box" size="0.01 0.01 0.01" pos="0.05 0 0"/>' + ball(SET)
    assert "do not touch any more" in str(found(off))


def test_a_model_that_becomes_unstable_is_told():
    wild = 'solref="-1e20 0" solimp="0.9999 0.9999 0.001" condim="1" priority="1"'
    with unlogged():
        assert "unstable" in str(found(FLOOR + ball(wild)))
