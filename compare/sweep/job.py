"""Make the maps, and the picture of them, that `cointoss basin` is asked for."""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from pathlib import Path

from compare.engines import Engine
from compare.files import require_file
from compare.sweep import run, show, store
from compare.sweep.axes import parse_axis
from compare.sweep.grid import Sweep
from compare.sweep.pixels import check
from models.reading import parse

Watch = Callable[[str, int, int], AbstractContextManager[run.Progress]]
"""Called with a map's name, the pixels that it has, and how many it will have; gives what to tell of more."""


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
    """As of a `Sweep`."""
    after: int | None
    """As of a `Sweep`."""
    resume: bool
    """Whether to go on with maps that are there."""
    overwrite: bool
    """Whether to replace them."""
    scheduler: str | None
    """Address of a cluster's scheduler, if the tosses are made there."""
    png: Path | None
    """Where to draw."""
    look: show.Look
    """How to draw."""


def sweeps_of(job: Job) -> dict[Path, Sweep]:
    """Give the sweep of each map that is asked for.

    Raises:
        ScenarioError: for a bad scenario.
        SweepError: for bad axes.
    """
    scenario = parse(job.text, job.source)
    x, y = parse_axis(job.x, scenario), parse_axis(job.y, scenario)
    second = job.out.with_name(f"{job.out.stem}-mujoco.zarr")
    engines = {job.out: job.engine or Engine.ANALYTIC} | ({} if job.engine else {second: Engine.MUJOCO})
    return {
        path: Sweep(scenario=scenario, engine=engine, x=x, y=y, after=job.after, contact=job.contact)
        for path, engine in engines.items()
    }


def make(job: Job, watch: Watch) -> Iterator[str]:
    """Make what is asked for, and give the results as text, each as soon as it is there.

    Nothing is begun before all is checked that can be.

    Raises:
        ScenarioError, SweepError, UnsupportedError: for what can't be tossed.
        UnwritableError: for what can't be written.
    """
    sweeps = sweeps_of(job)
    for path, sweep in sweeps.items():
        store.require_place(path, resume=job.resume, overwrite=job.overwrite)
        if job.resume:
            store.require_same(path, sweep)
    if job.png is not None:
        require_file(job.png, ".png", job.source)
    for sweep in sweeps.values():
        check(sweep)
        drawn = len(sweeps) > 1 or job.png is not None
        run.require_room(sweep, job.out.parent, maps=len(sweeps), drawn=drawn)
    with _tosser(job.scheduler) as tosser:
        for path, sweep in sweeps.items():
            with store.opened(path, sweep, job.text, overwrite=job.overwrite) as map_:
                left, whole = run.missing(map_), run.size(map_.tiles)
                with watch(path.name, whole - run.size(left), whole) as progress:
                    run.fill(map_, sweep, left, tosser, progress)
                yield show.describe_map(path, sweep, run.fractions_of(map_))
    maps = [show.outcomes_of(path) for path in (sweeps if len(sweeps) > 1 or job.png else ())]
    if len(maps) > 1:
        yield show.describe_agreement(show.measure(*maps))
    if job.png is not None:
        show.write(job.png, maps, next(iter(sweeps.values())), job.look)
        yield f"picture    {job.png}"


def _tosser(scheduler: str | None) -> AbstractContextManager[run.Tosser]:
    if scheduler is None:
        return nullcontext(run.toss_here)
    from compare.sweep.cluster import cluster

    return cluster(scheduler)
