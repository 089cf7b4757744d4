"""Digests of rows, tosses and settings that every processor should make alike, printed by `python -m`."""

import hashlib
import json
from typing import Any

import numpy as np

from cointoss import analytic
from cointoss.coin_mj.model.machine import machine_of
from cointoss.coin_mj.model.settings import FINE, MANY, MujocoSettings, Realisation, rebound_of
from cointoss.compare.metrics import margin, sequences
from cointoss.models.hand import Hand, _normals
from cointoss.models.laws import ContactLaw
from cointoss.models.reading import load
from cointoss.models.rows import row_of
from cointoss.models.scenario import Scenario
from cointoss.models.sources import named_scenarios
from tests.helpers.many import assert_same_toss

RELEASES, DRAWN, TILTED, TOSSED = 10_000, 200, 1200, 6
HANDS = {
    "tossed": Hand(psi=1.2, psi_scatter=0.05),
    "spun": Hand(spun=True, psi_scatter=0.2),
    "of either side": Hand(up="either", psi_scatter=0.1),
    "people's": Hand.people(),
    "caught": Hand(caught=0.6),
}
MUJOCO = {"fine": FINE, "many": MANY, "one step": MujocoSettings(contact=Realisation.ONE_STEP)}
REALISED = ("smooth", "coulomb", "perfectly_rough")
"""The laws of MuJoCo's floors."""


def drawn_scenario(number: int) -> Scenario:
    """Return a scenario with angles, a slope, units, and all six numbers of an inertia or a mass centre."""
    part = np.random.default_rng([71, number]).random
    J = np.diag([2e-7, 3e-7, 4e-7]) + 2e-8 * part((3, 3))
    shape = (
        {"center_of_mass": [1e-3 * part(), 1e-3, 0.0]}
        if number % 2
        else {"inertia": ((J + J.T) / 2).tolist()}
    )
    return Scenario.checked(
        {
            "gravity": f"{25 + 10 * part()} ft/s^2",
            "coin": {
                "mass": f"{0.1 + part()} oz",
                "radius": "0.5 inch",
                "thickness": f"{3 * part()} mm",
                **shape,
            },
            "air": {"exponent": number % 3 / 2, "normal": part(), "tangential": part()},
            "floor": {
                "restitution": 0.2 + 0.6 * part(),
                "restitution_exponent": part() / 4,
                "restitution_threshold": f"{part()} km/h",
                "contact": str(ContactLaw(1 + number % 7)),
                "friction": part(),
                "slope": 0.0 if number % 3 else f"{20 * part()} deg",
            },
            "release": {
                "position": [0.0, 0.0, f"{1 + part()} ft"],
                "angles": [f"{180 * part()} deg", f"{2 * part()} rad", f"{3600 * part()} arcmin"],
                "angular_velocity": [f"{300 * part()} rpm", f"{40 * part()} rad/s", f"{part()} turn/s"],
            },
            "ending": {"max_impacts": 5, "max_time": "0.4 s"},
        }
    )


def results() -> dict[str, Any]:
    """Return what is to be the same, by name."""
    cases = [*map(drawn_scenario, range(DRAWN)), *map(load, named_scenarios())]
    tilted = [
        cases[-1].replace("coin.radius", 0.01 + part / 50, "floor.slope", slope, "release.angles", angles)
        for part, slope, *angles in np.random.default_rng(72).random((TILTED, 5)).tolist()
    ]
    rows = np.array([row_of(case) for case in cases])
    turned, many = margin.with_quaternions(rows), analytic.toss_rows(rows[:TOSSED])
    tosses = [analytic.toss(case, settings=analytic.MANY) for case in cases[:TOSSED]]
    for i, toss in enumerate(tosses):
        assert_same_toss(many, i, toss)
    found: dict[str, Any] = {
        "rows": rows,
        "attitudes": [case.release.attitude for case in (*cases, *tilted)],
        "bodies and rules": [(case.body, case.rules) for case in (*cases, *tilted)],
        "toss_many": [many.outcome, many.ending, many.impacts, many.end_time],
        "toss": [[toss.outcome, toss.impacts.time, toss.impacts.impulse] for toss in tosses],
        "late faces": [row_of(sequences._touching_at(toss, 0, 1e-3)) for toss in tosses],
        "steps of margins": margin.FINE.ladder,
        # One of NumPy's own, of this seed, differs without fused products.
        "far normals": np.extract(
            np.abs(normals := _normals(np.random.default_rng(9), 10**7)) > 3.5, normals
        ),
        "springs": [rebound_of(restitution, FINE) for restitution in np.linspace(0.01, 1, TILTED)],
    }
    for name, hand in HANDS.items():
        found[f"releases, {name}"] = [hand.releases(coin, RELEASES) for coin in ("fig29", "zloty")]
    for quantity in margin.QUANTITIES:
        found[f"margins, {quantity.name}"] = quantity.change(turned, np.linspace(-1, 1, len(rows)))
    for name, settings in MUJOCO.items():
        machines = [machine_of(case, settings) for case in cases[::9] if str(case.floor.contact) in REALISED]
        found[f"MuJoCo, {name}"] = [
            (settings, unit, coin.body, coin.shape, coin.rebound, plastic.rebound, data.qpos, data.qvel)
            for _, data, settings, unit, coin, plastic in machines
        ]
    return found


def written(value: Any) -> str:
    """Return an array, or settings, as text."""
    return value.tobytes().hex() if isinstance(value, np.ndarray) else repr(value)


if __name__ == "__main__":
    texts = {name: json.dumps(result, default=written) for name, result in results().items()}
    print(json.dumps({name: hashlib.sha256(text.encode()).hexdigest() for name, text in texts.items()}))
