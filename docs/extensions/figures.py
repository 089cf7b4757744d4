"""The figures of the site: each leads to itself at its full size, and has one for dark pages."""

import re
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from sphinx.application import Sphinx

from cointoss.models.palette import HEADS

GROUND, INK = 0.08, 0.92
"""Of dark figures: what stands for white, and what for black."""
COLOURED = 0.35
"""The highest channel of a colour less the lowest: from here on it stays as it is."""
MOST_PALE = 0.2
"""A figure of which a larger part is in pale colours or in photographs stays as it is, on a white card."""
SHOWN = re.compile(r'(<a [^>]*>\s*)?<img ([^>]*)src="((?:\.\./)*_images/([^"]+\.(?:png|svg)))"([^>]*)/>')
"""A figure in a page, with a link that it stands in."""


def darkened(colours: np.ndarray, least: float = 0.0) -> np.ndarray:
    """Return colours for a dark ground: greys change places, saturated colours stay.

    Args:
        colours: red, green and blue from 0 to 1, (..., 3).
        least: what the highest channel of a saturated colour is at least.
    """
    high, low = colours.max(-1, keepdims=True), colours.min(-1, keepdims=True)
    saturated = np.clip((high - low) / COLOURED, 0, 1)
    grey = GROUND + (INK - GROUND) * (1 - (high + low) / 2)
    return saturated * colours * np.maximum(1, least / np.maximum(high, 0.01)) + (1 - saturated) * grey


def is_pale(colours: np.ndarray) -> bool:
    """Return whether greys and saturated colours are too small a part of a picture."""
    saturated = (colours.max(-1) - colours.min(-1)) / COLOURED
    return float(np.mean((saturated > 0.03) & (saturated < 0.97))) > MOST_PALE


def dark_drawing(text: str) -> str:
    """Return an SVG for a dark ground; what names no colour in it is black."""
    named = text.replace('"white"', '"#ffffff"').replace('"black"', '"#000000"')
    filled = named.replace("<svg ", '<svg fill="#000000" ', 1)
    return re.sub(r"#[0-9a-f]{6}\b", lambda found: _dark_code(found[0]), filled)


def _dark_code(code: str) -> str:
    colour = darkened(np.array(list(bytes.fromhex(code[1:]))) / 255, least=0.9)
    return "#" + bytes(np.round(255 * colour).astype(int).tolist()).hex()


@cache
def made_dark(source: Path, target: Path) -> bool:
    """Write the dark one of a figure, and return whether it has one."""
    target.parent.mkdir(parents=True, exist_ok=True)
    if source.suffix == ".svg":
        text = source.read_text(encoding="utf-8")
        if HEADS.lower() in text:  # what is written on a coin is dark
            return False
        target.write_text(dark_drawing(text), encoding="utf-8")
        return True
    with Image.open(source) as picture:
        colours = np.asarray(picture.convert("RGB"), np.float32) / 255
    if is_pale(colours):
        return False
    Image.fromarray(np.round(255 * darkened(colours)).astype(np.uint8)).save(target)
    return True


def shown(app: Sphinx, _page: str, _template: str, context: dict[str, Any], _doctree: object) -> None:
    """Let each figure of a page lead to its full size, and put its dark one beside it."""
    sources = {name: Path(app.srcdir, source) for source, (_, name) in app.env.images.items()}

    def rewritten(found: re.Match[str]) -> str:
        link, before, address, name, after = found.groups()
        place = Path(name)
        dark = f"{place.stem}-dark{place.suffix}"
        both = made_dark(sources[name], Path(app.outdir, "_images", dark))
        schemes = {"only-light": address, "only-dark": address.replace(name, dark)}
        texts = []
        for kind, at in (schemes if both else {"card": address}).items():
            image = f'<img {before}src="{at}"{after} loading="lazy" '
            texts.append(
                f'{image}class="{kind}"/>' if link else f'<a class="figure {kind}" href="{at}">{image}/></a>'
            )
        return (link or "") + "".join(texts)

    if "body" in context:
        context["body"] = SHOWN.sub(rewritten, context["body"])


def setup(app: Sphinx) -> dict[str, bool]:
    """Connect to the pages as they are written."""
    app.connect("html-page-context", shown)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
