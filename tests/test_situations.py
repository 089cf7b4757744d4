"""Situations whose motion is a closed form, on both engines: one row each, its formula in its function."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
import pytest

from cointoss import analytic, coin_mj
from cointoss.coin_mj import Realisation
from cointoss.models.attitude import rotation_matrix
from cointoss.models.records import ApproximationWarning, Ending, Outcome, Toss
from cointoss.models.scenario import Scenario
from tests.helpers.draws import AIR, PAPER_OFFSET, THIN, ZLOTY, scenario
from tests.helpers.states import energies

pytestmark = [
    pytest.mark.filterwarnings(f"ignore::{ApproximationWarning.__module__}.ApproximationWarning"),
    pytest.mark.usefixtures("without_horizon"),
]

G, M, R, H = 9.81, ZLOTY["mass"], ZLOTY["radius"], ZLOTY["thickness"]
UNIT = (G / R) ** 0.5
UPRIGHT, HAND = np.pi / 2, 1.2
"""A tilt [rad], and the height at which a hand catches [m]."""
THICK = {**ZLOTY, "thickness": 4e-3}
HOOP = {**THIN, "inertia": (np.diag([0.5, 0.5, 1.0]) * M * R * R).tolist()}
NICKEL = {"mass": 5e-3, "radius": 10.6e-3, "thickness": 1.95e-3}
WAYS: dict[str, tuple[Any, Any]] = {
    "analytic": (analytic, analytic.FINE),
    **{
        f"mujoco{step}{many}": (coin_mj, replace(coin_mj.MANY if many else coin_mj.FINE, contact=contact))
        for step, contact in (("", Realisation.SPRING), (", one step", Realisation.ONE_STEP))
        for many in ("", ", many")
    },
}
"""Engines with their settings."""


class Check(NamedTuple):
    """A number of a toss, and its right value."""

    measured: Callable[[Toss], Any]
    right: Any
    near: dict[str, float]
    """How near it must be, by way."""
    is_relative: bool = True


class Situation(NamedTuple):
    """What is tossed, its ending if it is known, and what is checked."""

    case: Scenario
    ends: tuple[Outcome, Ending] | None
    checks: tuple[Check, ...] = ()


def both(exact: float, mujoco: float) -> dict[str, float]:
    """Return how near the two engines must be with their settings for one toss."""
    return {"analytic": exact, "mujoco": mujoco}


def each(exact: float, fine: float, many: float) -> dict[str, float]:
    """Return how near the two engines must be with all their settings."""
    return {way: exact if way == "analytic" else many if "many" in way else fine for way in WAYS}


def on_floor(height: float, *, coin: dict[str, Any] = ZLOTY, ending: Any = None, **more: Any) -> Scenario:
    """Return a coin released at a height; of `more`, names of a release go there, others to the floor."""
    of_release = {"velocity", "angles", "quaternion", "angular_velocity", "rolls"}
    release = {"position": [0.0, 0.0, height]} | {key: more[key] for key in of_release & more.keys()}
    floor = {"restitution": 0.5, "contact": "smooth"} | {key: more[key] for key in more.keys() - of_release}
    return scenario(coin=coin, floor=floor, release=release, ending=ending or {})


def set_down(speed: float, *, coin: Any = THIN, tilt: float = UPRIGHT, spin: float = 0.0, **more: Any) -> Any:
    """Return a coin that is set down at a tilt on a rough floor, and rolls along x without slip."""
    height = R * np.sin(tilt) + coin["thickness"] / 2 * abs(np.cos(tilt))
    floor = {"contact": "coulomb", "friction": 0.9, "restitution": 0.3}
    motion = {"velocity": [speed, 0, 0], "angles": [0, tilt, 0], "angular_velocity": [0, spin, -speed / R]}
    return on_floor(height, coin=coin, **floor | motion | more)


def end_time(toss: Toss) -> float:
    """Return the time of the end [s]."""
    return toss.end_time


def touches(toss: Toss) -> int:
    """Return the number of impacts."""
    return len(toss.impacts)


NO_TOUCH = Check(touches, 0, both(0, 0))


def falls_flat(chi: float) -> Situation:
    """It comes down at v₀ χⁿ: touch number ln(v₀/v)/ln(1/χ), rounded up, is the first plastic one."""
    v_0, threshold = (2 * G) ** 0.5, 1.0
    speeds = v_0 * chi ** np.arange(1 + np.ceil(np.log(v_0 / threshold) / np.log(1 / chi)))
    of_path = each(1e-12, 25 * 2e-4, 25 * 3e-3)  # in MuJoCo four contacts leave 1e-4 of the speed
    return Situation(
        on_floor(1 + H / 2, restitution=chi, restitution_threshold=threshold),
        (Outcome.HEADS, Ending.SETTLED),
        (
            Check(approaches, speeds, of_path),
            Check(lambda toss: rebounds(toss)[:-1], chi, each(1e-14, 2 * 2e-4, 2 * 3e-3)),
            Check(
                lambda toss: toss.impacts.contact_velocity_after[-1, 2], 0, each(1e-15, 5e-4, 7.5e-3), False
            ),
            Check(end_time, (v_0 + 2 * speeds[1:].sum()) / G, of_path),
        ),
    )


def falls_flat_by_speed() -> Situation:
    """χ = (v/v₀)^-p χ₀, so that v(n) = v_e (v(0)/v_e)^((1 - p)^n) with v_e = χ₀^(1/p)."""
    chi, p = 0.5, 0.25
    speeds = chi ** (1 / p) * ((2 * G) ** 0.5 / chi ** (1 / p)) ** ((1 - p) ** np.arange(6))
    case = on_floor(1 + H / 2, restitution=chi, restitution_exponent=p, ending={"max_impacts": 6})
    checks = (Check(approaches, speeds, each(1e-12, 25 * 2e-4, 25 * 3e-3)),)
    return Situation(case.replace("ending.test", "lying"), (Outcome.UNDECIDED, Ending.MAX_IMPACTS), checks)


def spins_flat(coin: dict[str, Any], spin: float, theta: float) -> Situation:
    """Flat within rounding, at every angle about ζ: where a search for the lowest rim point meets nothing."""
    motion = {"angles": [0.3, theta, 0], "angular_velocity": [0, 0, spin], "velocity": [0.2, 0.1, 0]}
    way = {"analytic": 1e-9, "mujoco": 1e-9}

    def off(toss: Toss) -> float:
        psi = 0.3 + spin * toss.end_time * np.cos(theta)
        expected = scenario(release={"angles": [psi, theta, 0]}).release.attitude
        return 1 - abs(toss.sample([toss.end_time]).quaternion[0] @ expected)

    return Situation(
        on_floor(0.4, coin=coin, ending={"max_impacts": 2}, **motion),
        None,
        (
            Check(rebounds, [0.5, 0.5], both(1e-12, 1e-4)),
            Check(lambda toss: toss.impacts.velocity_after[:, :2], np.array([[0.2, 0.1]] * 2), way, False),
            Check(
                lambda toss: toss.impacts.angular_velocity_after,
                np.array([[0, 0, spin]] * 2),
                both(1e-12, 1e-6 * max(spin, 1)),
                False,
            ),
            Check(off, 0, way, False),
        ),
    )


def thrown_down_from_the_floor() -> Situation:
    """S = (1 + χ) v/K_zz, K_zz = 1/m + (r cos s)²/J; MuJoCo's made-up thickness must not be in the floor."""
    tilt, speed = 0.5, 0.5
    S = 1.5 * speed * M / (1 + 4 * np.cos(tilt) ** 2)
    case = on_floor(
        R * np.sin(tilt), coin=THIN, angles=[0, tilt, 0], velocity=[0, 0, -speed], ending={"max_impacts": 1}
    )
    return Situation(
        case,
        None,
        (
            Check(lambda toss: toss.impacts.impulse[0, 2], S, both(1e-12, 1e-4)),
            Check(lambda toss: toss.impacts.time[0], 0, both(1e-12, 1e-8), False),
        ),
    )


