"""Tosses with known answers for any engine; its public names, each brought when it is first used."""

from typing import TYPE_CHECKING, Any

from cointoss.study import brought, homes_of

if TYPE_CHECKING:
    from cointoss_yardstick.simulators.simulator import Simulates as Simulates
    from cointoss_yardstick.suite.agreeing import assert_agrees as assert_agrees
    from cointoss_yardstick.suite.agreeing import assert_met as assert_met
    from cointoss_yardstick.suite.card import Card as Card
    from cointoss_yardstick.suite.conform import conform as conform

_HOMES = homes_of(__file__)
__all__ = list(_HOMES)  # pyright: ignore[reportUnsupportedDunderAll]


def __getattr__(name: str) -> Any:
    return brought(_HOMES, name, __name__)
