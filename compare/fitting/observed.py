"""What was seen of a coin: the times of its touches, its faces, and its heights and attitudes at times."""

from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cointoss.compare.fitting.errors import ObservationError, ValueRefusedError
from cointoss.models.attitude import norm_of
from cointoss.models.quantities import LARGEST
from cointoss.models.records import Array, Face

MOST = 20_000
"""The most touches, and the most frames, that are fitted."""
LEAST_SD = 1e-12
"""The least standard deviation, in SI units; nothing is measured better."""
NORM_ERROR = 0.05
"""The largest error of the norm of measured Euler parameters; they are brought to norm 1."""


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
        shapes = {item.name: (n if item.name.startswith(("touch", "face")) else m,) for item in fields(self)}
        for name, shape in shapes.items():
            values = np.array(given[name], dtype=float)
            whole = (*shape, 4) if name == "quaternions" else shape
            if values.size == 0:
                values = np.full(whole, np.nan)
            elif name.endswith("_sd") and values.ndim == 0:
                values = np.full(whole, values)
            if values.shape != whole:
                raise ObservationError(f"Observed.{name}: shape {values.shape}, accepted: {whole}")
            self._keep(name, values)
        self._check()

    def _keep(self, name: str, values: Array) -> None:
        kinds: dict[str, Any] = {"touch_numbers": np.int64, "faces": np.int8}
        if name in kinds:
            bad = ~((values % 1 == 0) & (np.abs(values) <= MOST))
            _refuse(name, values, bad, f"whole numbers up to {MOST}")
        kept = values.astype(kinds.get(name, np.float64))
        kept.setflags(write=False)
        object.__setattr__(self, name, kept)

    def _check(self) -> None:
        finite = np.isfinite
        for name in ("touch_times", "times"):
            times = getattr(self, name)
            _refuse(name, times, ~(np.abs(times) <= LARGEST), f"numbers within {LARGEST:g} [s]")
        _refuse("heights", self.heights, np.abs(self.heights) > LARGEST, f"numbers within {LARGEST:g} [m]")
        earlier = np.diff(self.touch_numbers, prepend=0) <= 0
        _refuse("touch_numbers", self.touch_numbers, earlier, "rising whole numbers from 1")
        back = np.diff(self.touch_times, prepend=-np.inf) < 0
        _refuse("touch_times", self.touch_times, back, "times in their order")
        norms = np.array([norm_of((a, b, c, d)) for a, b, c, d in self.quaternions.tolist()])
        wrong = np.abs(norms - 1) > NORM_ERROR if len(norms) else np.zeros(0, dtype=bool)
        _refuse("quaternions", self.quaternions, wrong, f"four numbers of norm 1 within {NORM_ERROR:g}")
        outside = (self.tilts < 0) | (self.tilts > np.pi)
        _refuse("tilts", self.tilts, outside, "angles from 0 to pi [rad]")
        for name, values in (
            ("touch_sd", self.touch_times),
            ("height_sd", self.heights),
            ("tilt_sd", self.tilts),
            ("quaternion_sd", self.quaternions[:, 0]),
        ):
            sd = getattr(self, name)
            bounds = f"a standard deviation from {LEAST_SD:g} to {LARGEST:g}"
            _refuse(name, sd, finite(values) & ~((sd >= LEAST_SD) & (sd <= LARGEST)), bounds)
        if self.count == 0:
            raise ObservationError("Observed: nothing was seen; accepted: touches, heights or attitudes")

    @property
    def count(self) -> int:
        """How many numbers were seen; a face is none, and an attitude three."""
        frames = sum(int(np.isfinite(values).sum()) for values in (self.heights, self.tilts))
        return len(self.touch_times) + frames + 3 * int(np.isfinite(self.quaternions[:, 0]).sum())

    def __repr__(self) -> str:
        """Return how much was seen."""
        return f"<Observed: {len(self.touch_times)} touches, {len(self.times)} frames>"


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
