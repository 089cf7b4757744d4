"""Random impacts, resolved by the analytic engine."""

import numpy as np

from cointoss import analytic
from cointoss.analytic.contact.resets import hit, restitution_at
from cointoss.analytic.impact.laws import delassus
from cointoss.models.attitude import rotation_matrix
from cointoss.models.contact_laws.law import Impact
from cointoss.models.geometry import contact_velocity, lowest_point
from cointoss.models.laws import RestitutionKind
from cointoss.models.records import IMPACT_ROW
from tests.helpers.draws import draw_coin, draw_quaternion, draw_release, scenario
from tests.helpers.tuples import quaternion, vector


def draw_contact(rng):
    """The Delassus matrix of a coin's lowest point, and a velocity of it that closes."""
    body = scenario(coin=draw_coin(rng)).body
    R = rotation_matrix(quaternion(draw_quaternion(rng)))
    point, _ = lowest_point(body, R[2], (1.0, 2.0, 3.0))
    arm = np.array(R) @ (np.array(point) - body.center)
    return delassus(body, R, vector(arm)), (*rng.uniform(-2, 2, 2), -rng.uniform(0.2, 3))


def asked(K, v, chi, mu=0.0):
    """What a contact law is given of an impact at a point of no edge, with kinematic restitution."""
    return Impact(K, v, (0.0, 0.0, 0.0), chi, mu, RestitutionKind.KINEMATIC)


def draw_impact(rng, law, restitution=None):
    """A scenario and a state in which the coin's lowest point moves down onto the floor."""
    case = scenario(
        coin=draw_coin(rng),
        floor={
            "restitution": rng.uniform(0, 1) if restitution is None else restitution,
            "contact": str(law),
            "friction": float(rng.uniform(0, 0.6)),
        },
    )
    body = case.body
    while True:
        e = draw_quaternion(rng)
        R = rotation_matrix(quaternion(e))
        v, w = rng.uniform(-1, 1, 3) - [0, 0, 2], rng.uniform(-100, 100, 3)
        point, _ = lowest_point(body, R[2], tuple(w))
        if contact_velocity(body, R, tuple(v), tuple(w), point)[2] < -0.1:
            return case, np.array([0, 0, 0.01, *v, *e, *w])


DOUBLE = 1e-4
"""Where a second rim point lands so soon after the first [s], both are pressed at once."""


def draw_single_impact(rng, law="smooth", least=0.01, spin=40.0):
    """A toss whose first impact is by one rim point, its restitution `least` or more, and its impacts."""
    while True:
        floor = {
            "contact": law,
            "restitution": float(rng.uniform(least, 1.0)),
            "friction": 0.0 if law == "smooth" else float(rng.uniform(0, 1)),
        }
        parts = {"coin": draw_coin(rng), "floor": floor, "release": draw_release(rng, spin)}
        impacts = analytic.toss(scenario(**parts, ending={"max_impacts": 2})).impacts
        if np.all(np.diff(impacts.time) > DOUBLE):
            return scenario(**parts, ending={"max_impacts": 1}), impacts


def struck(case, y):
    row = np.zeros(1, IMPACT_ROW)
    after = y.copy()
    ending = hit(case.body, case.rules, restitution_at(case.body, case.rules, y), after, row[0])
    return row[0], after, ending
