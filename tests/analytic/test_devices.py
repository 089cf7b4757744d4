"""Many tosses on a card, for which a stand-in tosses: the same answers, and what the CPU makes of them."""

import numpy as np
import pytest

from cointoss import analytic, coin_mj
from cointoss.models.batch import rows_from_states, rows_of
from cointoss.models.devices import DeviceError, DeviceWarning
from cointoss.models.processor import LEAST_TOSSES, Processor, usual
from cointoss.models.records import UnsupportedError
from tests.helpers.cards import with_card, without_card
from tests.helpers.draws import AIR, IMPERFECT, ZLOTY, scenario
from tests.helpers.many import draw_states
from tests.helpers.own_laws import smooth

COUNT = 20


def rows_in(air=AIR, count=COUNT):
    case = scenario(air=air, ending={"max_impacts": 3})
    return rows_from_states(case, draw_states(np.random.default_rng(7), count)[1])


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


def test_auto_tosses_few_rows_and_what_no_card_can_on_the_cpu(monkeypatch):
    rows, card = rows_in(), with_card(monkeypatch)
    analytic.toss_rows(rows, device="auto")
    assert not card.given
    for air, is_tossed in (({**AIR, "exponent": 0.5}, False), ({"exponent": 0.5}, True), (AIR, True)):
        card.given.clear()
        processor = Processor("auto")
        processor.expect(LEAST_TOSSES)
        few = rows_in(air, 3)
        assert same(analytic.toss_rows(few, device=processor), analytic.toss_rows(few))
        assert bool(card.given) == is_tossed


def test_auto_tosses_coins_that_are_not_homogeneous_on_the_cpu(monkeypatch):
    card = with_card(monkeypatch)
    for shape, is_tossed in ((IMPERFECT, False), (ZLOTY, True)):
        case = scenario(coin=shape, air=AIR, ending={"max_impacts": 1})
        processor = Processor("auto")
        processor.expect(LEAST_TOSSES)
        analytic.toss_rows(rows_of(case, 2), device=processor)
        assert bool(card.given) == is_tossed


def test_what_no_card_tosses_is_refused_by_name(monkeypatch):
    card = with_card(monkeypatch)
    with pytest.raises(UnsupportedError, match=r"^air.exponent = 0.5: accepted with `device` cuda: 0;"):
        analytic.toss_rows(np.vstack([rows_in(), rows_in({**AIR, "exponent": 0.5})]), device="cuda")
    with pytest.raises(UnsupportedError, match=r"^`device` cuda: accepted by the MuJoCo engine: cpu, auto$"):
        coin_mj.toss_rows(rows_in(), device="cuda")
    assert not card.given


def test_a_law_of_ones_own_is_tossed_by_the_cpu(monkeypatch):
    card, law, rows, processor = with_card(monkeypatch), analytic.OwnLaw(smooth), rows_in(), Processor("auto")
    with pytest.raises(UnsupportedError, match=r"^law: given, accepted: none with `device` cuda;"):
        analytic.toss_rows(rows, law=law, device="cuda")
    processor.expect(LEAST_TOSSES)
    assert same(analytic.toss_rows(rows, law=law, device=processor), analytic.toss_rows(rows, law=law))
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
    rows = rows_in()
    with_card(monkeypatch, calls=0)
    with pytest.raises(DeviceError, match=r"^`device` cuda: the card was lost; accepted: cpu, auto$"):
        analytic.toss_rows(rows, device="cuda")
    without_card(monkeypatch)
    with pytest.raises(DeviceError, match="no NVIDIA driver was found"):
        analytic.toss_rows(rows, device="cuda")
    assert same(analytic.toss_rows(rows, device="auto"), analytic.toss_rows(rows))


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
