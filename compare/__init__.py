"""Both engines asked the same question, and the command line; imports the other three packages."""

import inspect
import sys
from collections.abc import Callable
from types import ModuleType
from typing import Any


class _Package(ModuleType):
    """This package, which is the function `cointoss.compare` too, imported when it is first used."""

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        """Compare both engines' tosses of a scenario."""
        return _function()(*arguments, **named)

    @property
    def __signature__(self) -> inspect.Signature:
        return inspect.signature(_function())

    @property
    def _about(self) -> str:
        return f"{vars(self)['__doc__']}\n\ncompare{self.__signature__}\n\n{inspect.getdoc(_function())}"

    __doc__: Any = _about


def _function() -> Callable[..., Any]:
    from cointoss.compare.report.comparison import compare

    return compare


sys.modules[__name__].__class__ = _Package

if __name__ == "compare":  # by its bare name, in a checkout
    from cointoss.bare_names import open_as_part

    open_as_part(__name__)
