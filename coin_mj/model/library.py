"""MuJoCo's own functions, which compiled code calls by their addresses."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import ctypes
from functools import cache
from pathlib import Path

import mujoco

from cointoss.coin_mj.model.mujoco_coin import Functions
from cointoss.models.records import UnusableEngineError

PATH = str(next(Path(mujoco.__file__).parent.glob("*mujoco.*")))
"""The path of the library that the bindings have loaded already."""


@cache
def functions() -> Functions:
    """Return where the library's functions are."""
    library = ctypes.CDLL(PATH)
    found = (ctypes.cast(getattr(library, name), ctypes.c_void_p).value for name in Functions._fields)
    return Functions._make(address or 0 for address in found)


def require_no_contact_filter() -> None:
    """Raise UnusableEngineError where MuJoCo's user filters contacts: the coin's would be, too."""
    if mujoco.get_mjcb_contactfilter() is not None:
        raise UnusableEngineError(
            "mjcb_contactfilter is set, and MuJoCo asks it about the coin's contacts as well; "
            "accepted: mujoco.set_mjcb_contactfilter(None) before a toss, or `engine` analytic"
        )
