"""What Python's functions refuse: a line that names the argument, its value and what is accepted."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import mujoco
import numpy as np
import pytest

from cointoss_bounce import bounce, engine_bounce, solref, solref_of
from two_geoms import FLOOR, ball, model

TWO_GEOMS = FLOOR + ball("")
HELD = (
    '<body name="B" pos="0 0 1"><freejoint/><geom name="b" size="0.1"/></body></worldbody>'
    '<equality><weld body1="B"/></equality><worldbody>'
)
A_GEOM = r"geom = .*accepted: a geom of the model, by name or number: a, b"


def of_option(option):
    """Return a model with this attribute of its option."""
    return mujoco.MjModel.from_xml_string(
        f"<mujoco><option {option}/><worldbody>{TWO_GEOMS}</worldbody></mujoco>"
    )


def of_friction(number):
    """Return a model in which a coefficient was set afterwards."""
    given = model(TWO_GEOMS)
    given.geom_friction[1, 0] = number
    return given


SETTINGS = [
    (
        {"restitution": 1e-3, "spring": True},
        "restitution = 0.001: accepted: a number from 0.01 to 1 by a spring",
    ),
    ({"restitution": "x"}, 'restitution = "x": accepted: a number'),
    ({"restitution": True}, "restitution = True: accepted: a number"),
    ({"timestep": None}, "timestep = None: accepted: a number"),
    ({"steps": 7.5, "spring": True}, "steps = 7.5: accepted: a whole number from 5 to 500"),
    ({"timestep": float("nan")}, "timestep = nan: accepted"),
    ({"body": "box 0.1"}, 'body = "box 0.1": accepted: a type and its size'),
    ({"body": "plane 1 1 1"}, 'body = "plane 1 1 1": accepted: a type and its size'),
    ({"body": "sphere -1"}, 'body = "sphere -1": accepted: a type and its size'),
    ({"backend": "brax"}, 'backend = "brax": accepted: mujoco, mjx, warp'),
    ({"body": ""}, 'body = "": accepted: a type and its size'),
    ({"restitution": 1, "backend": "genesis"}, "restitution = 1: accepted: .* 0.999 by genesis"),
    ({"restitution": 0, "backend": "genesis"}, "restitution = 0: accepted: .* 0.01 to 0.999"),
    ({"backend": "brax"}, "accepted: mujoco, mjx, warp, newton, genesis$"),
    ({"backend": "isaaclab"}, "genesis; engine_bounce has the settings of isaaclab$"),
    ({"gravity": 1001.0}, "gravity = 1001.0: accepted: from 0.001 to 1000 m/s.2 at this step"),
    ({"mass": 1e-7}, "mass = 1e-07: accepted: from 1e-06 to"),
    ({"body": "sphere 1e-7"}, "body = .*: accepted: a type and its size"),
    ({"steps": 501, "spring": True}, "steps = 501: accepted: a whole number from 5 to 500"),
    ({"timestep": 2e-3, "gravity": 501.0}, "gravity = 501.0: accepted: from 0.001 to 500 m/s.2"),
]
OF_ENGINES = [
    ({"restitution": 1.2}, "restitution = 1.2: accepted: a number from 0 to 1"),
    ({"restitution": 0, "backend": "drake"}, "restitution = 0: accepted: a number from 0.01 to 1 by drake"),
    ({"backend": "ode"}, 'backend = "ode": accepted: drake, gazebo, isaaclab, pybullet'),
]
OF_GIVEN = [
    ({"solref": (0.01, -1)}, "solref = .*: accepted: two numbers as in a <geom>"),
    ({"solref": (0.01,)}, "solref = .*: accepted: two numbers"),
    ({"solref": "0.01 1"}, "solref = .*: accepted: two numbers"),
    ({"solref": (float("nan"), 1)}, "solref = .*: accepted: two numbers"),
    ({"other": (-1, 1)}, "other = .*: accepted: two numbers"),
    ({"timestep": 0}, "timestep = 0: accepted: a number of seconds"),
    ({"integrator": "RK5"}, 'integrator = "RK5": accepted: Euler, RK4'),
    ({"solimp": "soft"}, 'solimp = "soft": accepted: up to five numbers'),
    ({"solimp": "1 2 3 4 5 6"}, "solimp = .*: accepted: up to five numbers"),
    ({"solimp": "-0.1"}, "solimp = .*: accepted: up to five numbers"),
]
GEOMS = [
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
    (
        '<geom name="a" type="plane" size="0 0 1"/><geom name="b" type="plane" size="0 0 1"/>',
        ("a", "b"),
        "at least one is no plane",
    ),
    (
        FLOOR + ball('margin="-0.11"'),
        ("a", "b"),
        "margin is -0.11 m, and the contact would push only from",
    ),
    (FLOOR + ball('solref="0.02 -1"'), ("a", "b"), "geom b solref = .0.02 -1.: accepted: two numbers"),
    (FLOOR + HELD, ("a", "b"), "equality constraints hold them"),
    (FLOOR + ball('solref="nan 1"'), ("a", "b"), "geom b solref = nan: accepted: finite numbers"),
    (FLOOR + ball('solimp="0.9 inf 1"'), ("a", "b"), "geom b solimp = inf: accepted: finite numbers"),
    (
        '</worldbody><asset><hfield name="h" nrow="6" ncol="6" size="1 1 0.1 0.1"/></asset><worldbody>'
        '<geom name="a" type="hfield" hfield="h"/>' + ball("", "3 0 1"),
        ("a", "b"),
        "not above the height field",
    ),
    (TWO_GEOMS, (-1, "a"), A_GEOM),
    (TWO_GEOMS, (2, "a"), A_GEOM),
    (TWO_GEOMS, (True, "a"), A_GEOM),
    (TWO_GEOMS, (None, "a"), A_GEOM),
    (TWO_GEOMS, (1.0, "a"), A_GEOM),
]
SPEEDS = r"speeds = .*: accepted: finite speeds above 0"
OF_BOUNCE = [
    ({"speeds": (1.0, 0.0)}, SPEEDS),
    ({"speeds": []}, SPEEDS),
    ({"model": mujoco.MjModel.from_xml_string("<mujoco/>")}, "by name or number: it has none"),
    ({"model": None}, "model = None: accepted: an XML file of MuJoCo that exists, or an MjModel"),
    ({"model": of_friction(np.nan)}, "geom b friction = nan: accepted: finite numbers"),
    *(
        ({"model": of_option(f'timestep="{step}"')}, r"option timestep = .*: accepted: a number of seconds")
        for step in ("-1", "0", "10", "inf", "nan")
    ),
    *(
        ({"model": of_option(option)}, r"option .*: accepted: finite numbers")
        for option in ('gravity="0 0 inf"', 'impratio="nan"', 'density="inf"')
    ),
    *(({"model": model(bodies), "one": one, "two": two}, said) for bodies, (one, two), said in GEOMS),
]
GIVEN = {
    solref: {"restitution": 0.5, "timestep": 1e-3},
    solref_of: {"solref": (0.02, 1), "timestep": 1e-3},
    engine_bounce: {"restitution": 0.5, "timestep": 1e-3, "backend": "gazebo"},
    bounce: {"model": model(TWO_GEOMS), "one": "a", "two": "b"},
}
"""Arguments that each function accepts."""
REFUSED = [
    (function, wrong, said)
    for function, rows in (
        (solref, SETTINGS),
        (solref_of, OF_GIVEN),
        (engine_bounce, OF_ENGINES),
        (bounce, OF_BOUNCE),
    )
    for wrong, said in rows
]


@pytest.mark.parametrize(("function", "wrong", "said"), REFUSED, ids=[said[:50] for *_, said in REFUSED])
def test_what_cannot_be_is_refused_with_what_is_accepted(function, wrong, said):
    with pytest.raises(ValueError, match=said):
        function(**{**GIVEN[function], **wrong})
