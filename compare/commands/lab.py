"""`cointoss lab`: a page in which one tosses coins, and that opens a map."""

import re
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any

import click
from click.core import ParameterSource

from cointoss.compare.commands.common import SCENARIO_HELP
from cointoss.compare.commands.explore import explore
from cointoss.compare.commands.names import spared_scenario_argument
from cointoss.compare.commands.options import only_with, options_of, without
from cointoss.compare.commands.served import ServedPage, open_page, serve
from cointoss.compare.commands.settings import set_option, with_scenario
from cointoss.compare.output.accepted import Form, Written
from cointoss.compare.sweep.asked import Source
from cointoss.models.devices import Device


@dataclass(frozen=True, kw_only=True)
class LabPage(ServedPage):
    """Where the page goes, and what tosses its map."""

    out: Annotated[Path | None, Written((".html",)), Form("FILE.html")] = None
    """Write the page, at most 2 MB, instead of opening it."""
    device: Device | None = None
    """Serve the page to this machine until Ctrl-C, and compute its map here: on the CPU, an NVIDIA card, or
    the card where there is one and it is faster."""


class _OfScenarioOrMap(click.Command):
    """Takes a map in place of a scenario: the command is `explore` then, whose `--static` is `--out` too."""

    def make_context(
        self, info_name: str | None, args: list[str], parent: click.Context | None = None, **extra: Any
    ) -> click.Context:
        if any(Path(word).suffix == ".zarr" and before != "--out" for before, word in pairwise(["", *args])):
            named = [re.sub("^--out(=|$)", r"--static\1", word) for word in args]
            return explore.make_context(info_name, named, parent, **extra)
        return super().make_context(info_name, args, parent, **extra)


@click.command(cls=_OfScenarioOrMap, epilog=SCENARIO_HELP)
@spared_scenario_argument
@set_option
@options_of(LabPage, without("device", "out"), only_with("port", "device"), only_with("no_browser", "device"))
@with_scenario
def lab(source: Source, asked: LabPage) -> None:
    """Toss coins in the browser: a map that follows sliders, and each of its tosses.

    The page is one file with the analytic engine in it; it needs no server and no network. It begins with
    SCENARIO, by default with its tour. With --device the page is served, and its map is tossed here. A
    MAP.zarr in place of SCENARIO is opened as by cointoss explore, with its options; --out is its --static.
    """
    is_given = click.get_current_context().get_parameter_source("scenario") is not ParameterSource.DEFAULT
    is_tour = not (is_given or source.settings)
    if asked.device is not None:
        from cointoss.compare.lab.served import ServedLab

        serve(ServedLab(source.scenario, asked.port or 0, asked.device, is_tour=is_tour), asked)
        return
    from cointoss.compare.lab.lab import lab_page
    from cointoss.compare.output.files import write_text

    page = lab_page(source.scenario, is_tour=is_tour)
    if asked.out is None:
        open_page(page)
        return
    write_text(asked.out, page)
    click.echo(asked.out)
