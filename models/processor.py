"""The processor of a job: the CPU, or a card, which hands some rows over to the CPU."""

import warnings
from collections.abc import Iterator
from contextlib import contextmanager

from cointoss.models.devices import Device, DeviceError, DeviceWarning
from cointoss.models.distribution import DISTRIBUTION
from cointoss.models.kernel import cuda
from cointoss.models.records import UnsupportedError

LEAST_TOSSES = 1 << 12
"""The number of tosses in a job from which on "auto" uses a card."""


@contextmanager
def usual(processor: "Processor") -> Iterator[None]:
    """Set the device that this process uses where none is named, as while a study runs."""
    _usual.append(processor)
    try:
        yield
    finally:
        _usual.remove(processor)


_usual = list["Processor"]()


class Processor:
    """The device of one job, which counts what a card tossed of it."""

    def __init__(self, device: Device | str = Device.CPU) -> None:
        """Make the processor, which has tossed nothing yet.

        Raises:
            ValueError: for another name of a device.
        """
        self.device = Device(device)
        self.card = ""
        """The name of the card that tossed; empty if no card did."""
        self.tossed, self.handed_over = 0, 0
        """The number of tosses that the card was given, and the number that it handed over to the CPU."""
        self.failure = ""
        """Why the CPU tosses in place of a card."""
        self._expected = 0

    @classmethod
    def of(cls, device: "Processor | Device | str | None") -> "Processor":
        """Return the processor of a job, or a new one on this device; for None the `usual` one."""
        if device is None:
            return _usual[-1] if _usual else cls()
        return device if isinstance(device, Processor) else cls(device)

    @property
    def attributes(self) -> dict[str, str | int]:
        """The attributes of a dataset that name the processor."""
        return {"device": self.card or str(Device.CPU), "handed_over": self.handed_over}

    @property
    def in_words(self) -> str:
        """The processor, in words."""
        if self.card:
            return f"{self.card}, {self.handed_over:,d} of {self.tossed:,d} tosses handed over to the CPU"
        return f"{Device.CPU} ({self.failure})" if self.failure else str(Device.CPU)

    @property
    def is_card(self) -> bool:
        """Whether a card tosses."""
        return bool(self.card) and not self.failure

    def require_cpu(self, where: str) -> None:
        """Refuse the device "cuda" where no card tosses.

        Raises:
            UnsupportedError: saying where.
        """
        if self.device is Device.CUDA:
            raise UnsupportedError(f"`device` cuda: accepted {where}: cpu, auto")

    def expect(self, count: int) -> None:
        """Set the number of tosses in the whole job, which decides whether a card pays."""
        self._expected = count

    def card_for(self, count: int) -> cuda.GraphicsCard | None:
        """Return the card that tosses n rows of the job, None where the CPU does.

        Raises:
            DeviceError: for the device "cuda" without a card that can be used.
        """
        pays = self.device is Device.CUDA or max(count, self._expected) >= LEAST_TOSSES
        if self.device is Device.CPU or not pays or self.failure:
            return None
        try:
            return cuda.card()
        except ModuleNotFoundError:
            why, way = "needs cuda-bindings", f'pip install "{DISTRIBUTION}[gpu]", '
        except cuda.CardError as error:
            why, way = str(error), ""
        self._give_up(why, way)
        return None

    def count(self, card: cuda.GraphicsCard, tossed: int, handed_over: int) -> None:
        """Count what a card was given and what it handed over."""
        self.card = card.name
        self.tossed, self.handed_over = self.tossed + tossed, self.handed_over + handed_over

    def lose(self, error: cuda.CardError) -> None:
        """Stop using a card that failed; for the device "auto" the CPU continues.

        Raises:
            DeviceError: for the device "cuda".

        Warns:
            DeviceWarning: for the device "auto".
        """
        self._give_up(str(error))
        warnings.warn(DeviceWarning(f"device: {self.failure}; the CPU tosses what is left"), stacklevel=4)

    def _give_up(self, why: str, way: str = "") -> None:
        if self.device is Device.CUDA:
            raise DeviceError(f"`device` cuda: {why}; accepted: {way}cpu, auto") from None
        self.failure = why
