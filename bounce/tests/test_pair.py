"""Two geoms of a user's model: closed forms of their restitution, and what is refused."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import mujoco
import numpy as np
import pytest

from cointoss_bounce import bounce, pair
from cointoss_bounce.approach import Pair
from cointoss_bounce.bounce_lines import bounce_table
from cointoss_bounce.pair import PairOutcome
from cointoss_bounce.recipe import recipe_of
from two_geoms import ALONG_AXES, DT, FLOOR, HARD, SET, ball, model, rebound, thrown

ROD = (
    '<body><joint type="hinge" axis="0 1 0"/>'
    '<geom name="a" type="capsule" fromto="0 0 0 0 0 -1" size="0.05" mass="1"/></body>'
)
PAIRS = {
    "a ball on a plane": FLOOR + ball(SET),
    "a ball on a ball": '<body><freejoint/><geom name="a" size="0.3"/></body>' + ball(SET),
    "a ball far off": FLOOR + ball(SET, "0 0 50"),
    "a ball that starts in the plane": FLOOR + ball(SET, "0 0 0.03"),
    "a box flat on a plane": FLOOR
    + f'<body pos="0 0 1"><freejoint/><geom name="b" type="box" size="0.1 0.2 0.05" {SET}/></body>',
    "a ball on a rod that is hinged": ROD + ball(SET, "1 0 -0.8"),
    "a rod that is hinged on a wall": ROD
    + f'<geom name="b" type="box" size="0.1 1 1" pos="0.6 0 -0.9" {SET}/>',
    "a capsule on an ellipsoid": '<geom name="a" type="ellipsoid" size="0.5 0.4 0.2"/>'
    + f'<body pos="0 0 1"><freejoint/><geom name="b" type="capsule" size="0.05 0.2" {SET}/></body>',
    "a ball with a margin": FLOOR + ball(SET + ' margin="0.01"'),
    "the second geom moves": FLOOR.replace('"a"', '"b"') + ball(SET).replace('"b"', '"a"'),
    "a ball on a ball that lies on a table": FLOOR.replace('"a"', '"table"')
    + ball("", "0 0 0.1").replace('"b"', '"a"')
    + ball(SET),
    "a ball that a pair of its own holds": FLOOR
    + ball("")
    + ball("", "0 0 3").replace('"b"', '"c"')
    + f'</worldbody><contact><pair geom1="a" geom2="b" condim="1" {HARD.geom}/>'
    '<pair geom1="a" geom2="c"/></contact><worldbody>',
}


QUICK = (
    *list(PAIRS)[-2:],
    "a ball on a ball",
    "a ball far off",
    "a ball on a rod that is hinged",
    "a box flat on a plane",
)


@pytest.mark.parametrize(
    "name", [name if name in QUICK else pytest.param(name, marks=pytest.mark.long) for name in PAIRS]
)
def test_geoms_rebound_with_the_restitution_that_is_set(name):
    found = bounce(model(PAIRS[name]), "a", "b")
    # Half of the stiffness's part, and what bodies turn in a step: 2 ms at up to 2 m/s over about 1 m.
    assert found.restitutions[:5] == pytest.approx(0.8, abs=6e-3 if "hinged" in name else 6e-4)
    assert found.durations == pytest.approx(DT, rel=1e-12)
    assert np.diff(found.restitutions, axis=1).any()


MOVING = {
    "sphere": 'size="0.1"',
    "capsule": 'size="0.05 0.1" euler="90 0 0"',
    "ellipsoid": 'size="0.1 0.08 0.06"',
    "cylinder": 'size="0.1 0.04"',
    "box": 'size="0.1 0.08 0.05"',
}
FIXED = {
    "plane": 'size="0 0 1"',
    "sphere": 'size="0.3"',
    "capsule": 'size="0.2 0.3" euler="90 0 0"',
    "ellipsoid": 'size="0.4 0.3 0.2"',
    "cylinder": 'size="0.4 0.2"',
    "box": 'size="0.4 0.3 0.2"',
}


@pytest.mark.long
@pytest.mark.parametrize("steps", [None, 40])
@pytest.mark.parametrize("below", FIXED)
@pytest.mark.parametrize("above", MOVING)
def test_every_kind_of_geom_rebounds_from_every_other_as_the_page_says(above, below, steps):
    contact = recipe_of(0.8, DT, steps)
    text = (
        f'<geom name="a" type="{below}" {FIXED[below]}/><body pos="0 0 1"><freejoint/>'
        f'<geom name="b" type="{above}" {MOVING[above]} condim="1" priority="1" {contact.geom}/></body>'
    )
    found = bounce(model(text, contact.integrator), "b", "a").restitutions[1:5]
    promised = (2e-3 if above == below == "ellipsoid" else 6e-4) if steps is None else 7e-3
    assert found == pytest.approx(0.8, abs=promised)


PENDULUM = (
    '<geom name="a" type="box" size="0.1 1 2" pos="0.5 0 0"/><body pos="0 0 1">'
    f'<joint axis="0 -1 0"/><geom name="b" size="0.06" pos="0 0 -0.6" {SET}/></body>'
)
SLIDES = f"""{FLOOR}<body pos="0 0 0.2"><joint name="j1" type="slide" axis="0 0 1"/>
<geom name="b" size="0.05" mass="0.3" {SET}/></body>
<body pos="0.5 0 0.2"><joint name="j2" type="slide" axis="0 0 1"/>
<geom size="0.05" mass="0.5" contype="0" conaffinity="0"/></body>"""
COUPLED = {
    "as fast": '<equality><joint joint1="j2" joint2="j1"/></equality>',
    "twice as fast": '<equality><joint joint1="j2" joint2="j1" polycoef="0 2 0 0 0"/></equality>',
    "by a tendon": '<tendon><fixed name="t"><joint joint="j1" coef="1"/><joint joint="j2" coef="2"/></fixed>'
    '</tendon><equality><tendon tendon1="t"/></equality>',
}


@pytest.mark.parametrize("steps", [None, 40])
def test_a_pendulum_has_e_at_every_speed_and_keeps_its_square_of_the_energy(steps):
    """Its angular velocity after over that before is -e, wherever within a step it touches."""
    contact = recipe_of(0.8, DT, steps)
    text = PENDULUM.replace(HARD.geom, contact.geom)
    found = bounce(model(text, contact.integrator), "b", "a")
    # As the page promises, without the flag diagexact.
    error = 6e-4 if steps is None else 7e-3
    assert found.restitutions == pytest.approx(0.8, abs=error)
    assert found.energy_kept == pytest.approx(0.64, abs=2 * error)
    assert found.energy_kept == pytest.approx(found.restitutions**2, rel=2e-3)
    # It touches the wall where its ball of 6 cm is 34 cm from the hinge along the normal.
    assert found.turning == pytest.approx(1 / np.sqrt(0.6**2 - 0.34**2), rel=1e-3)


LIFT = '<geom name="a" type="box" size="1 1 0.1" pos="0 0 -0.1" density="1e6"/>'
TINY = '<geom size="0.01" contype="0" conaffinity="0"/>'
BLOCK = '<geom name="b" type="box" size="0.05 0.05 0.05"/>'
SLIDING = "".join(ALONG_AXES)
FREE = f'<body pos="0 0 1">{SLIDING}<joint type="ball"/>{BLOCK}</body>'
JOINTS = {
    "a freejoint": FLOOR + f'<body pos="0 0 1"><freejoint/>{BLOCK}</body>',
    "slides and a ball": FLOOR + FREE,
    "slides and hinges": FLOOR + FREE.replace('<joint type="ball"/>', SLIDING.replace("slide", "hinge")),
    "bodies in bodies, in a heavy lift": f'<body>{ALONG_AXES[2]}{LIFT}<body pos="0 0 1">{ALONG_AXES[0]}'
    f'{TINY}<body>{ALONG_AXES[2]}{TINY}<body>{ALONG_AXES[1]}<joint type="ball"/>{BLOCK}</body></body>'
    "</body></body>",
    "slides, over a heavy lift": FREE + f"<body>{ALONG_AXES[2]}{LIFT}</body>",
}
"""A block whose third coordinate is its height, by what it can fall freely."""


@pytest.mark.parametrize("how", JOINTS)
def test_a_block_that_can_fall_freely_is_thrown_straight_whatever_its_joints(how):
    """Plain steps from the same heights leave it the same speed."""
    built = model(JOINTS[how], "Euler")
    kept = np.array([data.qvel[2] / 2.0 for data in thrown(built, 2.0, 0.05)])
    found = bounce(built, "a", "b", speeds=(2.0,))
    assert found.restitutions[0] == pytest.approx(kept, abs=1e-5)
    assert found.energy_kept[0] == pytest.approx(kept**2, abs=1e-5)
    assert np.mean(kept) == pytest.approx(0.1228, abs=1e-4)
    assert found.turning == 0


HOPPER = (
    FLOOR + '<body pos="0 0 1"><joint type="slide" axis="0.0003 0 1"/><geom size="0.1" mass="3"/>'
    '<body euler="0 30 0"><joint axis="0 1 0"/>'
    '<geom type="capsule" fromto="0 0 0 0 0 -0.4" size="0.04" mass="1"/>'
    '<body pos="0 0 -0.4" euler="0 -60 0"><joint axis="0 1 0"/>'
    '<geom name="b" type="capsule" fromto="0 0 0 0 0 -0.4" size="0.03" mass="0.5"/></body></body></body>'
)
"""A weight on a slide, which leans, a thigh and a shin on hinges."""
TOE = (
    FLOOR + '<body pos="0 0 1"><joint type="slide" axis="0 0 1"/><geom size="0.05" mass="3"/>'
    '<body pos="0 0 -0.3"><joint axis="0 1 0" stiffness="40" damping="0.4"/><geom name="b" type="capsule" '
    'fromto="0 0 0 0.1 0 -0.06" size="0.02" mass="1" friction="0.7" solref="0.04 0.5"/></body></body>'
)
"""A toe on a spring, under a leg on a slide."""
DEEPER = "* deeper than half of the thinner geom, 7 mm thick"
GAINS = "+ gains energy: at one phase or more, the geoms part with more energy than they came with"


SPRING = '<fixed name="t" stiffness="1e3" damping="10"><joint joint="j1" coef="1"/></fixed>'
KEPT_APART = f"{SLIDES}</worldbody><tendon>{SPRING}</tendon><worldbody>"
"""A tendon's spring ends the approach."""
THROUGH = (
    '<geom name="a" type="box" size="1 1 0.05"/><body pos="0 0 1"><freejoint/><geom name="b" type="box" '
    'size="0.1 0.1 0.002" condim="1" priority="1" solref="-1542 -5.84" solimp="0.9 0.9 0.001 0.5 2"/></body>'
)
FIELD = """</worldbody><asset><hfield name="h" nrow="6" ncol="6" size="1 1 0.1 0.1"/></asset>
<worldbody><geom name="a" type="hfield" hfield="h"/><body pos="0.03 0.02 1"><freejoint/>
<geom name="b" size="0.05"/></body>"""