def hops_downhill(slope: float) -> Situation:
    """Its hops are those of a ball under g cos(a), and x = g sin(a) t²/2 throughout."""
    down, chi, height = G * np.cos(slope), 0.6, 1.0
    first = (2 * height / down) ** 0.5
    times = first + 2 * first * np.cumsum([0.0, *chi ** np.arange(1, 4)])
    return Situation(
        on_floor(height + H / 2, restitution=chi, slope=slope, ending={"max_impacts": 4}),
        (Outcome.UNDECIDED, Ending.MAX_IMPACTS),
        (
            Check(lambda toss: toss.impacts.time, times, both(1e-12, 1e-4)),
            Check(
                lambda toss: toss.impacts.position[:, 0], G * np.sin(slope) * times**2 / 2, both(1e-12, 3e-4)
            ),
            Check(
                lambda toss: toss.impacts.velocity_after[:, 0], G * np.sin(slope) * times, both(1e-12, 3e-4)
            ),
        ),
    )


def slides_down(mu: float) -> Situation:
    """v = v₀ + g (sin(a) - μ cos(a)) t, up to rest."""
    slope, speed = 0.3, 0.3
    gained = G * (np.sin(slope) - mu * np.cos(slope))
    until = 0.2 if gained > 0 else 1.5 * speed / -gained
    way = speed * until + gained * until**2 / 2 if gained > 0 else speed**2 / (2 * -gained)
    floor = {"contact": "coulomb", "friction": mu, "restitution": 0.0, "slope": slope}
    return Situation(
        on_floor(H / 2, velocity=[speed, 0, 0], ending={"until": until}, **floor),
        (Outcome.HEADS, Ending.LYING),
        (
            Check(lambda toss: toss.sample([until]).position[0, 0], way, both(5e-3, 5e-3)),
            Check(
                lambda toss: toss.sample([until]).velocity[0, 0],
                max(speed + gained * until, 0.0),
                both(2e-3, 2e-3),
                False,
            ),
        ),
    )


