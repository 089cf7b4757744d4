"""Many tosses: how far each can be trusted, how each ends, and what an interruption leaves."""

import signal
import threading
import time

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic import many
from cointoss.analytic.entries import certainty_of
from cointoss.analytic.runs import horizon_of, run
from cointoss.analytic.toss import state_at_release
from cointoss.models.answers import ANSWER, NOT_TOSSED, Answers
from cointoss.models.batch import rows_from_states, rows_of
from cointoss.models.errors import ScenarioError
from cointoss.models.hand import Hand
from cointoss.models.parts import Release
from cointoss.models.records import Ending, Face, Outcome
from cointoss.models.scenario import MOST_KEPT
from tests.helpers.draws import AIR, PAPER_OFFSET, ZLOTY, scenario
from tests.helpers.many import draw_states

pytestmark = pytest.mark.usefixtures("without_horizon")


@pytest.mark.slow_after_first
@pytest.mark.parametrize("air", [{}, AIR])
@pytest.mark.parametrize("contact", ["smooth", "coulomb"])
def test_many_tosses_tell_how_far_each_can_be_trusted(air, contact):
    """As the horizon of one toss does; and that changes no toss."""
    floor = {"restitution": 0.5, "contact": contact, "friction": 0.3 * (contact == "coulomb")}
    case = scenario(coin={**ZLOTY, "center_of_mass": PAPER_OFFSET}, air=air, floor=floor)
    drawn, states = draw_states(np.random.default_rng(4), 12)
    rows = rows_from_states(case, states)
    plain, trusting = analytic.toss_rows(rows), analytic.toss_rows(rows, trust="impacts")
    certain = analytic.toss_rows(rows, trust="certain")
    assert plain.trusted_impacts is plain.outcome_certain is trusting.outcome_certain is None
    assert trusting.trusted_impacts is not None
    starts = [state_at_release(Release.model_validate(release)) for release in drawn]
    logs = [run(case.body, case.rules, start, analytic.MANY) for start in starts]
    horizons = [horizon_of(case.body, case.rules, log) for log in logs]
    trusted = [horizon.impacts for horizon in horizons]
    assert trusting.trusted_impacts.tolist() == trusted
    assert max(trusted) > min(trusted) > 0
    in_turn = [
        certainty_of(case.body, case.rules, log.rows, log.started, log.verdict, horizon).certain
        for log, horizon in zip(logs, horizons, strict=True)
    ]
    assert certain.outcome_certain is not None
    assert certain.trusted_impacts is not None
    assert certain.outcome_certain.tolist() == in_turn
    assert 0 < sum(in_turn)
    assert np.array_equal(certain.trusted_impacts, trusting.trusted_impacts)
    for name in ("outcome", "ending", "impacts", "last_face", "end_time"):
        assert np.array_equal(getattr(plain, name), getattr(trusting, name))
        assert np.array_equal(getattr(plain, name), getattr(certain, name))


def test_where_trust_is_asked_for_no_more_impacts_are_accepted_than_are_kept():
    rows = rows_of(scenario(), 3, {"ending.max_impacts": [5, MOST_KEPT + 1, np.nan]})
    with pytest.raises(ScenarioError, match=rf"ending\.max_impacts = {MOST_KEPT + 1}: accepted: "):
        analytic.toss_rows(rows, trust="impacts")
    assert analytic.toss_rows(rows).impacts[0] == 5


@pytest.mark.slow
def test_a_touch_without_solution_is_no_impact_and_shows_no_face():
    floor = {"restitution": 0.8, "contact": "sliding_friction", "friction": 1.5}
    case = scenario(floor=floor, ending={"max_impacts": 40}, air=AIR)
    drawn, states = draw_states(np.random.default_rng(7), 40)
    outcomes = analytic.toss_rows(rows_from_states(case, states))
    turned = 0
    for i in np.flatnonzero((outcomes.ending == Ending.NO_SOLUTION) & (outcomes.impacts > 0)):
        tossed = analytic.toss(case.replace("release", drawn[i]))
        assert outcomes.last_face[i] == tossed.impacts.face[-1]
        face_at_end = Face.HEADS if tossed.sample(tossed.end_time).normal[0, 2] > 0 else Face.TAILS
        turned += outcomes.last_face[i] != face_at_end
    assert turned > 0, "some coin should turn over before the touch without solution"


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
