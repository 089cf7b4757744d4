"""Whether a run finds the numbers of an earlier one: each with what it may differ by, and why."""

import json
import math
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeGuard

from cointoss.study import read_bounded
from cointoss_reproduction.frame.cells import ENDS, TABLE, read_table
from cointoss_reproduction.frame.claim import VERDICTS, read_claims
from cointoss_reproduction.frame.provenance import PROVENANCE, read_provenance, unlike

CONFIDENCE = 2.58
"""Standard deviations to either side of 99 % of a normal distribution."""
BITS = "equal to the bit: the same sources, versions and kind of machine"
EQUAL = "equal to the bit"
ESTIMATE = "each value within the other's 99 % interval"
COUNT = f"within {CONFIDENCE} √n of the larger count n: tosses past their horizon of trust may end otherwise"
PRINTED = "within one in the third digit, as they are printed"
BESIDE = "within a thousandth of the largest number beside it"
SMALL = "within a hundredth of the threshold: rounding"
SAME = "equal"
MOST_BYTES = 1 << 26
"""Of the numbers of a run."""
LONGEST = 18
"""Digits of a whole number."""
_ENDS = frozenset({"value", "low", "high"})
"""Of an estimate."""
_TOLD = ("analytic", "mujoco", "headline")
"""What a claim says in words."""


@dataclass(frozen=True, kw_only=True)
class Compared:
    """A number of two runs."""

    place: str
    """Where it stands."""
    there: Any
    here: Any
    reason: str
    """What it may differ by, and why."""
    agrees: bool


@dataclass(frozen=True, kw_only=True)
class Check:
    """What two runs have in common."""

    unlike: str
    """By what their sources, versions and machines differ, in words; empty where by nothing."""
    verdicts: int
    """How many claims were compared."""
    changed: tuple[str, ...]
    """Claims whose verdict changes, in words."""
    numbers: tuple[Compared, ...]
    words: tuple[str, ...] = ()
    """What the claims say in words, where that differs; its numbers have no tolerance of their own."""

    @property
    def off(self) -> tuple[Compared, ...]:
        """The numbers that do not agree."""
        return tuple(number for number in self.numbers if not number.agrees)

    @property
    def agrees(self) -> bool:
        """Whether no verdict changes and all numbers agree; the words too, where the bits should."""
        return not self.changed and not self.off and (bool(self.unlike) or not self.words)


class RunError(ValueError):
    """A folder that is not as a run leaves it; the message names the file and why."""


def require_run(folder: Path, *, quick: bool | None) -> None:
    """Check that a folder holds what a run of this size, or of any, has left.

    Raises:
        RunError: naming the file, why, and what is accepted.
    """
    if not (folder / "claims.json").is_file():
        raise RunError(
            f"{folder}: holds no claims.json, so no run; accepted: --check DIR after a run with --out DIR"
        )
    made_of: Any = None
    for name, read in (
        ("claims.json", lambda: _require_claims(folder)),
        ("numbers.json", lambda: _numbers(folder)),
        (TABLE, lambda: _columns(folder)),
        (PROVENANCE, lambda: read_provenance(folder)),
    ):
        try:
            made_of = read()
        except (ValueError, TypeError, LookupError, AttributeError, RecursionError, OSError) as error:
            why = error.strerror if isinstance(error, OSError) else error
            raise RunError(f"{folder / name}: {why}; accepted: the file as a run has written it") from None
    if quick is not None and quick is not (made_of is not None and made_of["quick"]):
        size, way = ("full", "without") if quick else ("quick", "with")
        raise RunError(f"{folder}: of the {size} size; accepted: the same {way} --quick")


def _require_claims(folder: Path) -> None:
    """Check that the claims of a run are claims, with verdicts.

    Raises:
        ValueError, TypeError, LookupError, AttributeError: where they are not.
    """
    listed = json.loads((folder / "claims.json").read_text(encoding="utf-8"))
    if not isinstance(listed, list):
        raise ValueError("no list of claims")
    for number, one in enumerate(listed, start=1):
        if not (isinstance(one["claim"], str) and "\n" not in one["claim"]):
            raise ValueError(f"claim {number}: no line of text")
        if not (one["holds"] is None or isinstance(one["holds"], bool)):
            raise ValueError(f"claim {number}: holds is {one['holds']!r}")
        for value in (value for criterion in one["criteria"] for value in _values(criterion)):
            if not (isinstance(value, float) or (_is_number(value) and abs(value) < 10**LONGEST)):
                raise ValueError(f"claim {number}: {str(value)[:LONGEST]!r} where a number is due")
    read_claims(folder / "claims.json")


