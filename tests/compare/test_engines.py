"""The engines by their names: the same verbs with the same arguments, each with settings of its own."""

import pickle
from dataclasses import FrozenInstanceError, replace
from inspect import signature
from typing import Any

import pytest

from cointoss import analytic, coin_mj
from cointoss.coin_mj import Realisation
from cointoss.compare.engines import Engine


@pytest.mark.parametrize("verb", ["toss", "toss_many", "require_supported"])
def test_both_engines_have_the_same_verbs_with_the_same_arguments(verb):
    ours, theirs = (
        [(name, of.kind) for name, of in signature(getattr(engine.package, verb)).parameters.items()]
        for engine in Engine
    )
    assert ours == theirs
    assert ours[-1][0] == "settings"


def test_an_engine_is_its_package():
    assert Engine.ANALYTIC.package is analytic
    assert Engine.MUJOCO.package is coin_mj
    assert Engine.MUJOCO.versions.keys() - Engine.ANALYTIC.versions.keys() == {"mujoco"}


@pytest.mark.parametrize("engine", list(Engine))
def test_settings_are_frozen_travel_and_name_what_a_toss_depends_on(engine):
    settings = engine.package.MANY
    name, value = next(iter(settings.as_dict().items()))
    with pytest.raises(FrozenInstanceError):
        setattr(settings, name, value)
    assert pickle.loads(pickle.dumps(settings)) == settings


def test_settings_of_a_contact_are_those_on_which_it_depends():
    assert coin_mj.MANY.as_dict() == {
        "contact": "spring",
        "friction": "explicit",
        "stiffness": 1e11,
        "steps": 3,
        "flight_angle": 0.8,
        "contact_steps": 1_000_000,
        "flight_steps": 1_000_000,
    }
    one_step = replace(coin_mj.MANY, contact=Realisation.ONE_STEP, slip_damping=2.0)
    assert one_step.as_dict() == {
        "contact": "one_step",
        "friction": "explicit",
        "step": 1e-7,
        "slip_damping": 2.0,
        "flight_angle": 0.8,
        "contact_steps": 1_000_000,
        "flight_steps": 1_000_000,
    }
    recorded: dict[str, Any] = one_step.as_dict()
    assert coin_mj.Settings(**recorded).as_dict() == recorded


@pytest.mark.parametrize(
    ("wrong", "accepted"),
    [
        ({"contact": "hard"}, '"spring" or "one_step"'),
        ({"friction": "none"}, '"explicit" or "native"'),
        ({"stiffness": 0.0}, "a finite number > 0"),
        ({"stiffness": float("nan")}, "a finite number > 0"),
        ({"step": float("inf")}, "a finite number > 0"),
        ({"flight_angle": -1.0}, "a finite number > 0"),
        ({"flight_steps": 0}, "a whole number >= 1"),
        ({"steps": 0}, "a whole number >= 1"),
        ({"steps": 1.5}, "a whole number >= 1"),
        ({"slip_damping": -1.0}, "a finite number >= 0"),
    ],
)
def test_a_wrong_setting_is_refused_by_name_value_and_what_is_accepted(wrong, accepted):
    ((name, value),) = wrong.items()
    with pytest.raises(ValueError, match=f"Settings.{name} = {value}: accepted: {accepted}"):
        coin_mj.Settings(**wrong)
