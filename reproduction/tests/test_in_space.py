"""The coin in space: its flights and contact against the engine, its impacts against the planar coin."""

from math import inf

import numpy as np
import pytest

from cointoss.study import run
from cointoss_reproduction.setups.general_coins import CoinClass
from cointoss_reproduction.studies.rotor import chain, in_space, study
from cointoss_reproduction.studies.rotor.chain import Z
from cointoss_reproduction.studies.rotor.splitting import coin_of

VACUUM = {thick: CoinClass(thick=thick, imperfect=False, air=False, coulomb=False) for thick in (False, True)}


def touch(coin, state, change):
    """Move a state and its change past a touch; return its time, and how fast the lowest point leaves."""
    time = in_space.next_touch(coin, state)
    in_space.fly(coin, state, change, time)
    return time, in_space.strike(coin, state, change)[0]


@pytest.mark.parametrize("thick", VACUUM)
def test_touches_and_contact_are_the_engines(thick):
    """A contact begins at the engine's time, and the tilt is the engine's where it ends."""
    kind = VACUUM[thick]
    coin, unit, compared = coin_of(kind.scenario), np.sqrt(0.0125 / kind.scenario.gravity), 0
    states = study.releases(kind, inf, 60)
    for start, state in zip(states, in_space.started(kind.scenario, states), strict=True):
        tossed, now, touches = run(kind.scenario.body, kind.scenario.rules, start), 0.0, []
        held = False
        while in_space.above(coin, state) > 0 and not held and len(touches) < 60:
            time, leaves = touch(coin, state, np.eye(7)[0])
            now += time * unit
            touches.append(now)
            held = in_space.dies_out(coin, state, leaves)
        assert touches[:2] == pytest.approx(tossed.rows["time"][: len(touches[:2])], rel=1e-6)
        if held and len(tossed.contacts) and abs(tossed.contacts[0, 0] - now) < 1e-4:
            in_space.slide(coin, state, np.eye(7)[0])
            end = tossed.started.states[np.searchsorted(tossed.started.times, tossed.contacts[0, 1])]
            n_z = 1 - 2 * (end[7] ** 2 + end[8] ** 2)
            compared += abs(in_space.lean(coin, state)[0] - n_z) < 0.1
    print(compared)
    assert compared > 5


@pytest.mark.parametrize("half", [0.0, 0.3])
def test_a_coin_in_one_plane_strikes_as_the_planar_one(half):
    coin = chain.Coin(inertia=0.25, half=half, restitution=0.6, rough=False, slowing=0.0, drag=0.0)
    state, change = np.array([0.9, -1.0, 1.1, 2.5, 0, 0, 0]), np.array([0.3, -0.5, 0.7, 0.2, 0, 0, 0])
    planar, planar_change = state[:5].copy(), change[:5].copy()
    state[Z] = planar[Z] = in_space.depth(coin, state)
    chain.strike(coin, planar, planar_change)
    in_space.strike(coin, state, change)
    assert (*in_space.lean(coin, state), *change[:2]) == pytest.approx(
        (np.cos(planar[2]), -planar[3] * np.sin(planar[2]), *planar_change[:2]), rel=1e-6
    )
