"""What MJX and Warp are measured by: MuJoCo's own column in closed form, refusals, and missing packages."""

import numpy as np
import pytest

from cointoss.models.records import UnusableEngineError
from cointoss_reproduction.studies.mujoco_backends import backends as mujoco_backends
from cointoss_reproduction.studies.mujoco_backends.backends import by_mujoco
from cointoss_reproduction.studies.mujoco_backends.study import (
    BACKENDS,
    SETTINGS,
    SLIP,
    Backends,
    Cell,
    measured,
    measures,
    tables,
)
from tests.helpers.command_line import cointoss

FLAG, AT_REST = '`<flag diagexact="enable"/>`', ("one step, at rest", "spring, at rest")


@pytest.mark.parametrize("name", [name for name in SETTINGS if "one step" in name and "rest" not in name])
def test_one_step_has_e_by_mujoco(name):
    cell = measured(by_mujoco, name)
    assert cell.refused == ""
    # Half of the stiffness's part; contacts at four corners share a softness of 1 - 0.9999.
    assert cell.numbers == pytest.approx([0.8, 0.8], abs=6e-4)
    assert np.ptp(cell.numbers) < (1e-9 if "no stiffness" in name else 1e-3)


@pytest.mark.parametrize(("name", "depth"), [(AT_REST[0], 3.92e-6), (AT_REST[1], 2.5e-4)])
def test_a_ball_lies_as_deep_as_the_closed_form_says(name, depth):
    found, hop = measured(by_mujoco, name).numbers
    assert found == pytest.approx(depth, rel=0.05)
    assert hop < 1e-6


def test_a_ball_that_slides_is_stopped_by_friction():
    left, error = measured(by_mujoco, "restitution and friction together").numbers
    assert abs(left) < 0.05 * SLIP
    assert error < 6e-4


def test_what_a_backend_raises_is_its_refusal():
    def refusing(*_):
        raise NotImplementedError("diagexact")

    assert measured(refusing, FLAG) == Cell("NotImplementedError", [])


def test_a_ball_that_hops_and_one_that_errs_are_seen():
    lies, errs = Cell("", [4e-6, 0.0]), Cell("", [0.8, 0.82])
    cells = {name: dict.fromkeys(BACKENDS, Cell("", [0.8, 0.8])) for name in SETTINGS}
    cells |= {name: dict.fromkeys(BACKENDS, lies) for name in AT_REST}
    cells[FLAG] = dict.fromkeys(BACKENDS, Cell("NotImplementedError", []))
    cells["restitution and friction together"] = dict.fromkeys(BACKENDS, Cell("", [1.0, 1e-4]))
    good = measures(Backends("", cells))
    assert (good["refusing"], good["single"], good["hop"], good["depth"]) == (3, 0, 0, 4e-6)
    cells[AT_REST[1]] = {**cells[AT_REST[1]], "Warp, float32": Cell("", [4e-6, 1e-3])}
    cells["one step, `implicitfast`"] = {
        **cells["one step, `implicitfast`"],
        "MJX, float32": errs,
    }
    bad = measures(Backends("", cells))
    assert (bad["hop"], bad["single"]) == (1e-3, pytest.approx(0.02))
    shown = tables(Backends("", cells))
    assert "| 4 µm, hops by 1e+03 µm |" in shown
    assert "refused: NotImplementedError" in shown
    assert "0.8000 to 0.8200" in shown
    assert "slip 1.0000 m/s, e errs by 1e-04" in shown


def test_a_package_that_is_missing_is_named(monkeypatch, tmp_path):
    monkeypatch.setattr(mujoco_backends, "find_spec", lambda _: None)
    with pytest.raises(UnusableEngineError, match="jax: not installed; accepted: it is, by pip install"):
        mujoco_backends.require_backends()
    answered = cointoss("reproduce", "mujoco-backends", "--out", tmp_path)
    assert answered.exit_code == 2
    assert answered.stderr.splitlines()[-1].startswith("cointoss: jax: not installed")
    assert not list(tmp_path.rglob("*.json"))
