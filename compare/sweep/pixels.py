"""What is known of some pixels of a map: their tosses, and their margins."""

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.sweep import pieces
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.grid import Sweep
from cointoss.compare.sweep.layers import layers_of
from cointoss.compare.sweep.pieces import Columns
from cointoss.models.answers import Answers
from cointoss.models.errors import ScenarioError
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario


def pixels_of(sweep: Sweep, numbers: NDArray[np.intp], answers: Answers) -> Columns:
    """Return what a map keeps of some pixels, (n,) each.

    Args:
        sweep: of the map.
        numbers: of the pixels, row by row.
        answers: of their tosses.
    """
    found: Columns = {"outcome": shown(sweep, answers)}
    for name in layers_of(sweep).keys() - found:
        found[name] = _margins(sweep, numbers) if name == "margin" else getattr(answers, name)
    return found


def shown(sweep: Sweep, answers: Answers) -> NDArray[np.int8]:
    """Return the outcomes, or the faces at a touch, that the map shows."""
    return answers.outcome if sweep.after is None else answers.after(sweep.after)


def _margins(sweep: Sweep, numbers: NDArray[np.intp]) -> Array:
    from cointoss.compare.metrics.margin import MANY, smallest_changes

    def outcomes(rows: Array) -> NDArray[np.int8]:
        how = sweep.how
        return shown(sweep, how.engine.package.toss_rows(rows, settings=how.settings, device=how.processor))

    quantity = sweep.quantity
    return quantity.factor * smallest_changes(
        sweep.batch.rows(numbers), quantity, outcomes=outcomes, search=MANY
    )


def pixel_scenario(sweep: Sweep, y: float, x: float) -> Scenario:
    """Return the scenario of the toss at a point of the map.

    Raises:
        ScenarioError: for values that make no valid scenario, naming them.
    """
    given = ((sweep.y.field, y), (sweep.x.field, x))
    # A number of impacts is whole on every axis.
    first, second = ((field, int(at) if field == "ending.max_impacts" else at) for field, at in given)
    return sweep.batch.scenario.replace(*first, *second)


def check(sweep: Sweep) -> None:
    """Refuse a sweep with a pixel that is no scenario, or that its engine can't toss.

    Raises:
        SweepError: naming field, value, and what is accepted.
        UnsupportedError: for what the engine can't toss.

    Warns:
        UnusedFieldWarning: for a field that nothing uses.
    """
    try:
        pieces.require_scenarios(sweep.batch)
    except ScenarioError as error:
        raise SweepError(str(error)) from None
    pieces.require_supported(sweep.batch, sweep.how)
