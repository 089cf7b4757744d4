"""Many tosses in MuJoCo: each is that of `toss` by every setting, and what is refused."""

import pytest

from cointoss import coin_mj
from cointoss.models.batch import rows_of
from cointoss.models.laws import ContactLaw
from cointoss.models.records import ApproximationWarning, Ending, UnsupportedError
from tests.helpers.draws import scenario


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
