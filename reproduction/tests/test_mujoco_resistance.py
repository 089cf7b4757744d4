"""The study of MuJoCo's torsional and rolling friction: its page, its closed forms, and its check."""

from dataclasses import replace

import pytest

from cointoss_reproduction.frame.saving import read_numbers
from cointoss_reproduction.studies.mujoco_resistance.study import (
    CONTACTS,
    STARTS,
    NativeResistance,
    closed_form,
    explicit,
    native,
)
from saved import missed, saved

SAVED = read_numbers(saved("mujoco-resistance"), NativeResistance)


def test_the_closed_forms_are_those_of_the_paths():
    for label in ("hoop rolls", "disc turns"):
        found, expected = explicit(STARTS[label]), closed_form(STARTS[label])
        assert found.distance == pytest.approx(expected.distance, rel=1e-3)
        assert found.duration == pytest.approx(expected.duration, rel=1e-3)


def test_mujocos_friction_does_now_what_it_did():
    """The numbers are those of MuJoCo's own arithmetic, from one release to the next."""
    name = "elliptic, solimp 0.9999"
    run = native(STARTS["ball rolls"], CONTACTS[name])
    assert run.stopped.distance == pytest.approx(SAVED.native[name]["ball rolls"].distance, rel=1e-2)


def test_a_friction_that_stops_both_motions_at_once_is_seen():
    name = "elliptic, solimp 0.9999"
    fair = {**SAVED.native, name: {**SAVED.native[name], "ball does both": SAVED.closed["ball does both"]}}
    (wrong,) = missed("mujoco-resistance", replace(SAVED, native=fair))
    assert "share one bound" in wrong
