"""Pages of docs/ as Sphinx must read them, where GitHub reads them as they are; the way back to the site."""

import re
from pathlib import Path

from sphinx.application import Sphinx

from cointoss_reproduction.frame import gallery, runner

BACK = (
    '<a href="{}index.html" style="display: block; padding: 0.5rem 1rem; color: inherit">← cointoss</a>'
    "<script>if (self !== top) document.currentScript.previousSibling.remove()</script>"
)
"""The first line of a page that the site takes as it is, but for a page that shows it in a frame."""
NOTEBOOK = re.compile(r"\[([^\]]+)\]\(([^)\s]+\.ipynb)\)")
"""A link that Sphinx would take for one to the page beside the notebook."""


def read(_app: Sphinx, docname: str, source: list[str]) -> None:
    """Change the text of a page before it is parsed; the page of verdicts gets all figures and studies."""
    text = NOTEBOOK.sub(r"{download}`\1 <\2>`", source[0]).replace("](../README.md", "](OVERVIEW.md")
    if docname == "REPRODUCTION":
        places = {name: runner.find(name).paper for name in gallery.of_paper()}
        places |= {name: f"Study {name}" for name in runner.names() if name not in places}
        names = [f"{place} <reproduction/{name}/index>" for name, place in places.items()]
        text = "\n".join([text, "```{toctree}", ":hidden:", "", *names, "```", ""])
    source[0] = text


def lead_back(app: Sphinx, error: Exception | None) -> None:
    """Write the gallery to project; it and each page that the site takes as it is begin with a link back."""
    docs, made, site = map(Path, (app.srcdir, app.config.html_extra_path[0], app.outdir))
    if error is None:
        taken = {page.relative_to(made): page.read_text(encoding="utf-8") for page in made.glob("**/*.html")}
        taken[Path("gallery.html")] = gallery.html(docs, gallery.entries(docs, gallery.of_paper()))
        for place, text in taken.items():
            back = BACK.format("../" * len(place.parents[1:]))
            shown = text.replace("<body>\n", f"<body>\n{back}\n", 1)
            (site / place).write_text(shown, encoding="utf-8")


def setup(app: Sphinx) -> dict[str, bool]:
    """Connect to the reading of a page, and to the end."""
    app.connect("source-read", read)
    app.connect("build-finished", lead_back)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
