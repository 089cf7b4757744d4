"""What one module hands to another: units, frames, orders of columns and signs, against plain formulas."""

import csv
import re
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from cointoss import Hand, analytic, coin_mj
from cointoss.coin_mj.model.scene import build, shape_thickness
from cointoss.coin_mj.model.settings import MujocoSettings, rebound_of
from cointoss.compare.basins.picture import MapAxis, draw_map
from cointoss.compare.engines import Engine
from cointoss.compare.film.visual_model import build_visual_model
from cointoss.compare.metrics.impulses import match
from cointoss.compare.metrics.trajectories import attitude_angle
from cointoss.compare.output.answer import as_lines, path_csv
from cointoss.compare.shares.counting import Block, draws
from cointoss.compare.shares.plan import Plan
from cointoss.compare.sweep.batch import batch_of
from cointoss.compare.web.playable import path_of, playable
from cointoss.models.parts import Air
from cointoss.models.records import Toss
from cointoss.models.units import in_si, lambda_unit
from tests.helpers.draws import IMPERFECT, scenario

TUMBLING = {
    "position": [0.3, -0.1, 0.3],
    "velocity": [0.1, -0.2, 0.3],
    "angles": [0.4, 0.6, 0.1],
    "angular_velocity": [20.0, 35.0, -10.0],
}
CASE = scenario(coin=IMPERFECT, release=TUMBLING, ending={"max_impacts": 3})
C = np.array(CASE.coin.center_of_mass)
X, Y = "release.position.x", "release.position.y"


@cache
def tossed() -> Toss:
    """Return an unbalanced coin's toss, no two of whose numbers are alike."""
    return analytic.toss(CASE)


def states() -> tuple[Any, Rotation]:
    """Return some states of the toss, and their attitudes."""
    found = tossed().sample(np.linspace(0, 0.25, 5))
    return found, Rotation.from_quat(found.quaternion, scalar_first=True)


def joint() -> Any:
    """Return B and its velocity, by R and c, (5, 6)."""
    found, R = states()
    v = found.velocity - R.apply(np.cross(found.angular_velocity, C))
    return np.hstack([found.position - R.apply(C), v])


def columns() -> dict[str, Any]:
    """Return the columns of the path's CSV file by their heads."""
    head, *rows = csv.reader(path_csv(states()[0], CASE).splitlines())
    return dict(zip(head, np.array(rows, dtype=float).T, strict=True))


def printed(column: int) -> list[float]:
    """Return a column of the printed impacts, counted from the last."""
    return [float(line.split()[-column]) for line in as_lines(tossed()).splitlines()[-3:]]


def drawn(**fields: Any) -> Any:
    """Return the first of a hand's releases."""
    hand = Hand(height=1.5, speed=2.5, spin=100.0, scatter=0.0)
    return {name: values[0] for name, values in hand.releases(CASE, 2, **fields).items()}


def image() -> Any:
    """Return the image of a map of 2 rows and 3 columns, whose last row and first column is tails."""
    axes = MapAxis(name="x", unit="", start=0.0, stop=2.0), MapAxis(name="y", unit="", start=5.0, stop=6.0)
    return draw_map(np.array([[1, 1, 1], [2, 1, 1]]), x=axes[0], y=axes[1]).axes[0].images[0]


def heights(material: str) -> set[float]:
    """Return on which sides of the coin a material is drawn."""
    model = build_visual_model(CASE, extent=1.0, tile=0.1)
    number = model.material(material).id
    return {float(np.sign(model.geom_pos[i, 2])) for i in range(model.ngeom) if model.geom_matid[i] == number}


def gravity(slope: float) -> Any:
    """Return gravity in MuJoCo's model of a slope, (3,)."""
    case = CASE.replace("floor.slope", slope)
    return build(case, rebound_of(0.5, MujocoSettings()), 0.0, shape_thickness(case)).opt.gravity


def rows() -> Any:
    """Return x and y of all tosses of a batch over both, (6, 2)."""
    batch = batch_of(CASE, {X: (0.0, 1.0, 2), Y: (2.0, 4.0, 3)})
    return [batch.scenario_at(i).release.position[:2] for i in range(len(batch))]


def block(seed: int, number: int = 0) -> float:
    """Return the first number that a block of shares draws."""
    plan = Plan(scenario=CASE, name="", hand=Hand(), seed=seed)
    return draws(plan, Engine.ANALYTIC, Block(0, number)).random()


