"""The record of shares: its table, CSV, JSON, dataset and pictures say the same."""

import csv
import io
import json

import numpy as np
import pytest
from matplotlib.figure import Figure

from cointoss.compare.engines import Engine
from cointoss.compare.metrics.estimates import chance_alike, share_of
from cointoss.compare.shares.picture import picture_of, require_drawable
from cointoss.compare.shares.plan import plan_of
from cointoss.compare.shares.record import Shares
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.hand import Hand
from cointoss.models.reading import load
from cointoss.models.records import Outcome

AXES = ("floor.restitution=0.2:0.6:2", "coin.thickness=1 mm:3 mm:3")


def made(*axes, engines=(Engine.ANALYTIC,)):
    plan = plan_of(axes, load("zloty"), name="zloty", hand=Hand(), engines=engines)
    counts = np.random.default_rng(3).multinomial(
        1000, [0, 0.45, 0.4, 0.15, 0, 0], (len(engines), *plan.shape)
    )
    return Shares(plan=plan, counts=counts)


def test_the_table_has_a_row_for_each_setting_with_intervals():
    found = made(*AXES)
    head, _, *rows = found.table().splitlines()
    assert head == "| restitution χ | thickness [m] | tosses | heads | tails | edge |"
    assert len(rows) == 6
    part = share_of(int(found.counts[0, 1, 2, Outcome.HEADS]), 1000)
    assert rows[-1].startswith(f"| 0.6 | 0.003 | 1,000 | {100 * part.value:.1f} % [{100 * part.low:.1f}, ")


def test_both_engines_stand_beside_each_other_with_the_chance_of_their_difference():
    found = made(AXES[0], engines=tuple(Engine))
    assert found.alike == [chance_alike(found.counts[:, i]) for i in range(2)]
    assert found.least_alike == pytest.approx(1 - (1 - min(found.alike)) ** 2)
    rows = [line.split(" | ") for line in found.table().splitlines()[2:]]
    assert [row[1] for row in rows] == ["analytic", "mujoco"] * 2
    assert float(rows[3][-1].rstrip(" |")) == pytest.approx(found.alike[1], rel=0.01)
    assert made(AXES[0]).alike == []


def test_the_dataset_the_csv_and_the_json_say_the_same():
    found = made(*AXES)
    data = found.to_xarray()
    assert dict(data.sizes) == {"engine": 1, "floor.restitution": 2, "coin.thickness": 3, "outcome": 6}
    assert data["coin.thickness"].attrs["units"] == "m"
    at = {"engine": "analytic", "floor.restitution": 0.6, "outcome": "edge"}
    edge = data.sel(at).isel({"coin.thickness": 1})
    rows = list(csv.DictReader(io.StringIO(found.to_csv())))
    told = json.loads(json.dumps(found.as_json()))["settings"][4]
    for name, key in (("share", "value"), ("low", "low"), ("high", "high")):
        column = "edge" if name == "share" else f"edge {name}"
        assert float(edge[name]) == float(rows[4][column]) == told["shares"]["edge"][key]
    assert int(edge["count"]) == int(rows[4]["edge count"])
    assert float(rows[4]["coin.thickness [m]"]) == told["coin.thickness"]
    frame = found.to_dataframe()
    assert len(frame) == 36
    assert repr(found).startswith(
        "<Shares zloty: 2 values of floor.restitution by 3 values of coin.thickness, 6,000"
    )


def test_no_share_of_the_dataset_is_of_coins_that_are_not_caught():
    plan = plan_of((), load("zloty"), name="zloty", hand=Hand(caught=1.0))
    found = Shares(plan=plan, counts=np.array([[60, 30, 10, 0, 0, 0]]))
    (row,) = found.rows
    share = found.to_xarray().share.sel(engine="analytic")
    assert share.sel(outcome="heads") == row.shares[Outcome.HEADS].value == 0.75
    assert share.sel(outcome="undecided") == 0
    assert found.not_caught == 60


def test_a_picture_has_a_panel_for_each_value_of_the_second_field():
    axes = Figure().subplots()
    assert made(AXES[0]).plot(axes) is axes
    assert axes.get_legend_handles_labels()[1] == ["heads", "tails", "edge"]
    with pytest.raises(ValueError, match=r"^ax: one Axes, accepted: None"):
        made(*AXES).plot(axes)
    for found in (made(), made(AXES[0]), made(*AXES, engines=tuple(Engine))):
        assert picture_of(found, ".png").startswith(b"\x89PNG")
        assert picture_of(found, ".svg") == picture_of(found, ".svg")
    require_drawable((2, 30))
    with pytest.raises(SweepError, match="31 values of the second field; accepted: at most 30"):
        require_drawable((2, 31))


def test_counts_of_another_shape_are_refused():
    with pytest.raises(ValueError, match=r"^Shares.counts: shape \(1, 2\), expected \(1, 2, 3, 6\)$"):
        Shares(plan=made(*AXES).plan, counts=np.zeros((1, 2), dtype=np.int64))