def nickel_on_its_edge(degrees: float) -> Situation:
    """It is held up to tan(a) = δ/r; above, (1 + J/(m r²)) dv/dt = g (sin(a) - δ/r cos(a))."""
    delta, angle = NICKEL["radius"] * np.tan(np.radians(0.54)), np.radians(degrees)
    floor = {"contact": "coulomb", "friction": 0.3, "restitution": 0.6, "rolling_friction": delta}
    more = {"slope": angle, "angles": [0, UPRIGHT, 0], **floor}
    is_held = degrees < 0.54
    gained = G * (np.sin(angle) - delta / NICKEL["radius"] * np.cos(angle)) / 1.5
    # At first resistance is less, while the coin turns slower than 1e-3 √(g/r).
    speeds = Check(
        lambda toss: np.diff(toss.sample([0.25, 0.5]).velocity[:, 0]) / 0.25, [gained], both(2e-3, 2e-2)
    )
    return Situation(
        on_floor(NICKEL["radius"], coin=NICKEL, ending={} if is_held else {"max_time": 0.5}, **more),
        (Outcome.EDGE, Ending.AT_REST if is_held else Ending.ROLLING),
        () if is_held else (speeds,),
    )


def rolls_to_rest(coin: dict[str, Any], share: float, law: str) -> Situation:
    """(J_ζ + m r²) dω_ζ/dt = -δ m g: v falls by δ g/(r (1 + J_ζ/(m r²))) a second."""
    delta, speed = 1e-3, 0.3
    slowing = delta * G / (R * (1 + share))
    times = np.linspace(0, 0.9 * speed / slowing, 9)
    return Situation(
        set_down(speed, coin=coin, contact=law, rolling_friction=delta),
        (Outcome.EDGE, Ending.AT_REST),
        (
            Check(end_time, speed / slowing, both(3e-3, 2e-3)),  # rest is found at 1e-3 √(g/r)
            Check(lambda t: t.sample(t.end_time).position[0, 0], speed**2 / (2 * slowing), both(1e-4, 1e-4)),
            # Within a step of MuJoCo's path states are interpolated.
            Check(lambda t: t.sample(times).velocity[:, 0], speed - slowing * times, both(2e-4, 2e-4)),
        ),
    )


