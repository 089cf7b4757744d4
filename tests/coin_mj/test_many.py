"""Many tosses in MuJoCo: each is that of `toss` by every setting, and what is refused."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from cointoss import coin_mj
from cointoss.coin_mj import MANY, Friction, Realisation
from cointoss.models.batch import rows_from_states, rows_of
from cointoss.models.laws import ContactLaw
from cointoss.models.records import ApproximationWarning, Ending, UnsupportedError
from tests.helpers.draws import AIR, PAPER_OFFSET, ZLOTY, scenario
from tests.helpers.many import assert_same_toss, draw_states


@pytest.mark.slow_after_first
@pytest.mark.parametrize("law", ["smooth", "coulomb", "perfectly_rough"])
@pytest.mark.parametrize("realisation", list(Realisation))
@pytest.mark.parametrize("friction", list(Friction))
@pytest.mark.usefixtures("without_horizon")
@pytest.mark.filterwarnings("ignore::cointoss.models.records.ApproximationWarning")
def test_each_toss_is_that_of_toss_to_the_bit_by_every_setting(law, realisation, friction):
    """With and without air, thin and thick; whole tosses, contacts and all."""
    settings = replace(MANY, contact=realisation, friction=friction)
    for thickness, air in product((0.0, 2e-3), ({}, AIR)):
        case = scenario(
            coin={**ZLOTY, "thickness": thickness, "center_of_mass": [*PAPER_OFFSET[:2], -thickness / 10]},
            air=air,
            floor={"restitution": 0.5, "contact": law, "friction": 0.3},
            ending={"max_impacts": 30, "max_time": 2.0},
        )
        drawn, states = draw_states(np.random.default_rng([len(law), len(air), int(1e4 * thickness)]), 4)
        answers = coin_mj.toss_rows(rows_from_states(case, states), settings=settings)
        for i, release in enumerate(drawn):
            tossed = coin_mj.toss(case.replace("release", release), settings=settings)
            assert_same_toss(answers, i, tossed)


def test_what_toss_refuses_is_refused_and_what_it_warns_of_is_warned_of():
    laws = [ContactLaw.SMOOTH, ContactLaw.KNURLED]
    with pytest.raises(UnsupportedError, match=r"floor\.contact = "):
        coin_mj.toss_rows(rows_of(scenario(), 2, {"floor.contact": laws}))
    for trust in ("impacts", "certain"):
        with pytest.raises(UnsupportedError, match=rf'^trust = "{trust}": accepted by the MuJoCo engine'):
            coin_mj.toss_rows(rows_of(scenario(), 1), trust=trust)
    rough = scenario(floor={"contact": "perfectly_rough"}, ending={"max_impacts": 1})
    with pytest.warns(ApproximationWarning, match="friction 100"):
        answers = coin_mj.toss_rows(rows_of(rough, 1))
    assert answers.ending.tolist() == [Ending.MAX_IMPACTS]
