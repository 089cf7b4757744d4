"""What the pages of a built site link to, load and describe, and what is wrong with them."""

import re
from dataclasses import dataclass, field
from html.parser import HTMLParser
from io import BytesIO
from pathlib import Path
from urllib.parse import unquote, urlsplit

import numpy as np
from PIL import Image

from cointoss.models.fields import FIELDS
from cointoss.models.palette import HEADS, TAILS
from tests.helpers.pages import TOP

SITE = TOP / "out" / "site"
"""As `make docs` builds it."""
LOADED = {
    "audio": ("src",),
    "embed": ("src",),
    "iframe": ("src",),
    "img": ("src", "srcset"),
    "input": ("src",),
    "link": ("href",),
    "object": ("data",),
    "script": ("src",),
    "source": ("src", "srcset"),
    "video": ("src", "poster"),
}
"""Elements that load what an attribute names, without a click."""
LINKED = {"a": ("href",), "area": ("href",), "form": ("action",), **LOADED}
ADDRESS_IN_STYLE = re.compile(r"""(?:url\(\s*|@import\s+)["']?([^"')\s]+)""")
ELSEWHERE = re.compile(r"(?i)https?:|//")


@dataclass
class Read(HTMLParser):
    """A page: its anchors, the addresses it links to, those it loads, and its pictures without words."""

    anchors: set[str] = field(default_factory=set)
    linked: list[str] = field(default_factory=list)
    loaded: list[str] = field(default_factory=list)
    wordless: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Make the parser."""
        super().__init__()
        self._in_style = False

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note what an element names."""
        given = {name: value or "" for name, value in attrs}
        self._in_style = tag == "style"
        self.anchors |= {given[name] for name in ("id", "name") if name in given}
        for name in LINKED.get(tag, ()):
            if name in given:
                (self.loaded if tag in LOADED else self.linked).append(given[name].partition(" ")[0])
        self.loaded += ADDRESS_IN_STYLE.findall(given.get("style", ""))
        # Sphinx writes the file's name where a page gives no words.
        if tag == "img" and given.get("alt", "").strip() in ("", given.get("src")):
            self.wordless.append(given.get("src", ""))

    def handle_data(self, data: str) -> None:
        """Note what a style sheet in the page names."""
        if self._in_style:
            self.loaded += ADDRESS_IN_STYLE.findall(data)


def shows_a_map(picture: bytes) -> bool:
    """Return whether a PNG has much of the color of heads and of that of tails."""
    with Image.open(BytesIO(picture)) as opened:
        pixels = np.asarray(opened.convert("RGB"), int)
    faces = [np.array(list(bytes.fromhex(color[1:]))) for color in (HEADS, TAILS)]
    return all((abs(pixels - face).max(axis=-1) < 8).mean() > 0.02 for face in faces)


def read(page: Path) -> Read:
    """Return what a page names."""
    found = Read()
    found.feed(page.read_text(encoding="utf-8"))
    found.close()
    return found


def problems(site: Path) -> list[str]:
    """Return what is wrong with the pages and style sheets of a site, one line each.

    A relative address must lead to a file, and to an anchor of it, or of the lab to fields; what is loaded
    must be of the site or in the page; an address elsewhere must be one by its form; and a picture must be
    described.
    """
    pages = {path: read(path) for path in sorted(site.rglob("*.html"))}
    found = []
    for path, page in pages.items():
        told = [_of_link(path, address, pages) for address in page.linked]
        told += [_of_load(path, address, pages) for address in page.loaded]
        told += [f"{picture[:80]} has no alt" for picture in page.wordless]
        found += [f"{path.relative_to(site)}: {problem}" for problem in told if problem]
    for path in sorted(site.rglob("*.css")):
        named = ADDRESS_IN_STYLE.findall(path.read_text(encoding="utf-8"))
        told = [_of_load(path, address, pages) for address in named]
        found += [f"{path.relative_to(site)}: {problem}" for problem in told if problem]
    return found


def _of_load(source: Path, address: str, pages: dict[Path, Read]) -> str:
    """Return what is wrong with an address that a file loads; empty where nothing is."""
    return f"loads {address}" if ELSEWHERE.match(address) else _of_link(source, address, pages)


def _of_link(source: Path, address: str, pages: dict[Path, Read]) -> str:
    """Return what is wrong with an address that a file names; empty where nothing is."""
    parts = urlsplit(address)
    if parts.scheme in ("data", "mailto"):
        return ""
    if parts.scheme or parts.netloc:
        whole = parts.scheme in ("http", "https") and "." in parts.netloc and " " not in address
        return "" if whole else f"{address} is no address"
    target = (source.parent / unquote(parts.path)).resolve() if parts.path else source
    if not target.is_file():
        return f"{address} leads nowhere"
    anchor = unquote(parts.fragment)
    if target.name == "lab.html" and "=" in anchor:
        named = {part.partition("=")[0] for part in anchor.split("&")}
        return "" if named <= {*FIELDS, "map"} else f"{address} has no such field"
    if anchor and target in pages and anchor not in pages[target].anchors:
        return f"{address} has no such anchor"
    return ""
