"""Make the maps, their picture and their report that `cointoss basin` is asked for."""

import os
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from cointoss.compare.engines import Engine
from cointoss.compare.film.back_end import drawing_problem, require_mujoco
from cointoss.compare.output.files import UnwritableError, write_bytes
from cointoss.compare.report.contents import NOT_ASKED, require_folder
from cointoss.compare.sweep import describe, run, store
from cointoss.compare.sweep.asked import Job, Source
from cointoss.compare.sweep.axes import Axis, parse_axis
from cointoss.compare.sweep.cluster import Workers, cluster
from cointoss.compare.sweep.layout import Layout, layout_of
from cointoss.compare.sweep.maps import asked, outcomes_in
from cointoss.compare.sweep.pieces import How, check_map, pieces, toss_part
from cointoss.compare.sweep.reading import map_in
from cointoss.models.devices import Device
from cointoss.models.stages import stage

if TYPE_CHECKING:
    import xarray as xr

Say = Callable[[str], None]
"""Called with a message on what the command waits for."""


@dataclass(frozen=True, kw_only=True)
class Planned:
    """A map that is asked for."""

    path: Path
    how: How
    layout: Layout


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
    plans, no_video = _planned(job, source)
    made = list["xr.Dataset"]()
    with cluster(job.scheduler, say, "`resume` goes on") as workers:
        for plan in plans:
            with store.opened(plan.path, plan.layout, overwrite=job.overwrite) as kept:
                run.fill(kept, _tosser(plan, workers))
                if job.device != Device.CPU:
                    say(f"{plan.path}: tossed by {plan.how.processor.in_words}")
                yield from _described(plan, kept)
                if _is_drawn(job):
                    made.append(map_in(kept))
    if made:
        yield from _shown(job, source, made, no_video, command)


def _planned(job: Job, source: Source) -> tuple[list[Planned], str | None]:
    """Return the maps that are asked for, and why there is no video; all is checked."""
    x, y = parse_axis(job.x, source.scenario), parse_axis(job.y, source.scenario)
    engines = {job.out: Engine(job.engine)}
    if job.compare:
        other = job.out.with_name(f"{job.out.stem}-mujoco.zarr")
        engines = {job.out: Engine.ANALYTIC, other: Engine.MUJOCO}
    for path in engines:
        store.require_place(path, resume=job.resume, overwrite=job.overwrite)
    no_video = None if job.report is None else _require_report(job, job.report, source.name, engines)
    # From here on MuJoCo is imported: its back end is chosen.
    require_mujoco(*engines.values())
    plans = [_plan(job, source, path, engine, x, y) for path, engine in engines.items()]
    kept = [store.there(plan.path, plan.layout) for plan in plans if job.resume]
    new = len(plans) - sum(one is not None and one.is_whole for one in kept)
    for plan in plans:
        check_map(plan.layout.batch, plan.how)
        run.require_room(plan.layout, job.out.parent, maps=new, drawn=_is_drawn(job))
    return plans, no_video


def _is_drawn(job: Job) -> bool:
    return job.compare or job.png is not None


def _require_report(job: Job, report: Path, name: str, maps: Iterable[Path]) -> str | None:
    """Refuse a folder that can't be a report's; return why the report has no video."""
    require_folder(report, name)
    for path in maps:
        if Path(os.path.realpath(report)).is_relative_to(os.path.realpath(path)):
            raise UnwritableError(f"{report}: lies in the map {path}; accepted: a folder outside of it")
    return NOT_ASKED if job.no_video else drawing_problem()


def _plan(job: Job, source: Source, path: Path, engine: Engine, x: Axis, y: Axis) -> Planned:
    chosen = {"contact": job.contact} if engine == Engine.MUJOCO else {}
    batch, how = asked(
        source.scenario,
        x,
        y,
        engine=engine,
        settings=replace(engine.package.MANY, **chosen),
        after=job.after,
        margin=job.margin,
        trust=job.trust and engine == Engine.ANALYTIC,
        device=job.device,
    )
    layout = layout_of(batch, how, name=source.stem, scenario_text=source.text)
    return Planned(path=path, how=how, layout=layout)


def _tosser(plan: Planned, workers: Workers | None) -> run.Tosser:
    """Return what tosses the pixels of a map: this machine, or the workers of a cluster."""
    batch, how = plan.layout.batch, plan.how
    if workers is None:
        return partial(pieces, batch, how)
    return lambda parts: workers(partial(toss_part, batch, how), parts, how.engine)


def _described(plan: Planned, kept: store.Store) -> Iterator[str]:
    """Yield what a whole map has, as text."""
    how = plan.how
    yield describe.describe_map(plan.path, plan.layout, run.fractions_of(kept))
    if how.margin is not None:
        yield describe.describe_margins(how.quantity, kept.whole("margin"))
    if how.trust:
        yield describe.describe_trust(how.after, run.trust_counts(kept, how.after))


def _shown(
    job: Job, source: Source, made: "list[xr.Dataset]", no_video: str | None, command: str
) -> Iterator[str]:
    """Draw the maps and write their report, where asked for; yield what is said of them."""
    from cointoss.compare.sweep import show

    if len(made) > 1:
        yield describe.describe_agreement(describe.measure(*map(outcomes_in, made)))
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
