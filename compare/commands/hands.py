"""`cointoss hands`: a coin tossed many times as a hand does."""

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Annotated, Any, Literal

import click

from cointoss.compare.commands.common import SCENARIO_HELP, print_json
from cointoss.compare.commands.hand_options import ByHand, chosen_hand
from cointoss.compare.commands.names import scenario_argument
from cointoss.compare.commands.options import options_of
from cointoss.compare.commands.settings import set_option, with_scenario
from cointoss.compare.output.accepted import Within
from cointoss.compare.sweep.asked import Source

if TYPE_CHECKING:
    from collections.abc import Iterator

    from cointoss.compare.shares.plan import Plan

BLOCK = {"analytic": 5000, "mujoco": 100}
"""Tosses that are counted together; an interruption tells those that are counted."""

Counts = dict[str, tuple[int, int]]
"""For each of what is counted, how often it was so, of how many tosses."""


@dataclass(frozen=True, kw_only=True)
class TossedCoins(ByHand):
    """How many coins are tossed, and how."""

    tosses: Annotated[int, Within(1, 10_000_000)] = 1000
    """Number of tosses."""
    engine: Literal["analytic", "mujoco"] = "analytic"
    """Engine that computes the tosses."""
    json: bool = False
    """Print JSON, in full precision."""


@click.command(epilog=SCENARIO_HELP)
@scenario_argument
@set_option
@options_of(TossedCoins)
@with_scenario
def hands(source: Source, asked: TossedCoins) -> None:
    """Toss a scenario's coin many times as a hand does, and count how often its first side is up again.

    The first side is the one that is up at the release. The command counts how often this side is up at each
    of the first four touches of the floor and at rest, or in the hand that catches the coin. The coin is
    released flat; the scenario's own release is not used. With --spun it is released on its edge, and the
    command counts the outcomes. Intervals are of 99 %. Ctrl-C prints the counts so far.
    """
    from cointoss.compare.engines import Engine
    from cointoss.compare.film.back_end import require_mujoco
    from cointoss.compare.output.hand_lines import hand_lines
    from cointoss.compare.output.interruption import saying
    from cointoss.compare.shares.plan import Plan, check

    hand, coin = chosen_hand(asked, source.scenario)
    engine, seed = asked.engine, asked.seed
    require_mujoco(engine)
    plan = Plan(scenario=coin, name="", hand=hand, engines=(Engine(engine),), seed=seed, tosses=asked.tosses)
    check(plan)
    counted, counts = 0, Counts()
    told = {"hand": asdict(hand), "caught": coin.ending.caught, "seed": seed, "engine": engine}
    try:
        with saying(lambda said: f"{said}: {counted:,d} tosses are counted"):
            for so_far in (spins if hand.spun else first_sides)(plan):
                counted, counts = so_far
    finally:
        if counted:
            _answer(counted, counts, told, None if asked.json else hand_lines(hand, coin, engine, seed))


def spins(plan: "Plan") -> "Iterator[tuple[int, Counts]]":
    """Yield how many coins were spun so far, and how many ended with each outcome."""
    from cointoss.compare.shares.counting import counting
    from cointoss.models.records import Outcome

    for (counts,) in counting(plan):
        tosses = int(counts.sum())
        yield tosses, {str(one): (int(counts[one]), tosses) for one in Outcome if counts[one]}


def first_sides(plan: "Plan") -> "Iterator[tuple[int, Counts]]":
    """Yield how many coins were tossed so far, and how often the side that was up at first is up later."""
    import numpy as np

    from cointoss.compare.metrics.first_side import TOUCHES, caught_side, first_side
    from cointoss.compare.shares.plan import rows_of_releases
    from cointoss.models.stages import stage

    (engine,), setting, counts = plan.engines, plan.setting(0), Counts()
    states = setting.states(np.random.default_rng(plan.seed), plan.tosses)

    def found() -> str:
        return ", ".join(f"{name} {met / max(of, 1):.1%}" for name, (met, of) in counts.items())

    with stage("tossing by hand", "tosses", total=plan.tosses, detail=found) as progress:
        for first in range(0, plan.tosses, BLOCK[engine.value]):
            block = rows_of_releases(setting, states[first : first + BLOCK[engine.value]])
            if plan.catches:
                sides = {"caught": caught_side(block, engine)}
            else:
                seen = first_side(block, engine)
                touches = {f"touch {n + 1}": up for n, up in zip(TOUCHES, seen.touches, strict=True)}
                sides = {**touches, "at rest": seen.at_rest}
            for name, up in sides.items():
                met, of = counts.get(name, (0, 0))
                counts[name] = met + int(up.sum()), of + len(up)
            yield first + len(block), dict(counts)
            progress(first + len(block), plan.tosses)


def _answer(
    counted: int, counts: Counts, told: dict[str, Any], lines: tuple[str, tuple[str, ...]] | None
) -> None:
    """Print what is counted; as JSON where there are no lines for a person, above the counts and below."""
    from cointoss.compare.metrics.estimates import share_of
    from cointoss.compare.output.hand_lines import uncaught

    shares = {name: share_of(met, of) for name, (met, of) in counts.items() if of}
    not_caught = counted - counts["caught"][1] if "caught" in counts else 0
    if lines is None:
        told |= {"tosses": counted, "not_caught": not_caught}
        kind = "ended" if told["hand"]["spun"] else "same_side"
        print_json({**told, kind: {k: asdict(v) for k, v in shares.items()}}, told["engine"])
        return
    not_flat = counted - counts["at rest"][1] if "at rest" in counts else 0
    told_shares = (
        f"{name:9} {one.value:7.2%} [{one.low:.2%}, {one.high:.2%}] of {one.count:,d} tosses"
        for name, one in shares.items()
    )
    left_out = [f"left out  {uncaught(not_caught)}"] if not_caught else []
    if not_flat:
        left_out.append(f"left out  at rest: {not_flat:,d} coin{'s' * (not_flat != 1)} that ended on no face")
    click.echo("\n".join([lines[0], *told_shares, *left_out, "", *lines[1]]))
