"""What a toss and its fields are called in words."""

import pytest

from cointoss.models.fields import UNITS, WORDS
from cointoss.models.reading import load
from cointoss.models.title import title_of_toss
from cointoss.models.units import lambda_unit, printed_unit


@pytest.mark.parametrize(
    ("field", "value", "varied", "title"),
    [
        ("release.position.z", 0.4, (), "fig24a: 2 g, 25 mm, from 40 cm"),
        ("release.position.z", 0.40001, (), "fig24a: 2 g, 25 mm, from 40.001 cm"),
        ("release.position.z", 1, (), "fig24a: 2 g, 25 mm, from 1 m"),
        ("release.position.z", 0.0999, (), "fig24a: 2 g, 25 mm, from 99.9 mm"),
        ("coin.mass", 1.5, ("release.position.z",), "fig24a: 1.5 kg, 25 mm"),
        ("coin.radius", 0.06, ("gravity", "coin.mass"), "fig24a: 12 cm, from 40.001 cm"),
        ("coin.mass", 0.00814, ("coin.radius",), "fig24a: 8.14 g, from 40.001 cm"),
    ],
)
def test_a_title_tells_the_coin_and_the_height_but_for_what_varies(field, value, varied, title):
    case = load("fig24a").replace(field, value)
    assert title_of_toss(case, "fig24a", varied=varied) == title
    assert title_of_toss(case, "", varied=varied) == title.removeprefix("fig24a: ")


def test_a_title_of_nothing_but_the_name_has_no_colon():
    varied = "coin.mass", "coin.radius", "release.position.z"
    assert title_of_toss(load("fig24a"), "mine", varied=varied) == "mine"


def test_each_field_has_a_word_of_its_own():
    assert len(set(WORDS.values())) == len(WORDS) == len(UNITS)
    assert (WORDS["release.position.z"], WORDS["release.angular_velocity.eta"]) == ("height", "spin about η")


def test_units_are_printed_with_raised_powers():
    printed = [printed_unit(unit) for unit in ("", "rad/s", "m/s**2", lambda_unit(0.5))]
    assert printed == ["", "rad/s", "m/s²", "kg m⁻²·⁵ s⁻⁰·⁵"]
