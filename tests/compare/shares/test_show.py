"""The dataset of shares: its table, CSV, JSON and pictures say the same."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from cointoss.compare.engines import Engine
from cointoss.compare.metrics.estimates import chance_alike
from cointoss.compare.shares import show
from cointoss.compare.shares.picture import picture_of, plot_shares, require_drawable
from cointoss.compare.shares.plan import plan_of
from cointoss.compare.shares.shares import dataset_of
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.hand import Hand
from cointoss.models.reading import load

ONE = {"floor.restitution": "0.2:0.6:2"}
TWO = ONE | {"coin.thickness": "1 mm:3 mm:3"}


def made(vary, engines=(Engine.ANALYTIC,), hand=None, odds=(0, 0.45, 0.4, 0.15, 0, 0)):
    plan = plan_of(
        vary, load("zloty"), tosses=1000, to=None, name="zloty", hand=hand or Hand(), engines=engines
    )
    counts = np.random.default_rng(3).multinomial(1000, odds, (len(engines), *plan.shape))
    return dataset_of(plan, counts, is_complete=True)


def test_both_engines_stand_beside_each_other_with_the_chance_of_their_difference():
    found = made(ONE, engines=tuple(Engine))
    alike = show.alike(found)
    assert alike.tolist() == [chance_alike(found["count"].values[:, i]) for i in range(2)]
    assert show.least_alike(found) == pytest.approx(1 - (1 - min(alike)) ** 2)
    rows = [line.split(" | ") for line in show.markdown(found).splitlines()[2:]]
    assert [row[1] for row in rows] == ["analytic", "mujoco"] * 2
    assert float(rows[3][-1].rstrip(" |")) == pytest.approx(alike[1], rel=0.01)
    assert len(show.alike(made(ONE))) == 0


def test_no_share_is_of_coins_that_are_not_caught():
    found = made({}, hand=Hand(caught=1.0), odds=(0.5, 0.3, 0.2, 0, 0, 0))
    assert found["count"].sel(outcome="undecided") == found.share.sel(outcome="undecided") == 0
    assert (found.share.sum(), found.not_caught + found["count"].sum()) == (pytest.approx(1), 1000)
    assert show.as_json(found)["settings"][0]["not_caught"] == int(found.not_caught) > 400


@pytest.mark.slow
def test_a_picture_has_a_panel_for_each_value_of_the_second_field():
    axes = Figure().subplots()
    assert plot_shares(made(ONE), axes) is axes
    assert axes.get_legend_handles_labels()[1] == ["heads", "tails", "edge"]
    with pytest.raises(ValueError, match=r"^ax: one Axes, accepted: None"):
        plot_shares(made(TWO), axes)
    for found in (made({}), made(ONE), made(TWO, engines=tuple(Engine))):
        assert picture_of(found, ".png").startswith(b"\x89PNG")
        assert picture_of(found, ".svg") == picture_of(found, ".svg")
    require_drawable((2, 30))
    with pytest.raises(SweepError, match="31 values of the second field; accepted: at most 30"):
        require_drawable((2, 31))
