"""The palette: one pair of colours for the faces, and outcomes that the colour-blind can distinguish."""

import itertools
import re
from importlib import resources

import numpy as np
import pytest
from matplotlib.colors import to_rgb

from cointoss.compare.film.captions import LABELS
from cointoss.compare.output.style import OUTCOMES, looks_of
from cointoss.models.records import Outcome

# Linear RGB as seen by a protanope and a deuteranope; Viénot, Brettel and Mollon, Color Res. Appl. 24 (1999).
SEEN = {
    "by most": np.eye(3),
    "by a protanope": np.array([[0.11238, 0.88762, 0], [0.11238, 0.88762, 0], [0.00401, -0.00401, 1]]),
    "by a deuteranope": np.array([[0.29275, 0.70725, 0], [0.29275, 0.70725, 0], [-0.02234, 0.02234, 1]]),
}


def linear(color):
    encoded = np.array(to_rgb(color))
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


@pytest.mark.parametrize("eyes", SEEN)
def test_outcomes_are_distinguished_by_all_eyes(eyes):
    seen = [np.clip(SEEN[eyes] @ linear(color), 0, 1) ** (1 / 2.2) for color in OUTCOMES.values()]
    assert len(seen) == len(Outcome)
    for one, other in itertools.combinations(seen, 2):
        assert np.linalg.norm(one - other) > 0.2


def test_engines_of_others_are_told_apart():
    looks = looks_of(["analytic", "a", "mujoco", "b", "c", "d"])
    assert [look.kind for look in looks] == ["analytic", "other-1", "mujoco", "other-2", "other-3", "other-4"]
    assert len({look.color for look in looks}) == len(looks)


COIN = (resources.files("cointoss.models") / "coin.xml").read_text(encoding="utf-8")
MATERIALS = {
    name: [float(part) for part in rgb.split()]
    for name, rgb in re.findall(r'<material name="(\w+)" rgba="([\d. ]+) 1"', COIN)
}
"""The colours of the film's coin."""


@pytest.mark.parametrize(("face", "outcome"), [("heads", Outcome.HEADS), ("tails", Outcome.TAILS)])
def test_the_coin_of_the_film_has_the_colours_of_the_maps(face, outcome):
    assert MATERIALS[face] == pytest.approx(to_rgb(OUTCOMES[outcome]), abs=0.005)
    assert LABELS[outcome][0] == OUTCOMES[outcome]


@pytest.mark.parametrize(
    ("light", "dark"), [("heads", "tails"), ("heads", "heads_letter"), ("tails_letter", "tails")]
)
def test_the_faces_and_their_letters_differ_in_brightness_too(light, dark):
    """By the contrast of the web's guidelines."""
    one, other = (linear(MATERIALS[name]) @ [0.2126, 0.7152, 0.0722] + 0.05 for name in (light, dark))
    assert one / other > 3
