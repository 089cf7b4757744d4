"""Make the maps, their picture and their report that `cointoss basin` is asked for."""

import os
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path

from cointoss.compare.engines import Engine
from cointoss.compare.film.back_end import drawing_problem, require_mujoco
from cointoss.compare.output.files import UnwritableError, write_bytes
from cointoss.compare.report.contents import NOT_ASKED, require_folder
from cointoss.compare.sweep import describe, run, store
from cointoss.compare.sweep.asked import Job, Source
from cointoss.compare.sweep.axes import Axis, parse_axis
from cointoss.compare.sweep.cluster import Workers, cluster
from cointoss.compare.sweep.grid import Sweep
from cointoss.compare.sweep.layout import layout_of_map
from cointoss.compare.sweep.pixels import check
from cointoss.compare.sweep.tossed_map import TossedMap
from cointoss.models.devices import Device
from cointoss.models.stages import stage

Say = Callable[[str], None]
"""Called with a message on what the command waits for."""


def sweeps_of(job: Job, source: Source, x: Axis, y: Axis) -> dict[Path, Sweep]:
    """Return the sweep of each map that is asked for; its engine is imported.

    Raises:
        SweepError: for axes that exclude each other, and for a margin that there is none of.
    """
    chosen = {Engine.MUJOCO: {"contact": job.contact}}
    return {
        path: Sweep(
            scenario=source.scenario,
            engine=engine,
            x=x,
            y=y,
            settings=replace(engine.package.MANY, **chosen.get(engine, {})),
            after=job.after,
            margin=job.margin,
            trust=job.trust and engine == Engine.ANALYTIC,
            device=job.device,
            name=source.stem,
        )
        for path, engine in _engines_of(job).items()
    }


def _engines_of(job: Job) -> dict[Path, Engine]:
    if not job.compare:
        return {job.out: Engine(job.engine)}
    return {job.out: Engine.ANALYTIC, job.out.with_name(f"{job.out.stem}-mujoco.zarr"): Engine.MUJOCO}


def make(job: Job, source: Source, command: str, say: Say) -> Iterator[str]:
    """Make what is asked for, and yield the results as text, each as soon as it is ready.

    Nothing is begun before all is checked that can be.

    Args:
        job: what is asked for.
        source: the scenario.
        command: the command line that makes the report, for it to name.
        say: called with what is waited for.

    Raises:
        ScenarioError, SweepError, UnsupportedError, DeviceError: for what can't be tossed.
        UnwritableError: for what can't be written.
        BackEndError: where MuJoCo can't be used.
    """
    engines = _engines_of(job)
    x, y = parse_axis(job.x, source.scenario), parse_axis(job.y, source.scenario)
    for path in engines:
        store.require_place(path, resume=job.resume, overwrite=job.overwrite)
    no_video = None
    if job.report is not None:
        require_folder(job.report, source.name)
        for path in engines:
            if Path(os.path.realpath(job.report)).is_relative_to(os.path.realpath(path)):
                why = f"lies in the map {path}; accepted: a folder outside of it"
                raise UnwritableError(f"{job.report}: {why}")
        no_video = NOT_ASKED if job.no_video else drawing_problem()
    # From here on MuJoCo is imported: its back end is chosen.
    require_mujoco(*engines.values())
    sweeps = sweeps_of(job, source, x, y)
    kept = [
        store.there(path, layout_of_map(sweep, source.text)) for path, sweep in sweeps.items() if job.resume
    ]
    new = len(sweeps) - sum(one is not None and one.is_whole for one in kept)
    drawn, made = len(sweeps) > 1 or job.png is not None, list[TossedMap]()
    for sweep in sweeps.values():
        check(sweep)
        run.require_room(sweep, job.out.parent, maps=new, drawn=drawn)
    with cluster(job.scheduler, say, "`resume` goes on") as workers:
        for path, sweep in sweeps.items():
            with store.opened(path, layout_of_map(sweep, source.text), overwrite=job.overwrite) as map_:
                run.fill(map_, _tosser(sweep, workers))
                if job.device != Device.CPU:
                    say(f"{path}: tossed by {sweep.how.processor.in_words}")
                yield describe.describe_map(path, sweep, run.fractions_of(map_))
                if sweep.margin is not None:
                    yield describe.describe_margins(sweep.quantity, map_.whole("margin"))
                if sweep.trust:
                    yield describe.describe_trust(sweep, run.trust_counts(map_, sweep.after))
                if drawn:
                    layers = {name: map_.whole(name) for name in map_.layers}
                    made.append(TossedMap(name=sweep.name, sweep=sweep, layers=layers))
    if not drawn:
        return
    from cointoss.compare.sweep import show

    if len(made) > 1:
        yield describe.describe_agreement(describe.measure(*(each.outcome for each in made)))
    if job.png is not None:
        with stage("drawing the picture"):
            write_bytes(job.png, show.png_of(made, job))
        yield f"picture    {job.png}"
    if job.report is not None:
        from cointoss.compare.report.comparison import compared
        from cointoss.compare.report.folder import write_report

        fine = replace(Engine.MUJOCO.package.FINE, contact=job.contact)
        both = compared(source.scenario, source.text, source.stem, settings={"mujoco": fine})
        page = write_report(both, job.report, no_video, maps=show.section(made, job, command))
        yield f"report     {page}"


def _tosser(sweep: Sweep, workers: Workers | None) -> run.Tosser:
    """Return what tosses the pixels of a sweep: this machine, or the workers of a cluster."""
    if workers is None:
        return run.toss_here(sweep)
    return lambda parts: workers(partial(run.toss_part, sweep), parts, sweep.engine)
