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
    assert (tmp_path / "e.png").read_bytes().startswith(b"\x89PNG")
    found = json.loads(cointoss("bounce", "model.xml", "0", "ball", "--json").stdout)
    assert "mujoco" in found["versions"]
    assert len(found["restitutions"]) == len(found["speeds"]) == 6
    (tmp_path / "bad.xml").write_text("<mujoco><a/></mujoco>")
    assert "bad.xml: accepted: an XML file that MuJoCo loads (" in refused("bounce", "bad.xml", "a", "b")
    assert "geom cup: accepted: a geom of the model" in refused("bounce", "model.xml", "cup", "ball")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bad.xml", "e.png", "model.xml"]
