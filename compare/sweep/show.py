"""Maps for a person: their pictures, and what is measured on them in a few lines."""

import io
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray
from matplotlib.figure import Figure
from numpy.typing import NDArray

from compare.basins import picture
from compare.basins.agreement import Agreement, Share, agreement
from compare.basins.fractions import fractions
from compare.report.map_section import MapSection
from compare.sweep.axes import Axis
from compare.sweep.grid import Sweep
from models.records import Outcome

AWAY = 2.0
"""A pixel is away from the boundaries where all within this distance have its outcome [pixels]."""


@dataclass(frozen=True, kw_only=True)
class PictureStyle:
    """How a picture is drawn."""

    palette: picture.Palette = picture.Palette.SAFE
    boundaries: bool = False
    """Whether pixels at a boundary are coloured as such."""
    size: tuple[float, float] | None = None
    """Width and height of the whole, by default those of `picture` [inches]."""
    dpi: float = picture.DPI
    """Pixels per inch."""


def outcomes_of(path: Path) -> NDArray[np.int8]:
    """Read the outcomes of a map, (y, x)."""
    with xarray.open_dataset(path, engine="zarr", consolidated=True) as dataset:
        return dataset["outcome"].to_numpy()


def describe_map(path: Path, sweep: Sweep, fractions: dict[Outcome, float]) -> str:
    """Return a map as text: where it is, what it is of, and the share of each outcome."""
    ny, nx = sweep.shape
    shown = "" if sweep.after is None else f"face at touch {sweep.after + 1}, or "
    lines = [
        f"map        {path}",
        f"engine     {sweep.engine}",
        f"tosses     {nx} by {ny}: {shown}final outcome",
        *(
            f"{outcome.label:11}{100 * share:.3f} %"
            for outcome, share in fractions.items()
            if share > 0 or outcome in (Outcome.HEADS, Outcome.TAILS)
        ),
    ]
    return "\n".join(lines)


def describe_agreement(measured: Agreement) -> str:
    """Return how far two maps agree as text."""
    return "\n".join(
        [
            f"agreement  {_share(measured.away)} more than {AWAY:g} pixels from the boundaries of the first",
            f"           {_share(measured.near)} nearer to the boundaries",
            f"           {measured.undecided} pixels are undecided in one or both",
        ]
    )


def write(png: Path, maps: list[NDArray[np.int8]], sweep: Sweep, style: PictureStyle) -> None:
    """Draw one map, or those of both engines and where they differ, with the numbers of their agreement.

    Args:
        png: the file.
        maps: (y, x) each, the first by the analytic engine if there are two.
        sweep: what the first was made of.
        style: how to draw.

    Raises:
        UnwritableError: naming the file and why.
    """
    picture.write_png(_figure(maps, sweep, style), png, dpi=style.dpi)


def section(
    maps: list[NDArray[np.int8]], sweeps: Sequence[Sweep], style: PictureStyle, command: str
) -> MapSection:
    """Return what a report shows of the maps of both engines.

    Args:
        maps: (y, x) each, the first by the analytic engine.
        sweeps: what each was made of.
        style: how to draw.
        command: that makes the maps.
    """
    drawn, sweep = io.BytesIO(), sweeps[0]
    _figure(maps, sweep, style).savefig(drawn, format="png", dpi=style.dpi)
    shares = {
        sweep.engine.value: {outcome.label: share for outcome, share in fractions(outcomes).items()}
        for sweep, outcomes in zip(sweeps, maps, strict=True)
    }
    return MapSection(
        picture=drawn.getvalue(),
        numbers={
            "axes": {"x": asdict(sweep.x), "y": asdict(sweep.y)},
            "after": sweep.after,
            "fractions": shares,
            "agreement": {"distance": AWAY, **asdict(measure(*maps))},
            "settings": {sweep.engine.value: sweep.settings.as_dict() for sweep in sweeps},
            "command": command,
        },
    )


def _figure(maps: list[NDArray[np.int8]], sweep: Sweep, style: PictureStyle) -> Figure:
    x, y = _drawn(sweep.x), _drawn(sweep.y)
    common: Any = {"x": x, "y": y, "palette": style.palette, "boundaries": style.boundaries}
    if len(maps) > 1:
        measured = measure(*maps)
        return picture.draw_comparison(
            *maps,
            **common,
            size=style.size or picture.COMPARISON_SIZE,
            note=f"agree: {_share(measured.away)} away from boundaries,\n{_share(measured.near)} near them",
        )
    return picture.draw_map(maps[0], **common, size=style.size or picture.PANEL_SIZE)


def measure(analytic: NDArray[np.int8], mujoco: NDArray[np.int8]) -> Agreement:
    """Compare the maps of both engines; the boundaries are those of the analytic map."""
    return agreement(analytic, mujoco, distance=AWAY)


def _share(share: Share) -> str:
    part = share.fraction
    return f"none of {share.compared}" if part is None else f"{100 * part:.3f} % of {share.compared}"


def _drawn(axis: Axis) -> picture.MapAxis:
    return picture.MapAxis(
        name=axis.field, unit=axis.unit.replace("**", "^"), start=axis.start, stop=axis.stop
    )
