"""Builds an engine's library: numba lowers its entries, musl's functions are linked in, ziglang links it.

Nothing at run time imports this package. A checkout runs it as a process, once for the sources there.
"""
