"""Tosses of every kind, and all numbers of each, to be compared to the bit."""

from typing import Any

import numpy as np

from cointoss import analytic
from cointoss.models.reading import scenario_of
from tests.helpers.draws import AIR, IMPERFECT, LONG_TRANSIENT, THIN, ZLOTY, draw_release, scenario

STOUT = {**ZLOTY, "thickness": 1.2e-2}
GENERAL = {
    **IMPERFECT,
    "inertia": [[1.1e-7, 6e-9, -3e-9], [6e-9, 9e-8, 4e-9], [-3e-9, 4e-9, 1.6e-7]],
}
FLOOR = {"friction": 0.3, "restitution": 0.5}
RESISTANCE = {"rolling_friction": 1e-5, "pivoting_friction": 2e-5}
CONTOUR = {"contour_friction": 1e-3, "contour_viscosity": 1e-6}
BY_SPEED = {"restitution_exponent": 0.25, "restitution_viscous": 0.1}
OTHER_AIR, SQUARE_AIR = {**AIR, "exponent": 0.3}, {**AIR, "exponent": 1.0}
SHORT, ONE, LONG = {"max_time": 3.0, "max_impacts": 200}, {"max_impacts": 1}, {"max_time": 2.0}
SITUATIONS: dict[str, tuple[Any, dict[str, Any], dict[str, Any], dict[str, Any]]] = {
    "smooth": (ZLOTY, {"contact": "smooth"}, {}, SHORT),
    "coulomb": (ZLOTY, {"contact": "coulomb"}, {}, SHORT),
    "perfectly rough": (ZLOTY, {"contact": "perfectly_rough"}, {}, SHORT),
    "sharp edge": (ZLOTY, {"contact": "sharp_edge"}, {}, SHORT),
    "knurled": (ZLOTY, {"contact": "knurled"}, {}, SHORT),
    "slip preserving": (ZLOTY, {"contact": "slip_preserving"}, {}, SHORT),
    "sliding friction": (ZLOTY, {"contact": "sliding_friction"}, {}, SHORT),
    "imperfect, smooth": (IMPERFECT, {"contact": "smooth"}, {}, SHORT),
    "imperfect, coulomb": (IMPERFECT, {"contact": "coulomb"}, {}, SHORT),
    "imperfect, perfectly rough": (IMPERFECT, {"contact": "perfectly_rough"}, {}, SHORT),
    "imperfect, air, smooth": (IMPERFECT, {"contact": "smooth"}, AIR, SHORT),
    "imperfect, air, coulomb": (IMPERFECT, {"contact": "coulomb"}, AIR, SHORT),
    "imperfect, air, perfectly rough": (IMPERFECT, {"contact": "perfectly_rough"}, AIR, SHORT),
    "imperfect, air, sharp edge": (IMPERFECT, {"contact": "sharp_edge"}, AIR, SHORT),
    "imperfect, air, knurled": (IMPERFECT, {"contact": "knurled"}, AIR, SHORT),
    "imperfect, air, slip preserving": (IMPERFECT, {"contact": "slip_preserving"}, AIR, SHORT),
    "imperfect, air, sliding friction": (IMPERFECT, {"contact": "sliding_friction"}, AIR, SHORT),
    "air, smooth": (ZLOTY, {"contact": "smooth"}, AIR, SHORT),
    "air, coulomb": (ZLOTY, {"contact": "coulomb"}, AIR, SHORT),
    "thin, air": (THIN, {"contact": "coulomb"}, AIR, SHORT),
    "thin, plastic": (THIN, {"contact": "smooth", "restitution": 0.0}, {}, SHORT),
    "stout": (STOUT, {"contact": "coulomb"}, AIR, SHORT),
    "of any inertia": (GENERAL, {"contact": "coulomb"}, AIR, SHORT),
    "energetic": (ZLOTY, {"contact": "coulomb", "restitution_kind": "energetic"}, {}, SHORT),
    "threshold": (IMPERFECT, {"contact": "coulomb", "restitution_threshold": 0.05}, AIR, SHORT),
    "by speed": (IMPERFECT, {"contact": "coulomb", **BY_SPEED}, AIR, {"max_impacts": 120}),
    "slope": (IMPERFECT, {"contact": "coulomb", "slope": 0.2}, AIR, SHORT),
    "contact, coulomb": (IMPERFECT, {"contact": "coulomb", "restitution": 0.0}, {}, LONG),
    "contact, coulomb, resistance": (IMPERFECT, {"contact": "coulomb", **RESISTANCE}, {}, LONG),
    "contact, coulomb, contour": (ZLOTY, {"contact": "coulomb", **CONTOUR}, {}, LONG),
    "contact, perfectly rough": (IMPERFECT, {"contact": "perfectly_rough", "restitution": 0.0}, {}, LONG),
    "contact, smooth": (IMPERFECT, {"contact": "smooth", "restitution": 0.3}, {}, LONG),
    "without solution": (ZLOTY, {"contact": "sliding_friction", "friction": 1.5}, AIR, SHORT),
    "few impacts": (ZLOTY, {"contact": "coulomb"}, {}, {"max_impacts": 3}),
    "one impact": (ZLOTY, {"contact": "coulomb"}, {}, ONE),
    "little time": (ZLOTY, {"contact": "coulomb"}, {}, {"max_time": 0.4}),
    "caught": (ZLOTY, {"contact": "coulomb"}, AIR, {"caught": 0.04}),
    "the paper's test": (IMPERFECT, {"contact": "smooth"}, AIR, {"test": "paper"}),
    "thin, air with b = 0.3": (THIN, {"contact": "coulomb"}, OTHER_AIR, ONE),
    "ideal, air with b = 1": (ZLOTY, {"contact": "coulomb"}, SQUARE_AIR, ONE),
    "imperfect, air with b = 0.3": (IMPERFECT, {"contact": "coulomb"}, OTHER_AIR, ONE),
}
"""Coin, floor, air and ending, of which the release is drawn."""


def cases():
    """Return scenarios by name: every law, coins and airs of all kinds, every part of a floor, contacts."""
    rng = np.random.default_rng(43)
    found = {
        name: scenario(coin=coin, floor=FLOOR | floor, air=air, ending=ending, release=draw_release(rng))
        for name, (coin, floor, air, ending) in SITUATIONS.items()
    }
    found["by angles"] = scenario_of("fig24a")
    found["long contact"] = scenario(**LONG_TRANSIENT, ending=LONG)
    return found


def numbers_of(case):
    """Return all numbers of a toss: how it ends, its impacts, its state at each tenth of its time.

    The state at the end is there as it is followed, too: a sampled one has a quaternion of norm 1.
    """
    toss = analytic.toss(case)
    path: Any = toss.path
    states, impacts = path.sample(np.linspace(0, toss.end_time, 11)), toss.impacts
    rows = np.hstack([states.position, states.velocity, states.quaternion, states.angular_velocity])
    return {
        "ending": str(toss.ending),
        "outcome": str(toss.outcome),
        "certain": toss.outcome_certain,
        "trusted": toss.trusted_impacts,
        "time": toss.end_time,
        "impacts": np.column_stack([impacts.time, impacts.energy, impacts.impulse]).tolist(),
        "states": rows.ravel().tolist(),
        "end": path.started.states[-1].tolist(),
    }
