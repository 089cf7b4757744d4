"""How functions of long arithmetic are compiled: by numba, as IEEE 754 has it, without the lock of Python."""

from numba import njit

compiled = njit(nogil=True, error_model="numpy")
