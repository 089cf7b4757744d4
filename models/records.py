"""The record of a toss, the same for both engines: its impacts, how it ended, and its path."""

from collections.abc import Sequence
from dataclasses import dataclass, field, fields, make_dataclass
from enum import StrEnum
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cointoss.models import notebook
from cointoss.models.contact_laws.table import LAWS
from cointoss.models.entries import joint_of_states, lowest_points
from cointoss.models.geometry import FACE_SINE
from cointoss.models.interruptible import interruptible
from cointoss.models.kernel.arrays import Array
from cointoss.models.labelled import EqualByValue, ReadOnlyArrays, column, dataset, freeze, table
from cointoss.models.resting_place import Rest, RestReason
from cointoss.models.scenario import Scenario
from cointoss.models.views import view
from cointoss.models.words import Word

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


_DRAWN = 600
"""The number of times at which a path is drawn."""
_PROVED, _NO_PROOF = "", "by a test that is no proof"


class Face(Word):
    """The face that is up. Heads is the face ζ = +h/2; it is up when n_z > 0, eq. (4)."""

    HEADS = 1
    TAILS = 2

    @property
    def symbol(self) -> str:
        """H or T."""
        return self.name[0]


class Outcome(Word):
    """How the coin lies in the end."""

    UNDECIDED = 0
    HEADS = 1
    TAILS = 2
    EDGE = 3
    PERPETUAL = 4
    TRANSIENT = 5

    @property
    def is_decided(self) -> bool:
        """Whether the outcome is known."""
        return self not in (Outcome.UNDECIDED, Outcome.TRANSIENT)


class Ending(Word):
    """Why a toss stopped."""

    sentence: str
    """The meaning of the ending, in words."""
    proviso: str
    """The reservation about the outcome, in words; empty if the ending proves the outcome."""

    def __new__(cls, value: int, sentence: str, proviso: str = "so far") -> "Ending":
        """Make a member of its integer and its words."""
        member = int.__new__(cls, value)
        member._value_, member.sentence, member.proviso = value, sentence, proviso
        return member

    NONE = 0, "The toss goes on."
    SETTLED = 1, "The coin can no longer turn over, and this floor gives it no energy.", _PROVED
    PAPER = 2, "The coin's energy is too low to turn it over, but a later impact may add some.", _NO_PROOF
    PAPER_SMOOTH = (
        3,
        "The energy that can turn the coin over is below m g r: the paper's eq. (20).",
        _NO_PROOF,
    )
    MAX_IMPACTS = 4, "The toss stopped at [ending] max_impacts; raise it to go on."
    MAX_TIME = 5, "The toss stopped at [ending] max_time; raise it to go on."
    CHATTER = 6, "Ever faster impacts bring the coin into contact, where this law is not followed."
    NO_SOLUTION = 7, "The contact law has no solution at this impact."
    LYING = 8, "The coin lies on a face. It may still slide or spin, but that can't tip it.", _PROVED
    STANDING = (
        9,
        "The coin stands on its edge: by all evidence the floor turns it back from either rim.",
        _NO_PROOF,
    )
    PERPETUAL = (
        10,
        "Its recent losses, extrapolated, leave the coin enough energy to turn over for ever.",
        "by extrapolation",
    )
    CONTACT_STEPS = 11, "The toss stopped at `contact_steps`; raise it to go on."
    FLIGHT_STEPS = 12, "The toss stopped at `flight_steps`; raise it to go on."
    AT_REST = 13, "The coin rests on its edge, held by the floor's resistance to rolling.", _PROVED
    ROLLING = 14, "The coin still rolls on its edge; to go on raise [ending] max_time or `contact_steps`."
    CAUGHT = 15, "A hand caught the coin; the face that was up then counts.", _PROVED
    NOT_CAUGHT = 16, "The coin never came down to the hand."
    PERIODIC = 17, "The coin's contact has gone through a whole period, and repeats it for ever.", _PROVED
    TRANSIENT = 18, "A long transient: after `contact_steps` its losses had neither settled it nor died away."


