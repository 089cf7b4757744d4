"""A hand: the distribution of its releases."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from numbers import Real
from os import PathLike
from pathlib import Path
from typing import Any, Literal

import numpy as np

from cointoss.models.batch import STATE
from cointoss.models.body import Body
from cointoss.models.entries import spun_states, tossed_states
from cointoss.models.errors import FieldError, ScenarioError
from cointoss.models.reading import ScenarioSource, scenario_of, tables_of
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario
from cointoss.models.sources import plain_text
from cointoss.models.units import in_si
from cointoss.models.words import Word

QUANTITIES = {
    "height": ("height of the release", "m"),
    "speed": ("speed upwards", "m/s"),
    "spin": ("spin", "rad/s"),
    "psi": ("angle ψ", "rad"),
    "scatter": ("scatter", ""),
    "psi_scatter": ("scatter of ψ", "rad"),
    "tilt": ("tilt at the release", "rad"),
}
"""The hand's numbers that may vary, in a person's words, and their SI units in pint's spelling."""
UPWARDS = ("heads", "either")
"""The sides that may be up at the release."""
MOST = 10_000_000
"""The number of releases drawn at a time, which take a gigabyte."""
PEOPLE = math.radians(10.0)
"""Root of the mean square of 90° - ψ over 48 people who flipped 350,757 times [rad].

From the counts of F. Bartoš et al., J. Am. Stat. Assoc. 120 (2025) 2118, by `cointoss reproduce same-side`.
"""
_TAIL = 3.654
"""Up to it NumPy draws a normal number by products alone."""
OF_A_TOSS = ("height", "speed", "tilt", "caught")
"""The fields that a coin spun on its edge does not use."""


