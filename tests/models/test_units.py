"""Quantities in SI: units written often are read without pint, to the same bit."""

import subprocess
import sys

import numpy as np
import pytest

from models import units
from tests.helpers.command_line import HERE


@pytest.mark.parametrize(
    ("unit", "given"), [(unit, given) for unit, common in units._COMMON.items() for given in common]
)
def test_a_common_unit_gives_the_number_that_pint_gives(monkeypatch, unit, given):
    random = np.random.default_rng(1)
    numbers = [*(10.0 ** random.uniform(-9, 9, 100) * random.choice([-1, 1], 100)).tolist(), 0.0, 1.25, 7.0]
    texts = [f"{number!r} {given}" for number in numbers]
    ours = [units.in_si(text, unit) for text in texts]
    monkeypatch.setattr(units, "_COMMON", {})
    assert ours == [units.in_si(text, unit) for text in texts]


def test_pint_is_imported_for_other_units_alone():
    script = (
        "import sys; from models.units import in_si\n"
        "assert in_si('2 g', 'kg') == 0.002 and 'pint' not in sys.modules\n"
        "assert in_si('1 inch', 'm') == 0.0254 and 'pint' in sys.modules"
    )
    subprocess.run([sys.executable, "-c", script], env=HERE, check=True)
