"""Many tosses: how far each can be trusted, how each ends, and what an interruption leaves."""

import signal
import threading
import time

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic import many
from cointoss.models.answers import ANSWER, NOT_TOSSED, Answers
from cointoss.models.batch import rows_from_states, rows_of
from cointoss.models.errors import ScenarioError
from cointoss.models.hand import Hand
from cointoss.models.records import Outcome
from cointoss.models.scenario import MOST_KEPT
from tests.helpers.draws import AIR, ZLOTY, scenario
from tests.helpers.many import draw_states

pytestmark = pytest.mark.usefixtures("without_horizon")


def test_where_trust_is_asked_for_no_more_impacts_are_accepted_than_are_kept():
    rows = rows_of(scenario(), 3, {"ending.max_impacts": [5, MOST_KEPT + 1, np.nan]})
    with pytest.raises(ScenarioError, match=rf"ending\.max_impacts = {MOST_KEPT + 1}: accepted: "):
        analytic.toss_rows(rows, trust="impacts")
    assert analytic.toss_rows(rows).impacts[0] == 5


def test_the_face_after_impacts_is_the_face_of_that_touch_or_the_final_face():
    drawn, states = draw_states(np.random.default_rng(4), 60)
    whole = scenario(floor={"restitution": 0.4}, air=AIR)
    stopped = 0
    for after in (0, 1, 12):
        case = scenario(floor={"restitution": 0.4}, air=AIR, ending={"max_impacts": after + 1})
        faces = analytic.toss_rows(rows_from_states(case, states)).after(after)
        for face, release in zip(faces, drawn, strict=True):
            tossed = analytic.toss(whole.replace("release", release))
            there = len(tossed.impacts) > after
            stopped += not there
            assert face == (tossed.impacts.face[after] if there else tossed.outcome)
    assert 0 < stopped < 60, "some of the tosses should end before their last touch"
    with pytest.raises(ValueError, match=r"set ending\.max_impacts = 1"):
        analytic.toss_rows(rows_from_states(whole, states)).after(0)


def test_what_an_interruption_leaves_undone_is_not_tossed(monkeypatch):
    """Ctrl-C after the first of four tiles."""
    rows = rows_from_states(scenario(air=AIR), draw_states(np.random.default_rng(5), 400)[1])
    toss_some = many.toss_some

    def interrupting(*arguments):
        toss_some(*arguments)
        signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGINT)
        time.sleep(0.5)

    monkeypatch.setattr(many, "toss_some", interrupting)
    monkeypatch.setattr(many, "TILE", 100)
    table = np.empty((len(rows), len(ANSWER)))
    with pytest.raises(KeyboardInterrupt):
        analytic.toss_rows(rows, workers=1, answers=table)
    monkeypatch.undo()
    made = Answers.of_table(table)
    assert (made.outcome[100:] == NOT_TOSSED).all()
    assert np.array_equal(made.end_time[:100], analytic.toss_rows(rows[:100]).end_time)


@pytest.mark.parametrize("chi", [0.0, 0.6])
def test_a_square_section_that_turns_in_its_plane_ends_on_its_edge_as_often_as_on_a_face(chi):
    """Half a toss each: its four sides are alike, and no roll brings it out of the plane."""
    thick = {**ZLOTY, "thickness": 2 * ZLOTY["radius"]}
    case = scenario(coin=thick, floor={"contact": "coulomb", "friction": 0.3, "restitution": chi})
    count = 600
    ended = analytic.toss_rows(rows_of(case, count, Hand().releases(case, count, seed=17)))
    assert set(ended.outcome) == {Outcome.HEADS, Outcome.TAILS, Outcome.EDGE}
    # Four standard deviations of a fair draw.
    assert abs(np.mean(ended.outcome == Outcome.EDGE) - 1 / 2) < 2 / count**0.5
