"""Classes of tosses, as `classes.toml` declares them: what is tossed, how often, and who tosses."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from cointoss import Scenario, load
from cointoss.models.answers import Trust

HEYOKA = "heyoka has wheels for Linux on x86-64 only"
"""Why a benchmark by it may be left out."""


@dataclass(frozen=True, kw_only=True)
class TossClass:
    """Tosses of one kind, on a grid of spin and height."""

    scenario: str
    changed: Mapping[str, Any] = field(default_factory=dict)
    tosses: int
    card: int = 0
    engine: str = "analytic"
    trust: Trust | None = None

    def varied(self, tosses: int) -> dict[str, Any]:
        """Return what varies in so many tosses or some fewer, and what is changed in all."""
        side = int(tosses**0.5)
        spin, height = np.meshgrid(np.linspace(20, 60, side), np.linspace(0.2, 0.6, side))
        grid = {"release.angular_velocity.eta": spin.ravel(), "release.position.z": height.ravel()}
        return {**grid, **self.changed}

    def scenarios(self) -> list[Scenario]:
        """Return the tosses of a benchmark one by one."""
        named = self.varied(self.tosses)
        columns = np.broadcast_arrays(*named.values())
        return [
            load(self.scenario).replace(*(part for pair in zip(named, row, strict=True) for part in pair))
            for row in zip(*(column.tolist() for column in columns), strict=True)
        ]


CLASSES = {
    name: TossClass(**declared)
    for name, declared in tomllib.loads(Path(__file__).with_name("classes.toml").read_text("utf-8")).items()
}
