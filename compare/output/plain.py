"""Answers as JSON has them."""

import json
import math
from typing import Any


def json_text(found: Any) -> str:
    """Return tables, lists, arrays and numbers as JSON; null stands for what is infinite or NaN."""
    return json.dumps(_plain(found), indent=1, allow_nan=False)


def _plain(value: Any) -> Any:
    """Return tables, lists and arrays of numbers as JSON has them."""
    if hasattr(value, "tolist"):  # an array, or a number of numpy
        value = value.tolist()
    if isinstance(value, dict):
        return {name: _plain(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
