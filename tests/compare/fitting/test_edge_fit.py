"""A field fitted to counts of edges: closed forms, and a restitution that is found again."""

import json
import math

import numpy as np
import pytest
import xarray as xr
from scipy.optimize import brentq
from scipy.stats import binom, chi2

from cointoss import EdgeFit, Edges, Hand, fit, shares
from cointoss.compare.fitting import edge_fit
from cointoss.compare.fitting.edge_answer import as_lines
from cointoss.compare.fitting.errors import ObservationError
from cointoss.compare.fitting.table import read_seen
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.scenario import Scenario
from cointoss.models.unlikely import UnitWarning
from tests.helpers.command_line import cointoss

COIN = Scenario(
    coin={"mass": 0.005, "radius": 0.0106, "thickness": 0.002},
    floor={"restitution": 0.3, "contact": "smooth"},
    release={"position": [0, 0, 1]},
)
SPAN = {"restitution": (0.1, 0.5)}


def counting(perpetual=0.0):
    """Coins whose share of the edge is 40 times the thickness less the restitution; some go on for ever."""

    def counted(coin, ranges, tosses, **_):
        ((field, (start, stop, count)),) = ranges.items()
        values = np.linspace(start, stop, count)
        edge = np.round(tosses * (40 * coin.coin.thickness - values))
        forever = np.full(count, tosses * perpetual)
        counts = np.stack([tosses - edge, np.zeros(count), edge, forever], axis=-1)
        return xr.Dataset(
            {"count": ((field, "outcome"), counts)},
            {field: values, "outcome": ["heads", "tails", "edge", "perpetual"]},
            {"complete": 1},
        )

    return counted


@pytest.fixture
def linear(monkeypatch):
    monkeypatch.setattr(edge_fit, "shares", counting())


@pytest.mark.usefixtures("linear")
def test_the_restitution_of_one_thickness_is_that_of_its_share():
    """The ends are where twice the log-likelihood of the binomial counts has fallen by χ²."""
    found = fit(Edges(thickness=[0.02], edge=[500], tosses=[1000]), COIN, SPAN, tosses=10**7)

    def above(p):
        return binom.logpmf(500, 1000, p) - binom.logpmf(500, 1000, 0.5) + chi2.ppf(0.99, 1) / 2

    high, low = (brentq(above, *ends) for ends in ((0.3, 0.5), (0.5, 0.7)))
    assert 0.8 - np.array(found.value.ends) == pytest.approx([0.5, low, high], abs=1e-4)
    assert found.scenario.floor.restitution == found.value.value
    assert math.isnan(found.p_value)
    assert "nothing is left" in found.verdict


@pytest.mark.usefixtures("linear")
def test_shares_that_no_value_explains_are_refused():
    thick = [0.015, 0.02]
    good = fit(Edges(thickness=thick, edge=[310, 490], tosses=[1000, 1000]), COIN, SPAN, tosses=10**7)
    assert good.value.value == pytest.approx(0.3, abs=0.01)
    assert good.chi_square == pytest.approx(1e5 / 1000 / 0.21 / 1000 + 0.4, abs=0.4)
    assert good.is_possible
    bad = fit(Edges(thickness=thick, edge=[490, 310], tosses=[1000, 1000]), COIN, SPAN, tosses=10**7)
    assert not bad.is_possible
    assert math.isnan(bad.value.low)


def test_thicknesses_in_a_wrong_unit_are_questioned():
    wrong = Edges(thickness=[2.0, 5.0], edge=[10, 20], tosses=[100, 100])
    named = r'"thickness \(mm\)"'
    with pytest.warns(UnitWarning, match=named), pytest.raises(ObservationError, match=f"2 m: .*{named}"):
        fit(wrong, COIN.replace("release.position.z", 0.1), SPAN)


@pytest.mark.usefixtures("linear")
def test_few_simulated_tosses_widen_the_interval():
    edges = Edges(thickness=[0.02], edge=[500], tosses=[1000])
    wide, narrow = (fit(edges, COIN, SPAN, tosses=tosses).value for tosses in (300, 10**7))
    assert wide.high - wide.low > 1.5 * (narrow.high - narrow.low)


def test_tosses_that_end_neither_way_are_left_out_and_told(monkeypatch):
    edges = Edges(thickness=[0.02], edge=[500], tosses=[1000])
    monkeypatch.setattr(edge_fit, "shares", counting(perpetual=0.25))
    found = fit(edges, COIN, SPAN, tosses=10**7)
    assert found.value.value == pytest.approx(0.3, abs=1e-4)
    assert found.as_dict()["left_out"] == pytest.approx(0.2)
    assert "left out    20 % of the tosses" in as_lines(found)
    monkeypatch.setattr(edge_fit, "shares", lambda *_, **__: counting(1)(COIN, {"z": (0.8, 0.8, 9)}, 0))
    with pytest.raises(SweepError, match="of one value no toss ends on a face or the edge"):
        fit(edges, COIN, SPAN)


