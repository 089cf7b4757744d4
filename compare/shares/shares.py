"""Count the shares of outcomes along fields of a scenario, from Python."""

import json
from collections.abc import Mapping
from dataclasses import asdict
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from cointoss.compare.engines import Engine
from cointoss.compare.shares.counting import Counts, counting
from cointoss.compare.shares.plan import Plan, check, plan_of
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.devices import Device
from cointoss.models.hand import Hand, load_hand
from cointoss.models.processor import Processor
from cointoss.models.reading import ScenarioSource, scenario_of
from cointoss.models.records import Outcome
from cointoss.models.scenario import Scenario

if TYPE_CHECKING:
    import xarray as xr

BOTH = "both"


def shares(
    scenario: ScenarioSource,
    vary: Mapping[str, Any] | None = None,
    *,
    hand: Hand | str | PathLike[str] | None = None,
    engine: Engine | str = "analytic",
    tosses: int | None = None,
    to: float | None = None,
    seed: int = 0,
    device: Device | str = Device.CPU,
) -> "xr.Dataset":
    """Toss a coin by hand many times for each value of a field, and return how often it ends in each way.

        ds = cointoss.shares("zloty", {"restitution": "0.2:0.8:7"}, hand=Hand(speed=3.0), to=0.01)
        ds.share.sel(outcome="edge"), ds.cointoss.table(), ds.cointoss.plot()

    The numbers are the same on any number of cores. An interrupt (Ctrl-C) returns the counts so far,
    if there are any; then the attribute `complete` is false.

    Args:
        scenario: a `Scenario`, the path of its file, or the name of one that comes with the package; its own
            release is not used.
        vary: up to two fields of the scenario, or of the hand, such as "hand.height", and for each a range
            START:STOP:N, as text, which may carry units, or as (START, STOP, N); both ends are included.
        hand: that releases the coin, or the path of its file; by default `Hand.people()`.
        engine: "analytic", "mujoco", or "both"; each engine has releases of its own.
        tosses: the tosses of each setting, by default 1000; with `to` the most tosses, by default ten
            million.
        to: counting of a setting stops when half the width of its widest 99 % interval is at most this, such
            as 0.005.
        seed: for the releases.
        device: "cpu", "cuda" or "auto", as in `toss_many`.

    Returns:
        `count` and `share`, with the ends `low` and `high` of its 99 % interval (Wilson), over the fields
        that vary and `outcome`, and with both engines over `engine`; and `not_caught`, how many coins the
        hand was to catch and did not, which count in no share.

    Raises:
        ScenarioError: naming file, field, value and what is accepted.
        ValueError: naming the argument, its value and what is accepted.
        UnsupportedError: for a scenario that the engine can't toss, or not on that device.
        DeviceError: for the device "cuda" where no card can be used, and where one fails.
    """
    if not (hand is None or isinstance(hand, Hand | str | PathLike)):
        raise SweepError(f"hand: {hand!r}, accepted: a Hand, or the path of its file")
    if engine not in (*Engine, BOTH):
        raise SweepError(f"engine: {engine!r}, accepted: {', '.join([*Engine, BOTH])}")
    plan = plan_of(
        {} if vary is None else vary,
        scenario_of(scenario),
        name="" if isinstance(scenario, Scenario) else Path(scenario).stem,
        hand=hand if isinstance(hand, Hand) else Hand.people() if hand is None else load_hand(hand),
        engines=tuple(Engine) if engine == BOTH else (Engine(engine),),
        seed=seed,
        tosses=tosses,
        to=to,
        processor=Processor(device),
    )
    check(plan)
    counts, is_complete = no_counts(plan), False
    try:
        for so_far in counting(plan):
            counts = so_far
        is_complete = True
    except KeyboardInterrupt:
        if not counts.any():
            raise
    return dataset_of(plan, counts, is_complete=is_complete)


def no_counts(plan: Plan) -> Counts:
    """Return the counts of a plan before its first toss, (engines, values of each field, 6)."""
    return np.zeros((len(plan.engines), *plan.shape, len(Outcome)), dtype=np.int64)


def dataset_of(plan: Plan, counts: Counts, *, is_complete: bool = True) -> "xr.Dataset":
    """Return the dataset of `shares`.

    Args:
        plan: what was counted.
        counts: of all tosses, (engines, values of each field, 6).
        is_complete: whether nothing is left to count.
    """
    from cointoss.compare.shares.show import shares_of

    coordinates: dict[str, Any] = {
        "engine": [engine.value for engine in plan.engines],
        "outcome": list(Outcome.by_value().values()),
        **{
            axis.field: (axis.field, axis.values, {"long_name": axis.word, "units": axis.unit})
            for axis in plan.vary
        },
    }
    about = {
        "scenario": plan.scenario.to_toml(),
        "name": plan.name,
        "hand": json.dumps(asdict(plan.hand)),
        "seed": plan.seed,
        "complete": int(is_complete),
        **plan.processor.attributes,
    }
    dims = ("engine", *(axis.field for axis in plan.vary), "outcome")
    told = plan.counted(counts)
    found = shares_of(told, dims, coordinates, about)
    missed = "number of coins that the hand did not catch"
    found["not_caught"] = (dims[:-1], (counts - told).sum(axis=-1), {"long_name": missed})
    return found if len(plan.engines) > 1 else found.squeeze("engine")
