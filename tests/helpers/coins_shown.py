"""What a page shows of its coins, in a headless Chromium."""

import base64
import io

import numpy as np
from PIL import Image

UNNAMED = (
    "[...document.querySelectorAll('button, select, input, canvas, video, svg[role], [tabindex]')]"
    ".filter((one) => !(one.ariaLabel || one.textContent.trim() || one.labels?.length)).length"
)
"""How many controls, pictures and places of the keyboard have no name."""
NO_WEBGL = """
const own = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
  return kind.startsWith("webgl") ? null : own.call(this, kind, ...more);
};
"""
GOLD, BLUE = (245, 171, 31), (13, 92, 168)


def box(page, id_):
    return page.value(
        f"(() => {{ const b = document.getElementById('{id_}').getBoundingClientRect();"
        " return [b.left, b.top, b.width, b.height]; })()"
    )


def picture(page, id_):
    """Return what the window shows of an element, (height, width, 3)."""
    shot = Image.open(io.BytesIO(base64.b64decode(page.call("Page.captureScreenshot")["data"])))
    left, top, width, height = (round(part) for part in box(page, id_))
    return np.asarray(shot.convert("RGB"))[top : top + height, left : left + width]


def faces(coins):
    """Count the pixels in the colours of the coin's faces, below the labels."""
    shown = coins[48:].astype(int)
    return sum((np.abs(shown - color).max(axis=-1) <= 60).sum() for color in (GOLD, BLUE))


def set_time(page, time):
    """Move the slider of the time, when the coin is as released: it shows its face."""
    slider = "document.getElementById('time')"
    page.value(f"{slider}.value = {time}; {slider}.dispatchEvent(new Event('input'))")
