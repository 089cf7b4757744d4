"""The report as one self-contained HTML page."""

import math
import platform
import re
from base64 import b64encode
from importlib import resources
from itertools import zip_longest
from typing import Any

import jinja2
import numpy as np
from markupsafe import Markup, escape
from pydantic import BaseModel

from cointoss.compare.engines import is_own, label_of
from cointoss.compare.film.filmed import FOLLOWED_FOR, goes_on
from cointoss.compare.metrics.sequences import SAFETY
from cointoss.compare.output.answer import CERTAIN, TRUSTED, contact_line, counted
from cointoss.compare.output.style import looks_of
from cointoss.compare.report.compared_tosses import Against, ComparedTosses
from cointoss.compare.report.counts import counts_sentence
from cointoss.compare.report.map_section import MapSection
from cointoss.compare.report.motion import motion_of
from cointoss.compare.report.verdict import horizon_sentence, verdicts_of
from cointoss.compare.web.scripts import POLICY, data_element, import_map, shared_files
from cointoss.models import certificate
from cointoss.models.distribution import versions_of
from cointoss.models.fields import WORDS
from cointoss.models.meanings import meanings
from cointoss.models.records import Face, Toss
from cointoss.models.scenario import Scenario
from cointoss.models.units import printed_unit

MOST_SHOWN = 200
"""Symbols of a sequence, and impacts, that the page shows."""
_NUMBERS = ("no engine", "one engine", "two engines", "three engines", "four engines", "five engines")
_POWER = re.compile(r"\^(?:\(([^)]*)\)|(-?\w+))")
PACKAGES = ("cointoss", "mujoco", "numpy", "scipy", "matplotlib", "mediapy")


def render(
    comparison: ComparedTosses,
    *,
    film: tuple[bytes, bytes] | None = None,
    no_video: str = "",
    maps: MapSection | None = None,
) -> str:
    """Return the HTML text of a page.

    Args:
        comparison: of the tosses.
        film: of them, as mp4, and a frame that stands for it, as JPEG.
        no_video: why there is no film, where there is none.
        maps: what the page also shows.
    """
    folder = resources.files("cointoss.compare.report")
    template = (folder / "report.html.j2").read_text(encoding="utf-8")
    shared = {name: content.decode("utf-8") for name, content in shared_files().items()}
    modules = {
        **{name: text for name, text in shared.items() if name.endswith(".js")},
        **{name: (folder / name).read_text(encoding="utf-8") for name in ("report.js", "present.js")},
    }
    engines = [toss.engine for toss in comparison.tosses]
    horizons = _horizons(comparison)
    asked = len(engines) + len(comparison.absent)
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True)
    return environment.from_string(template).render(
        no_video=no_video,
        maps=maps,
        compared=comparison,
        tosses=comparison.tosses,
        measured=certificate.NAMES,
        engines=_NUMBERS[asked] if asked < len(_NUMBERS) else f"{asked} engines",
        label_of=label_of,
        is_own=is_own,
        kinds=[look.kind for look in looks_of(engines)],
        horizons=horizons,
        parameters=_parameters(comparison.scenario),
        policy=POLICY,
        style=shared["shared.css"],
        licence=shared["LICENSE"],
        scripts=import_map(modules),
        data=data_element(motion_of(comparison), id_="data"),
        about=_about(comparison.text),
        verdicts=verdicts_of(comparison),
        horizon_sentence=horizon_sentence,
        certain=CERTAIN,
        amplified=TRUSTED,
        contact_line=contact_line,
        counted=counted,
        counts=counts_sentence(comparison.tosses),
        rows=list(zip_longest(*(toss.sequence for toss in comparison.tosses), fillvalue="")),
        most_shown=MOST_SHOWN,
        impacts=_impact_rows(comparison, horizons),
        film=[b64encode(part).decode("ascii") for part in film] if film else None,
        map_picture=b64encode(maps.picture).decode("ascii") if maps else None,
        words=WORDS,
        printed_unit=printed_unit,
        raised=_raised,
        safety=SAFETY,
        goes_on=any(map(goes_on, comparison.tosses)),
        followed_for=FOLLOWED_FOR,
        slope=comparison.scenario.floor.slope,
        degrees=math.degrees,
        versions=versions(),
    )


