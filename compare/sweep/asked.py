"""What `cointoss basin` is asked for."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, NamedTuple

from cointoss.compare.basins.picture_style import PictureStyle
from cointoss.compare.metrics.quantity_names import latin_name
from cointoss.compare.output.accepted import Form, Within, Written
from cointoss.models.devices import Device

if TYPE_CHECKING:
    from cointoss.models.scenario import Scenario


class Source(NamedTuple):
    """The scenario that is asked for."""

    name: str
    """Its name, or its file's, in messages."""
    scenario: "Scenario"
    text: str
    """Its TOML."""
    settings: tuple[str, ...]
    """FIELD=VALUE each, with which it was changed."""

    @property
    def stem(self) -> str:
        """What a report, a map or a table calls it."""
        return Path(self.name).stem


@dataclass(frozen=True, kw_only=True)
class Job(PictureStyle):
    """A map of a scenario, or one by each engine, with what is printed about them and how they are drawn."""

    x: Annotated[str, Form("FIELD=START:STOP:N")]
    """Field that varies along x, and its N values."""
    y: Annotated[str, Form("FIELD=START:STOP:N")]
    """Field that varies along y, and its N values."""
    out: Annotated[Path, Written((".zarr",), "map"), Form("MAP.zarr")]
    """The Zarr store to write."""
    engine: Literal["analytic", "mujoco"] = "analytic"
    """Engine that computes the tosses."""
    compare: bool = False
    """Make the map by both engines, MuJoCo's as MAP-mujoco.zarr, and compare the two."""
    contact: Literal["spring", "one_step"] = "spring"
    """How MuJoCo realises the restitution."""
    after: Annotated[int | None, Within(0, 999_999)] = None
    """Map the face at the touch after this number of impacts; 0: at the first touch."""
    margin: Annotated[str | None, Form("QUANTITY", latin_name)] = None
    """Also map the smallest change of this quantity of the release that changes a pixel's outcome:
    height, velocity x (y, z), attitude about xi (eta, zeta) or spin about xi (eta, zeta)."""
    trust: bool = False
    """Also find which pixels the engine's own errors may have decided."""
    resume: bool = False
    """Continue a map; begin it where there is none."""
    overwrite: bool = False
    """Replace an existing map."""
    device: Device = Device.CPU
    """Device that computes the tosses: the CPU, an NVIDIA card, or the card where it is faster."""
    scheduler: Annotated[str | None, Form("ADDRESS")] = None
    """Address of a Dask scheduler, whose workers compute the tosses."""
    png: Annotated[Path | None, Written((".png",))] = None
    """Also draw the map to this .png file."""
    report: Annotated[Path | None, Written(kind="folder")] = None
    """Folder of a report as by `cointoss compare`, with both maps; requires --compare."""
    no_video: bool = False
    """Draw no video, which takes longest."""

    @property
    def is_drawn(self) -> bool:
        """Whether whole maps are compared or drawn."""
        return self.compare or self.png is not None
