"""Many tosses on a card, for which a stand-in tosses: the same answers, and what the CPU makes of them."""

import numpy as np
import pytest

from cointoss import analytic, coin_mj
from cointoss.models.batch import rows_of
from cointoss.models.devices import DeviceError, DeviceWarning
from cointoss.models.processor import LEAST_TOSSES, Processor, usual
from cointoss.models.records import UnsupportedError
from tests.helpers.bits import GENERAL
from tests.helpers.cards import with_card, without_card
from tests.helpers.draws import AIR, IMPERFECT, ZLOTY, scenario
from tests.helpers.own_laws import smooth

COUNT = 20
OTHER_AIR, LAW = {**AIR, "exponent": 0.5}, analytic.OwnLaw(smooth)
OF_INERTIA = {**ZLOTY, "inertia": GENERAL["inertia"]}
TOSSES = {
    "few": (ZLOTY, AIR, None, 0, False),
    "many": (ZLOTY, AIR, None, LEAST_TOSSES, True),
    "in air with b above 0": (ZLOTY, OTHER_AIR, None, LEAST_TOSSES, False),
    "in no air": (ZLOTY, {"exponent": 0.5}, None, LEAST_TOSSES, True),
    "of an unbalanced coin": (IMPERFECT, AIR, None, LEAST_TOSSES, False),
    "of a coin of another inertia": (OF_INERTIA, AIR, None, LEAST_TOSSES, False),
    "by a law of one's own": (ZLOTY, AIR, LAW, LEAST_TOSSES, False),
}
"""Coin, air, law, tosses that are expected, and whether `auto` takes a card."""


def rows_in(air=AIR, coin=ZLOTY, count=COUNT):
    heights = np.linspace(0.2, 0.6, count)
    case = scenario(coin=coin, air=air, ending={"max_impacts": 3}, release={"angular_velocity": [3, 30, 5]})
    return rows_of(case, count, {"release.position.z": heights})


def same(found, due):
    return all(
        np.array_equal(*pair, equal_nan=True) for pair in zip(found, due, strict=True) if pair[1] is not None
    )


@pytest.mark.parametrize("trust", [None, "impacts", "certain"])
def test_a_card_and_what_it_hands_over_have_the_bits_of_the_cpu(monkeypatch, trust):
    rows, card, processor = rows_in(), with_card(monkeypatch), Processor("cuda")
    found = analytic.toss_rows(rows, trust=trust, device=processor)
    assert same(found, analytic.toss_rows(rows, trust=trust))
    assert card.given == [COUNT]
    assert (processor.tossed, processor.handed_over) == (COUNT, COUNT // 3)
    assert processor.card == "Stand-in"


@pytest.mark.parametrize("name", TOSSES)
def test_auto_takes_a_card_for_many_tosses_that_are_faster_there(monkeypatch, name):
    coin, air, law, expected, is_taken = TOSSES[name]
    rows, card, processor = rows_in(air, coin, 3), with_card(monkeypatch), Processor("auto")
    processor.expect(expected)
    assert same(analytic.toss_rows(rows, law=law, device=processor), analytic.toss_rows(rows, law=law))
    assert bool(card.given) == is_taken


REFUSED = {
    "air": (analytic, None, r"^air.exponent = 0.5: accepted with `device` cuda: 0;"),
    "law": (analytic, LAW, r"^law: given, accepted: none with `device` cuda;"),
    "engine": (coin_mj, None, r"^`device` cuda: accepted by the MuJoCo engine: cpu, auto$"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_no_card_tosses_is_refused_by_name(monkeypatch, name):
    card, (package, law, words) = with_card(monkeypatch), REFUSED[name]
    with pytest.raises(UnsupportedError, match=words):
        package.toss_rows(np.vstack([rows_in(), rows_in(OTHER_AIR)]), law=law, device="cuda")
    assert not card.given


@pytest.mark.parametrize("calls", [0, 1])
def test_where_a_card_is_lost_auto_goes_on_by_the_cpu(monkeypatch, calls):
    """It failed after its first row, whose answer is kept."""
    rows, card, processor = rows_in(), with_card(monkeypatch, calls=calls), Processor("auto")
    processor.expect(LEAST_TOSSES)
    for _ in range(calls):
        analytic.toss_rows(rows, device=processor)
    with pytest.warns(DeviceWarning, match="the card was lost; the CPU tosses what is left"):
        found = analytic.toss_rows(rows, device=processor)
    assert same(found, analytic.toss_rows(rows))
    assert same(analytic.toss_rows(rows, device=processor), found)
    assert len(card.given) == calls + 1
    assert processor.handed_over == calls * (COUNT // 3) + COUNT - 1


def test_where_a_card_is_lost_or_missing_cuda_ends(monkeypatch):
    with_card(monkeypatch, calls=0)
    with pytest.raises(DeviceError, match=r"^`device` cuda: the card was lost; accepted: cpu, auto$"):
        analytic.toss_rows(rows_in(), device="cuda")
    without_card(monkeypatch)
    with pytest.raises(DeviceError, match="no NVIDIA driver was found"):
        analytic.toss_rows(rows_in(), device="cuda")
    assert same(analytic.toss_rows(rows_in(), device="auto"), analytic.toss_rows(rows_in()))


def test_a_usual_processor_tosses_where_no_device_is_named(monkeypatch):
    card, rows, processor = with_card(monkeypatch), rows_in(), Processor("cuda")
    with usual(processor):
        found = analytic.toss_rows(rows)
        analytic.toss_rows(rows, device="cpu")
        with pytest.raises(UnsupportedError, match=r"^`device` cuda: accepted by the MuJoCo engine"):
            coin_mj.toss_rows(rows)
    assert same(analytic.toss_rows(rows), found)
    assert card.given == [COUNT]
    assert processor.handed_over == COUNT // 3
