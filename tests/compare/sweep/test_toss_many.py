"""The verb: each toss of a batch is that of `toss`, and its dataset says how each ended."""

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

import cointoss
from cointoss import SweepError, analytic, coin_mj, load, toss_many
from cointoss.compare.engines import Engine
from cointoss.compare.output.files import UnwritableError
from cointoss.compare.sweep.batch import batch_of
from cointoss.compare.sweep.layout import TILE_TOSSES
from cointoss.models.records import UnsupportedError
from cointoss.models.unlikely import UnitWarning
from cointoss.models.unused import UnusedFieldWarning
from tests.helpers.own_laws import smooth

CASE = load("fig24a").replace("ending.max_impacts", 8)
GRID = {"restitution": "0.3:0.9:3", "height": [0.2, 0.3, 0.4, 0.5]}


def singles(ds, engine=Engine.ANALYTIC):
    """Yield each toss of a dataset, at its place, as `toss` makes it with the settings for many."""
    for at in np.ndindex(ds.outcome.shape):
        here = ds[dict(zip(ds.outcome.dims, at, strict=True))]
        given = [part for name, one in here.coords.items() for part in (str(name), one.item())]
        case = ds.cointoss.scenario.replace(*given)
        yield here, engine.package.toss(case, settings=engine.package.MANY)


@pytest.mark.parametrize("engine", list(Engine))
def test_each_toss_is_that_of_toss(engine):
    ds = toss_many(CASE, GRID, engine=engine)
    assert ds.sizes == {"floor.restitution": 3, "toss": 4}
    for here, toss in singles(ds, engine):
        assert (here.outcome, here.ending) == (str(toss.outcome), str(toss.ending))
        assert (here.impacts, here.end_time) == (len(toss.impacts), toss.end_time)
        face = {1: "heads", 2: "tails"}[toss.impacts.face[-1]] if len(toss.impacts) else "none"
        assert here.last_face == face


def test_a_dataset_can_be_written_by_xarray_itself(tmp_path):
    ds = toss_many(CASE, {"floor.contact": ["smooth", "knurled"], "height": "0.3:0.4:2"}, trust="certain")
    assert ds["floor.contact"].values.tolist() == ["smooth", "knurled"]
    ds.to_zarr(tmp_path / "own.zarr", zarr_format=2)
    with xr.open_zarr(tmp_path / "own.zarr") as back:
        assert (back.outcome == ds.outcome).all()


def test_trust_is_that_of_toss_and_by_the_analytic_engine():
    plain, impacts, certain = (toss_many(CASE, GRID, trust=trust) for trust in (None, "impacts", "certain"))
    assert "trusted_impacts" not in plain
    assert "outcome_certain" not in impacts
    assert certain.outcome_certain.dtype == bool
    for here, toss in singles(certain):
        assert here.trusted_impacts == toss.trusted_impacts
        assert here.outcome_certain == toss.outcome_certain
    assert (impacts.trusted_impacts == certain.trusted_impacts).all()
    with pytest.raises(UnsupportedError, match='trust = "impacts": accepted by the MuJoCo engine: None'):
        toss_many(CASE, GRID, engine="mujoco", trust="impacts")


def test_what_is_no_scenario_is_refused_or_kept():
    vary = {"restitution": [0.5, 1.5, 0.6], "height": 0.3}
    with pytest.raises(cointoss.ScenarioError, match=r"floor\.restitution = 1\.5.*at toss 1"):
        toss_many(CASE, vary)
    kept = toss_many(CASE, vary, errors="keep", trust="certain")
    alone = toss_many(CASE, {**vary, "restitution": [0.5, 0.6]}, trust="certain")
    assert kept.outcome.values.tolist() == [alone.outcome[0], "refused", alone.outcome[1]]
    assert np.isnan(kept.end_time[1])
    assert not kept.outcome_certain[1]
    assert kept.cointoss.counts["refused"] == 1
    assert int(kept.cointoss.shares()["count"].sum()) == 2


@pytest.mark.parametrize("height", [20.0, [0.2, 20.0], xr.DataArray([20.0, 0.2], dims="n")])
def test_a_number_in_another_unit_is_questioned_in_the_line_that_gives_it(height):
    asked = r'^release\.position\.z = 20 m: is it cm\? write "20 cm"$'
    with pytest.warns(UnitWarning, match=asked) as told:
        toss_many(CASE, {"height": height, "max_impacts": 1})
    assert [one.filename for one in told] == [__file__]
    toss_many(CASE.replace("release.position.z", 20.0), {"max_impacts": [1, 2]})


