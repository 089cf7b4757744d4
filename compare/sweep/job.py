"""Make the maps, their picture and their report that `cointoss basin` is asked for."""

import os
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from cointoss.compare.basins.agreement import agreement
from cointoss.compare.engines import Engine
from cointoss.compare.film.back_end import drawing_problem, require_mujoco
from cointoss.compare.output.files import UnwritableError, write_bytes
from cointoss.compare.report.contents import NOT_ASKED, require_folder
from cointoss.compare.sweep import describe, store
from cointoss.compare.sweep.asked import Job, Source
from cointoss.compare.sweep.axes import Axis, parse_axis
from cointoss.compare.sweep.cluster import Workers, cluster
from cointoss.compare.sweep.layout import Layout, layout_of
from cointoss.compare.sweep.maps import asked, outcomes_in
from cointoss.compare.sweep.pieces import check_map, pieces, toss_part
from cointoss.compare.sweep.reading import map_in
from cointoss.compare.sweep.room import require_room
from cointoss.models.devices import Device
from cointoss.models.stages import stage

if TYPE_CHECKING:
    import xarray as xr


def make(job: Job, source: Source, command: str, say: Callable[[str], None]) -> Iterator[str]:
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
    layouts, made = _layouts(job, source), list["xr.Dataset"]()
    with cluster(job.scheduler, say, "`resume` goes on") as workers:
        for path, layout in layouts.items():
            with store.opened(path, layout, overwrite=job.overwrite) as kept:
                store.fill(kept, _tosser(layout, workers))
                if job.device != Device.CPU:
                    say(f"{path}: tossed by {layout.how.processor.in_words}")
                yield from describe.described(path, layout, kept)
                if job.is_drawn:
                    made.append(map_in(kept))
    if made:
        yield from _shown(job, source, made, command)


def _layouts(job: Job, source: Source) -> dict[Path, Layout]:
    """Return the layout of each map that is asked for, all checked."""
    x, y = parse_axis(job.x, source.scenario), parse_axis(job.y, source.scenario)
    engines = {job.out: Engine(job.engine)}
    if job.compare:
        other = job.out.with_name(f"{job.out.stem}-mujoco.zarr")
        engines = {job.out: Engine.ANALYTIC, other: Engine.MUJOCO}
    for path in engines:
        store.require_place(path, resume=job.resume, overwrite=job.overwrite)
    if job.report is not None:
        _require_report(job, job.report, source.name, engines)
    # From here on MuJoCo is imported: its back end is chosen.
    require_mujoco(*engines.values())
    layouts = {path: _layout(job, source, engine, x, y) for path, engine in engines.items()}
    kept = [store.there(path, layout) for path, layout in layouts.items() if job.resume]
    new = len(layouts) - sum(one is not None and one.is_whole for one in kept)
    for layout in layouts.values():
        check_map(layout.batch, layout.how)
        require_room(layout, job.out.parent, maps=new, drawn=job.is_drawn)
    return layouts


def _require_report(job: Job, report: Path, name: str, maps: Iterable[Path]) -> None:
    """Refuse a folder that can't be a report's."""
    require_folder(report, name)
    for path in maps:
        if Path(os.path.realpath(report)).is_relative_to(os.path.realpath(path)):
            raise UnwritableError(f"{report}: lies in the map {path}; accepted: a folder outside of it")
    _no_video(job)


def _no_video(job: Job) -> str | None:
    """Return why the report has no video; the first call chooses MuJoCo's back end."""
    return NOT_ASKED if job.no_video else drawing_problem()


def _layout(job: Job, source: Source, engine: Engine, x: Axis, y: Axis) -> Layout:
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
    return layout_of(batch, how, name=source.stem, scenario_text=source.text)


def _tosser(layout: Layout, workers: Workers | None) -> store.Tosser:
    """Return what tosses the pixels of a map: this machine, or the workers of a cluster."""
    if workers is None:
        return partial(pieces, layout.batch, layout.how)
    return lambda parts: workers(partial(toss_part, layout.batch, layout.how), parts, layout.how.engine)


def _shown(job: Job, source: Source, made: "list[xr.Dataset]", command: str) -> Iterator[str]:
    """Draw the maps and write their report, where asked for; yield what is said of them."""
    from cointoss.compare.sweep import show

    if len(made) > 1:
        yield describe.describe_agreement(agreement(*map(outcomes_in, made), distance=describe.AWAY))
    if job.png is not None:
        with stage("drawing the picture"):
            write_bytes(job.png, show.png_of(made, job))
        yield f"picture    {job.png}"
    if job.report is not None:
        from cointoss.compare.report.comparison import compared
        from cointoss.compare.report.folder import write_report

        fine = replace(Engine.MUJOCO.package.FINE, contact=job.contact)
        both = compared(source.scenario, source.text, source.stem, settings={"mujoco": fine})
        page = write_report(both, job.report, _no_video(job), maps=show.section(made, job, command))
        yield f"report     {page}"
