"""Count the shares of outcomes along fields of a scenario, from Python."""

from os import PathLike
from pathlib import Path

import numpy as np

from cointoss.compare.engines import Engine
from cointoss.compare.shares.counting import counting
from cointoss.compare.shares.plan import check, most_tosses, plan_of
from cointoss.compare.shares.record import Shares
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.hand import Hand, load_hand
from cointoss.models.reading import ScenarioSource, scenario_of
from cointoss.models.records import Outcome
from cointoss.models.scenario import Scenario


def shares(
    scenario: ScenarioSource,
    *along: str,
    hand: Hand | str | PathLike[str] | None = None,
    engine: str = "analytic",
    compare: bool = False,
    tosses: int | None = None,
    to: float | None = None,
    seed: int = 0,
) -> Shares:
    """Toss a coin by hand many times for each value of a field, and return how often it ends how.

        shares("zloty", "floor.restitution=0.2:0.8:7", hand=Hand(speed=3.0), to=0.01).plot()

    The numbers are the same on any number of cores. An interrupt (Ctrl-C) returns what is counted, once
    there is something; `is_complete` tells.

    Args:
        scenario: a `Scenario`, the path of its file, or the name of one that comes with the package; its own
            release is not used.
        along: FIELD=START:STOP:N, such as "coin.thickness=1 mm:12 mm:12", of none, one or two fields of the
            scenario, or of the hand, such as "hand.height=0.2:2:10"; both ends are included.
        hand: that releases the coin, or the path of its file; by default `Hand.people()`.
        engine: "analytic" or "mujoco".
        compare: whether both engines toss, each its own releases.
        tosses: of each setting; with `to` at most, by default ten million, without it 1000.
        to: half the width of a setting's widest 99 % interval at which its counting stops, such as 0.005.
        seed: of the releases.

    Raises:
        ScenarioError: naming file, field, value and what is accepted.
        ValueError: naming the argument, its value and what is accepted.
        UnsupportedError: for a scenario that the engine can't toss.
    """
    if not isinstance(compare, bool):
        raise SweepError(f"compare: {compare!r}, accepted: True or False")
    if not (hand is None or isinstance(hand, Hand | str | PathLike)):
        raise SweepError(f"hand: {hand!r}, accepted: a Hand, or the path of its file")
    plan = plan_of(
        along,
        scenario_of(scenario),
        name="" if isinstance(scenario, Scenario) else Path(scenario).stem,
        hand=hand if isinstance(hand, Hand) else Hand.people() if hand is None else load_hand(hand),
        engines=tuple(Engine) if compare else (Engine(engine),),
        seed=seed,
        tosses=most_tosses(to) if tosses is None else tosses,
        to=to,
    )
    check(plan)
    counts = np.zeros((len(plan.engines), *plan.shape, len(Outcome)), dtype=np.int64)
    try:
        for so_far in counting(plan):
            counts = so_far
    except KeyboardInterrupt:
        if not counts.any():
            raise
    return Shares(plan=plan, counts=counts)
