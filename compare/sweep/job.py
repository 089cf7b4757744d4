"""Make the maps, their picture and their report that `cointoss basin` is asked for."""

import os
import shlex
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from cointoss.compare.basins.picture_style import PictureStyle
from cointoss.compare.engines import Engine
from cointoss.compare.film.back_end import drawing_problem, require_mujoco
from cointoss.compare.output.files import UnwritableError, require_file, written_whole
from cointoss.compare.report.contents import NOT_ASKED, require_folder
from cointoss.compare.sweep import describe, run, store
from cointoss.compare.sweep.axes import Axis, parse_axis
from cointoss.compare.sweep.grid import Sweep
from cointoss.compare.sweep.layers import trust_layer
from cointoss.compare.sweep.pixels import check
from cointoss.compare.sweep.untrusted import untrusted_pixels
from cointoss.models.reading import parse
from cointoss.models.scenario import Scenario
from cointoss.models.stages import stage

Say = Callable[[str], None]
"""Called with what is waited for."""


@dataclass(frozen=True, kw_only=True)
class Job:
    """What is asked for."""

    source: str
    """What to call the scenario in messages."""
    text: str
    """The scenario's TOML."""
    x: str
    """FIELD=START:STOP:N."""
    y: str
    """FIELD=START:STOP:N."""
    out: Path
    """The map's folder."""
    engine: Engine | None
    """None for both, the second's map beside the first."""
    contact: str
    """Of MuJoCo, "spring" or "one_step"."""
    after: int | None
    """As of a `Sweep`."""
    margin: str | None
    """Name of the quantity along which margins are mapped."""
    trust: bool
    """Whether the pixels that can be trusted are found."""
    resume: bool
    """Whether to go on with maps that are there."""
    overwrite: bool
    """Whether to replace them."""
    scheduler: str | None
    """Address of a cluster's scheduler, if the tosses are made there."""
    png: Path | None
    """Where to draw."""
    style: PictureStyle
    """How to draw."""
    report: Path | None
    """Folder of a report on both engines' maps and tosses; accepted for both engines only."""
    no_video: bool
    """Whether that report is to have no video."""


def sweeps_of(job: Job, scenario: Scenario, x: Axis, y: Axis) -> dict[Path, Sweep]:
    """Return the sweep of each map that is asked for; its engine is imported.

    Raises:
        SweepError: for axes that exclude each other, and for a margin that there is none of.
    """
    chosen = {Engine.MUJOCO: {"contact": job.contact}}
    return {
        path: Sweep(
            scenario=scenario,
            engine=engine,
            x=x,
            y=y,
            settings=replace(engine.package.MANY, **chosen.get(engine, {})),
            after=job.after,
            margin=job.margin,
            trust=job.trust and engine == Engine.ANALYTIC,
            name=Path(job.source).stem,
        )
        for path, engine in _engines_of(job).items()
    }


def _engines_of(job: Job) -> dict[Path, Engine]:
    second = job.out.with_name(f"{job.out.stem}-mujoco.zarr")
    return {job.out: job.engine or Engine.ANALYTIC} | ({} if job.engine else {second: Engine.MUJOCO})


