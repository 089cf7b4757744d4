"""What earlier releases read and wrote means what it meant; `made.sh` of each folder made what it wrote."""

import json
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray

import cointoss as package
from cointoss.compare.fitting.table import read_seen
from cointoss.models.batch import STATE
from cointoss.models.hand import load_hand
from cointoss.models.reading import parse
from cointoss.models.records import Outcome
from tests.helpers.command_line import cointoss

RELEASES = sorted(folder for folder in (Path(__file__).parent / "releases").iterdir() if folder.is_dir())
TOSSED = [
    pytest.param(toss, id=f"{release.name}-{toss.stem}")
    for release in RELEASES
    for toss in sorted((release / "made").glob("*.json"))
    if "sequence" in toss.read_text(encoding="utf-8") and toss.stem != "find"
]
MAPS = [
    pytest.param(store, id=f"{release.name}-{store.stem}")
    for release in RELEASES
    for store in sorted((release / "made").glob("*.zarr"))
    if "cointoss_map" in (store / "zarr.json").read_text(encoding="utf-8")
]
OF_MAPS = {
    "touch": ("smooth.toml", "analytic", 1),
    "final": ("dropped.toml", "analytic", None),
    "mujoco": ("dropped.toml", "mujoco", 0),
}
"""By the name of a map: its scenario, its engine, and the touch that it shows."""
OF_THE_RUN = {"versions", "settings"}
"""What another version may say otherwise."""


@pytest.fixture(params=RELEASES, ids=lambda folder: folder.name)
def release(request):
    return request.param


def read(path: Path) -> Any:
    return json.loads(path.read_text(encoding="utf-8"))


def rows(path: Path) -> list[dict[str, Any]]:
    """Return the rows of a table."""
    return pd.read_csv(path).to_dict("records")


def unlike(then: Any, now: Any, place: str = "", *, values: bool = True) -> list[str]:
    """Return the places at which an answer is not what it was; what is new in it is no difference.

    Args:
        then: the earlier answer.
        now: today's.
        place: where they stand.
        values: whether numbers are compared, to what rounding makes of few impacts; else their kinds alone.
    """
    if isinstance(then, dict) and isinstance(now, dict):
        gone = [f"{place}.{key} is gone" for key in then if key not in now]
        kept = [
            (f"{place}.{key}", then[key], now[key]) for key in then if key in now and key not in OF_THE_RUN
        ]
        return gone + [each for inner, a, b in kept for each in unlike(a, b, inner, values=values)]
    if isinstance(then, list) and isinstance(now, list) and (len(then) == len(now) or not values):
        pairs = enumerate(zip(then, now, strict=False))
        return [each for i, (a, b) in pairs for each in unlike(a, b, f"{place}[{i}]", values=values)]
    if isinstance(then, float) and isinstance(now, float):
        same = not values or then == pytest.approx(now, rel=1e-6, abs=1e-10, nan_ok=True)
    else:
        same = then == now or (not values and type(then) is type(now))
    return [] if same else [f"{place} was {then!r}, is {now!r}"]


def test_its_scenarios_had_every_field_and_every_word(release):
    """Those that the release itself names, and the fields of their tables are set in some file of it."""
    found: dict[str, set[str]] = {}
    for path in (release / "given").glob("*.toml"):
        tables = tomllib.loads(path.read_text(encoding="utf-8"))
        parts = {name: part for name, part in tables.items() if isinstance(part, dict)}
        plain = {name: value for name, value in tables.items() if name not in parts}
        fields = {f"{name}.{key}": value for name, part in parts.items() for key, value in part.items()}
        for field, value in {**plain, **fields}.items():
            found.setdefault(field, set()).add(str(value))
    accepted = read(release / "made" / "fields.json")
    assert accepted.keys() - found.keys() == set()
    assert [word for field, words in accepted.items() for word in words if word not in found[field]] == []


@pytest.mark.parametrize("toss", TOSSED)
def test_a_scenario_is_tossed_as_it_was(toss):
    """Its numbers in SI, and what they do: an impact is trusted, so no error of either version decides it."""
    then = read(toss)
    assert then["trusted_impacts"] == len(then["impacts"])
    if toss.stem in ("sharp_edge", "knurled", "perfectly_rough", "slip_preserving"):
        for impact in then["impacts"]:  # 0.1.0 said of laws without a friction cone that they leave it
            impact["flags"] = [flag for flag in impact["flags"] if flag != "leaves_cone"]
    now = cointoss("toss", toss.parents[1] / "given" / f"{toss.stem}.toml", "--json")
    assert unlike(then, json.loads(now.stdout)) == []


def test_a_trajectory_has_the_columns_it_had(release, tmp_path):
    then, table = rows(release / "made" / "caught.csv"), tmp_path / "path.csv"
    assert cointoss("toss", release / "given" / "caught.toml", "--trajectory", table).exit_code == 0
    assert len(then) > 50
    assert unlike(then, rows(table)) == []


@pytest.mark.parametrize("name", ["hand", "spun"])
def test_a_hand_is_the_hand_it_was(release, name):
    file, then = release / "given" / f"{name}.toml", read(release / "made" / f"{name}.json")
    assert unlike(then["hand"], vars(load_hand(file))) == []
    words = ("hands", release / "given" / "smooth.toml", "--hand", file, "--tosses", then["tosses"], "--json")
    assert unlike(then, json.loads(cointoss(*words).stdout), values=False) == []