def test_an_own_law_takes_the_place_of_the_scenarios():
    law = cointoss.OwnLaw(smooth)
    ds = toss_many("fig24a", {"height": "0.2:0.4:5", "max_impacts": 4}, law=law)
    for here, height in zip(ds.end_time.values, ds["release.position.z"].values, strict=True):
        case = load("fig24a").replace("release.position.z", height, "ending.max_impacts", 4)
        assert here == cointoss.toss(case, law=law).end_time
    with pytest.raises(UnsupportedError, match="law: given, accepted: none with the engine mujoco"):
        toss_many(CASE, GRID, engine="mujoco", law=law)
    with pytest.raises(UnsupportedError, match="law: given, accepted: none in a store"):
        toss_many(CASE, GRID, law=law, out="never.zarr")


def test_a_field_that_nothing_uses_is_told():
    with pytest.warns(UnusedFieldWarning, match=r"floor\.friction = 0\.5"):
        toss_many(CASE, {"friction": [0.1, 0.5]})


class _Interrupting:
    """Raises KeyboardInterrupt in the n-th call of an engine, after some of its rows."""

    def __init__(self, monkeypatch, at):
        self.calls, self.at, self.own = 0, at, analytic.toss_rows
        monkeypatch.setattr(analytic, "toss_rows", self)

    def __call__(self, rows, **how):
        self.calls += 1
        if self.calls != self.at:
            return self.own(rows, **how)
        how["answers"][:] = -1
        self.own(rows[:2], **{**how, "answers": how["answers"][:2]})
        raise KeyboardInterrupt


def test_ctrl_c_keeps_what_is_done(monkeypatch):
    vary = {"height": "0.2:0.6:200"}
    whole = toss_many(CASE, vary)
    _Interrupting(monkeypatch, 2)
    with pytest.warns(
        UserWarning, match=r"interrupted: 66 of 200 tosses were made; the others are not_tossed"
    ):
        part = toss_many(CASE, vary)
    made = part.outcome != "not_tossed"
    assert made.sum() == 66
    assert part.where(made, drop=True).end_time.equals(whole.where(made, drop=True).end_time)
    assert np.isnan(part.end_time.where(~made, drop=True)).all()


@pytest.fixture
def small_tiles(monkeypatch):
    monkeypatch.setitem(TILE_TOSSES, Engine.ANALYTIC, 32)


@pytest.mark.usefixtures("small_tiles")
@pytest.mark.parametrize(
    "vary", [{"height": np.linspace(0.2, 0.6, 150)}, {"height": "0.2:0.6:15", "spin": "20:60:10"}]
)
def test_a_store_has_what_memory_has_and_goes_on(vary, tmp_path, monkeypatch):
    path, whole = tmp_path / "a.zarr", toss_many(CASE, vary, trust="impacts")
    with monkeypatch.context() as patched:
        _Interrupting(patched, 3)
        with pytest.warns(UserWarning, match=r"of 150 tosses were made; the others are not_tossed"):
            part = toss_many(CASE, vary, trust="impacts", out=path)
    assert 0 < part.cointoss.counts["not_tossed"] < 150
    with pytest.raises(UnwritableError, match="is a store of tosses with another scenario"):
        toss_many(CASE.replace("gravity", 9.0), vary, trust="impacts", out=path, resume=True)
    with pytest.raises(UnwritableError, match="is a store of tosses with another grid in"):
        toss_many(
            CASE, {**vary, "height": np.linspace(0.2, 0.7, 150)}, trust="impacts", out=path, resume=True
        )
    made = toss_many(CASE, vary, trust="impacts", out=path, resume=True)
    assert made.outcome.dtype == np.int8
    assert made.outcome.attrs["flag_meanings"].split()[3] == "heads"
    words = made.cointoss.words
    for name in whole.data_vars:
        assert np.array_equal(words[name].values, whole[name].values), name
    assert made.cointoss.counts == whole.cointoss.counts
    assert toss_many(CASE, {"height": [0.2]}, out=path, overwrite=True).sizes == {"toss": 1}


def test_what_is_no_scenario_is_not_tossed_in_a_map(tmp_path):
    ds = toss_many(CASE, {"restitution": "0.5:1.5:3", "height": "0.2:0.6:2"}, errors="keep")
    path = ds.cointoss.save(tmp_path / "a.zarr")
    assert cointoss.read_map(path).cointoss.counts["not_tossed"] == ds.cointoss.counts["refused"] == 2


