"""The records check themselves when they are made, and can't be changed."""

from dataclasses import replace

import numpy as np
import pytest

from cointoss import analytic
from cointoss.models.records import IMPACT_ROW, Flag, Impacts, TrustEnd
from tests.helpers.draws import draw_release, scenario


def test_impacts_check_their_shapes_and_order():
    rows = np.zeros(3, IMPACT_ROW)
    rows["time"] = [0.1, 0.2, 0.3]
    rows["face"] = [1, 2, 1]
    impacts = Impacts.from_rows(rows)
    assert impacts.sequence == "HTH"
    assert [(one.time, one.face) for one in impacts] == [(0.1, "heads"), (0.2, "tails"), (0.3, "heads")]
    assert (impacts[-1].time, impacts[1:].sequence) == (0.3, "TH")
    assert impacts[0] == impacts[0] != impacts[2]
    assert impacts[[0, 2]] == impacts[impacts.face == 1] == impacts[::2]
    assert impacts[impacts.face == 2] == impacts[1:2]
    for index in (3, slice(None, None, -1), [2, 0], None, "time", 0.5, (0, 1)):
        with pytest.raises(IndexError, match="ind"):
            impacts[index]
    rows["time"] = [0.1, 0.3, 0.2]
    with pytest.raises(ValueError, match=r"Impacts\.time"):
        Impacts.from_rows(rows)
    good = {name: rows[name] for name in rows.dtype.names or ()}
    with pytest.raises(ValueError, match=r"Impacts\.impulse: shape \(3, 2\), expected \(3, 3\)"):
        Impacts(**{**good, "impulse": np.zeros((3, 2))})


def test_arrays_are_read_only():
    tossed = analytic.toss(scenario())
    assert not tossed.impacts.impulse.flags.writeable
    assert not tossed.sample([0.0]).position.flags.writeable


def test_records_with_the_same_numbers_are_equal():
    one, two = analytic.toss(scenario()), analytic.toss(scenario())
    assert (one, hash(one), one.sample([0.1])) == (two, hash(two), two.sample([0.1]))
    assert one != replace(one, impacts=one.impacts[:1])
    assert one.impacts != 3


def test_columns_may_lie_in_memory_as_they_like():
    states = analytic.toss(scenario()).sample([0.1, 0.2])
    other = replace(states, quaternion=np.asfortranarray(states.quaternion))
    np.testing.assert_array_equal(other.lowest_points(scenario()), states.lowest_points(scenario()))


@pytest.mark.parametrize("time", [-0.1, 1e3, float("nan")])
def test_a_time_outside_the_toss_is_refused(time):
    with pytest.raises(ValueError, match="outside the toss"):
        analytic.toss(scenario()).sample([time])


def test_flags_name_what_no_passive_floor_does():
    """A gain of energy beyond rounding, and an impulse outside the cone of a law with μ; others have none."""
    smooth = analytic.toss(scenario(release=draw_release(np.random.default_rng(2))))
    assert smooth.flags == (frozenset(),) * len(smooth.impacts)
    change = smooth.impacts.energy_change.copy()
    change[:2] = [0.9e-9, 1.1e-9] * smooth.impacts.energy[:2]
    gains = replace(smooth, impacts=replace(smooth.impacts, energy_change=change))
    assert gains.flags[:3] == (frozenset(), {Flag.GAINS_ENERGY}, frozenset())
    edge = analytic.toss(smooth.scenario.replace("floor.contact", "sharp_edge"))
    assert Flag.LEAVES_CONE not in frozenset().union(*edge.flags)
    slid = smooth.scenario.replace("floor.contact", "sliding_friction", "floor.friction", 0.2)
    assert analytic.toss(slid).flags[0] == frozenset()
    weaker = replace(analytic.toss(slid), scenario=slid.replace("floor.friction", 0.1))
    assert weaker.flags[0] == {Flag.LEAVES_CONE}


@pytest.mark.parametrize(
    ("trusted", "before_contact", "end"),
    [(3, 3, "none"), (3, 2, "none"), (2, 2, "contact"), (1, 2, "errors"), (1, 3, "errors")],
)
def test_the_trust_ends_at_the_last_impact_in_contact_or_by_errors(trusted, before_contact, end):
    assert TrustEnd.of(trusted, before_contact=before_contact, count=3) == end


def test_the_end_of_trust_says_which_impact_it_is():
    tossed = analytic.toss(scenario())
    count = len(tossed.impacts)
    for end in TrustEnd:
        told = replace(tossed, trusted_impacts=1, trust_end=end).trust
        assert told.startswith(f"1 of {count} impacts")
        assert ("impact 2" in told) == (end != TrustEnd.NONE)
    assert replace(tossed, trusted_impacts=count, trust_end=TrustEnd.NONE).trust == f"{count} impacts"
    one = analytic.toss(scenario(ending={"max_impacts": 1}))
    assert (one.trusted_impacts, one.trust) == (1, "1 impact")