@pytest.mark.parametrize(
    ("speed", "bodies", "told"),
    [
        (
            5.0,
            '<geom name="a" type="capsule" size="0.01 0.2" euler="90 0 0"/><body pos="0 0 1"><freejoint/>'
            '<geom name="b" type="cylinder" size="0.012 0.001" euler="0 40 0"/></body>',
            "8 of 8 meet at a turned normal",
        ),
        (
            0.1,
            '<geom name="a" type="box" size="0.3 0.3 0.02" pos="0 0 0.3"/><body pos="0.5 0 0.8"><freejoint/>'
            '<geom name="b" type="box" size="0.02 0.03 0.04" mass="0.5"/></body>',
            "8 of 8 are pushed aside",
        ),
        (5.0, HOPPER, "8 of 8 come at another speed"),
        (5.0, FLOOR + ball('solref="-500 -5" priority="1" condim="1"', size=0.0035), DEEPER),
        (2.0, FLOOR + ball('solref="0 -1050" solimp="0.9999 0.9999 0.001" condim="1" priority="1"'), GAINS),
        (1.0, TOE, "]~ "),
        (1.0, TOE, "~ the points' speed changes by more than 10 % in the step in which they meet or part"),
        (0.1, KEPT_APART, "8 of 8 do not touch"),
        (0.1, KEPT_APART, "touch: the approach starts against a force of the model, such as a spring"),
        (0.5, FIELD, "8 of 8 stay"),
        (5.0, THROUGH, "8 of 8 go through"),
    ],
    ids=[
        "deep after a step",
        "0.05 mm deep at an edge",
        "a leg folds",
        "thin",
        "gain",
        "coarse",
        "told",
        "a spring",
        "a spring, told",
        "in a height field",
        "a thin box, softly",
    ],
)
def test_what_is_no_clean_rebound_is_told(speed, bodies, told):
    assert told in bounce_table(bounce(model(bodies), "a", "b", speeds=(speed,)))


