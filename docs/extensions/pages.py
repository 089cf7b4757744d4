"""Pages of docs/ as Sphinx must read them, where GitHub reads them as they are; the way back to the site."""

import re
from pathlib import Path

from sphinx.application import Sphinx

from cointoss_reproduction.frame import gallery, runner

BACK = '<a href="{}" style="display: block; padding: 0.5rem 1rem; color: inherit">← cointoss</a>'
"""The first line of a page that the site takes as it is."""
ANCHOR = re.compile(r'^(#+ )<a id="([\w-]+)"></a>', re.MULTILINE)
NOTEBOOK = re.compile(r"\[([^\]]+)\]\(([^)\s]+\.ipynb)\)")
"""A link that Sphinx would take for one to the page beside the notebook."""


def read(app: Sphinx, docname: str, source: list[str]) -> None:
    """Change the text of a page before it is parsed."""
    if docname == "OVERVIEW":
        path = Path(app.srcdir).parent / "README.md"
        app.env.note_dependency(str(path))
        source[0] = readme(path)
    if docname == "GALLERY":
        source[0] += cards()
    if docname == "REPRODUCTION":
        source[0] += contents()
    source[0] = NOTEBOOK.sub(r"{download}`\1 <\2>`", source[0])
    source[0] = ANCHOR.sub(r"(\2)=\n\1", source[0]).replace("](../README.md", "](OVERVIEW.md")


def readme(path: Path) -> str:
    """Return the README as the page "Overview", with its links as they are from docs/."""
    text = path.read_text(encoding="utf-8").replace("# cointoss\n", "# Overview\n", 1)
    return re.sub(r"\]\((?!https?:|#)(?!docs/)", "](../", text).replace("](docs/", "](")


def cards() -> str:
    """Return a card for each figure that was reproduced: its picture, with a link to its claims."""
    lines = ["", "::::{grid} 2 2 3 3", ":gutter: 2", ""]
    for name in gallery.of_paper():
        found = runner.find(name)
        lines += [
            f":::{{grid-item-card}} {found.paper}",
            f":img-top: reproduction/{name}/figure.png",
            f":img-alt: {found.paper}, {found.title}",
            f":link: {runner.folder_of(name, Path()).as_posix()}/index",
            ":link-type: doc",
            found.title,
            ":::",
        ]
    return "\n".join([*lines, "::::", ""])


def contents() -> str:
    """Return the contents of REPRODUCTION: a page for each figure."""
    names = (f"{runner.find(name).paper} <reproduction/{name}/index>" for name in gallery.of_paper())
    return "\n".join(["", "```{toctree}", ":hidden:", "", *names, "```", ""])


def write_gallery(app: Sphinx) -> None:
    """Write the gallery to project among the pages that the site takes as they are."""
    docs, made = Path(app.srcdir), Path(app.config.html_extra_path[0])
    made.mkdir(parents=True, exist_ok=True)
    shown = gallery.entries(docs, gallery.of_paper())
    (made / "gallery.html").write_text(gallery.html(docs, shown), encoding="utf-8")


def lead_back(app: Sphinx, error: Exception | None) -> None:
    """Begin each page that the site takes as it is with a link back."""
    for page in sorted(Path(app.outdir).glob("**/*.html")) if error is None else ():
        relative = page.relative_to(app.outdir)
        if (Path(app.config.html_extra_path[0]) / relative).exists():
            text = page.read_text(encoding="utf-8")
            top = f"{'../' * (len(relative.parts) - 1)}index.html"
            page.write_text(text.replace("<body>\n", f"<body>\n{BACK.format(top)}\n", 1), encoding="utf-8")


def setup(app: Sphinx) -> dict[str, bool]:
    """Connect to the reading of a page, and to the end."""
    app.connect("builder-inited", write_gallery)
    app.connect("source-read", read)
    app.connect("build-finished", lead_back)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