def test_shares_are_told_as_they_were(release, tmp_path):
    then, table = read(release / "made" / "shares.json"), tmp_path / "shares.csv"
    # By default a coin turned about a diameter then.
    words = ("shares", release / "given" / "dropped.toml", "--vary", "floor.restitution=0.3:0.6:2")
    words += ("--psi-scatter", "0")
    now = json.loads(cointoss(*words, "--tosses", "40", "--json", "--out", table).stdout)
    assert unlike(then, now, values=False) == []
    for one, other in zip(then["settings"], now["settings"], strict=True):
        assert one["floor.restitution"] == other["floor.restitution"]
        for outcome, share in one["shares"].items():
            assert other["shares"][outcome]["low"] <= share["value"] <= other["shares"][outcome]["high"]
    assert unlike(rows(release / "made" / "shares.csv"), rows(table), values=False) == []


@pytest.mark.parametrize("table", ["stopwatch", "frames"])
def test_what_was_seen_is_read_as_it_was(release, table):
    sd = {"time": 0.001, "height": 0.002, "attitude": 0.01}
    found = read_seen(release / "given" / f"{table}.csv", sd)
    now = {name: getattr(found, name).tolist() for name in found.__dataclass_fields__}
    assert unlike(read(release / "made" / f"{table}.json"), now) == []


@pytest.mark.slow
def test_a_fit_is_told_as_it_was(release):
    then, given = read(release / "made" / "fit.json"), release / "given"
    vary = ("floor.restitution=0.4:0.95", "release.position.z=0.1:0.6", "clock=0:1.2")
    words = ("--sd-time", "1 ms", *(word for span in vary for word in ("--vary", span)), "--json")
    now = json.loads(cointoss("fit", given / "stopwatch.csv", given / "dropped.toml", *words).stdout)
    assert unlike(then, now, values=False) == []
    for field, value in then["values"].items():
        assert now["values"][field]["value"] == pytest.approx(value["value"], abs=value["sd"] / 100)
    fitted = package.load(release / "made" / "fitted.toml")
    assert unlike(then["scenario"], fitted.as_tables()) == []


def test_a_scenario_that_was_found_shows_what_it_did(release):
    then = read(release / "made" / "find.json")
    found = package.load(release / "made" / "found.toml")
    assert unlike(then["found"], found.as_tables()) == []
    assert package.analytic.toss(found).sequence.startswith(then["sequence"])


@pytest.mark.parametrize("store", MAPS)
def test_a_map_is_read_as_it_was(store):
    """What xarray alone read of it then, the codes as the words that they stand for."""
    then, found = read(store.with_suffix(".json")), package.read_map(store)
    now = {str(name): array.values.tolist() for name, array in found.variables.items()}
    if "outcome_certain" in found:
        now["outcome_certain"] = np.where(found.outcome_certain, "certain", "uncertain").tolist()
    assert unlike(then, now) == []
    given, engine, after = OF_MAPS[store.stem]
    assert found.cointoss.scenario == package.load(store.parents[1] / "given" / given)
    assert (found.attrs["engine"], found.attrs["after"]) == (engine, "" if after is None else after)


def test_the_pixels_of_a_map_are_tosses_of_its_scenario(release):
    found = package.read_map(release / "made" / "touch.zarr")
    for i, j in ((0, 0), (0, 1), (2, 3)):
        pixel = found[{"y": i, "x": j}]
        fields = [part for field, value in pixel.coords.items() for part in (str(field), value.item())]
        toss = package.analytic.toss(found.cointoss.scenario.replace(*fields))
        assert str(Outcome(toss.impacts.face[1])) == pixel.outcome.item()


def meanings(attributes):
    """Return what the codes of a variable mean."""
    if "flag_values" not in attributes:
        return {}
    return dict(zip(attributes["flag_values"], attributes["flag_meanings"].split(), strict=True))


def test_a_store_of_tosses_means_what_it_meant(release, tmp_path):
    """No command reads one: its variables, their dimension and their words are among those of now."""
    coin, rng = package.load(release / "given" / "dropped.toml"), np.random.default_rng(0)
    states = np.concatenate([package.Hand().states(coin.body, rng, 4) for _ in range(2)])
    vary = dict(zip(STATE, states.T, strict=True))
    with (
        xarray.open_zarr(release / "made" / "tosses.zarr", consolidated=False) as then,
        package.toss_many(coin, vary, trust="certain", out=tmp_path / "tosses.zarr") as now,
    ):
        form = then.attrs["cointoss_tosses"], now.attrs["cointoss_tosses"]
        assert form == ({"0.1.0": 1}.get(release.name, 2), 2)
        assert parse(then.attrs["scenario"], "store") == coin
        for name, array in then.variables.items():
            assert array.dims == now[name].dims == ("toss",)
            assert meanings(array.attrs).items() <= meanings(now[name].attrs).items()
        sure = then.outcome_certain.values & (now.outcome_certain.values == 1)
        assert sure.sum() >= 3
        assert np.array_equal(then.outcome.values[sure], now.outcome.values[sure])
