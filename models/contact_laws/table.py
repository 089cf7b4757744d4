"""The records of all contact laws, and what compiled code asks of a law by its number."""

from collections.abc import Callable, Sequence
from importlib import import_module

from cointoss.models.contact_laws.law import Impact, Law
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector
from cointoss.models.laws import ContactLaw

LAWS: dict[ContactLaw, Law] = {law: import_module(f"{__package__}.{law}").LAW for law in ContactLaw}
"""Each law's record lies in the module of its name."""


def laws_that(has: Callable[[Law], bool]) -> tuple[ContactLaw, ...]:
    """Return the laws whose record has what is asked."""
    return tuple(law for law, record in LAWS.items() if has(record))


def quoted(laws: Sequence[ContactLaw]) -> str:
    """Return laws as a message lists them."""
    return ", ".join(f'"{law}"' for law in laws)


def _asked(has: Callable[[Law], bool]) -> Callable[[int], bool]:
    """Return a compiled function that says of a law, by its number, whether its record has what is asked."""
    bits = sum(1 << law for law in laws_that(has))

    @compiled
    def is_so(law: int) -> bool:
        return bits >> law & 1 == 1

    return is_so


uses_friction = _asked(lambda law: law.uses_friction)
jumps_without_slip = _asked(lambda law: law.jumps_without_slip)
is_smooth = _asked(lambda law: law.is_smooth)
spares_spin = _asked(lambda law: law.spares_spin)
is_rough = _asked(lambda law: law.is_rough)
is_followed = _asked(lambda law: law.is_followed)
never_adds = _asked(lambda law: law.never_adds_energy)
hardly_adds_energy = _asked(lambda law: law.hardly_adds_energy)
may_be_energetic = _asked(lambda law: law.may_be_energetic)


def _impulse_of_one(numbers: Sequence[ContactLaw]) -> Callable[[int, Impact], tuple[Vector, bool]]:
    """Return a compiled function that gives the impulse by one of some laws, by its number."""
    number, own = int(numbers[0]), LAWS[numbers[0]].impulse
    if len(numbers) == 1:

        @compiled
        def of_last(law: int, A: Impact) -> tuple[Vector, bool]:  # noqa: ARG001
            return own(A)

        return of_last
    of_another = _impulse_of_one(numbers[1:])

    @compiled
    def of_one(law: int, A: Impact) -> tuple[Vector, bool]:
        return own(A) if law == number else of_another(law, A)

    return of_one


impulse_by: Callable[[int, Impact], tuple[Vector, bool]] = _impulse_of_one(tuple(ContactLaw))
"""The impulse by the law of a number: S, space frame [N s], and whether there is one."""
