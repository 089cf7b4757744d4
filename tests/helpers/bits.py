"""Tosses of every kind, and all numbers of each, to be compared to the bit."""

from itertools import product
from typing import Any

import numpy as np

from cointoss import analytic
from cointoss.models.laws import ContactLaw
from cointoss.models.reading import scenario_of
from tests.helpers.draws import AIR, IMPERFECT, LONG_TRANSIENT, THIN, ZLOTY, draw_release, scenario

FEW, MANY = 3, 60
"""Releases of each coin, air and law; and of each class of general coins."""
_RESISTANCE = {"rolling_friction": 1e-5, "pivoting_friction": 2e-5}


def cases():
    """Return scenarios by name: every law, ideal and imperfect coins, every air, resistance, and contacts."""
    rng = np.random.default_rng(43)
    coins = {"ideal": ZLOTY, "imperfect": IMPERFECT}
    airs = {"vacuum": {}, "linear air": AIR}
    found = {}
    for (coin, shape), (air, drag), law in product(coins.items(), airs.items(), ContactLaw):
        floor = {"contact": str(law), "friction": 0.3, "restitution": 0.5}
        for i in range(FEW):
            ending = {"max_time": 3.0, "max_impacts": 200}
            parts = {"coin": shape, "air": drag, "floor": floor, "ending": ending}
            found[f"{coin}, {air}, {law}, {i}"] = scenario(release=draw_release(rng), **parts)
    for exponent, (coin, shape) in product((0.3, 1.0), {"thin": THIN, **coins}.items()):
        floor = {"contact": "coulomb", "friction": 0.3, "restitution": 0.5}
        parts = {"coin": shape, "air": {**AIR, "exponent": exponent}, "floor": floor}
        found[f"{coin}, air with b = {exponent}"] = scenario(
            release=draw_release(rng), ending={"max_impacts": 3}, **parts
        )
    for law, restitution in product(("coulomb", "perfectly_rough", "smooth"), (0.0, 0.3)):
        floor = {"contact": law, "friction": 0.2, "restitution": restitution}
        for resisted in (False, law == "coulomb"):
            more = _RESISTANCE if resisted else {}
            found[f"contact, {law}, {restitution}{', resistance' if resisted else ''}"] = scenario(
                coin=IMPERFECT, floor={**floor, **more}, release=draw_release(rng), ending={"max_time": 2.0}
            )
    found["energetic"] = scenario(
        floor={"contact": "coulomb", "friction": 0.3, "restitution": 0.5, "restitution_kind": "energetic"},
        release=draw_release(rng),
    )
    found["by angles"] = scenario_of("fig24a")
    found["long contact"] = scenario(**LONG_TRANSIENT, ending={"max_time": 2.0})
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


def numbers_of_many(kind):
    """Return the numbers of many tosses of a class of general coins."""
    many = analytic.toss_rows(kind.rows(MANY), trust="certain")
    names = ("outcome", "impacts", "end_time", "trusted_impacts", "outcome_certain")
    return {name: (getattr(many, name) + 0).tolist() for name in names}
