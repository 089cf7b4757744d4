"""The lab's map in a browser: its pictures from few tosses, while a slider moves, and while one zooms."""

import csv
import io
import json

import numpy as np
import pytest

import cointoss
from cointoss.compare.lab.served import ServedLab
from cointoss.models.devices import Device
from tests.helpers.coins_shown import BLUE, GOLD, NO_WEBGL, box, picture
from tests.helpers.explored import serving
from tests.helpers.lab import ADDRESSED, HEIGHT, SAVED, WHOLE, saved

HEADS, TAILS = np.array([200, 100, 0]), np.array([0, 20, 160])
COLUMNS, ROWS = 72, 48
DRAWS = """
window.draws = [];
const draw = CanvasRenderingContext2D.prototype.drawImage;
CanvasRenderingContext2D.prototype.drawImage = function (image, ...place) {
  if (this.canvas.id === "map") {
    if (!window.draws.some((one) => one.image === image)) {
      const { data } = image.getContext("2d").getImageData(0, 0, image.width, image.height);
      const isWhole = data.every((part, i) => i % 4 < 3 || part === 255);
      window.draws.push({ image, isWhole, time: performance.now(), widths: [] });
    }
    window.draws.find((one) => one.image === image).widths.push(place[2]);
  }
  return draw.call(this, image, ...place);
};
"""
"""A script that keeps which pictures are drawn on the map, whether they are whole, and how wide."""


def reconstructed(page, codes, stride, trusted=None):
    """Return the colours and doubts of a map, rows upwards, of which each square of a stride has one toss."""
    random = np.random.default_rng(1)
    known = np.full(codes.shape, -1)
    for row in range(0, ROWS, stride):
        for column in range(0, COLUMNS, stride):
            at = row + random.integers(stride), column + random.integers(stride)
            known[at] = codes[at]
    given = {
        "columns": COLUMNS,
        "rows": ROWS,
        "stride": stride,
        "codes": known.ravel().tolist(),
        "trusted": None if trusted is None else trusted.ravel().tolist(),
        "colors": {"-1": [9, 9, 9], "1": HEADS.tolist(), "2": TAILS.tolist()},
    }
    pixels, doubts = page.value(
        f"import('reconstruct.js').then(({{ reconstruct }}) => reconstruct({json.dumps(given)}))"
        ".then(({ pixels, doubts }) => [[...pixels], [...doubts]])"
    )
    colors = np.reshape(pixels, (ROWS, COLUMNS, 4))
    assert (colors[:, :, 3] == 255).all()
    return colors[:, :, :3], np.reshape(doubts, (ROWS, COLUMNS))


