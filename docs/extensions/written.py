"""Write what docs/ holds that is made of other files, as `make pages` does; nothing is computed."""

from pathlib import Path

import benchmarks
import engines
import house
import modes
import nbformat
from myst_nb.core.read import read_myst_markdown_notebook

from cointoss.compare.output.files import written_together
from cointoss_reproduction.frame import gallery, pages, runner
from cointoss_reproduction.frame.claim import to_json
from cointoss_reproduction.frame.result import PAGE, SHEETS, folder_of

DOCS = Path(__file__).parents[1]


def write_results(out: Path) -> None:
    """Write the pages of all results that earlier runs left in a folder; compute nothing."""
    for name in runner.names():
        folder = folder_of(name, out)
        if (folder / "claims.json").exists():
            result = runner.kept(name, out)
            with written_together(folder, ("claims.json", PAGE, *SHEETS)) as aside:
                (aside / "claims.json").write_text(to_json(result.claims), encoding="utf-8")
                pages.write(aside, name, runner.find(name), result)
            pages.write_blocks(out, name, result)
    gallery.write(out, gallery.of_paper(), quick=False)


def notebook_of(page: Path) -> str:
    """Return a page with cells of code as a notebook for Jupyter, without what its cells show."""
    notebook = read_myst_markdown_notebook(page.read_text(encoding="utf-8"), path=page)
    del notebook.metadata["jupytext"]
    for number, cell in enumerate(notebook.cells):
        cell.id = f"cell-{number}"
    return nbformat.writes(notebook) + "\n"


def write_notebooks(examples: Path) -> None:
    """Write a notebook for Jupyter beside each page in a folder."""
    for page in examples.glob("*.md"):
        page.with_suffix(".ipynb").write_text(notebook_of(page), encoding="utf-8")


if __name__ == "__main__":
    write_results(DOCS)
    engines.write(DOCS)
    benchmarks.write(DOCS)
    write_notebooks(DOCS / "examples")
    (DOCS / "house.svg").write_text(house.house(DOCS.parent), encoding="utf-8")
    (DOCS / "automaton.svg").write_text(modes.automaton(), encoding="utf-8")