@dataclass(frozen=True, kw_only=True)
class Hand:
    """A hand, which tosses a coin flat or spins it on its edge, with some scatter in each release.

    The normal of a tossed coin keeps the angle ψ to the angular momentum L in flight. At 90° the coin turns
    over as Keller's coin does; at a smaller angle it wobbles (P. Diaconis, S. Holmes, R. Montgomery, SIAM
    Review 49 (2007) 211).
    A spun coin touches the floor with its rim and turns about the vertical, to which its normal has the
    angle ψ.
    """

    height: float = 1.0
    """The height of C at the release [m]."""
    speed: float = 2.0
    """The speed of C upwards at the release [m/s]."""
    spin: float = 120.0
    """L/J_ξ, the rate at which the normal goes round L; for a spun coin, its angular velocity [rad/s]."""
    psi: float = math.pi / 2
    """ψ [rad]."""
    scatter: float = 0.1
    """Relative standard deviation of height, speed and spin."""
    psi_scatter: float = 0.0
    """Standard deviation of ψ [rad]."""
    tilt: float = 0.0
    """Standard deviation of a tossed coin's tilt at the release about each of two horizontal axes [rad]."""
    up: Literal["heads", "either"] | Word = "heads"
    """The side that is up at the release; "either": both sides are equally likely."""
    spun: bool = False
    """Whether the coin is spun on its edge, not tossed."""
    caught: float | None = None
    """Height at which the hand catches the coin [m]; by default as the scenario says."""

    @classmethod
    def people(cls, **others: Any) -> "Hand":
        """Return a hand whose coins wobble as people's coins do: ψ = 90° ± `PEOPLE`.

        Args:
            others: fields with other values than the default.

        Raises:
            ValueError: naming the field, its value and what is accepted.
        """
        return cls(psi_scatter=PEOPLE, **others)

    def __post_init__(self) -> None:
        """Refuse values that no hand can have.

        Raises:
            ValueError: naming the field, its value and what is accepted.
        """
        for name in (*QUANTITIES, *(["caught"] if self.caught is not None else [])):
            value = getattr(self, name)
            if not isinstance(value, Real) or isinstance(value, bool):
                raise FieldError(name, value, "a number")
        angle = "an angle from 0 to 90 deg; a number without a unit is in rad"
        accepted = {
            "height": (self.height > 0, "a length above 0, such as 1 m"),
            "speed": (self.speed >= 0, "a speed of 0 or more, such as 2 m/s"),
            "spin": (self.spin >= 0, "a spin of 0 or more, such as 120 rad/s"),
            "psi": (0 <= self.psi <= math.pi / 2, angle),
            "scatter": (0 <= self.scatter <= 0.3, "a part from 0 to 30 %"),
            "psi_scatter": (0 <= self.psi_scatter <= math.pi / 2, angle),
            "tilt": (0 <= self.tilt <= math.pi / 2, angle),
        }
        for name, (is_so, what) in accepted.items():
            if not is_so or not math.isfinite(getattr(self, name)):
                raise FieldError(name, getattr(self, name), what)
        if self.up not in UPWARDS:
            raise FieldError("up", self.up, " or ".join(UPWARDS))
        object.__setattr__(self, "up", str(self.up))
        if not isinstance(self.spun, bool):
            raise FieldError("spun", self.spun, "true or false")
        if self.spun and self.caught is not None:
            raise FieldError("caught", self.caught, "none where the coin is spun on its edge")

    @property
    def in_words(self) -> str:
        """A description of the hand, in words."""
        side = "heads up" if self.up == "heads" else "either side up"
        psi = f"ψ = {math.degrees(self.psi):.6g}° ± {math.degrees(self.psi_scatter):.6g}°"
        if self.spun:
            return f"spun on the edge, {side}, at {self.spin:.6g} rad/s ± {100 * self.scatter:.3g} %, {psi}"
        flat = f"flat ± {math.degrees(self.tilt):.6g}°" if self.tilt else "flat"
        caught = "" if self.caught is None else f", caught at {self.caught:.6g} m"
        return (
            f"{flat}, {side}, from {self.height:.6g} m, upwards at {self.speed:.6g} m/s, with "
            f"{self.spin:.6g} rad/s, each ± {100 * self.scatter:.3g} %, {psi}{caught}"
        )

    @property
    def unvaried(self) -> str:
        """Why all its tosses are alike, in words; empty where something varies that turns the coin."""
        if self.spun or self.tilt > 0 or (self.spin > 0 and (self.scatter > 0 or self.psi_scatter > 0)):
            return ""
        if self.spin > 0:
            return "no draw but the direction of the spin; a scatter or a tilt would vary the release"
        return "no draw turns the coin: it is released flat, without spin; a tilt would"

    def releases(self, scenario: ScenarioSource, n: int, *, seed: int = 0) -> dict[str, Any]:
        """Draw releases of a scenario's coin, as `cointoss.toss_many` takes them.

            cointoss.toss_many("zloty", hand.releases("zloty", 1000) | {"restitution": "0.2:0.8:7"})

        Args:
            scenario: a `Scenario`, the path of its file, or the name of one that comes with the package.
            n: how many.
            seed: of the draws.

        Returns:
            The numbers of each release by field, arrays of n; and the height at which the hand catches the
            coin, where it does.

        Raises:
            ScenarioError: for a scenario that can't be used, or a catch below the coin.
            ValueError: for another n.
        """
        if isinstance(n, bool) or not isinstance(n, int | np.integer) or not 1 <= n <= MOST:
            raise ValueError(f"n: {n!r}, accepted: a whole number from 1 to {MOST}")
        described = self.scenario(scenario_of(scenario))
        states = self.states(described.body, np.random.default_rng(seed), int(n))
        caught = {} if self.caught is None else {"ending.caught": self.caught}
        return dict(zip(STATE, states.T.copy(), strict=True)) | caught

    def states(self, body: Body, rng: np.random.Generator, count: int) -> Array:
        """Draw the states at release, (n, 13): position, velocity, Euler parameters, angular velocity.

        All azimuths of L, and all points of the rim as the lowest, are equally likely.

        Args:
            body: the coin.
            rng: draws them.
            count: how many.
        """
        means = (self.spin,) if self.spun else (self.height, self.speed, self.spin)
        scattered = [mean * np.maximum(1 + self.scatter * _normals(rng, count), 0) for mean in means]
        psi, around = self.psi + self.psi_scatter * _normals(rng, count), rng.uniform(0, 2 * np.pi, count)
        turned = 1.0 * (rng.random(count) < 1 / 2) if self.up == "either" else np.zeros(count)
        draws = np.stack([*scattered, psi, around, turned], axis=1, dtype=float)
        states = np.empty((count, len(STATE)))
        if self.spun:
            spun_states(body.center, body.radius, body.thickness, draws, states)
            return states
        tilts = self.tilt * _normals(rng, 2 * count).reshape(-1, 2) if self.tilt else np.zeros((count, 2))
        tossed_states(body.inertia, body.inertia_inverse, draws, tilts, states)
        return states

    def scenario(self, described: Scenario) -> Scenario:
        """Return the scenario with this hand's catch, if the hand catches coins.

        Raises:
            ScenarioError: for a catch below the coin, or one of a coin that is spun on its edge.
        """
        if self.spun and described.ending.caught is not None:
            accepted = "none where the coin is spun on its edge"
            raise ScenarioError(f"ending.caught = {described.ending.caught:g}: accepted: {accepted}")
        return described if self.caught is None else described.replace("ending.caught", self.caught)


