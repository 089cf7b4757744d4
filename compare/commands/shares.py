"""`cointoss shares`: how often a coin ends how, along fields of the scenario."""

import shutil
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import click

from cointoss.compare.commands.common import (
    SCENARIO_HELP,
    Given,
    naming_options,
    print_json,
    quantity,
    say,
)
from cointoss.compare.commands.hand_options import ByHand, chosen_hand
from cointoss.compare.commands.names import fields_in, scenario_argument, varied
from cointoss.compare.commands.options import one_of, options_of, without
from cointoss.compare.commands.settings import set_option, with_scenario
from cointoss.compare.output.accepted import Form, Within, Written
from cointoss.compare.sweep.asked import Source
from cointoss.models.devices import Device

if TYPE_CHECKING:
    import xarray as xr

    from cointoss.compare.shares.counting import Counts
    from cointoss.compare.shares.plan import Plan

PICTURES = (".png", ".svg", ".pdf")
WHOLE = 1000
"""Columns in which every table has room."""


@dataclass(frozen=True, kw_only=True)
class CountedTosses(ByHand):
    """What is counted, until when, and where the table goes."""

    vary: Annotated[tuple[str, ...], Form("FIELD=START:STOP:N")] = ()
    """Field that varies, and its N values; give it twice to vary two fields."""
    tosses: Annotated[int | None, Within(1, 10_000_000)] = None
    """Tosses for each value; by default 1000, or at most ten million with --to."""
    to: Annotated[Given | None, quantity(""), Form("PART")] = None
    """Toss for each value until the widest interval is at most this to either side, such as 0.5%."""
    engine: Literal["analytic", "mujoco"] = "analytic"
    """Engine that computes the tosses."""
    compare: bool = False
    """Count by both engines, and test how far their counts agree."""
    device: Device = Device.CPU
    """Device that computes the tosses: the CPU, an NVIDIA card, or the card where it is faster."""
    scheduler: Annotated[str | None, Form("ADDRESS")] = None
    """Address of a Dask scheduler on whose workers to toss."""
    out: Annotated[tuple[Path, ...], Written((".csv", *PICTURES)), Form("FILE")] = ()
    """Write the table (.csv) or the picture (.png, .svg, .pdf); may be given again."""
    json: bool = False
    """Print JSON, in full precision."""


@click.command(epilog=SCENARIO_HELP)
@scenario_argument
@set_option
@options_of(
    CountedTosses,
    one_of("engine", "compare"),
    without("device", "scheduler"),
    completed={"vary": fields_in("cointoss.compare.shares.plan")},
)
@with_scenario
def shares(source: Source, asked: CountedTosses) -> None:
    """Count how often a coin tossed by hand shows heads, tails or its edge, along a field.

    FIELD is a dotted path into the scenario, such as floor.restitution, coin.thickness or
    coin.center_of_mass.zeta, or a number of the hand, such as hand.height; START and STOP are in SI or carry
    a unit, both are included. A second --vary gives a table of both, and a picture with a panel for each
    of its values. The hand releases the coin, heads up and flat by default, as in `cointoss hands`; the
    scenario's own release is not used.

    \b
        cointoss shares zloty --vary floor.restitution=0.2:0.8:4 --tosses 500
        cointoss shares zloty --vary "coin.thickness=1 mm:15 mm:8" --up either --to 1% --out edge.png

    Intervals are of 99 %. With --compare both engines toss, each its own releases; the last column is the
    probability that counts of one distribution differ as much by chance (a chi-square test). Ctrl-C prints
    what is counted until then. Numbers depend on the seed, not on how many cores toss.
    """
    from cointoss.models.stages import stage

    with stage("getting ready"):
        from cointoss.compare.engines import Engine
        from cointoss.compare.film.back_end import require_mujoco
        from cointoss.compare.shares import plan as plans
        from cointoss.models.processor import Processor

    hand, _ = chosen_hand(asked, source.scenario)
    engines = tuple(Engine) if asked.compare else (Engine(asked.engine),)
    with naming_options({"to": ("--to", asked.to)}):
        plan = plans.plan_of(
            varied(asked.vary),
            source.scenario,
            name=source.stem,
            hand=hand,
            engines=engines,
            seed=asked.seed,
            tosses=asked.tosses,
            to=asked.to and asked.to.value,
            processor=Processor(asked.device),
        )
    if any(path.suffix.lower() in PICTURES for path in asked.out):
        from cointoss.compare.shares.picture import require_drawable

        require_drawable(plan.shape)
    require_mujoco(*engines)
    plans.check(plan)
    _count(plan, source.name, asked.scheduler, asked.out, asked.json)


