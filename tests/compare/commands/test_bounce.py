"""`cointoss bounce` prints and draws the restitution between two geoms of a model."""

import json

from tests.helpers.command_line import cointoss, refused

XML = """<mujoco><option timestep="0.002"/><worldbody><geom name="floor" type="plane" size="1 1 1"/>
<body pos="0 0 1"><freejoint/><geom name="ball" size="0.1" solref="0 -900" priority="1" condim="1"/></body>
</worldbody></mujoco>"""


def test_a_table_a_picture_and_numbers(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "model.xml").write_text(XML)
    shown = cointoss("bounce", "model.xml", "ball", "floor", "--png", "e.png").stdout
    assert 'mixed       solref="0 -900" solimp="0.9 0.95 0.001 0.5 2" condim="1"\n' in shown
    assert "integrator  Euler, 2 ms\n" in shown
    assert len(shown.splitlines()) == 3 + 7 + 2
    assert "energy kept" in shown
    assert (tmp_path / "e.png").read_bytes().startswith(b"\x89PNG")
    found = json.loads(cointoss("bounce", "model.xml", "0", "ball", "--json").stdout)
    assert "mujoco" in found["versions"]
    assert len(found["restitutions"]) == len(found["speeds"]) == 6
    (tmp_path / "bad.xml").write_text("<mujoco><a/></mujoco>")
    assert "bad.xml: accepted: an XML file that MuJoCo loads (" in refused("bounce", "bad.xml", "a", "b")
    assert "geom cup: accepted: a geom of the model" in refused("bounce", "model.xml", "cup", "ball")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bad.xml", "e.png", "model.xml"]


def test_what_is_no_rebound_is_said_and_what_is_no_model_is_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    dead = XML.replace('solref="0 -900"', 'solref="0 -500" solimp="0.9999 0.9999 0.001"')
    (tmp_path / "dead.xml").write_text(dead)
    shown = cointoss("bounce", "dead.xml", "ball", "floor").stdout
    assert "          1  8 of 8 stay  8 of 8 stay        0.0000" in shown
    assert "stay: the geoms do not part" in shown
    found = json.loads(cointoss("bounce", "dead.xml", "ball", "floor", "--json").stdout)
    assert found["outcomes"][0] == ["stay"] * 8
    assert found["restitutions"][0] == [0.0] * 8
    for number in ("-1", "0", "10", "nan"):
        (tmp_path / "step.xml").write_text(XML.replace("0.002", number))
        said = refused("bounce", "step.xml", "ball", "floor")
        assert "step.xml: option timestep" in said
        assert "accepted: a number of seconds from 1e-7 to 0.1" in said


def test_a_soft_constraint_is_named_in_text_and_json(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    slide = (
        '<body pos="0 0 1"><joint name="{0}" type="slide" axis="0 0 1"/><geom name="{0}" size="0.1"/></body>'
    )
    bodies = XML.split("<body")[0] + slide.format("one") + slide.format("two") + "</worldbody>"
    joints = '<equality><joint name="rod" joint1="one" joint2="two"/></equality></mujoco>'
    (tmp_path / "two.xml").write_text(bodies + joints)
    note = (
        "a soft constraint (equality rod) goes on acting after the contact: "
        "the speed and the energy are those at the parting"
    )
    assert cointoss("bounce", "two.xml", "one", "floor").stdout.endswith(f"\n{note}\n")
    assert json.loads(cointoss("bounce", "two.xml", "one", "floor", "--json").stdout)["notes"] == [note]