IMPACTS = {name: lambda name=name: getattr(tossed().impacts, name) for name in ("time", "point", "energy")}
CONVENTIONS = {
    "cm": (lambda: in_si("1.25 cm", "m"), lambda: 0.0125),
    "rpm": (lambda: in_si("30 rpm", "rad/s"), lambda: np.pi),
    "deg": (lambda: in_si("180 deg", "rad"), lambda: np.pi),
    "λ": (lambda: re.findall(r"-[0-9.]+", lambda_unit(0.5)), lambda: ["-2.5", "-0.5"]),
    "C_d": (lambda: Air.model_validate({"drag_coefficient": 1.1}).normal, lambda: 1.2 * 1.1 / 2),
    "the normal is R ζ": (lambda: states()[0].normal, lambda: states()[1].apply([0, 0, 1])),
    "heads is up where n_z > 0": (
        lambda: tossed().impacts.face == 1,
        lambda: Rotation.from_quat(tossed().impacts.quaternion, scalar_first=True).as_matrix()[:, 2, 2] > 0,
    ),
    "a touch is on the floor": (
        lambda: (
            tossed().impacts.position[:, 2]
            + Rotation.from_quat(tossed().impacts.quaternion, scalar_first=True).apply(
                tossed().impacts.point - C
            )[:, 2]
        ),
        lambda: np.zeros(3),
    ),
    "an impact's time is that of its state": (
        lambda: tossed().sample(IMPACTS["time"]()).position,
        lambda: tossed().impacts.position,
    ),
    "MuJoCo's joint has B": (
        lambda: np.hstack([part[:, :3] for part in states()[0].to_mujoco(CASE)]),
        joint,
    ),
    "a release of MuJoCo's joint is C's": (
        lambda: coin_mj.release_fields(*states()[0].to_mujoco(CASE), scenario=CASE)["release.velocity.y"],
        lambda: states()[0].velocity[:, 1],
    ),
    "downhill is x": (lambda: gravity(0.3), lambda: 9.81 * np.array([np.sin(0.3), 0, -np.cos(0.3)])),
    "heads is drawn at +ζ": (lambda: heights("heads"), lambda: {1.0}),
    "tails is drawn at -ζ": (lambda: heights("tails"), lambda: {-1.0}),
    "a file's y is y": (lambda: columns()["y [m]"], lambda: states()[0].position[:, 1]),
    "a file's v_y is v_y": (lambda: columns()["v_y [m/s]"], lambda: states()[0].velocity[:, 1]),
    "a file's e0 is the scalar": (lambda: columns()["e0"], lambda: states()[0].quaternion[:, 0]),
    "a file's ω_ζ is the body's": (
        lambda: columns()["w_zeta [rad/s]"],
        lambda: states()[0].angular_velocity[:, 2],
    ),
    "energies are printed in mJ": (lambda: printed(2), lambda: np.round(1e3 * IMPACTS["energy"](), 4)),
    "the rim is printed from ξ to η": (
        lambda: printed(1),
        lambda: np.round(np.degrees(np.arctan2(IMPACTS["point"]()[:, 1], IMPACTS["point"]()[:, 0])), 2),
    ),
    "a path's spin about the normal is ω_ζ": (
        lambda: path_of(tossed(), 40, with_spin=True)["spin_normal"][0],
        lambda: -10.0,
    ),
    "a page has the whole thickness": (
        lambda: playable(tossed(), 40)["coin"]["thickness"],
        lambda: CASE.coin.thickness,
    ),
    "a turn by 0.3 rad is 0.3 rad": (
        lambda: attitude_angle(
            analytic.toss(scenario(release={"angles": [0.3, 0, 0]})).sample([0]),
            analytic.toss(scenario()).sample([0]),
        ),
        lambda: [0.3],
    ),
    "a difference of times is a - b": (
        lambda: match(tossed().impacts[1:2], tossed().impacts[:1]).time[0] > 0,
        lambda: True,
    ),
    "the last of a batch's fields varies fastest": (
        rows,
        lambda: np.stack(np.meshgrid([0.0, 1.0], [2.0, 3.0, 4.0], indexing="ij"), axis=-1).reshape(-1, 2),
    ),
    "a map's first row is at the bottom": (lambda: image().origin == "lower", lambda: True),
    "a map's columns are x": (lambda: image().get_extent(), lambda: [-0.5, 2.5, 4.5, 6.5]),
    "a hand's height is z": (lambda: drawn()["release.position.z"], lambda: 1.5),
    "a hand's speed is upwards": (lambda: drawn()["release.velocity.z"], lambda: 2.5),
    "a hand's seed is heeded": (
        lambda: drawn(seed=0)["release.angular_velocity.xi"] != drawn(seed=1)["release.angular_velocity.xi"],
        lambda: True,
    ),
    "a seed of shares is heeded": (lambda: block(0) != block(1), lambda: True),
    "each block of shares draws its own": (lambda: block(0, 0) != block(0, 1), lambda: True),
}


@pytest.mark.parametrize("name", CONVENTIONS)
def test_what_is_handed_on_is_what_its_formula_says(name):
    found, right = (part() for part in CONVENTIONS[name])
    if isinstance(right, set):
        assert found == right
    else:
        assert np.asarray(found, dtype=float) == pytest.approx(
            np.asarray(right, dtype=float), rel=1e-9, abs=1e-9
        )