class TrustEnd(Word):
    """Why the impact after the trusted ones is not trusted."""

    NONE = 0
    ERRORS = 1
    CONTACT = 2
    SECOND_POINT = 3
    RESTITUTION = 4

    @classmethod
    def of(cls, trusted: int, *, before_contact: int, count: int) -> "TrustEnd":
        """Return why the trust ends, for impacts that all obey the contact law.

        Args:
            trusted: the number of trusted impacts.
            before_contact: the number of impacts before the first sustained contact.
            count: the number of impacts.
        """
        if trusted >= count:
            return cls.NONE
        return cls.CONTACT if trusted >= before_contact else cls.ERRORS

    def reason(self, number: int) -> str:
        """Return why impact `number`, counted from 1, is not trusted; empty for `NONE`."""
        return _REASONS[self].format(number=number)


_REASONS = {
    TrustEnd.NONE: "",
    TrustEnd.ERRORS: "the engine's own errors could change impact {number}",
    TrustEnd.CONTACT: "impact {number} comes after sustained contact",
    TrustEnd.SECOND_POINT: "at impact {number} a second point lands within MuJoCo's contact",
    TrustEnd.RESTITUTION: "at impact {number} MuJoCo's contact misses the restitution",
}


@dataclass(frozen=True, kw_only=True, eq=False)
class Impacts(EqualByValue):
    """The impacts of a toss, one row each, in order of time; arrays are read-only.

    `impacts[0]` is the first of them, `impacts[-1]` the last, and `impacts[:3]` are the first three; so are
    `impacts[[0, 1, 2]]`, and a mask chooses those where it is true.
    """

    time: Array = column(unit="s")
    """The time of first touch, (n,) [s]."""
    face: NDArray[np.int8] = column(kind=np.int8, long_name="face up", labels=Face.by_value())
    """The `Face` up at the touch, (n,)."""
    impulse: Array = column("space", "N s")
    """The impulse S of the floor on the coin, space frame, (n, 3) [N s]."""
    point: Array = column("body", "m")
    """The contact point A from B, body frame, (n, 3) [m]."""
    position: Array = column("space", "m")
    """The position of C at the touch, space frame, (n, 3) [m]."""
    quaternion: Array = column("attitude", "")
    """Euler parameters at the touch, body to space, (n, 4)."""
    velocity_before: Array = column("space", "m/s")
    """The velocity of C before the impact, space frame, (n, 3) [m/s]."""
    velocity_after: Array = column("space", "m/s")
    """The velocity of C after the impact, space frame, (n, 3) [m/s]."""
    angular_velocity_before: Array = column("body", "rad/s")
    """ω before the impact, body frame, (n, 3) [rad/s]."""
    angular_velocity_after: Array = column("body", "rad/s")
    """ω after the impact, body frame, (n, 3) [rad/s]."""
    contact_velocity_before: Array = column("space", "m/s")
    """v_A before the impact, space frame, (n, 3) [m/s]."""
    contact_velocity_after: Array = column("space", "m/s")
    """v_A after the impact, space frame, (n, 3) [m/s]."""
    energy: Array = column(unit="J")
    """The energy after the impact: kinetic and m g z_C, (n,) [J]."""
    energy_change: Array = column(unit="J")
    """The change of the energy in the impact, (n,) [J]; positive where the law feeds the coin."""

    def __post_init__(self) -> None:
        """Check every array's shape and make it read-only."""
        freeze(self)
        if np.any(np.diff(self.time) < 0):
            raise ValueError("Impacts.time: must not decrease")

    def __len__(self) -> int:
        """Return the number of impacts."""
        return len(self.time)

    def __getitem__(self, index: Any) -> Any:
        """Return one impact, by its number from 0, as an `Impact`; of a slice, numbers or a mask, a record.

        Raises:
            IndexError: for a number that no impact has, numbers that descend, and what is no index.
        """
        chosen = np.arange(len(self))[index]
        if chosen.ndim > 1 or np.any(np.diff(np.atleast_1d(chosen)) < 0):
            accepted = "a number, or a slice, numbers or a mask along the impacts, in order of time"
            raise IndexError(f"Impacts: index {index!r}, accepted: {accepted}")
        row = {item.name: getattr(self, item.name)[chosen] for item in fields(self)}
        return Impacts(**row) if chosen.ndim else Impact(**row | {"face": Face(row["face"])})

    @classmethod
    def from_rows(cls, rows: NDArray[Any]) -> "Impacts":
        """Make the record from an array of `IMPACT_ROW`."""
        return cls(**{name: np.ascontiguousarray(rows[name]) for name in IMPACT_ROW.names or ()})

    @property
    def sequence(self) -> str:
        """The faces up at the touches, as in "HHT"."""
        return "".join(Face(face).symbol for face in self.face)

    def __repr__(self) -> str:
        """Return how many there are, and the faces."""
        return f"<Impacts: {len(self)}, {notebook.shortened(self.sequence)}>"

    def to_xarray(self) -> "xr.Dataset":
        """Return the impacts as a dataset of xarray over `impact`, which counts from 1."""
        return dataset(self, "impact", first=1)

    def to_dataframe(self) -> "pd.DataFrame":
        """Return the impacts as a table of pandas, a row each."""
        return table(self, "impact", first=1)


