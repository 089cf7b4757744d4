"""`cointoss conform`: an engine tested on the suite of cases with known answers."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import click

from cointoss.study import ChoiceType, Form, Within, Written, options_of, plain_errors, print_json
from cointoss_yardstick.suite.tables import case_names


@dataclass(frozen=True, kw_only=True)
class Suite:
    """What is run, and where it goes."""

    case: Annotated[tuple[str, ...], ChoiceType(case_names()), Form("CASE")] = ()
    """Run this case alone; may be given several times."""
    full: bool = False
    """Simulate an hour in place of a minute, and 10,000 tosses in place of 200."""
    time_limit: Annotated[int, Within(1, 86400)] = 60
    """The longest time for one answer of the engine, in seconds."""
    out: Annotated[Path | None, Written((".html",))] = None
    """Write the card to this .html file."""
    json: bool = False
    """Print JSON, in full precision."""


@click.command()
@click.argument("engine", metavar="ENGINE")
@options_of(Suite)
def conform(engine: str, asked: Suite) -> None:
    """Test an engine on cases with known answers, and print a card of its errors.

    ENGINE is analytic, mujoco, the name of an entry point cointoss.engines, or package.module:name of an
    object with a function simulate(scenario, times); "PYTHON -m package.module:name" is run by another
    Python, which needs NumPy alone. The exit status is 1 where a case is missed.
    """
    with plain_errors(engine):
        from cointoss.study import write_text
        from cointoss_yardstick.suite.conform import conform as tested

        card = tested(engine, cases=asked.case, full=asked.full, time_limit=asked.time_limit)
        if asked.out is not None:
            write_text(asked.out, card.page())
        if asked.json:
            print_json(card.as_json(), "analytic")
        else:
            click.echo(card.as_lines())
        if card.missed:
            raise SystemExit(1)