def pivots(p: float) -> Situation:
    """J_ξ dω_z/dt = -p m g, whatever resists rolling."""
    spin, J = 80.0, M * R * R / 4
    slowing = p * M * G / J
    times = np.linspace(0, 0.95 * spin / slowing, 9) if p else np.array([0.1])
    ending = {} if p else {"max_time": 0.1}
    return Situation(
        set_down(0.0, spin=spin, pivoting_friction=p, rolling_friction=1e-3, ending=ending),
        None,
        (
            Check(lambda toss: turning(toss, times), spin - slowing * times, both(1e-6, 1e-4)),
            *([Check(end_time, spin / slowing, both(1e-3, 1e-3))] if p else []),
        ),
    )


def pivots_and_slides() -> Situation:
    """Likewise on a smooth floor; the toss ends while it still turns, too slowly to rise over its edge."""
    spin, p, J = 20.0, 1e-3, M * R * R / 4
    slowing = p * M * G / J
    more: Any = {"contact": "smooth", "pivoting_friction": p, "rolling_friction": p, "velocity": [0.2, 0, 0]}
    return Situation(
        set_down(0.0, spin=spin, **more),
        None,
        (
            Check(lambda toss: turning(toss, spin / 2 / slowing), spin / 2, both(2e-3, 2e-3)),
            Check(
                lambda toss: turning(toss, toss.end_time) + slowing * toss.end_time, spin, both(5e-5, 5e-5)
            ),
            Check(lambda toss: turning(toss, toss.end_time), 0.05, both(0.05, 0.05), False),
            Check(
                lambda toss: toss.sample(toss.end_time).velocity[0, :2], [0.2, 0], both(1e-12, 1e-12), False
            ),
        ),
    )


def is_caught_on_its_edge() -> Situation:
    """3/4 m v² is the energy of the pass over either rim."""
    speed, delta = 0.6, 5e-4
    caught = (G * (np.hypot(R, THICK["thickness"] / 2) - R) / 0.75) ** 0.5
    case = set_down(speed, coin=THICK, rolling_friction=delta, pivoting_friction=1e-4)
    checks = (Check(end_time, (speed - caught) / (delta * G / (1.5 * R)), both(0.02, 0.02)),)
    return Situation(case, (Outcome.EDGE, Ending.PAPER), checks)


def turns_steadily(thickness: float) -> Situation:
    """C rests, and V = m g z_C + L_z²/(2 J_ξ sin² s) has V' = 0, with L_z = J_ξ Ω sin² s."""
    tilt, J = 1.1, M * (R * R / 4 + thickness**2 / 12)
    sine, cosine = np.sin(tilt), np.cos(tilt)
    rate = np.sqrt(M * G * (R * cosine - thickness / 2 * sine) / (J * sine * cosine))
    case = on_floor(
        *[R * sine + thickness / 2 * cosine],
        coin={**ZLOTY, "thickness": thickness},
        angles=[0, tilt, 0],
        angular_velocity=[0, rate * sine, 0],
        ending={"test": "paper", "max_time": 2.0},
    )
    checks = (Check(lambda toss: tilts(toss, np.linspace(0, 1.9, 200)), tilt, both(1e-7, 1e-4), False),)
    return Situation(case, None, checks)