Impact = make_dataclass(
    "Impact",
    [item.name for item in fields(Impacts)],
    bases=(EqualByValue,),
    namespace={"__module__": __name__, "__doc__": "One impact, with the fields of `Impacts`."},
    frozen=True,
    kw_only=True,
    eq=False,
)
_ROW = [(item.name, item.metadata["kind"], item.metadata["shape"]) for item in fields(Impacts)]
IMPACT_ROW = np.dtype((np.record, np.dtype(_ROW, align=True)))
"""One impact as a row: the columns of `Impacts`. A record: to Python, too, its fields are attributes."""


@dataclass(frozen=True, kw_only=True, eq=False)
class States(EqualByValue):
    """States of the coin at several times; arrays are read-only."""

    time: Array = column(unit="s")
    """The times of the states, (n,) [s]."""
    position: Array = column("space", "m")
    """The position of C, space frame, (n, 3) [m]."""
    velocity: Array = column("space", "m/s")
    """The velocity of C, space frame, (n, 3) [m/s]."""
    quaternion: Array = column("attitude", "")
    """Euler parameters, body to space, (n, 4)."""
    angular_velocity: Array = column("body", "rad/s")
    """ω, body frame, (n, 3) [rad/s]."""

    def __post_init__(self) -> None:
        """Check every array's shape and make it read-only."""
        freeze(self)

    @classmethod
    def from_rows(cls, times: Array, rows: Array) -> "States":
        """Make the record from times, (n,) [s], and state vectors, (n, 13); it has copies of both."""
        x, v, e, w = (part.copy() for part in np.split(rows, (3, 6, 10), axis=1))
        return cls(time=times.copy(), position=x, velocity=v, quaternion=e, angular_velocity=w)

    def __repr__(self) -> str:
        """Return how many there are, and from when to when."""
        span = f" from {self.time.min():.6g} to {self.time.max():.6g} s" if len(self.time) else ""
        return f"<States: {len(self.time)}{span}>"

    def to_xarray(self) -> "xr.Dataset":
        """Return the states as a dataset of xarray over `time`."""
        return dataset(self, "time")

    def to_dataframe(self) -> "pd.DataFrame":
        """Return the states as a table of pandas, a row for each time."""
        return table(self, "time")

    def to_mujoco(self, scenario: Scenario) -> tuple[Array, Array]:
        """Return qpos and qvel of MuJoCo's free joint of the coin, (n, 7) and (n, 6).

        qpos has B in space, not C, and the Euler parameters, scalar first; qvel has the velocity of B in
        space and ω in the body frame.

        Args:
            scenario: the coin's, whose mass centre may lie off B.
        """
        rows = np.hstack([self.position, self.velocity, self.quaternion, self.angular_velocity])
        motions = joint_of_states(scenario.body, rows)
        return motions[:, :7], motions[:, 7:]

    def lowest_points(self, scenario: Scenario) -> Array:
        """Return the coin's lowest point A, space frame, (n, 3) [m]: the point of contact where it touches.

        Where a coin lies flat, it is the point of the face under C.

        Args:
            scenario: the coin's.
        """
        return lowest_points(
            scenario.body,
            *map(np.ascontiguousarray, (self.position, self.quaternion, self.angular_velocity)),
        )

    @property
    def normal(self) -> Array:
        """The coin's normal ζ, space frame, (n, 3)."""
        e0, e1, e2, e3 = self.quaternion.T
        return np.stack(
            [2 * (e0 * e2 + e1 * e3), 2 * (e2 * e3 - e0 * e1), (e0 * e0 + e3 * e3) - (e1 * e1 + e2 * e2)],
            axis=-1,
        )


class Flag(StrEnum):
    """A property of an impact that no passive floor with Coulomb friction could cause."""

    GAINS_ENERGY = "gains_energy"
    """The coin has more energy after it than before."""
    PULLS = "pulls"
    """S_z < 0: the floor would have to hold the coin back."""
    LEAVES_CONE = "leaves_cone"
    """|S_xy| > μ S_z: more friction than the floor's coefficient μ allows, in a law that has one."""


