"""The verb: toss a batch of scenarios, and return how they ended as one dataset."""

from collections.abc import Mapping
from functools import partial
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import xarray as xr

from cointoss.compare.engines import Engine
from cointoss.compare.sweep.batch import Batch, batch_of
from cointoss.compare.sweep.dataset import dataset_of
from cointoss.compare.sweep.errors import SweepError, require_whole
from cointoss.compare.sweep.pieces import How, check, gathered, pieces, warn_of_interruption
from cointoss.models.answers import COLUMNS, Trust
from cointoss.models.devices import Device
from cointoss.models.errors import require_type
from cointoss.models.processor import Processor
from cointoss.models.reading import ScenarioSource
from cointoss.models.records import UnsupportedError

if TYPE_CHECKING:
    from cointoss.analytic import OwnLaw

MOST_IN_MEMORY = 50_000_000
"""The most tosses whose answers are kept in memory: with their words, 300 bytes each."""
MOST_WORKERS = 4096
TRUSTS, ERRORS = (None, "impacts", "certain"), ("raise", "keep")


def toss_many(
    scenario: ScenarioSource,
    vary: Mapping[str, Any] | None = None,
    *,
    engine: Engine | str = "analytic",
    trust: Trust | None = None,
    rest: bool = False,
    settings: Any = None,
    law: "OwnLaw | None" = None,
    workers: int | None = None,
    device: Device | str = Device.CPU,
    errors: Literal["raise", "keep"] = "raise",
    progress: bool | None = None,
    out: str | PathLike[str] | None = None,
    resume: bool = False,
    overwrite: bool = False,
) -> xr.Dataset:
    """Toss a batch of scenarios, and return how each ended.

        ds = cointoss.toss_many("table", {"restitution": "0.4:0.8:5", "height": ("20 cm", "60 cm", 400)})
        float((ds.outcome == "heads").mean()), ds.cointoss.shares("floor.restitution")

    Each toss is that of `cointoss.toss` with the same settings, to the bit, whatever the number of workers.
    Ctrl-C returns the tosses made so far, with a warning; the others have the outcome "not_tossed".

    Args:
        scenario: a `Scenario`, the path of its file, or the name of one that comes with the package.
        vary: by field, its value or values. A number, a text with a unit or a word holds for all tosses. A
            range "START:STOP:N" or (START, STOP, N), both ends included, varies along a dimension of its own,
            named by the field. An array or a list broadcasts with the other arrays as in NumPy; an array with
            one axis varies along the dimension `toss`. A DataArray has named dimensions. A field's name may
            be a part that no other has, such as "restitution"; "height" is the height of C, and "spin" the
            size of ω about the scenario's own axis. `Hand.releases` draws the fields of a release.
        engine: "analytic" or "mujoco".
        trust: "impacts" also finds how many leading impacts of each toss can be trusted, in two to three
            times the time; "certain" finds that, and whether the engine's own errors can't change its
            outcome, in two to seven; by the analytic engine only.
        rest: whether to find where each coin comes to rest, on the CPU: each toss is made and followed twice
            more.
        settings: the engine's settings, by default its settings for many tosses.
        law: a contact law of one's own, in place of the scenario's, for the analytic engine.
        workers: number of threads, by default one for each core.
        device: "cpu"; "cuda", an NVIDIA card, which hands some tosses over to the CPU; or "auto", the card
            where there is one and it is faster, else the CPU. Each toss is the same on all, to the bit.
        errors: what happens with values that make no scenario: "raise" raises an error before the first toss;
            "keep" makes all other tosses, and gives these the outcome "refused".
        progress: whether to show progress; None shows it in a terminal or a notebook.
        out: a Zarr store, whose name ends in .zarr, into which the answers are written as they come: for more
            answers than memory holds, and to continue after an interruption.
        resume: whether to continue an existing store.
        overwrite: whether to replace an existing store.

    Returns:
        `outcome`, `ending` and `last_face` in words, `impacts`, `end_time` [s], and where asked for
        `trusted_impacts` and `outcome_certain`, over the dimensions of what varies, whose values are the
        coordinates. With `rest` also `rest_reason`, and the fields of `cointoss.Rest`, as `rest_x`. The
        attributes name the device, and say how many tosses a card handed over to the CPU. `ds.cointoss`
        counts, draws and saves. With `out` the dataset is the store's, which is
        read as it is asked for, and has codes in place of words: `ds.cointoss` knows both.

    Raises:
        ScenarioError: for a scenario that can't be used, naming file or toss, field, value and what is
            accepted.
        ValueError: naming the argument, its value and what is accepted.
        UnsupportedError: for a scenario that the engine can't toss, or not on that device.
        DeviceError: for the device "cuda" where no card can be used, and where one fails.
        OSError: for a store that can't be written, or that exists, naming it and why.

    Warns:
        UnusedFieldWarning: for a field that nothing uses.
        UnitWarning: for a number that was probably meant in another unit.
        ApproximationWarning: for what MuJoCo approximates.
        DeviceWarning: for a card that fails, with the device "auto": the CPU makes the remaining tosses.
    """
    batch = batch_of(scenario, vary)
    for name, value, accepted in (("trust", trust, TRUSTS), ("errors", errors, ERRORS)):
        if value not in accepted:
            raise SweepError(f"{name}: {value!r}, accepted: {', '.join(map(repr, accepted))}")
    if workers is not None:
        require_whole("workers", workers, 1, MOST_WORKERS)
    chosen = Engine(engine)
    usual = chosen.package.MANY
    if settings is not None:
        kind = type(usual)
        require_type("settings", settings, kind, f"{kind.__name__} of the engine {chosen}")
    how = How(
        engine=chosen,
        settings=usual if settings is None else settings,
        trust=trust,
        rest=rest,
        law=law,
        workers=workers,
        keeps=errors == "keep",
        processor=Processor(device),
    )
    if out is None and (resume or overwrite):
        raise SweepError(f"{'resume' if resume else 'overwrite'}: given, accepted: only with out")
    if out is not None:
        if not isinstance(out, str | PathLike):
            raise SweepError(f"out: {out!r}, accepted: the path of a store, which ends in .zarr")
        return _into_store(batch, how, Path(out), progress, resume=resume, overwrite=overwrite)
    if len(batch) > MOST_IN_MEMORY:
        raise SweepError(
            f"vary: {len(batch):g} tosses, accepted: at most {MOST_IN_MEMORY:g} in memory; out = NAME.zarr "
            "takes more"
        )
    check(batch, how)
    columns = {name: COLUMNS[name] for name in how.names}
    answers = gathered(batch, how, columns, f"tossing by {how.engine}", shown=progress)
    return dataset_of(batch, how, answers)


def _into_store(
    batch: Batch, how: How, path: Path, progress: bool | None, *, resume: bool, overwrite: bool
) -> xr.Dataset:
    """Toss a batch into a store, and return its dataset; the arguments are those of `toss_many`."""
    from cointoss.compare.sweep import store
    from cointoss.compare.sweep.layout import layout_of

    if how.law is not None:
        raise UnsupportedError("law: given, accepted: none in a store, whose scenario would not name it")
    if not batch.sizes:
        raise SweepError("vary: nothing varies, accepted: one field or more for a store")
    store.require_place(path, resume=resume, overwrite=overwrite)
    check(batch, how)
    with store.opened(path, layout_of(batch, how), overwrite=overwrite) as kept:
        try:
            store.fill(kept, partial(pieces, batch, how), shown=progress)
        except KeyboardInterrupt:
            left = sum(kept.missing(tile).size for tile in kept.tiles)
            warn_of_interruption(len(batch) - left, len(batch))
    return xr.open_zarr(path, chunks=None).assign_attrs(how.processor.attributes)