def keeps_its_momenta(center: list[float]) -> Situation:
    """A smooth floor in vacuum takes no energy and no angular momentum about the vertical."""
    coin, tilt, w = {**THIN, "center_of_mass": center}, 1.1, np.array([3.0, 50.0, 8.0])
    up = np.array([0.0, np.sin(tilt), np.cos(tilt)])
    arm = np.array([0.0, -R, 0.0]) - center
    case = on_floor(
        -float(up @ arm),
        coin=coin,
        angles=[0, tilt, 0],
        angular_velocity=w.tolist(),
        velocity=[0, 0, -float(up @ np.cross(w, arm))],
        ending={"until": 1.0},
    )

    def kept(toss: Toss) -> Any:
        """Return the energy and L_z over those at the release, (2, n)."""
        path = toss.sample(np.linspace(0, 0.98, 300))
        L = path.angular_velocity @ np.array(case.body.inertia)
        L_z = np.sum([rotation_matrix(tuple(e))[2] for e in path.quaternion] * L, axis=1)
        return np.array([energies(case, path), L_z]) / [[energies(case, path)[0]], [L_z[0]]]

    # Steps of 0.12 change the energy by about 1e-3 in a second.
    return Situation(case, None, (Check(kept, np.ones((2, 300)), both(1e-8, 3e-3)),))


def rolls_without_loss() -> Situation:
    """A thin coin that leans and rolls without slip keeps its energy."""
    tilt, times = 1.3, np.linspace(0.3, 0.9, 200)
    motion: Any = {"angular_velocity": [0, 8.0, 40.0], "ending": {"until": 1.0}}
    case = set_down(-40.0 * R, tilt=tilt, friction=5.0, **motion)

    def change(toss: Toss) -> float:
        energy = energies(case, toss.sample(times))
        return np.ptp(energy) / energy[0]

    return Situation(case, None, (Check(change, 0, both(1e-9, 5e-3), False),))


def rolls_steadily(tilt: float = 0.6, turning: float = 40.0) -> Situation:
    """A coin that `rolls` with dL/dt = A × F, A from C, about the vertical: C goes round, and the tilt stays.

    With η up the slope of the coin, k = h/2 and V = k ω_η - r ω_ζ, that is
    m V Ω (r s + k c) - m g (r c - k s) = Ω (J_ζ ω_ζ s - J_ξ ω_η c), ω_η = Ω s.
    """
    s, c, k, J = np.sin(tilt), np.cos(tilt), H / 2, R**2 / 4 + H**2 / 12
    reach, across = R * s + k * c, k * turning * s
    weight = across * turning * reach - G * (R * c - k * s) + J * turning**2 * s * c
    about = weight / turning / (R * reach + R**2 / 2 * s)
    spin, period = [0, turning * s, about], 2 * np.pi / turning
    rough: Any = {"contact": "coulomb", "friction": 5.0, "ending": {"until": period}}
    case = on_floor(0.0, angles=[0, tilt, 0], angular_velocity=spin, rolls=True, **rough)
    place = np.array([0, 2 * (across - R * about) / turning, reach])
    times = np.linspace(0, period, 40)
    return Situation(
        case,
        None,
        (
            NO_TOUCH,
            Check(lambda toss: tilts(toss, times), tilt, both(1e-8, 5e-3)),
            Check(lambda toss: toss.sample([period / 2]).position[0] / R, place / R, both(1e-8, 5e-3), False),
        ),
    )


def wobbles(power: float, loss: float, **floor: float) -> Situation:
    """Euler's disk: α^power falls steadily, by E = 3/2 m g r α and φ' = 2 √(g/(r α)); corrections of α²."""
    tilt, viscosity = 0.3, floor.pop("viscosity", 0.0)
    rate = 2 * (G * np.sin(tilt) / R) ** 0.5
    case = set_down(0.0, tilt=tilt, contact="perfectly_rough", ending={"until": 1.6}, **floor)
    case = case.replace("release.angular_velocity", [0, rate, 0], "air.viscosity", viscosity)

    def slope(toss: Toss) -> float:
        times = np.linspace(0, 1.6, 3001)
        angles = tilts(toss, times)
        low = (angles > (0.05 if power > 1 else 0.0)) & (angles < (0.2 if power > 1 else 0.05))
        return -np.polyfit(times[low], angles[low] ** power, 1)[0]

    return Situation(case, None, (Check(slope, loss * UNIT, both(3e-2, 3e-2)),))