def _values(criterion: Mapping[str, Any]) -> list[Any]:
    """Return the numbers of a criterion."""
    measured = criterion["measured"]
    ends = [measured[end] for end in sorted(_ENDS)] if isinstance(measured, dict) else [measured]
    return [criterion["threshold"], *ends]


def _numbers(folder: Path) -> Any:
    """Return the numbers of a run, None where it keeps none as text.

    Raises:
        ValueError, OSError: for what no run writes: what is not finite, or a share that is no number.
    """
    path = folder / "numbers.json"
    if not path.exists():
        return None
    read = {"parse_int": _whole, "parse_float": _finite, "parse_constant": _finite}
    return json.loads(read_bounded(path, MOST_BYTES), object_hook=_of_numbers, **read)


def _columns(folder: Path) -> dict[str, list[Any]] | None:
    """Return the table of a run by columns, an estimate as its ends, None where it keeps none.

    Raises:
        ValueError, OSError: where it is no table.
    """
    path = folder / TABLE
    if not path.exists():
        return None
    table = read_table(path).astype(object)
    columns = {str(name): values.tolist() for name, values in table.where(table.notna(), None).items()}
    for name in [name for name in columns if f"{name}{ENDS[0]}" in columns]:
        ends = zip(columns[name], *(columns.pop(name + end) for end in ENDS), strict=True)
        columns[name] = [{"value": value, "low": low, "high": high} for value, low, high, *_ in ends]
    return columns


def _whole(text: str) -> int:
    if len(text) > LONGEST:
        raise ValueError(f"a whole number of {len(text)} digits")
    return int(text)


def _finite(text: str) -> float:
    number = float(text)
    if not math.isfinite(number):
        raise ValueError(f"{text[:LONGEST]}: no finite number")
    return number


def _of_numbers(table: dict[str, Any]) -> dict[str, Any]:
    if table.keys() >= _ENDS and not all(_is_number(table[end]) for end in _ENDS):
        raise ValueError(f"{', '.join(f'{end} {table[end]!r}' for end in sorted(_ENDS))}: no numbers")
    return table


def check(there: Path, here: Path, *, timed: bool) -> Check:
    """Compare the folders of two runs.

    Args:
        there: of the earlier run.
        here: of the run of this machine.
        timed: whether the numbers are times, which no two runs share.
    """
    ours = read_provenance(here)
    assert ours is not None
    other = unlike(read_provenance(there), ours)
    claims, found = _claims(there), _claims(here)
    changed = tuple(
        f"{claim}: {_verdict(claims.get(claim))} there, {_verdict(found.get(claim))} here"
        for claim in {**claims, **found}
        if _verdict(claims.get(claim)) != _verdict(found.get(claim))
    )
    numbers: list[Compared] = []
    words: list[str] = []
    if not timed:
        words = [
            f"{claim}: {claims[claim].get(who, 'nothing')} there, {found[claim][who]} here"
            for claim in claims
            for who in _TOLD
            if claim in found and claims[claim].get(who) != found[claim][who]
        ]
        for claim in claims.keys() & found.keys():
            numbers += _criteria(claim, claims[claim]["criteria"], found[claim]["criteria"], exact=not other)
        if (kept := _numbers(there)) is not None:
            numbers += compared("numbers.json", kept, _numbers(here), exact=not other)
        if (columns := _columns(there)) is not None:
            numbers += compared(TABLE, columns, _columns(here), exact=not other)
    return Check(
        unlike=other,
        verdicts=len({**claims, **found}),
        changed=changed,
        numbers=tuple(numbers),
        words=tuple(words),
    )


def _claims(folder: Path) -> dict[str, Any]:
    """Return the claims of a run by their words, alike ones numbered."""
    listed, seen = json.loads((folder / "claims.json").read_text(encoding="utf-8")), Counter[str]()
    claims = {}
    for one in listed:
        seen[one["claim"]] += 1
        number = seen[one["claim"]]
        claims[one["claim"] if number == 1 else f"{one['claim']} ({number})"] = one
    return claims


def _verdict(claim: Mapping[str, Any] | None) -> str:
    return "no such claim" if claim is None else VERDICTS[claim["holds"]]


