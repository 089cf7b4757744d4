"""`cointoss hands`: where a smooth floor explains the side at rest; a transcript has the rest."""

import pytest

from cointoss.compare.output.hand_lines import WHY, hand_lines
from cointoss.models.hand import Hand
from cointoss.models.reading import load


@pytest.mark.parametrize(
    ("hand", "changes"),
    [
        (Hand.people(), {"floor.contact": "perfectly_rough"}),
        (Hand.people(), {"floor.slope": 0.1}),
        (Hand.people(), {"floor.pivoting_friction": 1e-4}),
        (Hand.people(), {"coin.center_of_mass": (1e-4, 0, 0)}),
        (Hand.people(), {"ending.caught": 1.0}),
        (Hand(), {}),
    ],
    ids=["rough", "slope", "pivoting", "offset", "caught", "no wobble"],
)
def test_a_smooth_floor_explains_the_side_at_rest_only_where_it_keeps_the_momenta(hand, changes):
    coin = load("fig29")
    assert hand_lines(Hand.people(), coin, "analytic", 0)[1][: len(WHY)] == WHY
    for field, value in changes.items():
        coin = coin.replace(field, value)
    assert WHY[0] not in hand_lines(hand, coin, "analytic", 0)[1]