def begins_in_contact(law: str, chi: float) -> Situation:
    """On its rim, at rest, the coin tips at once: nothing bounces, and the floor holds it from the start."""
    tilt, until = 0.3, 0.02
    case = on_floor(
        H / 2 * np.cos(tilt) + R * np.sin(tilt),
        angles=[0, tilt, 0],
        contact=law,
        friction=0.3,
        restitution=chi,
        ending={"test": "lying", "max_time": until},
    )
    return Situation(
        case,
        None,
        (
            NO_TOUCH,
            Check(lambda toss: toss.contacts, np.array([[0.0, until]]), both(1e-6, 1e-6), False),
            Check(lambda toss: toss.floor_force([1e-4, 0.01])[:, 2] / M / G, [1, 1], both(1, 1), False),
            Check(lambda t: t.sample([0, 0.01]).lowest_points(case)[:, 2], [0, 0], both(5e-6, 5e-6), False),
            Check(lambda toss: np.diff(tilts(toss, [0.0, 0.01]))[0] < -3e-5, True, both(0, 0)),
        ),
    )


def rocks_while_it_turns() -> Situation:
    """The other rim's landing stops the slip Ω h: 1 - h²/(2 J (3 + h²/(4 J))) of L_z is left, J = J_ξ/m."""
    n_z, turning, J = 0.02, 5.0, R**2 / 4 + H**2 / 12
    tilt = np.arccos(n_z)
    turn = np.array(rotation_matrix((np.cos(tilt / 2), np.sin(tilt / 2), 0.0, 0.0)))
    case = on_floor(
        0.0,
        quaternion=[np.cos(tilt / 2), np.sin(tilt / 2), 0.0, 0.0],
        angular_velocity=(turning * turn[2]).tolist(),
        rolls=True,
        contact="coulomb",
        friction=0.3,
    )

    def kept(toss: Toss) -> float:
        """Return L_z after the landing, at the farthest lean, over that at first."""
        path = toss.sample(np.linspace(0, 0.25, 5001))
        up = np.array([rotation_matrix(tuple(e))[2] for e in path.quaternion])
        about_vertical = np.sum(up * (np.diag(case.body.inertia) * path.angular_velocity), axis=1)
        return about_vertical[np.argmin(up[:, 2])] / about_vertical[0]

    return Situation(case, None, (Check(kept, 1 - H**2 / (2 * J * (3 + H**2 / 4 / J)), both(3e-4, 3e-4)),))


def thrown(height: float = 1.0, up: float = 3.0, spin: float = 38.0, **parts: Any) -> Scenario:
    """Return a coin thrown up from a height, flat, and to be caught at `HAND`."""
    release = {"position": [0, 0, height], "velocity": [0.2, 0, up], "angular_velocity": [spin, 0, 0]}
    return scenario(release=release, ending={"caught": HAND}, **parts)


def caught(spin: float, height: float = 1.0, up: float = 3.0) -> Situation:
    """It comes down to the hand on its parabola, with the face that cos(ω t) has up."""
    time = (up + np.sqrt(up**2 + 2 * G * (height - HAND))) / G
    at_hand = Check(
        lambda toss: toss.sample([toss.end_time]).position[0], [0.2 * time, 0, HAND], both(1e-9, 1e-9)
    )
    face = Outcome.HEADS if np.cos(spin * time) > 0 else Outcome.TAILS
    checks = (Check(end_time, time, both(1e-12, 1e-9), False), at_hand, NO_TOUCH)
    return Situation(thrown(height, up, spin), (face, Ending.CAUGHT), checks)


def caught_after_a_bounce() -> Situation:
    """It rises with χ √(v² + 2 g z) from where it lies flat."""
    up = 0.8 * np.sqrt(25 + 2 * G * (1.0 - H / 2))
    time = (up + np.sqrt(up**2 - 2 * G * (HAND - H / 2))) / G
    checks = (
        # A spring's restitution errs by up to 7e-5, at a speed of 4 m/s.
        Check(lambda toss: toss.end_time - toss.impacts.time[0], time, both(1e-9, 3e-5), False),
        Check(touches, 1, both(0, 0)),
    )
    return Situation(thrown(up=-5.0, spin=0.0), (Outcome.HEADS, Ending.CAUGHT), checks)