def _criteria(claim: str, there: list[Any], here: list[Any], *, exact: bool) -> Iterator[Compared]:
    if len(there) != len(here):
        yield _unequal(claim, f"{len(there)} criteria", f"{len(here)} criteria", PRINTED)
    for one, other in zip(there, here, strict=False):
        place = f"{claim}: {other['quantity']}"
        threshold = min(abs(one["threshold"]), abs(other["threshold"]))
        yield from compared(place, one["measured"], other["measured"], exact=exact, small=threshold / 100)


def compared(
    place: str, there: Any, here: Any, *, exact: bool, beside: float = 0.0, small: float = 0.0
) -> Iterator[Compared]:
    """Yield the numbers of two values as JSON has them, each with what it may differ by.

    Neither run is preferred: exchanged, they agree in the same places.

    Args:
        place: where the values stand.
        there: of the earlier run.
        here: of this one.
        exact: whether the bits should be the same.
        beside: the largest number in the lists that hold them.
        small: what rounding may change.
    """
    if isinstance(there, dict) and isinstance(here, dict):
        if not exact and _ENDS <= there.keys() & here.keys():
            agrees = _same(there["value"], here["value"]) or all(
                one["low"] <= other["value"] <= one["high"] for one, other in ((there, here), (here, there))
            )
            yield Compared(
                place=place, there=there["value"], here=here["value"], reason=ESTIMATE, agrees=agrees
            )
            return
        for key in {**there, **here}:
            inner = f"{place} {key}"
            if key in there and key in here:
                yield from compared(inner, there[key], here[key], exact=exact, small=small)
            else:
                yield _unequal(
                    inner, "given" if key in there else "none", "given" if key in here else "none", SAME
                )
    elif isinstance(there, list) and isinstance(here, list):
        if len(there) != len(here):
            yield _unequal(place, f"{len(there)} numbers", f"{len(here)} numbers", SAME)
        largest = max((abs(one) for one in (*there, *here) if isinstance(one, float)), default=0.0)
        for number, (one, other) in enumerate(zip(there, here, strict=False)):
            yield from compared(f"{place}[{number}]", one, other, exact=exact, beside=largest, small=small)
    elif _is_number(there) and _is_number(here):
        allowed, reason = (0.0, BITS) if exact else _allowed(there, here, beside, small)
        agrees = _same(there, here) or abs(there - here) <= allowed
        yield Compared(place=place, there=there, here=here, reason=reason, agrees=agrees)
    else:
        yield Compared(place=place, there=there, here=here, reason=SAME, agrees=there == here)


def _allowed(there: float, here: float, beside: float, small: float) -> tuple[float, str]:
    """Return by how much two numbers may differ, and why; the same whichever is the earlier."""
    if isinstance(there, int) and isinstance(here, int):
        return CONFIDENCE * math.sqrt(max(abs(there), abs(here))), COUNT
    size = max(abs(there), abs(here))
    printed = 10.0 ** (math.floor(math.log10(size)) - 2) if 0 < size < math.inf else 0.0
    return max((printed, PRINTED), (beside / 1000, BESIDE), (small, SMALL), key=lambda pair: pair[0])


def _same(there: float, here: float) -> bool:
    """Return whether two numbers are equal, or both not a number, as the share of no trials."""
    return there == here or (math.isnan(there) and math.isnan(here))


def _is_number(value: Any) -> TypeGuard[float]:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _unequal(place: str, there: str, here: str, reason: str) -> Compared:
    return Compared(place=place, there=there, here=here, reason=reason, agrees=False)


def in_words(name: str, where: str, found: Check, *, timed: bool) -> str:
    """Return what a check found, in lines.

    Args:
        name: of what was reproduced.
        where: the folder with which it was compared.
        found: by the check.
        timed: as `check` takes it.
    """
    lines = [
        f"{name}: {len(found.changed)} of {found.verdicts} verdicts change, "
        f"{len(found.off)} of {len(found.numbers)} numbers are off, against {where}"
    ]
    if timed:
        lines.append("  its numbers are times: verdicts alone are compared")
    elif found.unlike:
        lines.append(f"  not to the bit: {found.unlike}")
    agreeing = Counter(
        EQUAL if number.there == number.here else number.reason for number in found.numbers if number.agrees
    )
    lines += [f"  {count} {reason}" for reason, count in agreeing.items()]
    lines += [f"  changes: {words}" for words in found.changed]
    lines += [f"  in other words: {words}" for words in found.words]
    lines += [
        f"  off: {number.place}: {number.there} there, {number.here} here; accepted: {number.reason}"
        for number in found.off
    ]
    return "\n".join(lines)