@pytest.mark.usefixtures("linear")
@pytest.mark.parametrize(
    ("span", "said"),
    [
        ((0.1, 0.5), ""),
        ((0.1, 0.31), "  cut at the end of its span"),
        ((0.35, 0.5), "  at the end of its span"),
    ],
)
def test_a_value_or_an_interval_at_the_end_of_its_span_is_marked(span, said):
    edges = Edges(thickness=[0.02], edge=[500], tosses=[1000])
    found = fit(edges, COIN, {"restitution": span}, tosses=10**7)
    assert as_lines(found).splitlines()[0].partition("]")[2] == said
    told = found.as_dict()["values"]["floor.restitution"]
    assert (told["at_end"], told["cut"]) == (said.startswith("  at"), bool(said))


def test_a_restitution_is_found_again():
    """From tosses of other seeds."""
    thick = (0.007, 0.014)
    made = [
        shares(
            COIN.replace("coin.thickness", h, "floor.restitution", 0.3),
            hand=Hand.people(up="either"),
            tosses=300,
            seed=9,
        )
        for h in thick
    ]
    edge = [int(one["count"].sel(outcome="edge")) for one in made]
    found = fit(Edges(thickness=thick, edge=edge, tosses=[300, 300]), COIN, SPAN, tosses=50)
    assert isinstance(found, EdgeFit)
    assert found.is_possible
    assert found.value.low < 0.3 < found.value.high


@pytest.mark.usefixtures("linear")
def test_the_command_reads_a_table_of_edges(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "coin.toml").write_text(COIN.to_toml(), encoding="utf-8")
    (tmp_path / "edges.csv").write_text("Thickness (mm);edge;N\n15;310;1000\n20;490;1000\n", encoding="utf-8")
    words = ["fit", "edges.csv", "coin.toml", "--vary", "restitution=0.1:0.5", "--out", "found.toml"]
    told = json.loads(cointoss(*words, "--json").stdout)
    value = told["values"]["floor.restitution"]["value"]
    assert value == pytest.approx(0.3, abs=0.01)
    answered = cointoss(*words)
    assert answered.exit_code == 0
    assert f"floor.restitution  {value:.4g}  99 % [" in answered.stdout
    assert "            20    1000  49.0 [" in answered.stdout


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("thickness (s),edge,n\n1,2,3\n", "column thickness: in s, accepted: a unit of length, such as m"),
        ("thickness,edge,n\n0.01,4,3\n", "row 1: 4 edges of 3 tosses at thickness 0.01 m; accepted: whole"),
        ("thickness,edge,n\n-1,1,3\n", "row 1: 1 edges of 3 tosses at thickness -1 m; accepted: whole"),
        ("thickness,edge,n\n0.01,x,3\n", "column edge: row 1 is 'x', accepted: a whole number from 0"),
        ("thickness,edge,n\n0.01,,3\n", "column edge: row 1 is '', accepted: a whole number from 0"),
        ("thickness;edge;n\n0,01;1;5,000\n", "column n: row 1 is '5.000', accepted: a whole number"),
        ("thickness,edge,n\n", "Edges: 0 thicknesses, accepted: from 1"),
        ("thickness (mm),edge\n6,3\n", "no column tosses; accepted: thickness, edge and tosses"),
        ("thickness (mm),N\n6,3\n", "no column edge; accepted: thickness, edge and tosses"),
        ("edge,n\n1,3\n", "column edge: accepted: thickness, edge and tosses, or none"),
    ],
)
def test_what_no_edges_are_is_refused(tmp_path, text, message):
    (tmp_path / "edges.csv").write_text(text, encoding="utf-8")
    with pytest.raises(ObservationError) as refused:
        read_seen(tmp_path / "edges.csv")
    assert message in str(refused.value)


def test_one_field_explains_edges():
    edges = Edges(thickness=[0.02], edge=[5], tosses=[10])
    for vary, message in (
        ({}, "vary: nothing, accepted: a dict"),
        (SPAN | {"friction": (0, 1)}, "vary: 2 fields; accepted: one"),
        ({"coin.thickness": (0.01, 0.02)}, "thickness"),
    ):
        with pytest.raises(SweepError, match=message):
            fit(edges, COIN, vary)
