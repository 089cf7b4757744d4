"""The fields of a scenario that nothing uses."""

import warnings

from cointoss.models.contact_laws.table import laws_that
from cointoss.models.parts import Air, Floor

_WITH_FRICTION = laws_that(lambda law: law.uses_friction)


class UnusedFieldWarning(UserWarning):
    """A field of a scenario that nothing uses; the message names it, its value and what would use it."""


def unused_fields(floor: Floor, air: Air) -> list[str]:
    """Return a line for each field that has no effect: its name, its value, and what would use it."""
    law, laws = floor.contact, " and ".join(f'"{law}"' for law in _WITH_FRICTION)
    has_friction = floor.contact in _WITH_FRICTION
    lines = {
        f'floor.friction = {floor.friction:g}: not used with contact = "{law}"; {laws} use it': (
            floor.friction > 0 and not has_friction
        ),
        f'floor.friction = 0: contact = "{law}" is then without friction; '
        'give a number > 0, such as 0.3, or contact = "smooth"': floor.friction == 0 and has_friction,
        f"floor.restitution_threshold = {floor.restitution_threshold:g}: not used with restitution = 0; "
        "a restitution > 0 uses it": floor.restitution_threshold > 0 and floor.restitution == 0,
        f"floor.restitution_speed = {floor.restitution_speed:g}: not used with restitution_exponent = 0; "
        "an exponent > 0 uses it": floor.restitution_speed != 1 and floor.restitution_exponent == 0,
        f"air.exponent = {air.exponent:g}: not used without air; "
        "normal > 0 or tangential > 0 uses it": air.exponent > 0 and air.normal == air.tangential == 0,
    }
    return [line for line, is_so in lines.items() if is_so]


def warn_of_unused_fields(floor: Floor, air: Air) -> None:
    """Warn of each field that has no effect.

    Warns:
        UnusedFieldWarning: naming field, value and what would use it.
    """
    for line in unused_fields(floor, air):
        warnings.warn(line, UnusedFieldWarning, stacklevel=3)