def test_a_clean_rebound_has_no_mark():
    assert not set("*+~") & set(bounce_table(bounce(model(FLOOR + ball(SET)), "a", "b", speeds=(2.0,))))


@pytest.mark.parametrize("own", [0.01, -0.02])
def test_a_contact_pushes_from_the_margins_on_and_not_from_the_gaps(own):
    """As MuJoCo does since 3.9; below 0 a margin is a depth."""
    thick = f' margin="{own}" gap="0.005"'
    built = model(FLOOR.replace("/>", ' margin="0.002" gap="0.001"/>') + ball(SET + thick))
    found, data = bounce(built, "a", "b", speeds=(1.0,)), mujoco.MjData(built)
    assert (found.margin, found.gap) == pytest.approx((own + 0.002, 0.006))
    assert found.restitutions == pytest.approx(0.8, abs=7e-4)
    for distance in (own + 0.0069, own + 0.0019):
        data.qpos[2] = 0.1 + distance
        mujoco.mj_forward(built, data)
        assert (data.ncon, data.nefc) == (1, distance < found.margin)


def test_the_energy_kept_is_that_of_both_bodies():
    """A ball on one like it leaves with (1 - e)/2, the other with (1 + e)/2."""
    two = '<body><freejoint/><geom name="a" size="0.1"/></body>' + ball(SET)
    found = bounce(model(two), "a", "b")
    assert found.energy_kept == pytest.approx((1 + 0.64) / 2, abs=5e-4)
    assert {end for row in found.outcomes for end in row} == {PairOutcome.REBOUNDS}