def _count(plan: "Plan", scenario: str, scheduler: str | None, out: Sequence[Path], as_json: bool) -> None:
    """Count, print the result and write it; where a signal or a lost cluster ends it, what there is."""
    from cointoss.compare.output.files import write_bytes, write_text
    from cointoss.compare.output.interruption import saying
    from cointoss.compare.shares import counting, show
    from cointoss.compare.shares.shares import dataset_of, no_counts
    from cointoss.compare.sweep.cluster import cluster

    counts: Counts = no_counts(plan)
    try:
        with (
            saying(lambda said: f"{said}: {int(counts.sum()):,d} tosses are counted"),
            cluster(scheduler, say, "what was counted is printed") as workers,
        ):
            tosser = partial(counting.toss_there, workers) if workers else counting.toss_here
            for so_far in counting.counting(plan, tosser):
                counts = so_far
    finally:
        if counts.any():
            found = dataset_of(plan, counts)
            _print(found, plan, scenario, as_json)
            for path in out:
                if path.suffix.lower() == ".csv":
                    write_text(path, show.csv(found))
    if plan.processor.device is not Device.CPU:
        say(f"tossed by {plan.processor.in_words}")
    for path in out:
        if (suffix := path.suffix.lower()) in PICTURES:
            from cointoss.compare.shares.picture import picture_of

            write_bytes(path, picture_of(dataset_of(plan, counts), suffix))


def _print(found: "xr.Dataset", plan: "Plan", scenario: str, as_json: bool) -> None:
    """Print the shares."""
    import numpy as np

    from cointoss.compare.output.hand_lines import uncaught
    from cointoss.compare.output.terminal import laid_out
    from cointoss.compare.shares import show
    from cointoss.compare.sweep.axes import HAND

    if as_json:
        print_json({"scenario": scenario, "to": plan.to, **show.as_json(found)}, *plan.engines)
        return
    of = "coins that the hand catches, by the side that is up" if plan.catches else "tosses, by how they end"
    varied = [axis.field for axis in plan.vary if axis.field in HAND]
    instead = f"; but {' and '.join(varied)} as above" if varied else ""
    missed, alike = int(found.not_caught.sum()), show.alike(found)
    differ = "engines that agree differ as much with this probability"
    # What goes into a file or a pipe keeps its lines whole.
    width = shutil.get_terminal_size().columns if sys.stdout.isatty() else WHOLE
    lines = [
        laid_out(show.markdown(found), width),
        "",
        f"shares     of the {of}; in brackets 99 % intervals",
        f"hand       {plan.hand.in_words}{instead}",
        *([f"unvaried   {plan.unvaried}"] if plan.unvaried else []),
        f"engine     {' and '.join(plan.engines)}, seed {plan.seed}",
        *([f"left out   {uncaught(missed)}"] if missed else []),
        *([f"alike      p = {np.nanmin(alike):.2g}: {differ}"] if len(alike) else []),
    ]
    if len(alike) > 1:
        by_chance = f"by chance the least is as small in {show.least_alike(found):.2g} of all runs"
        lines.append(f"           (the least of {len(alike)} settings; {by_chance})")
    click.echo("\n".join(lines))
