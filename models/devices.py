"""The devices that a job may be tossed on, by name."""

from enum import StrEnum


class Device(StrEnum):
    """The name of a device; "auto" is the card where there is one and it pays, else the CPU."""

    CPU = "cpu"
    CUDA = "cuda"
    AUTO = "auto"

    @classmethod
    def _missing_(cls, value: object) -> "Device":
        raise ValueError(f"device: {value!r}, accepted: {', '.join(cls)}")


class DeviceError(RuntimeError):
    """A device that can't be used, or that failed; the message says why and what is accepted."""


class DeviceWarning(UserWarning):
    """A card failed, and the CPU tosses what is left."""
