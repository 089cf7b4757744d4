"""Write what docs/ holds that is made of other files, as `make pages` does; nothing is computed."""

from collections.abc import Mapping
from pathlib import Path

import engines
import nbformat
import others
import pictures
from myst_nb.core.read import read_myst_markdown_notebook
from myst_nb.core.utils import coalesce_streams
from papers import DOCS

from cointoss.study import table, write_text, written_together
from cointoss_reproduction.frame import gallery, pages, runner
from cointoss_reproduction.frame.claim import to_json
from cointoss_reproduction.frame.files import PAGE, SHEETS, folder_of

SHOWN = ("text/plain", "image/png")
"""Kinds of data that notebooks are kept with: an interactive page would add megabytes."""


def write_blocks(folder: Path, blocks: Mapping[str, str]) -> None:
    """Write blocks of Markdown, by the names of their files, which pages include."""
    folder.mkdir(exist_ok=True)
    for name, block in blocks.items():
        write_text(folder / f"{name}.md", f"{block}\n")


def write_results(out: Path) -> None:
    """Write the pages of all results that earlier runs left in a folder; compute nothing."""
    for name in runner.names():
        folder = folder_of(name, out)
        if runner.is_whole(name, out):
            result = runner.kept(name, out)
            with written_together(folder, ("claims.json", PAGE, *SHEETS)) as aside:
                (aside / "claims.json").write_text(to_json(result.claims), encoding="utf-8")
                pages.write(aside, name, runner.find(name), result)
    gallery.write(out, gallery.of_paper(), quick=False)


def figures() -> str:
    """Return a picture of each figure of the paper, with a link to its page, three in a row."""
    cells = [
        f"[![{found.title}]({place}/figure.png)]({place}/{PAGE}) **{found.paper}:** {found.title}"
        for name in gallery.of_paper()
        for found, place in [(runner.find(name), folder_of(name, Path()).as_posix())]
    ]
    cells += [" "] * (-len(cells) % 3)
    return table([" "] * 3, zip(*[iter(cells)] * 3, strict=True), words=True)


def notebook_of(page: Path) -> nbformat.NotebookNode:
    """Return a page with cells of code as a notebook for Jupyter, with what its cells showed when run."""
    notebook = read_myst_markdown_notebook(page.read_text(encoding="utf-8"), path=page)
    del notebook.metadata["jupytext"]
    ran = {cell.source: cell for cell in nbformat.read(page.with_suffix(".ipynb"), as_version=4).cells}
    for number, cell in enumerate(notebook.cells):
        cell.id = f"cell-{number}"
        if cell.cell_type == "code":
            cell.outputs = coalesce_streams([shown(one) for one in ran.get(cell.source, cell).outputs])
    return notebook


def shown(output: nbformat.NotebookNode) -> nbformat.NotebookNode:
    """Return what a cell shows without data of other kinds than `SHOWN`."""
    data = {kind: data for kind, data in output.get("data", {}).items() if kind in SHOWN}
    return nbformat.from_dict(output | {"data": data}) if "data" in output else output


def write(docs: Path) -> None:
    """Write all of it."""
    write_results(docs)
    blocks = {"figures": figures()} | engines.blocks(docs) | others.blocks(docs)
    write_blocks(docs / "made", blocks)
    others.draw(docs)
    (docs / "automaton.svg").write_text(pictures.automaton(), encoding="utf-8")
    for page in (docs / "examples").glob("*.md"):
        nbformat.write(notebook_of(page), page.with_suffix(".ipynb"))


if __name__ == "__main__":
    write(DOCS)
