"""Write what docs/ holds that is made from other files, as `make pages` does: the pages of kept results."""

from pathlib import Path

from compare.output.files import written_together
from compare.reproduction import gallery, pages, runner
from compare.reproduction.claim import to_json

DOCS = Path(__file__).parents[1]


def write_results(out: Path) -> None:
    """Write the pages of all results that earlier runs left in a folder; compute nothing."""
    for name in runner.names():
        folder = runner.folder_of(name, out)
        if (folder / "claims.json").exists():
            result = runner.kept(name, out)
            with written_together(folder, ("claims.json", runner.PAGE, *runner.SHEETS)) as aside:
                (aside / "claims.json").write_text(to_json(result.claims), encoding="utf-8")
                pages.write(aside, name, runner.find(name), result)
            pages.write_blocks(out, name, result)
    gallery.write(out, gallery.of_paper(), quick=False)


if __name__ == "__main__":
    write_results(DOCS)
