"""Compiled functions run by `numba.njit`, for tests and studies of parts of an engine."""

# numba describes few types.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false

from typing import Any

import numba

from cointoss.models.kernel.base_folder import base_folder
from cointoss.models.kernel.digests import ENGINES, code_digest, digest_of_parts


def dispatcher_of(function: Any, *, inlined: bool = False, wrapped: bool = True) -> Any:
    """Return numba's dispatcher of a function; its code is kept for exactly the sources that lie here.

    numba itself looks at the file of the function alone, not at those that it calls.

    Args:
        function: to be compiled.
        inlined: whether it goes into its callers.
        wrapped: whether Python calls it; wrappers take half of the time of compiling.
    """
    kept = f"numba-{_sources_of(function)}{'' if wrapped else '-bare'}"  # numba takes either for the other
    numba.config.CACHE_DIR = str(base_folder() / kept)
    bare: dict[str, Any] = {} if wrapped else {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
    return numba.njit(nogil=True, error_model="numpy", forceinline=inlined, cache=True, **bare)(function)


def _sources_of(function: Any) -> str:
    """Return the digest of the sources that a function may be made of: an engine imports the models alone."""
    package, part, *_ = *function.__module__.split("."), ""
    is_of_engine = package == "cointoss" and part in ENGINES
    return digest_of_parts(*sorted({"models", part})) if is_of_engine else code_digest()
