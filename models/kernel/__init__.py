"""Compiled functions and the vectors they compute with; imports nothing of the project."""

import time

BEGUN = time.time()
"""When modules began to be read: `cointoss.models` imports this package first [s]."""