def load_hand(path: str | PathLike[str]) -> Hand:
    """Return the hand of a TOML file with the fields of a `Hand`, in SI or with a unit.

        spin = "25 rad/s"
        psi_scatter = "10 deg"

    Raises:
        ScenarioError: naming file, field, value and what is accepted.
    """
    source = str(path)
    try:
        text = plain_text(Path(path), source)
    except OSError as error:
        raise ScenarioError(
            f"{source}: can't be read ({error.strerror}); accepted: a TOML file with {_known()}"
        ) from None
    try:
        return Hand(**_fields(tables_of(text, source)))
    except FieldError as error:
        raise ScenarioError(f"{source}: {error}") from None


def _fields(tables: Mapping[str, Any]) -> dict[str, Any]:
    if tables.get("spun") is True and (unused := [name for name in OF_A_TOSS if name in tables]):
        raise FieldError(unused[0], tables[unused[0]], "none where the coin is spun on its edge")
    units = {**{name: unit for name, (_, unit) in QUANTITIES.items()}, "caught": "m"}
    found = dict(tables)
    for name, value in tables.items():
        if name not in Hand.__dataclass_fields__:
            raise FieldError(name, value, f"one of {_known()}")
        if name in units and isinstance(value, str):
            try:
                found[name] = in_si(value, units[name])
            except ValueError as error:
                raise FieldError(name, value, str(error)) from None
    return found


def _known() -> str:
    return ", ".join(Hand.__dataclass_fields__)


def same_side_probability(psi: Array | float) -> Array:
    """Return the probability that an ideal coin is caught with the same side up as at its release.

    For a coin that is released flat and turns many times it is 1/2 + asin(cot² ψ)/π for ψ from 45° to 135°,
    else 1 (Diaconis, Holmes and Montgomery 2007, theorem 2).

    Args:
        psi: ψ, of any shape [rad].
    """
    angle = np.asarray(psi, dtype=float)
    off = np.abs(np.cos(angle) / np.maximum(np.abs(np.sin(angle)), 1e-300))
    return 0.5 + np.arcsin(np.minimum(off, 1.0) ** 2) / np.pi


def _normals(rng: np.random.Generator, count: int) -> Array:
    """Draw from the standard normal distribution, alike with every C library.

    NumPy takes a logarithm of the C library for the numbers beyond `_TAIL`, one in 3900. These are rounded to
    single precision, to which C libraries agree.
    """
    drawn = rng.standard_normal(count)
    far = np.abs(drawn) > _TAIL
    drawn[far] = drawn[far].astype(np.float32)
    return drawn
