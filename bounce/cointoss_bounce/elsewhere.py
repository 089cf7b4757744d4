"""The bounce of two geoms by the MuJoCo of another Python, which needs numpy beside it, and both versions."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import json
import subprocess
from dataclasses import asdict
from difflib import unified_diff
from pathlib import Path
from typing import Any

import mujoco

from cointoss_bounce.bounce_lines import bounce_lines
from cointoss_bounce.errors import FieldError
from cointoss_bounce.pair import PairBounce

RUN = """
import importlib.util as find, json, sys
at = find.spec_from_file_location("cointoss_bounce", sys.argv[1], submodule_search_locations=sys.argv[2:3])
sys.modules["cointoss_bounce"] = find.module_from_spec(at)
from cointoss_bounce import elsewhere, pair
told = elsewhere.told(pair.bounce(*sys.argv[3:]))
print(json.dumps(told, default=lambda array: array.tolist()))
"""
"""What the other Python runs: it sees this package, and none that lies beside it."""


def measured_by(python: str, *asked: str) -> dict[str, Any]:
    """Return what another Python tells, given the model and the names of both geoms.

    Raises:
        FieldError: with the last line that it says, where it measures nothing.
    """
    command = [python, "-c", RUN, Path(__file__).with_name("__init__.py"), Path(__file__).parent, *asked]
    try:
        return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    except (OSError, ValueError, subprocess.CalledProcessError) as error:
        said = (getattr(error, "stderr", "") or str(error)).strip().splitlines()[-1]
        accepted = "a Python from 3.11 on with numpy, and mujoco from 3.3 on"
        raise FieldError("--against", f"{python}: {said}", accepted) from None


def told(found: PairBounce) -> dict[str, Any]:
    """Return the version of MuJoCo here, what was measured, and its lines."""
    return {
        "mujoco": mujoco.__version__,
        "found": asdict(found),
        "lines": bounce_lines(found).splitlines(),
    }


def beside(here: dict[str, Any], there: dict[str, Any]) -> str:
    """Return the lines that two versions tell, as diff shows them."""
    names = [f"MuJoCo {each['mujoco']}" for each in (here, there)]
    lines = [*unified_diff(here["lines"], there["lines"], *names, n=len(here["lines"]), lineterm="")]
    return "\n".join(lines[:2] + lines[3:] or [*here["lines"], "", f"{names[1]}: the same"])