def make(job: Job, say: Say) -> Iterator[str]:
    """Make what is asked for, and give the results as text, each as soon as it is there.

    Nothing is begun before all is checked that can be.

    Raises:
        ScenarioError, SweepError, UnsupportedError: for what can't be tossed.
        UnwritableError: for what can't be written.
        BackEndError: where MuJoCo can't be used.
    """
    scenario, engines = parse(job.text, job.source), _engines_of(job)
    x, y = parse_axis(job.x, scenario), parse_axis(job.y, scenario)
    for path in engines:
        store.require_place(path, resume=job.resume, overwrite=job.overwrite)
    if job.png is not None:
        require_file(job.png, ".png", job.source)
    no_video = None
    if job.report is not None:
        _require_report(job.report, engines, job.source)
        no_video = NOT_ASKED if job.no_video else drawing_problem()
    # From here on MuJoCo is imported: its back end is chosen.
    if Engine.MUJOCO in engines.values():
        require_mujoco()
    sweeps = sweeps_of(job, scenario, x, y)
    if job.resume:
        for path, sweep in sweeps.items():
            store.require_same(path, store.layout_of_map(sweep, job.text))
    drawn, maps = len(sweeps) > 1 or job.png is not None, []
    margins = untrusted = None
    for sweep in sweeps.values():
        check(sweep)
        run.require_room(sweep, job.out.parent, maps=len(sweeps), drawn=drawn)
    with _tosser(job.scheduler, say) as tosser:
        for path, sweep in sweeps.items():
            with store.opened(path, store.layout_of_map(sweep, job.text), overwrite=job.overwrite) as map_:
                run.fill(map_, tosser(sweep))
                yield describe.describe_map(path, sweep, run.fractions_of(map_))
                if sweep.margin is not None:
                    margins = map_.whole("margin")
                    yield describe.describe_margins(sweep.quantity, margins)
                if sweep.trust:
                    yield describe.describe_trust(sweep, run.trust_counts(map_, sweep.after))
                    if drawn:
                        untrusted = untrusted_pixels(sweep.after, map_.whole(trust_layer(sweep.after)))
                if drawn:
                    maps.append(map_.whole("outcome"))
    if not drawn:
        return
    from cointoss.compare.sweep import show

    first = next(iter(sweeps.values()))
    if len(maps) > 1:
        yield describe.describe_agreement(describe.measure(*maps))
    if job.png is not None:
        with stage("drawing the picture"):
            drawn_map = show.png_of(maps, first, job.style, margins=margins, untrusted=untrusted)
            with written_whole(job.png) as aside:
                aside.write_bytes(drawn_map)
        yield f"picture    {job.png}"
    if job.report is not None:
        from cointoss.compare.report.comparison import compared
        from cointoss.compare.report.folder import write_report

        fine = replace(Engine.MUJOCO.package.FINE, contact=job.contact)
        both = compared(first.scenario, job.text, Path(job.source).stem, fine)
        made = list(sweeps.values())
        shown = show.section(maps, made, job.style, _command(job), untrusted=untrusted)
        page = write_report(both, job.report, no_video, maps=shown)
        yield f"report     {page}"


def _require_report(folder: Path, maps: Iterable[Path], source: str) -> None:
    require_folder(folder, source)
    for path in maps:
        if Path(os.path.realpath(folder)).is_relative_to(os.path.realpath(path)):
            raise UnwritableError(f"{folder}: lies in the map {path}; accepted: a folder outside of it")


def _command(job: Job) -> str:
    """Give the command line that makes the report, and the maps of both engines where they do not exist."""
    words: list[object] = ["cointoss", "basin", job.source, "--x", job.x, "--y", job.y]
    if job.after is not None:
        words += ["--after", job.after]
    words += ["--compare", "--contact", job.contact, "--out", job.out, "--report", job.report, "--resume"]
    words += ["--trust"] * job.trust + ["--no-video"] * job.no_video
    style = job.style
    words += ["--palette", style.palette, "--dpi", style.dpi] + ["--boundaries"] * style.boundaries
    if style.size is not None:
        words += ["--size", "x".join(f"{length:.17g}" for length in style.size)]
    return shlex.join(map(str, words))


@contextmanager
def _tosser(scheduler: str | None, say: Say) -> Iterator[Callable[[Sweep], run.Tosser]]:
    if scheduler is None:
        yield run.toss_here
        return
    from cointoss.compare.sweep.cluster import cluster

    with cluster(scheduler, say, "--resume goes on") as workers:
        yield lambda sweep: lambda parts: workers(partial(run.toss_part, sweep), parts, sweep.engine)
