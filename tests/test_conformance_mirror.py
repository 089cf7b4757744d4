"""No side is preferred: mirror images of tosses are tosses, and one that is its own is certain of no face."""

import numpy as np
import pytest

from cointoss import analytic, coin_mj
from cointoss.models.records import Outcome
from tests.helpers.bits import STOUT, cases
from tests.helpers.draws import AIR, THIN, ZLOTY, scenario
from tests.helpers.mirror import SPACE, Mirror
from tests.helpers.symmetries import SYMMETRIES

CASES = cases()
LINEAR = [name for name, case in CASES.items() if case.air.exponent == 0]
COINS = {"thin": THIN, "thick": ZLOTY, "stout": STOUT}
FACES = (Outcome.HEADS, Outcome.TAILS)


@pytest.mark.slow_after_first
@pytest.mark.parametrize("mirror", list(Mirror))
@pytest.mark.parametrize("name", ["thin, air with b = 0.3", "imperfect, air with b = 0.3"])
def test_in_air_with_b_above_0_a_mirrored_toss_is_mirrored_to_the_error_of_a_step(name, mirror):
    """The friction of the air on the wall is summed in one order around it."""
    case = CASES[name].replace("ending.max_impacts", 3)
    here, there = (analytic.toss(each) for each in (case, mirror.scenario(case)))
    n = min(here.trusted_impacts, there.trusted_impacts)
    assert n == 3
    # Another rounding gives other steps, which err by 1e-13. An impact multiplies that, by a hundred at most.
    late = np.abs(there.impacts.time - here.impacts.time)
    off = np.linalg.norm(there.impacts.impulse - SPACE * here.impacts.impulse, axis=1)
    assert np.all(late < 1e-12 * 100.0 ** np.arange(n))
    assert np.all(off < 1e-10 * 100.0 ** np.arange(n) * np.linalg.norm(here.impacts.impulse, axis=1))
    assert there.sequence == mirror.sequence(here.sequence)


def turned(case):
    """Return a toss that is turned about the vertical."""
    release = case.as_tables()["release"] | {"quaternion": case.release.attitude}
    return case.replace("release", SYMMETRIES["a turn about the vertical"].release(release))


MUJOCOS = CASES["imperfect, air, coulomb"].replace("ending.max_impacts", 3)
IMAGES = {
    # The time of a trusted impact is good to 1e-7 s.
    **{
        name: (analytic.toss, CASES[name].replace("floor.slope", 0.0), turned, Mirror.ETA, 2e-7)
        for name in LINEAR
    },
    # Rounding moves the first step in a contact, and impacts multiply it.
    **{f"by MuJoCo, {one}": (coin_mj.toss, MUJOCOS, one.scenario, one, 5e-7) for one in Mirror},
}
"""What tosses which case, its image, how its faces change, and how late an impact may be [s]."""


@pytest.mark.parametrize("name", IMAGES)
def test_an_image_of_a_toss_is_the_same_within_its_certificate(name):
    toss, case, image, faces, late = IMAGES[name]
    here, there = (toss(each) for each in (case, image(case)))
    n = min(here.trusted_impacts, there.trusted_impacts)
    assert n >= min(3 if toss is analytic.toss else 1, here.trusted_impacts)
    assert there.impacts.time[:n] == pytest.approx(here.impacts.time[:n], abs=late)
    assert there.sequence[:n] == faces.sequence(here.sequence[:n])
    if here.outcome_certain and there.outcome_certain:
        assert there.outcome == faces.outcome(here.outcome)


def upright(rng, coin):
    """Draw a toss that is its own mirror image in ζ: in its plane, upright, and slipping on the floor."""
    psi = 2 * np.pi * rng.integers(4) / 4 if rng.integers(2) else rng.uniform(0, 2 * np.pi)
    # A little above the floor, for the coin is to lean. One that comes to roll fast stays upright for long.
    speed, low = rng.uniform(0, 0.3), COINS[coin]["radius"] * (1 + 1e-8)
    return {
        "coin": COINS[coin],
        "floor": {
            "contact": "coulomb",
            "friction": rng.uniform(0.1, 0.5),
            "restitution": rng.uniform(0, 0.8),
        },
        "air": AIR if rng.integers(4) else {},
        "release": {
            "position": [0.0, 0.0, float(rng.choice([low, 2 * low]))],
            "velocity": [speed * np.cos(psi), speed * np.sin(psi), 0.0],
            "angles": [psi, np.pi / 2, 0.0],
            "angular_velocity": [0.0, 0.0, rng.uniform(-40, 40)],
        },
        "ending": {"max_time": 10.0},
    }


@pytest.mark.parametrize("coin", ["thin", "thick", "stout"])
@pytest.mark.parametrize("count", [15, pytest.param(500, marks=pytest.mark.long)])
def test_a_coin_that_is_its_own_mirror_image_is_never_certain_of_a_face(count, coin):
    """Nor are two that lean to either side certain of the same one, however little they lean."""
    rng, opposite = np.random.default_rng([7, list(COINS).index(coin)]), 0
    for _ in range(count):
        parts = upright(rng, coin)
        tie = analytic.toss(scenario(**parts))
        assert not (tie.outcome_certain and tie.outcome in FACES)
        psi, _, phi = parts["release"]["angles"]
        lean = 10 ** rng.uniform(-13, -8)
        pair = []
        for tilt in (np.pi / 2 - lean, np.pi / 2 + lean):
            parts["release"]["angles"] = [psi, tilt, phi]
            pair.append(analytic.toss(scenario(**parts)))
        faces = [toss.outcome for toss in pair if toss.outcome in FACES]
        if len(faces) == 2:
            certain = [toss.outcome_certain for toss in pair]
            assert faces[0] != faces[1] or not any(certain)
            opposite += faces[0] != faces[1]
    # The thicker a coin, the more of them stand on their edge.
    assert opposite >= {"thin": count / 2, "thick": count / 4, "stout": 0}[coin]
