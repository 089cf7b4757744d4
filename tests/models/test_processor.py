"""What tosses a job: which device is taken, and what is said where none can be."""

import pytest

from cointoss.models.devices import Device, DeviceError, DeviceWarning
from cointoss.models.kernel.cuda import CardError
from cointoss.models.processor import LEAST_TOSSES, Processor
from tests.helpers.cards import with_card, without_card


@pytest.mark.parametrize(
    ("device", "count", "job", "is_taken"),
    [
        ("cpu", 10**6, 0, False),
        ("cuda", 1, 0, True),
        ("auto", LEAST_TOSSES - 1, LEAST_TOSSES - 1, False),
        ("auto", LEAST_TOSSES, 0, True),
        ("auto", 1, LEAST_TOSSES, True),
    ],
)
def test_a_card_is_taken_where_it_is_asked_for_or_pays(monkeypatch, device, count, job, is_taken):
    card, processor = with_card(monkeypatch), Processor(device)
    processor.expect(job)
    assert processor.card_for(count) is (card if is_taken else None)


def test_the_cpu_never_asks_for_a_card(monkeypatch):
    asked = without_card(monkeypatch)
    assert Processor("cpu").card_for(10**6) is None
    assert not asked


@pytest.mark.parametrize(
    ("errors", "said"),
    [
        ((), r"^`device` cuda: no NVIDIA driver was found; accepted: cpu, auto$"),
        (
            (ModuleNotFoundError("No module named 'cuda'"),),
            r"needs cuda-bindings; accepted: pip install \"cointoss-dynamics\[gpu\]\", cpu, auto$",
        ),
    ],
    ids=["no driver", "no bindings"],
)
def test_without_a_card_cuda_is_refused_with_what_is_missing(monkeypatch, errors, said):
    without_card(monkeypatch, *errors)
    with pytest.raises(DeviceError, match=said):
        Processor("cuda").card_for(1)


def test_without_a_card_auto_is_the_cpu_and_a_job_asks_once(monkeypatch):
    asked, processor = without_card(monkeypatch), Processor("auto")
    assert processor.card_for(10**6) is processor.card_for(10**6) is None
    assert len(asked) == 1
    assert processor.attributes == {"device": "cpu", "handed_over": 0}
    assert processor.in_words == "cpu (no NVIDIA driver was found)"


def test_a_card_that_fails_is_not_asked_again(monkeypatch):
    card, processor = with_card(monkeypatch), Processor("auto")
    processor.count(card, 100, 3)
    assert processor.is_card
    assert processor.in_words == "Stand-in, 3 of 100 tosses handed over to the CPU"
    with pytest.warns(DeviceWarning, match=r"^device: the memory is full; the CPU tosses what is left$"):
        processor.lose(CardError("the memory is full"))
    assert processor.card_for(10**6) is None
    assert not processor.is_card


def test_a_job_keeps_its_processor():
    processor = Processor("auto")
    assert Processor.of(processor) is processor
    assert Processor.of("auto").device is Processor.of(Device.AUTO).device is Device.AUTO
