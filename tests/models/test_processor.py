"""What tosses a job: which device is taken, and what is said where none can be."""

import re

import pytest

from cointoss.models.devices import Device, DeviceError, DeviceWarning
from cointoss.models.kernel.cuda import CardError
from cointoss.models.processor import LEAST_TOSSES, Processor
from tests.helpers.cards import with_card, without_card


@pytest.mark.parametrize("name", ["gpu", "CUDA", "", None, 1])
def test_another_device_is_refused_with_those_that_there_are(name):
    with pytest.raises(ValueError, match=f"^device: {re.escape(repr(name))}, accepted: cpu, cuda, auto$"):
        Device(name)


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


def test_without_a_card_cuda_is_refused_and_auto_is_the_cpu(monkeypatch):
    asked = without_card(monkeypatch)
    with pytest.raises(
        DeviceError, match=r"^`device` cuda: no NVIDIA driver was found; accepted: cpu, auto$"
    ):
        Processor("cuda").card_for(1)
    processor = Processor("auto")
    assert processor.card_for(10**6) is processor.card_for(10**6) is None
    assert len(asked) == 2  # a job asks once
    assert processor.attributes == {"device": "cpu", "handed_over": 0}
    assert processor.in_words == "cpu (no NVIDIA driver was found)"


def test_without_the_bindings_the_extra_is_named(monkeypatch):
    without_card(monkeypatch, ModuleNotFoundError("No module named 'cuda'"))
    said = r"needs cuda-bindings; accepted: pip install \"cointoss-dynamics\[gpu\]\", cpu, auto$"
    with pytest.raises(DeviceError, match=said):
        Processor("cuda").card_for(1)


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
