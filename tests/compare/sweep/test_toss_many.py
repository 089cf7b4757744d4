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
from tests.helpers.own_laws import smooth

CASE = load("fig24a").replace("ending.max_impacts", 8)
GRID = {"restitution": "0.3:0.9:3", "height": [0.2, 0.3, 0.4, 0.5]}


@pytest.mark.parametrize(
    ("engine", "trust"), [(Engine.ANALYTIC, None), (Engine.ANALYTIC, "certain"), (Engine.MUJOCO, None)]
)
def test_each_toss_is_that_of_toss(engine, trust):
    ds = toss_many(CASE, GRID, engine=engine, trust=trust)
    assert ds.sizes == {"floor.restitution": 3, "toss": 4}
    assert ("trusted_impacts" in ds) == ("outcome_certain" in ds) == (trust == "certain")
    for at in np.ndindex(ds.outcome.shape):
        here = ds[dict(zip(ds.outcome.dims, at, strict=True))]
        given = [part for name, one in here.coords.items() for part in (str(name), one.item())]
        toss = engine.package.toss(ds.cointoss.scenario.replace(*given), settings=engine.package.MANY)
        face = {1: "heads", 2: "tails"}[toss.impacts.face[-1]] if len(toss.impacts) else "none"
        due = {"outcome": str(toss.outcome), "ending": str(toss.ending), "last_face": face}
        due |= {"impacts": len(toss.impacts), "end_time": toss.end_time}
        if trust:
            due |= {"trusted_impacts": toss.trusted_impacts, "outcome_certain": toss.outcome_certain}
        assert {name: one.item() for name, one in here.data_vars.items()} == due


def test_a_dataset_can_be_written_by_xarray_itself_and_a_store_has_its_words(tmp_path):
    vary = {"floor.contact": ["smooth", "knurled"], "height": "0.3:0.4:2"}
    ds = toss_many(CASE, vary, trust="certain")
    kept = toss_many(CASE, vary, out=tmp_path / "kept.zarr").cointoss.words
    for one in (ds, kept):
        assert one["floor.contact"].values.tolist() == vary["floor.contact"]
    ds.to_zarr(tmp_path / "own.zarr", zarr_format=2)
    with xr.open_zarr(tmp_path / "own.zarr") as back:
        assert (back.outcome == ds.outcome).all()


def test_what_is_no_scenario_is_refused_or_kept(tmp_path):
    vary = {"restitution": [0.5, 1.5, np.nan, 0.6], "height": 0.3}
    with pytest.raises(cointoss.ScenarioError, match=r"floor\.restitution = 1\.5.*at toss 1"):
        toss_many(CASE, vary)
    kept = toss_many(CASE, vary, errors="keep", trust="certain")
    alone = toss_many(CASE, {**vary, "restitution": [0.5, 0.6]}, trust="certain")
    assert kept.outcome.values.tolist() == [alone.outcome[0], "refused", "refused", alone.outcome[1]]
    assert np.isnan(kept.end_time[1:3]).all()
    assert not kept.outcome_certain[1]
    assert kept.cointoss.counts["refused"] == int(kept.cointoss.shares()["count"].sum()) == 2
    for resume in (False, True):
        stored = toss_many(CASE, vary, errors="keep", out=tmp_path / "a.zarr", resume=resume)
        assert stored.cointoss.words.outcome.values.tolist() == kept.outcome.values.tolist()


def test_what_is_no_scenario_is_not_tossed_in_a_map(tmp_path):
    ds = toss_many(CASE, {"restitution": "0.5:1.5:3", "height": "0.2:0.6:2"}, errors="keep")
    path = ds.cointoss.save(tmp_path / "a.zarr")
    assert cointoss.read_map(path).cointoss.counts["not_tossed"] == ds.cointoss.counts["refused"] == 2


@pytest.mark.parametrize("height", [20.0, [0.2, 20.0], xr.DataArray([20.0, 0.2], dims="n")])
def test_a_number_in_another_unit_is_questioned_in_the_line_that_gives_it(height):
    asked = r'^release\.position\.z = 20 m: is it cm\? write "20 cm"$'
    with pytest.warns(UnitWarning, match=asked) as told:
        toss_many(CASE, {"height": height, "max_impacts": 1})
    assert [one.filename for one in told] == [__file__]
    toss_many(CASE.replace("release.position.z", 20.0), {"max_impacts": [1, 2]})


LAW = cointoss.OwnLaw(smooth)


def test_an_own_law_takes_the_place_of_the_scenarios_and_is_in_no_map(tmp_path):
    eta, limit = "release.angular_velocity.eta", {"max_impacts": 4}
    ds = toss_many("fig24a", {"height": "0.2:0.4:5", eta: "20:60:2", **limit}, law=LAW)
    for height, (slow, _) in zip(ds["release.position.z"].values, ds.end_time.values, strict=True):
        case = load("fig24a").replace("release.position.z", height, eta, 20.0, "ending.max_impacts", 4)
        assert slow == cointoss.toss(case, law=LAW).end_time
    with pytest.raises(SweepError, match="by the law smooth of one's own, accepted"):
        ds.cointoss.save(tmp_path / "a.zarr")


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"engine": "mujoco", "law": LAW}, "law: given, accepted: none with the engine mujoco"),
        ({"out": "never.zarr", "law": LAW}, "law: given, accepted: none in a store"),
        ({"engine": "mujoco", "trust": "impacts"}, 'trust = "impacts": accepted by the MuJoCo engine: None'),
    ],
)
def test_what_an_engine_or_a_store_has_not_is_refused(given, said):
    with pytest.raises(UnsupportedError, match=said):
        toss_many(CASE, GRID, **given)


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
    made = toss_many(CASE, vary, trust="impacts", out=path, resume=True)
    assert made.outcome.dtype == np.int8
    assert made.outcome.attrs["flag_meanings"].split()[3] == "heads"
    words = made.cointoss.words
    for name in whole.data_vars:
        assert np.array_equal(words[name].values, whole[name].values), name
    assert made.cointoss.counts == whole.cointoss.counts
    assert toss_many(CASE, {"height": [0.2]}, out=path, overwrite=True).sizes == {"toss": 1}


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


HEIGHTS, SPINS = np.linspace(0.2, 0.6, 40), np.linspace(20, 60, 40)


@pytest.mark.usefixtures("small_tiles")
@pytest.mark.parametrize(
    ("gravity", "vary", "how", "said"),
    [
        (9.0, {"height": HEIGHTS, "spin": SPINS}, {}, "scenario"),
        (9.81, {"height": HEIGHTS + 0.1, "spin": SPINS}, {}, "grid in toss"),
        (9.81, {"height": HEIGHTS}, {}, r"set of arrays, for release\.spin"),
        (9.81, {"height": HEIGHTS, "spin": SPINS}, {"trust": "impacts"}, r"set of arrays \(`trust`\)"),
        (9.81, {"height": HEIGHTS, "spin": SPINS}, {"errors": "keep"}, "errors"),
    ],
)
def test_a_store_of_something_else_is_not_gone_on_with(tmp_path, gravity, vary, how, said):
    toss_many(CASE, {"height": HEIGHTS, "spin": SPINS}, out=tmp_path / "a.zarr")
    case = CASE.replace("gravity", gravity)
    with pytest.raises(UnwritableError, match=f"is a store of tosses with another {said}"):
        toss_many(case, vary, **how, out=tmp_path / "a.zarr", resume=True)


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