# Beyond rounding, against the energy and the impulse.
_BEYOND_ROUNDING = 1e-9


def raised_flags(impacts: Impacts, friction: float | Array) -> dict[Flag, NDArray[np.bool_]]:
    """Return for each flag which impacts raise it, (n,).

    Args:
        impacts: of any coins.
        friction: μ of the floor, one number or (n,).
    """
    S = impacts.impulse
    size = np.linalg.norm(S, axis=1)
    return {
        Flag.GAINS_ENERGY: impacts.energy_change > _BEYOND_ROUNDING * np.abs(impacts.energy),
        Flag.PULLS: S[:, 2] < -_BEYOND_ROUNDING * size,
        Flag.LEAVES_CONE: np.hypot(S[:, 0], S[:, 1]) - friction * S[:, 2] > _BEYOND_ROUNDING * size,
    }


class Path(Protocol):
    """A coin's motion that can be asked for its state at any time of the toss."""

    def sample(self, times: Array) -> States:
        """Return the states at `times` [s], in the order of `times`."""
        ...

    def floor_force(self, times: Array) -> Array:
        """Return the floor's force at `times` in sustained contacts, space frame, (n, 3) [N]."""
        ...


@dataclass(frozen=True, kw_only=True)
class Setting:
    """One line of a toss's certificate: a setting the engine used, or an error it measured."""

    name: str
    value: float | str
    unit: str = ""


@dataclass(frozen=True, kw_only=True)
class OtherOutcome:
    """Another outcome that a toss might have had, and the small change that leads to it."""

    outcome: Outcome
    change: float
    """The size of the change against the scales of the coin's state: r, √(g r) + |v|, 1 and √(g/r) + |ω|."""
    impact: int
    """The number of impacts before the change; 0 for a change of the release."""

    @property
    def told(self) -> str:
        """The change, in words."""
        where = f"after impact {self.impact}" if self.impact else "at the release"
        return f"a change of {self.change:.0e} {where} decides"


