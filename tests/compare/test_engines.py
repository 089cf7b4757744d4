"""The engines by their names: the same verbs with the same arguments, each with settings of its own."""

from dataclasses import replace
from inspect import signature
from typing import Any

import pytest

from cointoss import coin_mj
from cointoss.coin_mj import Realisation
from cointoss.compare.engines import Engine


@pytest.mark.parametrize("verb", ["toss", "toss_rows", "require_rows", "require_supported"])
def test_both_engines_have_the_same_verbs_with_the_same_arguments(verb):
    ours, theirs = (
        [(name, of.kind) for name, of in signature(getattr(engine.package, verb)).parameters.items()]
        for engine in Engine
    )
    assert [each for each in ours if each[0] != "law" or verb.endswith("rows")] == theirs


def test_settings_of_a_contact_are_those_on_which_it_depends():
    of_both = {"contact", "friction", "flight_angle", "contact_steps", "flight_steps"}
    assert coin_mj.MANY.as_dict().keys() == of_both | {"stiffness", "steps"}
    one_step = replace(coin_mj.MANY, contact=Realisation.ONE_STEP, slip_damping=2.0)
    assert one_step.as_dict().keys() == of_both | {"step", "slip_damping"}
    recorded: dict[str, Any] = one_step.as_dict()
    assert coin_mj.MujocoSettings(**recorded).as_dict() == recorded
