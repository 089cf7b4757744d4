"""Two geoms of a user's model: closed forms of their restitution, and what is refused."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import mujoco
import numpy as np
import pytest

from cointoss.coin_mj import bounce, solref_of
from cointoss.coin_mj.bounces.recipe import recipe_of

DT = 2e-3
HARD = recipe_of(0.8, DT)
SET = f'{HARD.geom} condim="1" priority="1"'
FLOOR = '<geom name="a" type="plane" size="1 1 1"/>'


def ball(more, place="0 0 1", size=0.1):
    return f'<body pos="{place}"><freejoint/><geom name="b" size="{size}" {more}/></body>'


def model(bodies, integrator="implicitfast", more=""):
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{DT}" integrator="{integrator}"/>'
        f"<worldbody>{bodies}</worldbody>{more}</mujoco>"
    )


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
}


QUICK = ("a ball on a ball", "a ball far off", "a ball on a rod that is hinged", "a box flat on a plane")


@pytest.mark.parametrize(
    "name", [name if name in QUICK else pytest.param(name, marks=pytest.mark.slow) for name in PAIRS]
)
def test_geoms_rebound_with_the_restitution_that_is_set(name):
    found = bounce(model(PAIRS[name]), "a", "b")
    # Half of the stiffness's part, and what bodies turn in a step: 2 ms at up to 2 m/s over about 1 m.
    assert found.restitutions[:5] == pytest.approx(0.8, abs=6e-3 if "hinged" in name else 7e-4)
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


@pytest.mark.slow
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


@pytest.mark.slow
def test_without_weight_it_does_not_depend_on_the_speed():
    e = bounce(model(FLOOR + ball("")), "a", "b").restitutions
    assert e.mean(axis=1) == pytest.approx(e.mean(), abs=3e-3)
    assert e.max() - e.min() > 0.01


@pytest.mark.slow
def test_it_is_that_of_the_ball_with_the_same_settings():
    found = bounce(model(FLOOR + ball('solref="0.01 0.37"'), "Euler"), "b", "a")
    same = solref_of((0.01, 0.37), DT, other=(0.02, 1))
    assert found.solref == pytest.approx(same.solref)
    fast = list(found.speeds).index(2.0)
    assert found.restitutions[fast].mean() == pytest.approx(same.restitution, abs=2e-3)
    assert found.with_gravity[fast].mean() == pytest.approx(same.restitution_with_weight, abs=2e-3)
    assert found.with_gravity[0].max() < 0.05  # at 0.1 m/s it hardly leaves


def test_masses_do_not_matter():
    light, heavy = (
        bounce(model(FLOOR + ball(f'{SET} mass="{mass}"')), "a", "b").restitutions for mass in (1e-3, 1e3)
    )
    assert light == pytest.approx(heavy, abs=1e-9)


def test_a_pair_of_its_own_is_what_holds():
    text = f'<contact><pair geom1="a" geom2="b" condim="1" {HARD.geom}/><pair geom1="a" geom2="c"/></contact>'
    third = '<body pos="0 0 3"><freejoint/><geom name="c" size="0.1"/></body>'
    found = bounce(model(FLOOR + ball("") + third, more=text), "a", "b")
    assert found.restitutions == pytest.approx(0.8, abs=6e-4)


def test_other_geoms_are_kept_out_of_it():
    """A ball that lies on a table is hit by another."""
    text = FLOOR.replace('"a"', '"table"') + ball("", "0 0 0.1").replace('"b"', '"a"') + ball(SET)
    assert bounce(model(text), "b", "a").restitutions == pytest.approx(0.8, abs=6e-4)


@pytest.mark.slow
def test_a_thin_body_that_goes_through_is_no_number():
    soft = 'condim="1" priority="1" solref="-1542 -5.84" solimp="0.9 0.9 0.001 0.5 2"'
    text = (
        '<geom name="a" type="box" size="1 1 0.05"/><body pos="0 0 1"><freejoint/>'
        f'<geom name="b" type="box" size="0.1 0.1 0.002" {soft}/></body>'
    )
    found = bounce(model(text, "RK4"), "a", "b").restitutions
    assert np.isnan(found[-1]).all()
    assert found[0] == pytest.approx(0.8, abs=0.02)


@pytest.mark.parametrize(
    ("bodies", "names", "said"),
    [
        (FLOOR + ball(""), ("a", "c"), "a geom of the model, by name or number: a, b"),
        (FLOOR + ball(""), ("a", "2"), "a geom of the model"),
        (FLOOR + ball(""), ("a", "a"), "two different geoms"),
        (FLOOR + ball('contype="0" conaffinity="0"'), ("a", "b"), "MuJoCo lets them pass"),
        (FLOOR + '<geom name="b" size="1" pos="0 0 2"/>', ("a", "b"), "no joint brings them together"),
        (
            FLOOR + '<body pos="0 0 2"><joint type="slide" axis="1 0 0"/><geom name="b" size="1"/></body>',
            ("a", "b"),
            "no joint brings them together",
        ),
        (
            FLOOR + '<body pos="0 0 2"><joint axis="1 0 0"/><geom name="b" size="0.1" pos="0 1 0"/></body>',
            ("a", "b"),
            "no joint brings them together",
        ),
        (FLOOR + ball("", "0 0 5000"), ("a", "b"), "further apart than 1000 m"),
    ],
)
def test_geoms_that_do_not_exist_or_touch_are_refused(bodies, names, said):
    with pytest.raises(ValueError, match=said):
        bounce(model(bodies), *names)


def test_a_model_is_read_by_the_loader_and_nothing_is_written(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    unstable = ball('solref="0.001 0.0001" priority="1"')
    (tmp_path / "model.xml").write_text(f"<mujoco><worldbody>{FLOOR}{unstable}</worldbody></mujoco>")
    with_speed = bounce("model.xml", "a", "b")
    assert not (with_speed.restitutions < 10).any()
    (tmp_path / "bad.xml").write_text('<mujoco><asset><mesh file="no.obj"/></asset></mujoco>')
    for name, said in (
        ("bad.xml", "Error opening file 'no.obj'"),
        ("none.xml", "that exists"),
        (".", "exists"),
    ):
        with pytest.raises(ValueError, match=said):
            bounce(name, "a", "b")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bad.xml", "model.xml"]
