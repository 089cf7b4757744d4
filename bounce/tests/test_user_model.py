"""Models of a user's own: what is read, how its geoms are named, and what is refused."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import numpy as np
import pytest

from cointoss_bounce import bounce
from two_geoms import FLOOR, SET, ball, model


def test_geoms_have_numbers():
    assert bounce(model(FLOOR + ball(SET)), 1, np.int32(0), speeds=(1.0,)).geoms == ("1", "0")


@pytest.mark.parametrize("ncol", ["60000", "+60000", " 60000\t"])
def test_a_height_field_beyond_the_memory_is_refused_before_it_is_read(ncol, tmp_path):
    asset = f'<mujoco><asset><hfield name="h" nrow="60000" ncol="{ncol}" size="1 1 1 1"/></asset></mujoco>'
    (tmp_path / "field.xml").write_text(asset)
    (tmp_path / "model.xml").write_text('<mujoco><include file="field.xml"/></mujoco>')
    for name in ("field.xml", "model.xml"):
        with pytest.raises(ValueError, match=r"hfield h nrow x ncol = .60000 x .* accepted: at most"):
            bounce(tmp_path / name, "a", "b")


def test_a_file_that_includes_itself_is_refused(tmp_path):
    (tmp_path / "self.xml").write_text('<mujoco><include file="self.xml"/></mujoco>')
    with pytest.raises(ValueError, match=r"self\.xml' already included"):
        bounce(tmp_path / "self.xml", "a", "b")


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
