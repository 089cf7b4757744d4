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


TILTED = FLOOR.replace("/>", ' euler="0 10 0"/>')
HARDEST = 'solref="{} {}" solimp="0.9999 0.9999 0.001" condim="1" priority="1"'
EGG = BOX.replace('1">', '1" euler="0 10 0">').replace("box", "ellipsoid").replace("0.05", "0.08")
TUMBLER = ball(ROUGH).replace(
    "<geom", '<inertial pos="0.02 0 -0.05" mass="1" diaginertia="0.004 0.004 0.004"/><geom'
)
ELLIPTIC = {"cone": "elliptic"}
STILL = {"hop": (0, 0), "sinking": (0, 0), "drift": (0, 0), "rocking": (0, 0), "rolls": (0, 0)}
SLOPE = 0.01


def near(value, part):
    return (1 - part) * value, (1 + part) * value


def shared(points, pull):
    """Return the bounds of a body on some points that lies still, and creeps on a slope by this pull."""
    creep = pull * LEFT * SLOPE / DAMPING / points
    return {**STILL, "depth": near(LEFT / STIFFNESS / points, 1e-3), "slip": near(creep, 2e-3)}


LYING = {
    # A ball rolls down, and its friction carries 2/7 of the slope's pull; four points carry a box.
    "ball": (FLOOR + ball(ROUGH), ELLIPTIC, shared(1, 2 / 7)),
    "box": (FLOOR + BOX.format(ROUGH), ELLIPTIC, shared(4, 1)),
    "box on slides": (
        FLOOR + BOX.replace("<freejoint/>", "".join(ALONG_AXES) + '<joint type="ball"/>').format(ROUGH),
        ELLIPTIC,
        shared(4, 1),
    ),
    "box on a tilted plane": (
        TILTED + BOX.format(ROUGH),
        ELLIPTIC,
        {"drift": near(LEFT * np.sin(np.radians(10)) / DAMPING / 4, 2e-3), "slope": (0, 0)},
    ),
    "without a stiffness": (
        FLOOR + ball(HARDEST.format(0, -900)),
        {},
        {"hop": (0, 0), "slope": (0, 0), "sinking": near(LEFT / 900, 1e-3)},
    ),
    "that stops in a step": (
        FLOOR + ball(HARDEST.format(0, -1 / DT)),
        {},
        {"sinking": near(LEFT * DT, 1e-3)},
    ),
    "on the hardest spring": (
        FLOOR + ball(HARDEST.format(*SPRING.solref)),
        {"integrator": "RK4"},
        {"hop": (2e-5, 1)},
    ),
    "mesh": (
        FLOOR + f'<body pos="0 0 1"><freejoint/><geom name="b" type="mesh" mesh="m" {ROUGH}/></body>',
        {"more": MESH},
        {"hop": (0, 0), "drift": (0, 0), "rocking": (0, 0), "slip": (0, 1e-8)},
    ),
    # It wanders over the prisms of a flat field.
    "ball on a height field": (
        '<geom name="a" type="hfield" hfield="h"/>' + ball(ROUGH),
        {"more": FIELD},
        {"depth": near(LEFT / STIFFNESS, 1e-2), "drift": (1e-5, 1), "slope": (0, 0)},
    ),
    "ball off balance": (FLOOR + TUMBLER, {}, {"rocking": (np.arctan2(0.02, 0.05), 1), "rolls": (0, 0)}),
    # Its middle rises and sinks by 0.7 mm as it rolls to and fro.
    "egg": (
        FLOOR + EGG.format(ROUGH),
        {},
        {"hop": (0, 0), "sinking": (0, 0), "rolls": (0, 0), "rocking": (0.1, 9)},
    ),
    "ball on a block, which it leaves on a slope": (
        '<geom name="a" type="box" size="0.05 0.05 0.05"/>' + ball(ROUGH),
        {},
        {"slope": (SLOPE, SLOPE)},
    ),
}


@pytest.mark.parametrize(("bodies", "options", "bounds"), LYING.values(), ids=LYING)
def test_how_it_lies_and_creeps_is_its_closed_form(bodies, options, bounds):
    lying = rest(bodies, **options)
    for name, (low, high) in bounds.items():
        assert low <= getattr(lying, name) <= high, name
    assert np.isnan(lying.slip) == ("slip" not in bounds)


def test_what_rolls_or_creeps_down_a_slope_does_not_lie_still():
    rolling, creeping = (bounce(model(TILTED + body), "b", "a") for body in (ball(ROUGH), BOX.format(ROUGH)))
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
        (
            '<geom name="a" type="box" size="0.01 0.01 0.01" pos="0.05 0 0"/>' + ball(SET),
            "do not touch any more",
        ),
        (FLOOR + ball(HARDEST.format(-1e20, 0)), "unstable"),
    ],
    ids=["two free bodies", "a wall", "falls off", "unstable"],
)
def test_why_it_cannot_rest_is_told(bodies, why):
    with unlogged():
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