@pytest.mark.parametrize("trust", [None, "impacts", "certain"])
def test_two_fields_are_a_map_in_memory_and_in_a_store(trust, tmp_path):
    vary = {"height": "0.2:0.6:3", "release.angular_velocity.eta": "20:60:4"}
    made = toss_many("fig24a", vary, trust=trust)
    kept = toss_many("fig24a", vary, trust=trust, out=tmp_path / "a.zarr")
    with pytest.raises(cointoss.MapError, match=r"a store of tosses, of which .*\.save makes"):
        cointoss.read_map(tmp_path / "a.zarr")
    assert isinstance(made.cointoss.untrusted, np.ndarray) == (trust == "certain")
    for number, ds in enumerate((made, kept, kept.cointoss.words)):
        axes = ds.cointoss.plot(Figure().subplots())
        assert (axes.get_xlabel(), axes.get_ylabel()) == ("spin about η [rad/s]", "height [m]")
        path = ds.cointoss.save(tmp_path / f"map{number}.zarr")
        assert (cointoss.read_map(path).outcome.values == made.outcome.values).all()


def test_laws_vary_as_words_do():
    laws = ("smooth", "coulomb", "knurled")
    ds = toss_many(CASE, {"contact": laws, "friction": 0.2})  # warnings are errors
    assert ds["floor.contact"].values.tolist() == list(laws)
    alone = [toss_many(CASE, {"contact": law, "friction": 0.2 * (law == "coulomb")}) for law in laws]
    assert ds.end_time.values.tolist() == [one.end_time.item() for one in alone]


@pytest.mark.usefixtures("small_tiles")
def test_a_store_of_fewer_fields_or_answers_is_not_gone_on_with(tmp_path):
    path, heights = tmp_path / "a.zarr", np.linspace(0.2, 0.6, 40)
    both = {"height": heights, "spin": np.linspace(20, 60, 40)}
    toss_many(CASE, both, out=path)
    with pytest.raises(UnwritableError, match=r"with another set of arrays, for release\.spin"):
        toss_many(CASE, {"height": heights}, out=path, resume=True)
    with pytest.raises(UnwritableError, match=r"with another set of arrays \(`trust`\)"):
        toss_many(CASE, both, out=path, resume=True, trust="impacts")


def test_a_store_with_a_field_that_is_not_a_number_goes_on(tmp_path):
    vary = {"height": [0.3, np.nan, 0.4]}
    made = toss_many(CASE, vary, errors="keep", out=tmp_path / "a.zarr")
    again = toss_many(CASE, vary, errors="keep", out=tmp_path / "a.zarr", resume=True)
    assert again.cointoss.counts == made.cointoss.counts
    assert again.cointoss.words.outcome.values[1] == "refused"


def test_a_store_of_laws_has_them_in_words(tmp_path):
    ds = toss_many(CASE, {"contact": ["smooth", "knurled"]}, out=tmp_path / "a.zarr")
    assert ds.cointoss.words["floor.contact"].values.tolist() == ["smooth", "knurled"]


def test_rows_of_another_form_are_refused_or_taken():
    rows = batch_of(CASE, {"height": "0.2:0.6:6"}).rows(np.arange(6))
    due = analytic.toss_rows(rows).end_time
    assert np.array_equal(analytic.toss_rows(rows[::-1]).end_time, due[::-1])
    assert np.array_equal(analytic.toss_rows(np.asfortranarray(rows)).end_time, due)
    for engine in (analytic, coin_mj):
        with pytest.raises(ValueError, match=r"rows: shape \(6, 53\), accepted: \(n, 54\)"):
            engine.toss_rows(rows[:, :53])
        with pytest.raises(ValueError, match=r"answers: shape \(3, 7\), accepted"):
            engine.toss_rows(rows, answers=np.empty((3, 7)))


def test_a_law_of_ones_own_is_in_no_map(tmp_path):
    law = cointoss.OwnLaw(smooth)
    ds = toss_many(CASE, {"height": "0.2:0.6:3", "release.angular_velocity.eta": "20:60:5"}, law=law)
    with pytest.raises(SweepError, match="by the law smooth of one's own, accepted"):
        ds.cointoss.save(tmp_path / "a.zarr")
