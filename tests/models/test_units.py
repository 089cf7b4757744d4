"""Quantities in SI: units written often are read without pint, to the same bit."""

import numpy as np
import pytest

from cointoss.models import units
from tests.helpers.command_line import python


@pytest.mark.parametrize(
    ("unit", "given"), [(unit, given) for unit, common in units.COMMON.items() for given in common]
)
def test_a_common_unit_gives_the_number_that_pint_gives(monkeypatch, unit, given):
    random = np.random.default_rng(1)
    numbers = [*(10.0 ** random.uniform(-9, 9, 100) * random.choice([-1, 1], 100)).tolist(), 0.0, 1.25, 7.0]
    texts = [f"{number!r} {given}" for number in numbers]
    ours = [units.in_si(text, unit) for text in texts]
    monkeypatch.setattr(units, "COMMON", {})
    assert ours == [units.in_si(text, unit) for text in texts]


ENDLESS = """kg**9**9**9, kg^9^9^9, kg**1e9, kg**1000000000, kg**(9**9**9), (((kg**99)**99)**99)**99,
kibig⁹⁹⁹⁹⁹⁹⁹⁹⁹, kibig⁹⁹**99, sq square cubic kibig squared cubed, kg*9**9**9, ((10**99)**99)**99*kg,
kg.__class__, __import__('os')"""


@pytest.mark.parametrize(
    "text",
    [
        *(f"1 {unit}" for unit in ENDLESS.replace("\n", " ").split(", ")),
        "1 " + 100 * "(" + "kg",
        "1" + 250 * "0" + " lb",
        "1 lb" + 250 * " ",
    ],
)
def test_pint_is_not_asked_for_what_could_take_it_for_ever(monkeypatch, text):
    asked = []
    monkeypatch.setattr(units, "pint_registry", lambda: asked.append(text))
    with pytest.raises(ValueError, match="a number in kg, or a string with a unit"):
        units.in_si(text, "kg")
    assert not asked


@pytest.mark.parametrize(
    ("text", "unit", "number"),
    [
        ("9.81 m/s^2", "m/s**2", 9.81),
        ("5 m/s²", "m/s**2", 5.0),
        ("1 m s⁻¹", "m/s", 1.0),
        ("7 °", "rad", 7 * np.pi / 180),
        ("2 µm", "m", 2e-6),
        ("12 g·cm²", "kg*m**2", 1.2e-6),
        ("3 g / (cm^2 s)", "kg*m**-2*s**-1", 30.0),
        ("3 rad per s", "rad/s", 3.0),
        ("2 1/s * m", "m/s", 2.0),
        ("1 kg*m^(-5/2)*s^(-1/2)", "kg*m**-2.5*s**-0.5", 1.0),
        ("1 kg*m**-2.333333333333333*s**-0.5", "kg*m**-2.333333333333333*s**-0.5", 1.0),
        ("3 ‰", "", 0.003),
    ],
)
def test_units_are_written_in_many_ways(text, unit, number):
    assert units.in_si(text, unit) == pytest.approx(number, rel=1e-15)


def test_pint_is_imported_for_other_units_alone():
    script = (
        "import sys; from cointoss.models.units import in_si\n"
        "assert in_si('2 g', 'kg') == 0.002 and 'pint' not in sys.modules\n"
        "assert in_si('1 inch', 'm') == 0.0254 and 'pint' in sys.modules"
    )
    assert python("-c", script).returncode == 0
