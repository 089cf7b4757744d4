"""Fill the numbers into the papers of docs/paper/ and set them as PDF, as `make paper` does."""

import re
import shutil
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from cointoss.study import Estimate, in_words
from cointoss_reproduction.frame import gallery
from cointoss_reproduction.frame.claim import VERDICTS, Criterion, read_claims
from cointoss_reproduction.frame.files import folder_of
from cointoss_reproduction.frame.pages import verdicts_of

TOP = Path(__file__).parents[2]
DOCS = TOP / "docs"
PAPER = DOCS / "paper"
BINDINGS = tomllib.loads((PAPER / "numbers.toml").read_text(encoding="utf-8"))
"""Where each number is, by its name."""
PLACE = re.compile(r"\{\{([\w-]+)( value)?\}\}")
"""Where a number goes: its name, and `value` where its interval is left out."""
POWERS = {"article.typ": "10#super[{}]", "joss.md": "10^{}^"}
"""How each paper writes a power of ten."""


class BindingError(ValueError):
    """A number that is not, or not once, where docs/paper/numbers.toml says."""


def number(name: str, binding: Mapping[str, Any]) -> str:
    """Return a number, with its interval as a reader sees it, or a verdict, from where its binding says.

    Raises:
        BindingError: naming the number and what was not found.
    """
    try:
        found = _found(binding)
    except (OSError, LookupError, ValueError) as error:
        raise BindingError(f"{name}: {error}") from error
    if isinstance(found, str):
        return found
    if "as" not in binding:
        return Criterion("", found, "=", 0, "").value
    return in_words(found, binding["as"]) if isinstance(found, Estimate) else f"{found:{binding['as']}}"


def _found(binding: Mapping[str, Any]) -> str | float | Estimate:
    if "count" in binding:
        read = (read_claims(folder_of(name, DOCS) / "claims.json") for name in gallery.of_paper())
        claims = [claim for all_of_one in read for claim in all_of_one if not claim.regression]
        return f"{len(claims):,d}" if binding["count"] == "claims" else verdicts_of(claims)
    folder = folder_of(binding["of"], DOCS)
    if "table" in binding:
        return _cell(folder / f"table-{binding['table']}.csv", binding["row"], binding["column"])
    claim = the_one(read_claims(folder / "claims.json"), "claim", binding["claim"])
    if "told" in binding:
        text = getattr(claim, binding["told"])
        if not (picked := re.search(binding["pick"], text)):
            raise BindingError(f"no {binding['pick']!r} in {text!r}")
        return picked[1].strip()
    if "quantity" in binding:
        # An estimate is shifted by what is taken from it.
        return the_one(claim.criteria, "quantity", binding["quantity"]).measured - -binding.get("plus", 0)
    return VERDICTS[claim.holds]


def the_one(among: Iterable[Any], part: str, words: str) -> Any:
    """Return the only one whose part has these words; where its part is these words, others do not count.

    Raises:
        BindingError: where there is none, or more than one.
    """
    found = {getattr(one, part): one for one in among if words in getattr(one, part)}
    if words not in found and len(found) != 1:
        raise BindingError(f"{len(found)} with {part} {words!r}, not 1")
    return found[words] if words in found else next(iter(found.values()))


def _cell(path: Path, row: Sequence[str], column: str) -> str:
    """Return what a table has in a column and the row that begins so, with its interval where it has one."""
    table = pd.read_csv(path, dtype=str, keep_default_na=False)
    found = table[(table.iloc[:, : len(row)] == list(row)).all(axis=1)].to_dict("records")
    if len(found) != 1 or column not in table.columns:
        raise BindingError(f"{path.name}: no one row {', '.join(row)!r} with a column {column!r}")
    name, bracket, unit = column.partition(" [")
    ends = [found[0].get(f"{name}, {end}{bracket}{unit}") for end in ("low", "high")]
    interval = f" [{ends[0]}, {ends[1]}]" if all(ends) else ""
    return f"{found[0][column]}{' %' if '%' in unit else ''}{interval}"


def filled(name: str) -> str:
    """Return the source of a paper with its numbers in their places, powers of ten as it writes them.

    Raises:
        BindingError: for a name that has no number, or more than one.
    """

    def place(found: re.Match[str]) -> str:
        if found[1] not in BINDINGS:
            raise BindingError(f"{found[1]}: not in docs/paper/numbers.toml")
        words = number(found[1], BINDINGS[found[1]])
        words = (words.partition(" [")[0] if found[2] else words).replace(" %", "%")
        return re.sub(r"\b([\d.]+)e([+-]\d+)\b", written, words)

    def written(found: re.Match[str]) -> str:
        ten = POWERS[name].format(int(found[2]))
        return ten if found[1] == "1" else f"{found[1]}\N{NO-BREAK SPACE}×\N{NO-BREAK SPACE}{ten}"

    return PLACE.sub(place, (PAPER / name).read_text(encoding="utf-8"))


def write(out: Path) -> list[Path]:
    """Write both papers, and what JOSS takes, into a folder within the tree; return the paths of the PDFs."""
    import pypandoc
    import typst

    out.mkdir(parents=True, exist_ok=True)
    (out / "paper.md").write_text(filled("joss.md"), encoding="utf-8")
    shutil.copy(PAPER / "references.bib", out)
    (out / "article.typ").write_text(filled("article.typ"), encoding="utf-8")
    template = f"--template={PAPER / 'joss.typ'}"
    pypandoc.convert_file(
        out / "paper.md", "typst", format="markdown", outputfile=out / "joss.typ", extra_args=[template]
    )
    pdfs = [out / "article.pdf", out / "joss.pdf"]
    for pdf in pdfs:
        typst.compile(pdf.with_suffix(".typ"), output=pdf, root=TOP, ignore_system_fonts=True)
    return pdfs


if __name__ == "__main__":
    for paper in write(TOP / "out" / "paper"):
        print(paper.relative_to(TOP))
