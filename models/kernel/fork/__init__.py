"""numba's compiler, changed by its private members: for the tested versions of numba alone."""

TESTED = ("0.68",)
"""The minor versions of numba that have these members as they are used here."""
