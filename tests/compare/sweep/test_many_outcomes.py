"""Outcomes in a Zarr store are those of `toss_many`, and what was finished is kept."""

from contextlib import nullcontext
from importlib.metadata import version

import numpy as np
import pytest
import xarray

from cointoss import Hand, OwnLaw, UnsupportedError, analytic, coin_mj, load, toss_to_zarr
from cointoss.compare.engines import Engine
from cointoss.compare.output.files import UnwritableError
from cointoss.compare.sweep import many_outcomes
from cointoss.compare.sweep.many_outcomes import FORMAT
from cointoss.models.outcomes import Outcomes
from cointoss.models.reading import parse

COIN = load("fig24a").replace("ending.max_impacts", 2)


def chunks(count, size=50):
    rng = np.random.default_rng(0)
    for _ in range(count):
        yield Hand().releases(COIN.body, rng, size)


def test_the_store_has_what_toss_many_returns(tmp_path):
    made = [analytic.toss_many(COIN, chunk, horizon=True) for chunk in chunks(3)]
    assert toss_to_zarr(tmp_path / "a.zarr", COIN, chunks(3), horizon=True) == 150
    with xarray.open_zarr(tmp_path / "a.zarr") as found:
        for name in ("outcome", "ending", "impacts", "last_face", "end_time", "trusted_impacts"):
            np.testing.assert_array_equal(found[name], np.concatenate([getattr(one, name) for one in made]))
        assert "outcome_certain" not in found
        assert found.outcome.attrs["flag_meanings"].split()[:3] == ["undecided", "heads", "tails"]
        assert parse(found.attrs["scenario"], "store") == COIN
        assert found.attrs["cointoss_tosses"] == FORMAT


def test_the_store_says_by_what_it_was_made(tmp_path):
    asked = coin_mj.MANY.softened(2.0)
    toss_to_zarr(tmp_path / "a.zarr", COIN, chunks(1, 2), engine="mujoco", settings=asked)
    with xarray.open_zarr(tmp_path / "a.zarr") as found:
        assert found.attrs["engine"] == "mujoco"
        assert found.attrs["engine_settings"] == asked.as_dict() != coin_mj.MANY.as_dict()
        assert found.attrs["versions"] == {**Engine.MUJOCO.versions, "zarr": version("zarr")}


def test_each_chunk_is_told(tmp_path, monkeypatch):
    told = []
    monkeypatch.setattr(many_outcomes, "stage", lambda *_, **__: nullcontext(lambda *made: told.append(made)))
    toss_to_zarr(tmp_path / "a.zarr", COIN, chunks(3))
    assert told == [(50, 50), (100, 100), (150, 150)]


def test_a_damaged_file_of_the_store_is_found_out(tmp_path):
    toss_to_zarr(tmp_path / "a.zarr", COIN, chunks(1))
    file = tmp_path / "a.zarr" / "end_time" / "c" / "0"
    content = bytearray(file.read_bytes())
    content[len(content) // 2] ^= 1
    file.write_bytes(content)
    with xarray.open_zarr(tmp_path / "a.zarr") as found, pytest.raises(RuntimeError, match="checksum"):
        found.end_time.load()


def test_what_was_finished_is_kept_where_it_is_interrupted(tmp_path):
    def interrupted():
        yield from chunks(2)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        toss_to_zarr(tmp_path / "a.zarr", COIN, interrupted())
    with xarray.open_zarr(tmp_path / "a.zarr") as found:
        assert len(found.toss) == 100
        assert np.all(found.ending > 0)


def test_without_chunks_the_store_has_no_tosses(tmp_path):
    assert toss_to_zarr(tmp_path / "a.zarr", COIN, [], horizon=True) == 0
    with xarray.open_zarr(tmp_path / "a.zarr") as found:
        assert found.sizes == {"toss": 0}
        assert {"outcome", "trusted_impacts"} < set(found.data_vars)


def test_what_breaks_off_while_it_is_written_is_not_seen(tmp_path, monkeypatch):
    """The second chunk's arrays are written half; the store has the first."""
    import zarr

    written, write = [], zarr.Array.__setitem__

    def broken(self, *part):
        written.append(part)
        if len(written) == 7:
            raise KeyboardInterrupt
        write(self, *part)

    monkeypatch.setattr(zarr.Array, "__setitem__", broken)
    with pytest.raises(KeyboardInterrupt):
        toss_to_zarr(tmp_path / "a.zarr", COIN, chunks(3))
    with xarray.open_zarr(tmp_path / "a.zarr") as found:
        assert len(found.toss) == 50
        assert np.all(found.ending > 0)


def test_a_place_that_exists_and_what_is_no_release_are_refused(tmp_path):
    (tmp_path / "a.zarr").mkdir()
    for name, named in (("a.zarr", "exists"), ("a.map", "ends in .zarr"), ("no/a.zarr", "no folder")):
        with pytest.raises(UnwritableError, match=named):
            toss_to_zarr(tmp_path / name, COIN, chunks(1))
    with pytest.raises(TypeError, match=r"chunks: of type Releases, accepted: .*, as in \[releases\]"):
        toss_to_zarr(tmp_path / "b.zarr", COIN, next(chunks(1)))  # pyright: ignore[reportArgumentType]
    with pytest.raises(TypeError, match="progress: 'yes', accepted: True, False, or None"):
        toss_to_zarr(tmp_path / "b.zarr", COIN, chunks(1), progress="yes")  # pyright: ignore[reportArgumentType]
    with pytest.raises(TypeError, match="chunks: of type int"):
        toss_to_zarr(tmp_path / "b.zarr", COIN, [1])  # pyright: ignore[reportArgumentType]
    law = OwnLaw(lambda K, v_A, tau, chi, mu: (0.0, 0.0, -(1 + chi) * v_A[2] / K[2][2]))  # noqa: ARG005
    with pytest.raises(UnsupportedError, match="law: given, accepted: none in a store"):
        toss_to_zarr(tmp_path / "b.zarr", COIN, chunks(1), law=law)
    assert not (tmp_path / "b.zarr").exists()


def test_an_interrupt_returns_the_tosses_that_were_made(monkeypatch):
    """Ctrl-C comes after the first tiles; `progress=True` asks for what is done."""
    from cointoss.models import tiles

    waited, wait = [], tiles.wait

    def interrupted(tossing):
        if not waited:
            waited.append(1)
            raise KeyboardInterrupt
        wait(tossing)

    releases = next(chunks(1, 4000))
    whole = analytic.toss_many(COIN, releases)
    assert whole.is_done.all()
    monkeypatch.setattr(tiles, "wait", interrupted)
    with pytest.warns(UserWarning, match="of 4,000 tosses were made; the others have the ending none"):
        part = analytic.toss_many(COIN, releases, progress=True)
    assert isinstance(part, Outcomes)
    assert len(part) == 4000
    assert not part.is_done.all()
    np.testing.assert_array_equal(part.outcome[part.is_done], whole.outcome[part.is_done])
    assert np.all(part.outcome[~part.is_done] == 0)
    waited.clear()
    with pytest.raises(KeyboardInterrupt):
        analytic.toss_many(COIN, releases)


def test_progress_is_shown_where_it_is_asked_for(monkeypatch):
    from cointoss.models.stages import stages

    asked = []
    monkeypatch.setattr(stages, "shown", lambda want: asked.append(want) or nullcontext())
    for progress in (None, True, False):
        analytic.toss_many(COIN, next(chunks(1, 2)), progress=progress)
    assert asked == [None, True, False]
