"""Maps from Python: the same as the command's, and what a notebook, xarray and pandas see of them."""

from dataclasses import replace
from io import BytesIO

import numpy as np
import pytest
import xarray

import cointoss
from compare.sweep.layers import NOT_TOSSED
from models.records import Outcome
from tests.helpers.command_line import cointoss as command

X, Y = "release.angular_velocity.eta=20:60:7", "release.position.z=20 cm:60 cm:5"


@pytest.fixture(scope="module")
def found():
    return cointoss.basin("fig24a", x=X, y=Y)


def test_a_map_has_the_tosses_of_its_pixels(found):
    scenario = cointoss.load("fig24a")
    assert (found.x[0], found.x[-1], found.y[0], found.y[-1]) == (20, 60, 0.2, 0.6)
    for row, column in ((0, 0), (4, 6), (2, 3)):
        changed = scenario.replace(
            "release.angular_velocity.eta", found.x[column], "release.position.z", found.y[row]
        )
        toss = cointoss.analytic.toss(changed)
        assert (found.outcome[row, column], found.impacts[row, column]) == (toss.outcome, len(toss.impacts))
    with pytest.raises(ValueError, match="read-only"):
        found.outcome[0, 0] = 0
    assert cointoss.basin("fig24a", x=X, y=Y, after=np.int64(0)).sweep.after == 0  # pyright: ignore


def test_a_map_is_that_which_the_command_writes(found, tmp_path):
    path = tmp_path / "map.zarr"
    command("basin", "fig24a", "--x", X, "--y", Y, "--out", path)
    read = cointoss.read_map(str(path))
    assert read.sweep == found.sweep
    for name, array in found.layers.items():
        assert np.array_equal(read.layers[name], array)
    with xarray.open_dataset(path, engine="zarr", consolidated=True) as on_disk:
        ours = found.to_xarray()
        for name in ("outcome", "impacts", "release.angular_velocity.eta", "release.position.z"):
            assert ours[name].attrs == on_disk[name].attrs
            assert ours[name].dims == on_disk[name].dims
            assert np.array_equal(ours[name], on_disk[name])
    assert ours.attrs["engine"] == on_disk.attrs["engine"]


def test_what_a_person_sees_of_a_map(found):
    counts = {str(item): np.count_nonzero(found.outcome == item) for item in Outcome}
    assert {name: round(35 * share) for name, share in found.shares.items()} == {
        name: count for name, count in counts.items() if count
    }
    told = repr(found)
    assert told.startswith(
        "<OutcomeMap map of fig24a by analytic: 7 x 5 over release.angular_velocity.eta and"
    )
    assert f"{counts['heads'] / 35:.1%} heads" in told
    assert len(told) < 200
    html = found._repr_html_()
    assert 'src="data:image/png;base64,' in html
    assert 'alt="map of the outcome: 7 x 5 over spin about η and height"' in html
    frame = found.to_dataframe()
    assert list(frame) == ["release.position.z", "release.angular_velocity.eta", "outcome", "impacts"]
    assert frame["outcome"].tolist().count("heads") == counts["heads"]
    assert frame["release.angular_velocity.eta"].tolist() == np.tile(found.x, 5).tolist()
    assert frame["impacts"].tolist() == found.impacts.ravel().tolist()


def test_a_plot_shows_the_map_and_its_margins(found):
    (panel,) = found.plot().axes
    assert (panel.get_xlabel(), panel.get_ylabel()) == ("spin about η [rad/s]", "height [m]")
    assert found.plot().get_suptitle() == "fig24a: 2 g, 25 mm"
    assert panel.get_images()[0].get_array().shape[:2] == found.outcome.shape
    hostile = replace(found, sweep=replace(found.sweep, name=r"$\frac$ 硬\n貨"))
    hostile.plot().savefig(BytesIO())  # warnings are errors
    with_margins = cointoss.basin(
        "fig24a", x="release.angular_velocity.eta=20:60:3", y="release.position.z=0.2:0.6:2", margin="height"
    )
    assert with_margins.margin is not None
    assert len(with_margins.plot(palette="paper").axes) > 2


def test_a_map_that_is_not_finished_says_so(found):
    outcome = found.outcome.copy()
    outcome[0, 0] = NOT_TOSSED
    part = cointoss.OutcomeMap(name="m", sweep=found.sweep, outcome=outcome, impacts=found.impacts)
    assert part.shares["not tossed"] == 1 / 35
    assert "not tossed" in part._repr_html_()
    assert part.to_dataframe()["outcome"].tolist()[0] == "not_tossed"
    with pytest.raises(cointoss.SweepError, match="m: 1 of 35 pixels are not tossed; accepted"):
        part.plot()


@pytest.mark.parametrize(
    ("wrong", "named"),
    [
        ({"engine": "paper"}, "engine: 'paper', accepted: analytic, mujoco"),
        ({"after": -1}, "after: -1, accepted: a whole number from 0"),
        ({"after": "2"}, "after: '2', accepted: a whole number"),
        ({"after": True}, "after: True, accepted: a whole number"),
        ({"after": 1.5}, "after: 1.5, accepted: a whole number"),
        ({"x": None}, "x: None, accepted: text"),
        ({"margin": 3}, "margin: 3, accepted: text"),
        (
            {"x": "release.position.z=0.1:1:100000", "y": "gravity=1:9:100000"},
            "100000 by 100000 pixels, accepted: at most 1e",
        ),
        ({"x": "release.position.z=1"}, "accepted: FIELD=START:STOP:N"),
        ({"x": Y}, "release.position.z: on both axes; accepted: two fields"),
        ({"margin": "luck"}, "margin luck: accepted: height"),
        ({"margin": "height", "engine": "mujoco"}, "margin: 'height' by mujoco, accepted: only by"),
        ({"y": "release.position.z=-1:1:3"}, "release.position.z"),
    ],
)
def test_what_makes_no_map_is_refused(wrong, named):
    with pytest.raises(ValueError, match=named):
        cointoss.basin("fig24a", **{"x": X, "y": Y, **wrong})


def test_what_is_no_map_is_refused(found):
    with pytest.raises(ValueError, match="77 is no outcome"):
        cointoss.OutcomeMap(
            name="m", sweep=found.sweep, outcome=np.full((5, 7), 77, np.int8), impacts=found.impacts
        )
    with pytest.raises(cointoss.SweepError, match="palette: 'foo', accepted: safe, paper"):
        found.plot(palette="foo")
    for most in (0, True, 2.5):
        with pytest.raises(cointoss.SweepError, match=f"most = {most}; accepted: a whole number from 1"):
            cointoss.read_map("map.zarr", most=most)  # pyright: ignore[reportArgumentType]
    mine = found.outcome.copy()
    cointoss.OutcomeMap(name="m", sweep=found.sweep, outcome=mine, impacts=found.impacts)
    mine[0, 0] = 1


def test_shapes_that_are_not_those_of_the_axes_are_refused(found):
    with pytest.raises(ValueError, match=r"OutcomeMap.impacts: shape \(1, 1\), expected \(5, 7\)"):
        cointoss.OutcomeMap(
            name="m", sweep=found.sweep, outcome=found.outcome, impacts=np.zeros((1, 1), np.int32)
        )
