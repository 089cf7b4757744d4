"""Joints, tendons, servos and feet: what a touch keeps of speed and energy, against loops of plain steps."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import mujoco
import numpy as np
import pytest

from cointoss_bounce import pair
from cointoss_bounce.approach import Pair
from two_geoms import FLOOR, model

SOFT = 'name="b" condim="3" friction="0.7" solref="0.04 0.5"'
SLIDE = '<joint name="up" type="slide" axis="0 0 1" damping="{}"/>'
LEG = (
    FLOOR + f'<body pos="0 0 1">{SLIDE.format(0)}<geom size="0.05" mass="3" contype="0" conaffinity="0"/>'
    '<body pos="0 0 -0.3" euler="0 {} 0"><joint axis="0 1 0" {}/>'
    f'<geom {SOFT} mass="1" {{}}/></body></body>'
)
BALL = f'<geom {SOFT} size="0.1" mass="1"/></body>'
ON_SLIDE = FLOOR + f'<body pos="0 0 0.3">{SLIDE.format(0)}' + BALL
MODELS = {
    "a damped slide": (FLOOR + f'<body pos="0 0 0.3">{SLIDE.format(20)}' + BALL, ""),
    "a servo": (ON_SLIDE, '<actuator><position joint="up" kp="100" kv="5"/></actuator>'),
    "a tendon": (
        ON_SLIDE,
        '<tendon><fixed stiffness="200" damping="3" springlength="-0.2"><joint joint="up" coef="1"/></fixed>'
        "</tendon>",
    ),
    "a capsule foot": (
        LEG.format(10, 'damping="0.5"', 'type="capsule" fromto="-0.07 0 0 0.14 0 0" size="0.03"'),
        "",
    ),
    "a box foot": (LEG.format(-8, 'damping="0.5"', 'type="box" size="0.1 0.05 0.02" pos="0.03 0 0"'), ""),
    "an ellipsoid foot": (
        LEG.format(5, 'damping="0.1"', 'type="ellipsoid" size="0.12 0.05 0.03" pos="0.05 0 0"'),
        "",
    ),
    "a head": (LEG.format(0, 'damping="0.2"', 'size="0.1" pos="0.2 0 -0.1"'), ""),
    "a toe": (
        LEG.format(
            0, 'stiffness="40" damping="0.4"', 'type="capsule" fromto="0 0 0 0.1 0 -0.06" size="0.02"'
        ),
        "",
    ),
    "a ball in a cup": (
        '<geom name="a" type="box" size="0.2 0.2 0.05" euler="0 15 0"/><body pos="0 0 0.3">'
        '<joint type="slide" axis="1 0 0" damping="2"/>' + SLIDE.format(2) + BALL,
        '<tendon><fixed limited="true" range="-0.3 0"><joint joint="up" coef="1"/></fixed></tendon>',
    ),
    "a gantry": (
        '<geom name="a" type="box" size="0.1 1 2" pos="0.6 0 0"/><body pos="0 0 1">'
        '<joint type="slide" axis="1 0 0" damping="5"/><geom size="0.05" mass="1"/><body>'
        '<joint axis="0 1 0" damping="0.1"/>'
        f'<geom {SOFT} size="0.06" pos="0.1 0 -0.5" mass="0.5"/></body></body>',
        "",
    ),
    "a capsule that rolls": (
        FLOOR + '<body pos="0 0 1" euler="0 8 0"><freejoint/>'
        f'<geom {SOFT} type="capsule" size="0.04" fromto="-0.15 0 0 0.15 0 0" mass="1"/></body>',
        "",
    ),
}


def plainly(given):
    """Return what is kept of speed and energy where plain steps part the points that touched first."""
    plain, data, geom = given.model, given.data, given.two
    plain.opt.enableflags = mujoco.mjtEnableBit.mjENBL_ENERGY
    given.set_apart(1.0, 2.5)
    while not data.ncon:
        mujoco.mj_step(plain, data)
    first = [touch for touch in data.contact if touch.dist <= data.contact.dist.min() / 2]
    at, gap = np.mean([touch.pos for touch in first], axis=0), np.mean([touch.dist for touch in first])
    point, seen = (at - data.geom_xpos[geom]) @ data.geom_xmat[geom].reshape(3, 3), []
    given.set_apart(1.0, 2.5)
    for _ in range(round(0.15 / plain.opt.timestep)):
        mujoco.mj_step(plain, data)
        moved = data.geom_xpos[geom] + data.geom_xmat[geom].reshape(3, 3) @ point - at
        seen.append((gap - given.normal @ moved, data.energy[1]))
    gaps, energies = np.array(seen).T
    met, parted = (np.flatnonzero(np.diff(np.sign(gaps)) == way)[0] for way in (-2, 2))
    middles, around = (gaps[1:] + gaps[:-1]) / 2, slice(parted - 1, parted + 2)
    return [abs(np.interp(0, middles[around], of[around]) / of[met]) for of in (np.diff(gaps), energies[1:])]


def measured(given):
    touches = pair._touches(given, (1.0,))[0]
    return np.mean([(touch.restitution, touch.kept) for touch in touches], axis=0)


def in_the_limit(of, built, dt):
    """Return what two steps, the second half of the first, say of a step that vanishes."""
    coarse, fine = (of(weightless(built, step)) for step in (dt, dt / 2))
    return 2 * np.array(fine) - coarse


def weightless(built, dt):
    built.opt.gravity[:], built.opt.timestep = 0, dt
    return Pair(built, built.geom("a").id, built.geom("b").id)


@pytest.fixture(autouse=True)
def few(monkeypatch):
    monkeypatch.setattr(pair, "PHASES", 2)


@pytest.mark.parametrize("name", MODELS)
def test_speed_and_energy_are_those_at_which_plain_steps_part_the_points(name):
    built = model(MODELS[name][0], more=MODELS[name][1])
    expected = in_the_limit(plainly, built, 1e-4)
    assert in_the_limit(measured, built, 2.5e-4) == pytest.approx(expected, abs=1.2e-4)


def test_a_ball_on_a_damped_slide_has_the_restitution_of_its_equation():
    """In the contact x'' + b x' + k x = 0; it lets go where it would pull, and the slide brakes the rest."""
    width, time, ratio, slide = 0.95, 0.06, 0.3, 20.0
    stiffness, damping = 1 / (width * (time * ratio) ** 2), 2 / (width * time)
    root = np.roots([1, (1 - width) * slide + width * damping, width * stiffness])[0]
    lasts = -np.angle((slide - damping) * root - stiffness) % np.pi / abs(root.imag)
    moved = np.exp(root * lasts) / root.imag
    e = abs((root * moved).imag + slide * moved.imag)
    contact = f'name="b" solref="{time} {ratio}" solimp="{width} {width} 0.001" condim="1" priority="1"'
    text = MODELS["a damped slide"][0].replace(SOFT, contact)
    found = in_the_limit(measured, model(text), 2.5e-4)
    assert found == pytest.approx((e, e**2), rel=3e-5)
