"""Every XML of page and command, stepped by plain `mujoco`: its bounces, and an hour at rest."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import mujoco
import numpy as np
import pytest

from tests.helpers.command_line import mj_bounce
from two_geoms import thrown

DOCS = Path(__file__).parents[2] / "docs"
TWO_LINES = re.compile(r"(<option .*>)\n\W*(<geom .*/>)")
"""What is pasted into a model, in a fence, in a listing or in the branches of a chart."""
BALL = """<mujoco>{}<worldbody><geom type="plane" size="0 0 1"/>
<body pos="0 0 0.5"><freejoint/>{}</body></worldbody></mujoco>"""
MODELS_OF_THE_PAGE = 3
E_OF_THE_PAGE = 0.8
PAGES_ERROR = {"implicitfast": 5.1e-4, "RK4": 3.5e-3}
"""Of e, as MUJOCO has it."""
COMMANDS = (
    "--restitution 0.8 --dt 0.002",
    "--restitution 0.3 --dt 0.001",
    "--restitution 0 --dt 0.002",
    "--restitution 0.5 --dt 0.002 --spring --steps 20",
    "--restitution 0.8 --dt 0.002 --spring",
    "--restitution 0.8 --dt 0.002 --backend mjx",
    "--restitution 0.8 --dt 0.002 --backend warp --spring",
    '--restitution 0.8 --dt 0.002 --body "box 0.1 0.1 0.02"',
)
QUICK = ("MUJOCO, model 1", "MUJOCO, model 3", COMMANDS[2], COMMANDS[3])


@dataclass(frozen=True)
class Printed:
    """A model that is printed, or that two printed lines make."""

    text: str
    e: float
    error: float
    """Of e, as it is told."""

    @property
    def model(self) -> mujoco.MjModel:
        return mujoco.MjModel.from_xml_string(self.text)


def of_the_pages() -> dict[str, Printed]:
    """Return every model of MUJOCO, and the two lines wherever they stand on a page."""
    found, page = {}, (DOCS / "MUJOCO.md").read_text(encoding="utf-8")
    models = re.findall(r"```xml\n(<mujoco>.*?)```", page, re.DOTALL)
    for number, text in enumerate(models, start=1):
        e = float(re.findall(r"<!-- e = ([\d.]+)", text)[0])
        integrator = "RK4" if "RK4" in text else "implicitfast"
        found[f"MUJOCO, model {number}"] = Printed(text, e, PAGES_ERROR[integrator])
    for name in sorted(DOCS.rglob("*.md")):
        for number, (option, geom) in enumerate(TWO_LINES.findall(name.read_text(encoding="utf-8")), start=1):
            if "<worldbody>" in option or '"..."' in geom:  # the command prints what "..." stands for
                continue
            pasted = BALL.format(in_numbers(option), in_numbers(geom).replace("<geom", '<geom size="0.1"'))
            error = PAGES_ERROR["implicitfast"]
            found[f"{name.stem}, lines {number}"] = Printed(pasted, E_OF_THE_PAGE, error)
    return found


def in_numbers(line: str) -> str:
    """Return a line whose e and dt are numbers: those of the page's example."""

    def number(found: re.Match[str]) -> str:
        worked = found[0].replace("²", "**2")
        return repr(eval(worked, {"__builtins__": {}}, {"e": E_OF_THE_PAGE, "dt": 2e-3}))

    return re.sub(r"-?[\d(][^\s\"]*/dt²?|\bdt\b", number, line)


PRINTED = of_the_pages()


@cache
def printed(name: str) -> Printed:
    """Return what a page has, or what the command prints now with these options."""
    if name in PRINTED:
        return PRINTED[name]
    words = ["solref", *(word.strip('"') for word in re.findall(r'"[^"]*"|\S+', name))]
    text = mj_bounce(*words, "--model").stdout
    asked = re.findall(r"--restitution (\S+)", name)[0]
    two = mj_bounce(*words)
    error = float(re.findall(r"^error +(\S+) at worst", two.stdout, re.MULTILINE)[0]) or 1e-12
    option, geom = TWO_LINES.findall(two.stdout)[0]
    assert option in text
    assert re.sub(r'\s+|condim="1"|priority="1"', "", geom[5:-2]) in re.sub(r"\s+", "", text)
    # Of the 16 phases measured the outermost are half a phase from the ends of a step.
    return Printed(text, float(asked), 16 / 15 * error)


def lowest(model: mujoco.MjModel) -> float:
    """Return the height of a body, flat or round, where it touches the plane."""
    return float(model.geom_size[1, 2 if model.geom_type[1] == mujoco.mjtGeom.mjGEOM_BOX else 0])


def test_every_xml_of_the_page_is_among_them():
    page = (DOCS / "MUJOCO.md").read_text(encoding="utf-8")
    assert page.count("```xml") == MODELS_OF_THE_PAGE + 1
    assert [name for name in PRINTED if "model" in name] == [
        f"MUJOCO, model {number}" for number in range(1, MODELS_OF_THE_PAGE + 1)
    ]
    assert {"MUJOCO, lines 1", "MUJOCO, lines 2", "COMMANDS, lines 1"} <= set(PRINTED)


ASKED = [name if name in QUICK else pytest.param(name, marks=pytest.mark.long) for name in COMMANDS]


@pytest.mark.parametrize("name", [*PRINTED, *ASKED])
def test_what_is_printed_bounces_as_it_says(name):
    """Without weight, in eight phases of a step."""
    given = printed(name)
    model = given.model
    left = thrown(model, 2.0, lowest(model), model.qpos0[2])
    e = np.array([max(data.qvel[2], 0.0) / 2.0 for data in left])
    assert np.abs(e - given.e).max() < given.error
    assert e.mean() == pytest.approx(given.e, abs=max(0.5 * given.error, 1e-9))


LONG = [pytest.param(name, True, marks=pytest.mark.long) for name in (*PRINTED, *COMMANDS)]


@pytest.mark.parametrize(("name", "long"), [*((name, False) for name in QUICK), *LONG])
def test_what_is_printed_comes_to_rest(name, long):
    """It falls from where it is printed, bounces out, rises in b/k, and lies still (1 - d) g/k deep."""
    model = printed(name).model
    data, heights = mujoco.MjData(model), []
    stiffness, damping = -model.geom_solref[1] if model.npair == 0 else -model.pair_solref[0]
    mujoco.mj_step(model, data, nstep=round(max(20.0, 30 * damping / stiffness) / model.opt.timestep))
    for _ in range(round((3600.0 if long else 20.0) / model.opt.timestep) // 1000):
        mujoco.mj_step(model, data, nstep=1000)
        heights.append(data.qpos[2])
    assert np.ptp(heights) < 1e-9
    assert not any(warning.number for warning in data.warning)
    deep = (1 - data.contact[0].solimp[0]) * 9.81 / stiffness
    if data.ncon == 4:  # the corners of a box: the closed form is tested in `test_rest.py`
        x, y, z = model.geom_size[1] ** 2
        deep *= (1 + 3 * x / (x + z) + 3 * y / (y + z)) / 4
    assert lowest(model) - heights[-1] == pytest.approx(deep, rel=2e-3)
    assert np.abs(data.qvel).max() < 1e-6


def test_what_still_comes_up_from_its_bounces_rises():
    """It was said to sink, at a speed below 0."""
    given = ["--solimp", "0.9999 0.9999 0.001", "--integrator", "implicitfast"]
    assert (
        "rest        rises 14.6 um/s, 277 um deep"
        in mj_bounce("solref", "--of", "-30 -500", "--dt", 2e-3, *given).stdout
    )