@pytest.mark.parametrize("stride", [2, 3, 4, 6, 8])
def test_both_halves_have_their_colours_and_a_boundary_between_them(kept, stride):
    codes = np.where(np.arange(COLUMNS) < COLUMNS // 2, 1, 2) * np.ones((ROWS, 1), dtype=int)
    colors, _ = reconstructed(kept, codes, stride)
    near = 3 * stride
    assert np.abs(colors[:, : COLUMNS // 2 - near] - HEADS).max() <= 1
    assert np.abs(colors[:, COLUMNS // 2 + near :] - TAILS).max() <= 1
    # Halfway where the boundary is, but for the distance between tosses.
    share = (colors[:, :, 0] - TAILS[0]) / (HEADS[0] - TAILS[0])
    assert np.abs((share > 0.5).sum(axis=1) - COLUMNS // 2).max() <= 1.5 * stride


@pytest.mark.parametrize("stride", [2, 3, 4])
def test_a_checkerboard_that_is_finer_than_the_tosses_is_grey(kept, stride):
    codes = 1 + np.add.outer(np.arange(ROWS), np.arange(COLUMNS)) % 2
    colors, _ = reconstructed(kept, codes, stride)
    share = (colors[:, :, 0] - TAILS[0]) / (HEADS[0] - TAILS[0])
    assert abs(share.mean() - 0.5) < 0.05
    assert share.std() < 0.1
    assert np.mean((share > 0.2) & (share < 0.8)) > 0.99


def test_what_is_doubted_is_so_in_part_where_neighbours_disagree(kept):
    codes = np.ones((ROWS, COLUMNS), dtype=int)
    trusted = np.where(np.arange(COLUMNS) < COLUMNS // 2, 0, 1) * np.ones((ROWS, 1), dtype=int)
    _, doubts = reconstructed(kept, codes, 4, trusted)
    assert (doubts[:, :24] == 255).all()
    assert (doubts[:, 48:] == 0).all()
    assert (np.diff(doubts.mean(axis=0)) <= 1e-9).all()
    _, none = reconstructed(kept, codes, 4)
    assert (none == 0).all()


def test_at_the_end_each_pixel_is_its_own_toss(page, lab_path):
    page.call("Page.addScriptToEvaluateOnNewDocument", source=SAVED)
    page.open(lab_path.as_uri(), width=420, height=1900)
    page.wait_for(WHOLE)
    rows = list(csv.DictReader(io.StringIO(saved(page, "csv"))))
    high = len({row[HEIGHT] for row in rows})
    codes = np.array([row["outcome"] for row in rows]).reshape(high, -1)
    shown = picture(page, "map")[10:-52, 74:-14]
    across = ((np.arange(codes.shape[1]) + 0.5) * shown.shape[1] / codes.shape[1]).astype(int)
    down = ((np.arange(high)[::-1] + 0.5) * shown.shape[0] / high).astype(int)
    seen = shown[np.ix_(down, across)]
    for name, color in (("heads", GOLD), ("tails", BLUE)):
        # All but those below the cross of the chosen release.
        assert np.mean((seen[codes == name] == color).all(axis=1)) > 0.99


def test_pictures_follow_a_slider_and_each_is_whole(tab, lab_path, capsys):
    # Without the coins, which a browser without a card draws slowly.
    tab.call("Page.addScriptToEvaluateOnNewDocument", source=DRAWS + NO_WEBGL)
    tab.open(lab_path.as_uri(), width=1280)
    tab.wait_for(WHOLE)
    first, pictures, span = tab.value(
        """(async () => {
          const input = document.querySelector("[data-field='floor.restitution']");
          const start = performance.now(), before = draws.length;
          for (let time = 0; time < 2000 || draws.length < before + 3; time = performance.now() - start) {
            input.value = 0.5 + (time % 3000) / 10000;
            input.dispatchEvent(new Event("input"));
            await new Promise(requestAnimationFrame);
          }
          const made = draws.slice(before);
          return [made[0].time - start, made.map(({ isWhole }) => isWhole), performance.now() - start];
        })()"""
    )
    with capsys.disabled():
        print(f"\n{len(pictures)} pictures in {span / 1000:.1f} s, the first after {first:.0f} ms", end="")
    assert all(pictures)
    # A scenario that cannot be is told, and the state stays.
    slider = f"document.querySelector('[data-field=\"{HEIGHT}\"]')"
    tab.value(f"Object.assign({slider}, {{ min: 0, value: 0.001 }}).dispatchEvent(new Event('input'))")
    tab.wait_for("document.getElementById('problem').textContent.includes('release.position.z')")
    assert float(tab.value(f"{slider}.value")) == pytest.approx(0.40001)
    tab.wait_for(WHOLE)


@pytest.mark.parametrize("moving", [True, False])
def test_a_zoom_glides_where_one_likes_motion(page, lab_path, moving):
    page.call("Page.addScriptToEvaluateOnNewDocument", source=DRAWS)
    page.open(lab_path.as_uri(), width=420, height=1900, moving=moving)
    page.wait_for(WHOLE)
    page.value("document.getElementById('map').focus()")
    page.press("+")
    page.wait_for(f"draws.length > 1 && {WHOLE}")
    widths = np.array(page.value("draws[0].widths")) / (box(page, "map")[2] - 74 - 14)
    # What was seen before grows to twice its size.
    assert (widths[0], widths[-1]) == pytest.approx((1, 2))
    assert (np.diff(widths) >= -1e-9).all()
    assert ((widths > 1.001) & (widths < 1.999)).any() == moving


def test_the_depth_of_a_zoom_is_told(kept):
    asked = [[1, False], [0.5, False], [2, False], [0.0125, False], [1e-3, False], [3.2e-13, True]]
    told = kept.value(
        "import('live_map.js').then(({ depthText }) =>"
        f" {json.dumps(asked)}.map((given) => depthText(...given)))"
    )
    assert told == [
        "",
        "0.5 of the map",
        "2 of the map",
        "1.3e-2 of the map",
        "1e-3 of the map",
        "3.2e-13 of the map; doubles end here",
    ]


def test_a_server_is_asked_for_few_pixels_first(page):
    with serving(ServedLab(cointoss.load("fig24a"), 0, Device.CPU)) as lab:
        page.open(lab.url, width=420)
        page.wait_for(f"{ADDRESSED} && {WHOLE}")
        asked = [address for address in page.asked() if "map?" in address]
        sizes = [int(part.split("columns=")[1].split("&")[0]) for part in asked]
        assert sizes[0] < sizes[-1] / 2
