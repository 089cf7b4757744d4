"""What MJX and Warp are measured by: MuJoCo's own column in closed form, refusals, and missing packages."""

import pytest

from cointoss import UnusableEngineError
from cointoss_reproduction.studies.mujoco_backends import backends as mujoco_backends
from cointoss_reproduction.studies.mujoco_backends.backends import by_mujoco
from cointoss_reproduction.studies.mujoco_backends.study import SETTINGS, SLIP, measured
from tests.helpers.command_line import cointoss

ONE_STEP = [f"{body}, one step" for body in ("box flat", "capsule", "ellipsoid")] + ["one step, implicitfast"]


def about(value, error):
    return pytest.approx(value, abs=error)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        # Half of the stiffness's part; contacts at four corners share a softness of 1 - 0.9999.
        *((name, {"least": about(0.8, 6e-4), "most": about(0.8, 6e-4)}) for name in ONE_STEP),
        ("one step, no stiffness", {"least": about(0.8, 1e-9), "most": about(0.8, 1e-9)}),
        ("one step, at rest", {"depth": about(3.92e-6, 2e-7), "hop": about(0, 1e-6)}),
        ("spring, at rest", {"depth": about(2.5e-4, 1e-5), "hop": about(0, 1e-6)}),
        ("restitution and friction together", {"slip": about(0, 0.05 * SLIP), "error": about(0, 6e-4)}),
    ],
)
def test_mujoco_does_as_the_closed_forms_say(name, expected):
    found = measured(SETTINGS[name], by_mujoco)
    assert {key: found[key] for key in ("answer", *expected)} == {"answer": "runs", **expected}


def test_what_a_backend_raises_is_its_refusal():
    def refusing(*_):
        raise NotImplementedError("diagexact")

    assert measured(SETTINGS["flag diagexact"], refusing) == {"answer": "refused: NotImplementedError"}


def test_a_package_that_is_missing_is_named(monkeypatch, tmp_path):
    monkeypatch.setattr(mujoco_backends, "find_spec", lambda _: None)
    with pytest.raises(UnusableEngineError, match="jax: not installed; accepted: it is, by pip install"):
        mujoco_backends.require_backends()
    answered = cointoss("reproduce", "mujoco-backends", "--out", tmp_path)
    assert answered.exit_code == 2
    assert answered.stderr.splitlines()[-1].startswith("cointoss: jax: not installed")
    assert not list(tmp_path.rglob("*.json"))