def _about(scenario_text: str) -> str:
    """Return what a scenario says of itself in its first line, or nothing."""
    first, _, _ = scenario_text.strip().partition("\n")
    return first.removeprefix("#").strip() if first.startswith("#") else ""


def versions() -> dict[str, str]:
    """Return the versions of Python and the packages that matter to the numbers."""
    return {"Python": platform.python_version(), **versions_of(PACKAGES)}


def _parameters(scenario: Scenario) -> list[tuple[str, str, str]]:
    """Return every field of the scenario: its dotted path, its value, its meaning with the unit."""
    parts = {"": scenario} | {f"{name}.": getattr(scenario, name) for name in Scenario.model_fields}
    return [
        (f"{path}{name}", _shown(name, value), meanings(type(part))[name])
        for path, part in parts.items()
        if isinstance(part, BaseModel)
        for name in type(part).model_fields
        if not ((value := getattr(part, name)) is None or isinstance(value, BaseModel))
    ]


def _shown(name: str, value: Any) -> str:
    """Return the value of a field; angles in degrees, too."""
    if isinstance(value, tuple):
        degrees = f" = {_shown('', tuple(np.degrees(value).tolist()))}°" if name == "angles" else ""
        return f"({', '.join(_shown('', item) for item in value)}){degrees}"
    return f"{value:.10g}" if isinstance(value, float) else str(value)


def _horizons(comparison: ComparedTosses) -> list[int]:
    """Return how many faces of each toss must agree: of the measure, with any other."""
    others = [pair.common_horizon for pair in comparison.against]
    return [max(others, default=len(comparison.measure.impacts)), *others]


def _impact_rows(comparison: ComparedTosses, horizons: list[int]) -> list[dict[str, Any]]:
    """Return the rows of the table of impacts, one for each of the longest toss, at most `MOST_SHOWN`."""
    count = min(max(len(toss.impacts) for toss in comparison.tosses), MOST_SHOWN)
    return [
        {
            "number": i + 1,
            "classes": ["beyond" * (i >= end) + "bar" * (i + 1 == end < count) for end in horizons],
            "impacts": [_impact(toss, i) for toss in comparison.tosses],
            "differences": [_difference(pair, i) for pair in comparison.against],
        }
        for i in range(count)
    ]


def _difference(pair: Against, i: int) -> dict[str, Any]:
    """Return by how much an impact differs from the measure's, and its error; None for what is missing."""
    found = {"time": pair.differences.time, "impulse": pair.differences.impulse, "error": pair.errors}
    return {name: values[i] if i < len(values) else None for name, values in found.items()}


def _impact(toss: Toss, i: int) -> dict[str, Any] | None:
    impacts = toss.impacts
    if i >= len(impacts):
        return None
    point = impacts.point[i]
    return {
        "time": impacts.time[i],
        "face": Face(impacts.face[i]).symbol,
        "rim": np.degrees(np.arctan2(point[1], point[0])),
        "impulse": ", ".join(_rounded(1e3 * part) for part in impacts.impulse[i]),
        "energy": 1e3 * impacts.energy[i],
        "energy_lost": -1e3 * impacts.energy_change[i],
    }


def _raised(text: str) -> Markup:
    """Return a text whose powers, such as m^2 and m^(-2-b), stand raised."""
    return Markup(_POWER.sub(lambda found: f"<sup>{found[1] or found[2]}</sup>", str(escape(text))))


def _rounded(number: float) -> str:
    """Return a number with four decimals, and a plain 0 for what rounds to it."""
    return f"{number:.4f}" if abs(number) >= 5e-5 else "0"
