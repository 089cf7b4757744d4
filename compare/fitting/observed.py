"""What was seen of a coin: the times of its touches, its faces, and its heights and attitudes at times."""

from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cointoss.compare.fitting.errors import ObservationError, ValueRefusedError
from cointoss.models.quantities import LARGEST
from cointoss.models.records import Array, Face

MOST = 20_000
"""The most touches, and the most frames, that are fitted."""
LEAST_SD = 1e-12
"""The least standard deviation, in SI units; nothing is measured better."""
NORM_ERROR = 0.05
"""The largest error of the norm of measured Euler parameters; they are brought to norm 1."""
_KINDS: dict[str, Any] = {"touch_numbers": np.int64, "faces": np.int8}


@dataclass(frozen=True, init=False, eq=False)
class Observed:
    """What was seen of one toss, each number with its standard deviation; arrays are copies, and read-only.

        Observed(touch_times=[0.286, 0.745], touch_sd=0.001, faces="HT")

    Touches are what a microphone hears, frames what a film shows; either may be missing. A standard deviation
    may be one number for all. NaN in a frame stands for what was not measured there.
    """

    touch_times: Array
    """The times of the touches of the floor, by the observer's clock, (n,) [s]."""
    touch_sd: Array
    """Standard deviations of the times of the touches, (n,) [s]."""
    touch_numbers: NDArray[np.int64]
    """Which touch of the coin each is, from 1, (n,); by default they are all that there were, in turn."""
    faces: NDArray[np.int8]
    """The `Face` up at each touch, 0 where it was not seen, (n,); a text such as "HT?" is accepted."""
    times: Array
    """The times of the frames, by the same clock, (m,) [s]."""
    heights: Array
    """The heights of C above the floor, (m,) [m]."""
    height_sd: Array
    """Standard deviations of the heights, (m,) [m]."""
    tilts: Array
    """Angle from the vertical to the normal ζ on the side of heads, 0 to π, (m,) [rad]."""
    tilt_sd: Array
    """Standard deviations of the tilts, (m,) [rad]."""
    quaternions: Array
    """Euler parameters, body to space, (m, 4); their sign has no meaning."""
    quaternion_sd: Array
    """Standard deviations of the angle about any axis, (m,) [rad]."""

    def __init__(
        self,
        *,
        touch_times: ArrayLike = (),
        touch_sd: ArrayLike = (),
        touch_numbers: ArrayLike = (),
        faces: ArrayLike = (),
        times: ArrayLike = (),
        heights: ArrayLike = (),
        height_sd: ArrayLike = (),
        tilts: ArrayLike = (),
        tilt_sd: ArrayLike = (),
        quaternions: ArrayLike = (),
        quaternion_sd: ArrayLike = (),
    ) -> None:
        """Check shapes and numbers, and fill in what was left out.

        Raises:
            ObservationError: naming the argument, its value and what is accepted.
        """
        given = dict(locals())
        n, m = np.size(touch_times), np.size(times)
        for count, of in ((n, "touches"), (m, "frames")):
            if count > MOST:
                raise ObservationError(f"Observed: {count:,} {of}; accepted: at most {MOST:,}")
        given["faces"] = _faces(faces, n)
        if np.size(touch_numbers) == 0:
            given["touch_numbers"] = np.arange(1, n + 1)
        for item in fields(self):
            count = n if item.name.startswith(("touch", "face")) else m
            shape = (count, 4) if item.name == "quaternions" else (count,)
            kept = _array(item.name, given[item.name], shape).astype(_KINDS.get(item.name, np.float64))
            kept.setflags(write=False)
            object.__setattr__(self, item.name, kept)
        self._check()
        if self.count == 0:
            raise ObservationError("Observed: nothing was seen; accepted: touches, heights or attitudes")

    def _check(self) -> None:
        """Refuse numbers that no observation has."""
        norms = np.hypot.reduce(self.quaternions, axis=1)
        near, bounds = f"numbers within {LARGEST:g}", f"a standard deviation from {LEAST_SD:g} to {LARGEST:g}"
        measured = {
            "touch_sd": (self.touch_times, self.touch_sd),
            "height_sd": (self.heights, self.height_sd),
            "tilt_sd": (self.tilts, self.tilt_sd),
            "quaternion_sd": (self.quaternions[:, 0], self.quaternion_sd),
        }
        for name, refused, accepted in (
            ("touch_times", ~(np.abs(self.touch_times) <= LARGEST), f"{near} [s]"),
            ("times", ~(np.abs(self.times) <= LARGEST), f"{near} [s]"),
            ("heights", np.abs(self.heights) > LARGEST, f"{near} [m]"),
            ("touch_numbers", np.diff(self.touch_numbers, prepend=0) <= 0, "rising whole numbers from 1"),
            ("touch_times", np.diff(self.touch_times, prepend=-np.inf) < 0, "times in their order"),
            ("quaternions", np.abs(norms - 1) > NORM_ERROR, f"four numbers of norm 1 within {NORM_ERROR:g}"),
            ("tilts", (self.tilts < 0) | (self.tilts > np.pi), "angles from 0 to pi [rad]"),
            *(
                (name, np.isfinite(of) & ~((sd >= LEAST_SD) & (sd <= LARGEST)), bounds)
                for name, (of, sd) in measured.items()
            ),
        ):
            _refuse(name, getattr(self, name), refused, accepted)

    @property
    def count(self) -> int:
        """How many numbers were seen; a face is none, and an attitude three."""
        heights, tilts, attitudes = (int(of.sum()) for of in self.measured.values())
        return len(self.touch_times) + heights + tilts + 3 * attitudes

    @property
    def measured(self) -> dict[str, NDArray[np.bool_]]:
        """The frames in which heights, tilts and attitudes were measured, by these names, (m,) each."""
        return {
            "heights": np.isfinite(self.heights),
            "tilts": np.isfinite(self.tilts),
            "attitudes": np.isfinite(self.quaternions[:, 0]),
        }

    def __repr__(self) -> str:
        """Return how much was seen."""
        return f"<Observed: {len(self.touch_times)} touches, {len(self.times)} frames>"


def _array(name: str, given: ArrayLike, shape: tuple[int, ...]) -> Array:
    """Return an argument's numbers: NaN where nothing is given; one standard deviation is that of all."""
    values = np.array(given, dtype=float)
    if values.size == 0 or (name.endswith("_sd") and values.ndim == 0):
        values = np.full(shape, values if values.size else np.nan)
    if values.shape != shape:
        raise ObservationError(f"Observed.{name}: shape {values.shape}, accepted: {shape}")
    if name in _KINDS:
        _refuse(name, values, ~((values % 1 == 0) & (np.abs(values) <= MOST)), f"whole numbers up to {MOST}")
    return values


def _faces(given: Any, n: int) -> ArrayLike:
    """Return codes of faces; none where nothing is given."""
    if len(given) == 0:
        return np.zeros(n)
    if isinstance(given, str):
        letters = {face.symbol: int(face) for face in Face} | {"?": 0}
        for i, letter in enumerate(given.upper()):
            if letter not in letters:
                raise ValueRefusedError("faces", i, repr(letter), "H, T or ? for each touch, as in HT?T")
        return [letters[letter] for letter in given.upper()]
    return [int(Face(face)) if face else 0 for face in given]


def _refuse(name: str, values: NDArray[Any], refused: ArrayLike, accepted: str) -> None:
    if np.any(refused):
        i = int(np.argmax(refused))
        raise ValueRefusedError(name, i, values[i].tolist(), accepted)