@dataclass(frozen=True, kw_only=True, eq=False)
class Later(ReadOnlyArrays, EqualByValue):
    """How a coin goes on after its toss is decided, see `ending.until`; arrays are read-only."""

    end: float = 0.0
    """The time at which the coin's path ends [s]; no later than the toss if the coin is not followed."""
    times: Array = field(default_factory=lambda: np.empty(0))
    """The times at which it touches and bounces, (n,) [s]."""
    contacts: Array = field(default_factory=lambda: np.empty((0, 2)))
    """Start and end of its sustained contacts, (n, 2) [s]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Toss(EqualByValue):
    """One toss by one engine; it equals another with the same numbers, whatever computed the path."""

    engine: str
    scenario: Scenario
    impacts: Impacts
    contacts: Array
    """Start and end of every sustained contact, (n, 2) [s]."""
    outcome: Outcome
    ending: Ending
    end_time: float
    """The time at which the toss stopped [s]."""
    outcome_certain: bool | None
    """Whether the engine's own errors can't change the outcome; None if the engine does not compute it."""
    other_outcome: OtherOutcome | None
    """Another outcome that the engine's own errors may lead to; None where none was found."""
    trusted_impacts: int
    """How many leading impacts the engine's own errors can't have changed; see the engine's `toss`."""
    trust_end: TrustEnd
    """Why the next impact is not trusted; `NONE` where all are."""
    certificate: Sequence[Setting]
    """Settings used and errors measured."""
    path: Path = field(compare=False)
    later: Later = field(default_factory=Later)
    """How the coin goes on after `end_time`."""
    rest: Rest | None = None
    """Where the coin comes to rest; None where it was not asked for, or where there is a reason against."""
    rest_reason: RestReason | None = None
    """That the coin comes to rest, or why not; None where it was not asked for."""

    def __post_init__(self) -> None:
        """Check the contacts and make them read-only."""
        if self.contacts.ndim != 2 or self.contacts.shape[1] != 2:
            raise ValueError(f"Toss.contacts: shape {self.contacts.shape}, expected (n, 2)")
        self.contacts.setflags(write=False)

    @property
    def sequence(self) -> str:
        """The faces up at the touches, as in "HHT"."""
        return self.impacts.sequence

    @property
    def path_end(self) -> float:
        """The time at which the path ends [s]: `end_time`, or with `ending.until` later."""
        return max(self.end_time, self.later.end)

    @property
    def later_times(self) -> Array:
        """The times at which the coin touches and bounces after `end_time`, (n,) [s]."""
        return self.later.times

    # The ending, the certainty of the outcome, and the trusted impacts are three separate facts. The texts
    # below must not contradict each other.

    @property
    def is_sure(self) -> bool:
        """Whether it has an outcome that the engine's own errors can't change."""
        return bool(self.outcome_certain) and self.outcome.is_decided

    @property
    def is_certain(self) -> bool:
        """Whether its outcome `is_sure`, and proved by its ending."""
        return self.is_sure and not self.ending.proviso

    @property
    def outcome_told(self) -> str:
        """The outcome, and how sure it is, in words."""
        told, other = str(self.outcome), self.other_outcome
        if not self.outcome.is_decided:
            return told
        if self.is_certain:
            return f"{told}, and that is certain"
        if other:
            return f"{told} or {other.outcome}: {other.told}"
        if self.outcome_certain is None:
            reserved = f"{told} {self.ending.proviso}".rstrip()
            return f"{reserved}; this engine does not find out how certain that is"
        but, how = ("that is the only doubt: ", "can't") if self.is_sure else ("", "may")
        return f"{told} {self.ending.proviso or 'as computed'}; {but}the engine's own errors {how} change it"

    @property
    def trust_reason(self) -> str:
        """Why the impact after the trusted ones is not trusted, in words; empty where all are."""
        number = self.trusted_impacts + 1
        if self.trust_end == TrustEnd.ERRORS and (level := self._level_at(number - 1)):
            return (
                f"impact {number} is {level}, where a tilt below every error chooses the point that touches"
            )
        return self.trust_end.reason(number)

    def _level_at(self, impact: int) -> str:
        """Return whether the coin touches "flat" or "upright" at an impact, counted from 0; else ""."""
        e0, e1, e2, e3 = self.impacts.quaternion[impact]
        kept, turned = np.hypot(e0, e3), np.hypot(e1, e2)
        upright = "upright" if abs(kept - turned) < FACE_SINE else ""
        return "flat" if 2 * kept * turned < FACE_SINE else upright

    @property
    def trust(self) -> str:
        """The number of trusted impacts, why the trust ends, and whether that matters, in words."""
        trusted, count = self.trusted_impacts, len(self.impacts)
        impacts = f"{count} impact" if count == 1 else f"{count} impacts"
        if trusted >= count:
            return impacts
        told = f"{trusted} of {impacts}" + (f": {self.trust_reason}" if self.trust_reason else "")
        return f"{told}; yet all faces and the outcome stay the same" if self.is_sure else told

    @property
    def flags(self) -> tuple[frozenset[Flag], ...]:
        """The flags that each impact raises; that of the friction cone where the contact law has one."""
        law, raised = (
            LAWS[self.scenario.floor.contact],
            raised_flags(self.impacts, self.scenario.floor.friction),
        )
        if not (law.uses_friction or law.is_smooth):
            del raised[Flag.LEAVES_CONE]
        return tuple(frozenset(flag for flag in raised if raised[flag][i]) for i in range(len(self.impacts)))

    def __repr__(self) -> str:
        """Return how the toss ended, and the faces up at its touches."""
        sequence = notebook.shortened(notebook.with_bar(self.sequence, self.trusted_impacts))
        return (
            f"<Toss by {self.engine}: {self.outcome}, {self.ending} at {self.end_time:.6g} s; "
            f"{len(self.impacts)} impacts: {sequence}>"
        )

    def _repr_html_(self) -> str:
        """Return what `repr` says, with a picture of the path."""
        times = np.linspace(0, self.path_end, _DRAWN)
        heights = self.sample(times).position[:, 2]
        impacts, trusted = self.impacts, self.trusted_impacts
        labels = [str(Face(face)) for face in impacts.face]
        touches = list(zip(impacts.time.tolist(), impacts.position[:, 2].tolist(), labels, strict=True))
        sequence = notebook.with_bar(self.sequence, trusted)
        return notebook.path_block(
            f"{self.outcome}, by the engine {self.engine}",
            {
                "ending": f"{self.ending}: {self.ending.sentence}",
                "end": f"{self.end_time:.6g} s, after {len(impacts)} impacts",
                "sequence": notebook.shortened(sequence),
                "trusted": self.trust,
            },
            times.tolist(),
            heights.tolist(),
            touches,
            float(impacts.time[trusted]) if trusted < len(impacts) else None,
        )

    def to_xarray(self) -> "xr.Dataset":
        """Return the impacts as a dataset of xarray over `impact`, with how the toss ended as attributes.

        The path is that of `sample(times).to_xarray()`.
        """
        about = {
            "engine": self.engine,
            "outcome": str(self.outcome),
            "ending": str(self.ending),
            "end_time": self.end_time,
            **({} if self.outcome_certain is None else {"outcome_certain": self.outcome_certain}),
            "trusted_impacts": self.trusted_impacts,
            "trust_end": str(self.trust_end),
            "sequence": self.sequence,
        }
        return self.impacts.to_xarray().assign_attrs(about)

    def to_dataframe(self) -> "pd.DataFrame":
        """Return the impacts as a table of pandas, a row each."""
        return self.impacts.to_dataframe()

    def plot(self, ax: Any = None, **line: Any) -> Any:
        """Plot the height of the mass centre over time, marked where the coin touches the floor.

        Args:
            ax: matplotlib's Axes where to draw, by default in a new figure of pyplot.
            line: of matplotlib's line, such as `color` or `label`.

        Returns:
            The axes.
        """
        return view("plot_toss")(self, ax, **line)

    def play(self, other: "Toss | None" = None) -> notebook.Frame:
        """Return what a notebook shows as the coin in 3D with its clock, its sequence and its energy.

        Args:
            other: a toss that is played beside it, by either engine, of this or another scenario.

        Returns:
            A frame, whose `page` is the HTML of a page that needs no other file and no network.

        Raises:
            TypeError: for another that is no toss.
        """
        return view("play")(self, other)

    def to_gltf(self) -> bytes:
        """Return the coin and its path as an animation: a .glb file of glTF 2.0, in metres, y up.

            Path("toss.glb").write_bytes(toss.to_gltf())

        Blender, game engines and three.js open it. The extras of its node `coin` hold the outcome, the
        impacts, and how far the animation misses at most between two poses [m].

        Raises:
            UnsupportedError: for a path that takes over a million poses.
        """
        return view("gltf")(self)

    def sample(self, times: ArrayLike) -> States:
        """Return the coin's states at `times`.

        At the time of an impact the analytic engine gives the state after it; MuJoCo, in which a contact
        takes time, gives the state at first touch.

        Args:
            times: one time, or (n,), each from 0 to `path_end` [s].

        Raises:
            ValueError: for a time outside the toss, or times in more than one dimension.
        """
        t = self._required(times)
        return interruptible(lambda: self.path.sample(t))

    def floor_force(self, times: ArrayLike) -> Array:
        """Return the floor's force on the coin in its sustained contacts, space frame, (n, 3) [N].

        Elsewhere it is 0; what the floor does in an impact is the impact's impulse. It is 0 in a contact that
        takes no time, too, such as that in which a coin comes to lie flat.

        Args:
            times: one time, or (n,), each from 0 to `path_end` [s].

        Raises:
            ValueError: as `sample`.
        """
        t = self._required(times)
        force = np.zeros((len(t), 3))
        contacts = np.concatenate([self.contacts, self.later.contacts])
        contact = np.searchsorted(contacts[:, 0], t, side="right") - 1
        # The last is that of contact -1, before the first.
        starts, ends = np.append(contacts, [[-np.inf, -np.inf]], axis=0).T
        held = (t <= ends[contact]) & (starts[contact] < ends[contact])
        if held.any():
            force[held] = interruptible(lambda: self.path.floor_force(t[held]))
        return force

    def _required(self, times: ArrayLike) -> Array:
        """Return times as an array, (n,); refuse those outside the toss."""
        t = np.atleast_1d(np.array(times, dtype=float))
        if t.ndim != 1:
            raise ValueError(f"times: shape {t.shape}, accepted: (n,)")
        outside = t[~((t >= 0) & (t <= self.path_end))]
        if outside.size:
            raise ValueError(f"times: {outside[0]} s is outside the toss, from 0 to {self.path_end} s")
        return t


class UnsupportedError(ValueError):
    """A scenario that an engine can't toss; the message names the field, its value and what is accepted."""


class UnusableEngineError(RuntimeError):
    """An engine that can't be used as it is installed; the message says what to do."""


class ApproximationWarning(UserWarning):
    """A scenario that an engine tosses by something near to it; the message names the field and by what."""