def not_caught(law: str) -> Situation:
    """Only of laws that never add energy is it known at the first touch."""
    case = thrown(up=1.0, floor={"contact": law, "friction": 0.2}, air=AIR)
    is_known = Check(lambda toss: len(toss.impacts) == 1, law == "smooth", both(0, 0))
    return Situation(case, (Outcome.UNDECIDED, Ending.NOT_CAUGHT), (is_known,))


def approaches(toss: Toss) -> Any:
    """Return the speeds of approach, (n,) [m/s]."""
    return -toss.impacts.contact_velocity_before[:, 2]


def rebounds(toss: Toss) -> Any:
    """Return the restitution of each impact, (n,)."""
    return toss.impacts.contact_velocity_after[:, 2] / approaches(toss)


def turning(toss: Toss, times: Any) -> Any:
    """Return ω_η, about the vertical where the coin is on its edge, at each time."""
    return toss.sample(times).angular_velocity[:, 1]


def tilts(toss: Toss, times: Any) -> Any:
    """Return the angle from the vertical to the normal at times, (n,) [rad]."""
    n = toss.sample(times).normal
    return np.arctan2(np.hypot(n[:, 0], n[:, 1]), n[:, 2])


SITUATIONS = {
    **{f"falls flat, χ = {chi}": falls_flat(chi) for chi in (0.8, 0.9)},
    "falls flat, χ by speed": falls_flat_by_speed(),
    **{
        f"spins flat at {spin} rad/s, h = {coin['thickness']}, θ = {theta:.0f}": spins_flat(coin, spin, theta)
        for coin in (ZLOTY, THIN)
        for spin in (0.0, 1.0, 50.0)
        for theta in (0, np.pi)
    },
    "thrown down from the floor": thrown_down_from_the_floor(),
    "hops downhill": hops_downhill(0.4),
    **{f"slides downhill, μ = {mu}": slides_down(mu) for mu in (0.2, 0.5)},
    **{f"nickel on its edge at {a}°": nickel_on_its_edge(a) for a in (0.5, 0.6, 5.0)},
    **{
        f"{name} rolls to rest, {law}": rolls_to_rest(coin, share, law)
        for name, coin, share in (("disc", THIN, 0.5), ("hoop", HOOP, 1.0))
        for law in ("perfectly_rough", "coulomb")
    },
    **{f"pivots, p = {p}": pivots(p) for p in (0.0, 1e-3)},
    "pivots and slides": pivots_and_slides(),
    "is caught on its edge by resistance": is_caught_on_its_edge(),
    **{f"turns steadily, h = {h}": turns_steadily(h) for h in (0.0, H)},
    "keeps its momenta": keeps_its_momenta([0.0, 0.0, 0.0]),
    "keeps its momenta, unbalanced": keeps_its_momenta([*PAPER_OFFSET[:2], 0.0]),
    "rolls without loss": rolls_without_loss(),
    "rolls steadily": rolls_steadily(),
    "wobbles with rolling friction": wobbles(0.5, 2 / 3 * 2e-4 / R, rolling_friction=2e-4),
    "wobbles with contour friction": wobbles(1.5, 2 * 1.6e-3, contour_friction=1.6e-3 * R),
    "wobbles with contour viscosity": wobbles(2, 16 / 3 * 3.4e-4, contour_viscosity=3.4e-4 * R / UNIT),
    "wobbles on a film of air": wobbles(3, 2 * np.pi * 8.5e-5, viscosity=8.5e-5 * M * UNIT / R),
    **{
        f"begins in contact, {law}, χ = {chi}": begins_in_contact(law, chi)
        for law in ("smooth", "coulomb")
        for chi in (0.0, 0.8)
    },
    "lies, slides and spins": Situation(
        on_floor(H / 2, contact="coulomb", friction=0.3, velocity=[1, 0, 0], angular_velocity=[0, 0, 50]),
        (Outcome.HEADS, Ending.LYING),
    ),
    **{
        f"nearly upright, turns at {rate} rad/s": Situation(
            on_floor(
                1.35e-2,
                restitution=0.7,
                angles=[0, UPRIGHT - 0.03, 0.3],
                angular_velocity=[rate * np.sin(0.3), rate * np.cos(0.3), 0],
            ),
            (Outcome.EDGE, Ending.SETTLED),
            (Check(lambda toss: len(toss.impacts) < 200, True, both(0, 0)),),
        )
        for rate in (5.0, 15.0, 30.0)
    },
    **{
        # Its steps repeat themselves, with n_z at rest, though its rate at their starts is not zero.
        f"rolls and spins on its edge, C {off} off B": Situation(
            on_floor(
                0.0126,
                coin={"mass": 5e-3, "thickness": 1e-2, "center_of_mass": [0, 0, off]},
                restitution=0.6,
                quaternion=[0.5**0.5, 0.5**0.5, 0, 0],
                angular_velocity=[0, 12, 23],
            ),
            (Outcome.EDGE, ending),
        )
        for off, ending in ((0.0, Ending.SETTLED), (1e-6, Ending.STANDING))
    },
    "rocks while it turns": rocks_while_it_turns(),
    **{f"caught at {spin} rad/s": caught(spin) for spin in (5.0, 12.0, 38.0, -60.0)},
    "caught on its first way down": caught(0.0, 1.5, 0.0),
    "caught after a bounce": caught_after_a_bounce(),
    **{f"never comes to the hand, {law}": not_caught(law) for law in ("smooth", "coulomb")},
    **{
        f"an arc {part:+} of its speed from the hand": Situation(
            thrown(up=(1 + part) * np.sqrt(2 * G * (HAND - 1)), spin=0.0), (outcome, ending)
        )
        for part, outcome, ending in (
            (1e-6, Outcome.HEADS, Ending.CAUGHT),
            (-1e-6, Outcome.UNDECIDED, Ending.NOT_CAUGHT),
        )
    },
    **{
        f"lies at rest, h = {h}": Situation(
            on_floor(h / 2, coin={**ZLOTY, "thickness": h}), (Outcome.HEADS, Ending.SETTLED), (NO_TOUCH,)
        )
        for h in (0.0, H)
    },
    "flies as its time ends": Situation(
        on_floor(0.4, ending={"max_time": 0.1}), (Outcome.UNDECIDED, Ending.MAX_TIME), (NO_TOUCH,)
    ),
    "settles, tails up": Situation(on_floor(0.4, angles=[0, np.pi, 0]), (Outcome.TAILS, Ending.SETTLED)),
    "stands without resistance": Situation(set_down(0.6, coin=THICK), (Outcome.EDGE, Ending.STANDING)),
    **{
        f"rolls on as {time} s end": Situation(
            set_down(
                0.6, coin=THICK, rolling_friction=5e-5, pivoting_friction=1e-5, ending={"max_time": time}
            ),
            (Outcome.EDGE, Ending.ROLLING),
            (
                Check(end_time, time, both(1e-6, 1e-6)),
                Check(lambda toss: toss.sample(toss.end_time).velocity[0, 0] > 0.1, True, both(0, 0)),
            ),
        )
        # After 64 √(r/g), or 2.3 s, a coin that nothing slows would stand.
        for time in (0.3, 4.0)
    },
}


@pytest.mark.parametrize(
    ("name", "way"),
    [
        pytest.param(name, way, id=f"{name}-{way}")
        for name, situation in SITUATIONS.items()
        for way in min((check.near for check in situation.checks), key=len, default=both(0, 0))
    ],
)
def test_a_toss_is_its_closed_form(name, way):
    situation, (package, settings) = SITUATIONS[name], WAYS[way]
    toss = package.toss(situation.case, settings=settings)
    assert situation.ends in (None, (toss.outcome, toss.ending))
    for measured, right, near, is_relative in situation.checks:
        tolerance: dict[str, Any] = {"rel" if is_relative else "abs": near[way]}
        assert measured(toss) == pytest.approx(right, **tolerance)