@pytest.mark.parametrize("how", COUPLED)
def test_what_is_coupled_comes_along(how):
    # MuJoCo's own impedance lets a part through, which pulls on until the points part.
    hard = COUPLED[how].replace("/></eq", ' solref="0.004 1" solimp="0.9999 0.9999 0.001"/></eq')
    found = bounce(model(SLIDES, more=hard), "b", "a")
    assert {end for row in found.outcomes for end in row} == {PairOutcome.REBOUNDS}
    assert found.restitutions == pytest.approx(0.8, abs=2e-3)


@pytest.mark.parametrize(("e", "v"), [(0.5, 2.0), (0.8, 1.0)])
def test_with_gravity_it_is_that_of_the_heights(e, v):
    """A ball is dropped from rest, and √(h'/h) is what it keeps of its speed at the plane."""
    contact = recipe_of(e, DT)
    text = FLOOR + ball(f'{contact.geom} condim="1" priority="1"', "0 0 1")
    built = model(text)
    kept = [rebound(built, 0.1, v**2 / 2 / 9.81 + phase * v * DT) for phase in np.arange(16) / 16]
    found = bounce(built, "b", "a", speeds=(v,)).with_gravity
    assert [found.min(), found.max()] == pytest.approx([min(kept), max(kept)], abs=2e-3)
    assert min(kept) < e - 4e-3


@pytest.mark.slow
def test_a_contact_that_outlasts_the_measurement_is_no_rebound(monkeypatch):
    monkeypatch.setattr(pair, "LONGEST", 300)
    soft = ball('solref="-10 -0.5" priority="1" condim="1"')
    found = bounce(model(FLOOR + soft), "a", "b")
    assert {end for row in found.outcomes for end in row} == {PairOutcome.LASTS}
    assert np.isnan(found.restitutions).all()


@pytest.mark.parametrize("v", [1.0, 5.0])
def test_a_plate_beyond_the_middle_of_another_after_a_step_goes_through(v):
    """Plain steps, with the touch anywhere within one, say for how many phases."""
    plates = (
        '<geom name="a" type="box" size="1 1 0.0005"/><body pos="0 0 1"><freejoint/>'
        f'<geom name="b" type="cylinder" size="0.1 0.0005" {SET}/></body>'
    )
    built = model(plates)
    passed = sum(data.qpos[2] < 0 for data in thrown(built, v, 1e-3))
    found = bounce(built, "b", "a", speeds=(v,))
    assert found.outcomes[0].count(PairOutcome.PASSES) == passed
    assert np.isnan(found.restitutions).sum() == passed
    assert set(found.outcomes[0]) == {PairOutcome.PASSES, PairOutcome.REBOUNDS}


@pytest.mark.parametrize(
    ("more", "name"),
    [
        (COUPLED["as fast"], "equality 0"),
        (COUPLED["by a tendon"], "equality 0"),
        (
            '<tendon><fixed name="t" stiffness="1"><joint joint="j1" coef="1"/></fixed></tendon>',
            "tendon t",
        ),
        (COUPLED["as fast"].replace("<joint ", '<joint active="false" '), None),
        ('<equality><joint joint1="j2"/></equality>', None),
        ("", None),
    ],
)
def test_soft_constraints_that_act_on_after_the_contact_are_named(more, name):
    found = bounce(model(SLIDES, more=more), "b", "a", speeds=(1.0,))
    said = () if name is None else (f"a soft constraint ({name}) goes on acting after the contact: ",)
    assert len(found.notes) == len(said)
    assert all(note.startswith(start) for note, start in zip(found.notes, said, strict=True))
    assert ("soft constraint" in bounce_table(found)) == (name is not None)


@pytest.mark.parametrize("integrator", ["Euler", "RK4"])
@pytest.mark.parametrize("speed", [0.1, 2.0])
def test_what_acts_on_the_way_is_reckoned_in(speed, integrator):
    """A ball that falls has the speed asked for where it touches; Euler's q̇ is that of half a step before."""
    fall = Pair(model(FLOOR + ball(SET), integrator), 1, 0)
    fall.set_apart(speed, 2.5)
    late = 9.81 * DT / 2 if integrator == "Euler" else 0.0
    square = (fall.data.qvel[2] - late) ** 2 + 2 * 9.81 * (fall.data.qpos[2] - 0.1)
    assert np.sqrt(square) == pytest.approx(speed, rel=1e-6)
