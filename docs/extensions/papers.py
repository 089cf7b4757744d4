"""Fill the numbers into the papers of docs/paper/ and set them as PDF, as `make paper` does."""

import csv
import json
import re
import shutil
import sys
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from cointoss.compare.metrics.estimate import Estimate
from cointoss.compare.metrics.estimates import in_words
from cointoss_reproduction.frame import gallery
from cointoss_reproduction.frame.claim import VERDICTS, Claim, Criterion, read_claims
from cointoss_reproduction.frame.pages import verdicts_of
from cointoss_reproduction.frame.result import folder_of

TOP = Path(__file__).parents[2]
DOCS = TOP / "docs"
PAPER = DOCS / "paper"
PLACE = re.compile(r"\{\{([\w-]+)( value)?\}\}")
"""Where a number goes: its name, and `value` where its interval is left out."""


class BindingError(ValueError):
    """A number that is not, or not once, where docs/paper/numbers.toml says."""


@dataclass(frozen=True)
class Number:
    """A number of a paper, or a verdict."""

    of: str
    """What `cointoss reproduce` calls the run that found it; empty where all claims are counted."""
    value: float | None
    """It alone; None where it is words."""
    words: str
    """As a reader sees it, with its interval."""


def bindings() -> dict[str, dict[str, Any]]:
    """Return what docs/paper/numbers.toml says of each number, by its name."""
    return tomllib.loads((PAPER / "numbers.toml").read_text(encoding="utf-8"))


def number(name: str, binding: Mapping[str, Any], docs: Path = DOCS) -> Number:
    """Return a number from where its binding says it is.

    Raises:
        BindingError: naming the number and what was not found.
    """
    try:
        found = _found(binding, docs)
    except (OSError, LookupError, ValueError) as error:
        raise BindingError(f"{name}: {error}") from error
    of = binding.get("of", "")
    if isinstance(found, str):
        leading = re.match(r"[-+\d.e]+(?=[ %]|$)", found)
        return Number(of, float(leading[0]) if leading else None, found)
    return Number(of, found.value if isinstance(found, Estimate) else float(found), _words(found, binding))


def _found(binding: Mapping[str, Any], docs: Path) -> str | float | Estimate:
    if "count" in binding:
        named = [folder_of(name, docs) for name in gallery.of_paper()]
        claims = [
            claim for folder in named for claim in read_claims(folder / "claims.json") if not claim.regression
        ]
        return f"{len(claims):,d}" if binding["count"] == "claims" else verdicts_of(claims)
    folder = folder_of(binding["of"], docs)
    if "table" in binding:
        return _cell(folder / f"table-{binding['table']}.csv", binding["row"], binding["column"])
    if "number" in binding:
        found = json.loads((folder / "numbers.json").read_text(encoding="utf-8"))
        for key in binding["number"]:
            found = found[key]
        found = Estimate(**found) if isinstance(found, dict) else found
    else:
        found = _of_claim(_one(read_claims(folder / "claims.json"), "claim", binding["claim"]), binding)
    if isinstance(found, str):
        return found
    # An Estimate is shifted by what is taken from it.
    return (found - -binding.get("plus", 0)) * binding.get("times", 1)


def _of_claim(claim: Claim, binding: Mapping[str, Any]) -> str | float | Estimate:
    if "told" in binding:
        text = getattr(claim, binding["told"])
        picked = re.search(binding["pick"], text)
        if not picked:
            raise BindingError(f"no {binding['pick']!r} in {text!r}")
        return picked[1].strip()
    if "quantity" in binding:
        return _one(claim.criteria, "quantity", binding["quantity"]).measured
    return VERDICTS[claim.holds]


def _one(among: Iterable[Any], part: str, words: str) -> Any:
    """Return the only one whose part has these words; where its part is these words, others do not count."""
    found = {getattr(one, part): one for one in among if words in getattr(one, part)}
    if words not in found and len(found) != 1:
        raise BindingError(f"{len(found)} with {part} {words!r}, not 1")
    return found[words] if words in found else next(iter(found.values()))


def _cell(path: Path, row: str, column: str) -> str:
    """Return what a table has in a row and a column, with its interval where columns beside it have one."""
    with path.open(encoding="utf-8", newline="") as opened:
        heading, *rows = csv.reader(opened)
    values = next((dict(zip(heading, cells, strict=True)) for cells in rows if cells[0] == row), None)
    if values is None or column not in values:
        raise BindingError(f"{path.name}: no row {row!r} with a column {column!r}")
    name, bracket, unit = column.partition(" [")
    sign = " %" if "%" in unit else ""
    ends = [values.get(f"{name}, {end}{bracket}{unit}") for end in ("low", "high")]
    return f"{values[column]}{sign}" + (f" [{ends[0]}, {ends[1]}]" if all(ends) else "")


def _words(found: float | Estimate, binding: Mapping[str, Any]) -> str:
    if "as" not in binding:
        return Criterion("", found, "=", 0, "").value
    return in_words(found, binding["as"]) if isinstance(found, Estimate) else f"{found:{binding['as']}}"


def filled(source: str, power: str) -> str:
    """Return a source with its numbers in their places.

    Args:
        source: of a paper.
        power: how the source writes a power of ten, as in "10^({})".

    Raises:
        BindingError: for a name that has no number, or more than one.
    """
    known = bindings()

    def place(found: re.Match[str]) -> str:
        if found[1] not in known:
            raise BindingError(f"{found[1]}: not in docs/paper/numbers.toml")
        words = number(found[1], known[found[1]]).words
        return _set(words.partition(" [")[0] if found[2] else words, power)

    return PLACE.sub(place, source)


def _set(words: str, power: str) -> str:
    """Return words as they are set: 1.2e-05 with a power of ten, and no space before a per cent sign."""

    def written(found: re.Match[str]) -> str:
        ten = power.format(int(found[2]))
        return ten if found[1] == "1" else f"{found[1]}\N{NO-BREAK SPACE}×\N{NO-BREAK SPACE}{ten}"

    return re.sub(r"\b([\d.]+)e([+-]\d+)\b", written, words.replace(" %", "%"))


def article() -> str:
    """Return the article in Typst, with its numbers."""
    return filled((PAPER / "article.typ").read_text(encoding="utf-8"), "10#super[{}]")


def joss() -> str:
    """Return the JOSS paper in Markdown, with its numbers, as it is submitted."""
    return filled((PAPER / "joss.md").read_text(encoding="utf-8"), "10^{}^")


def joss_in_typst(markdown: str) -> str:
    """Return the JOSS paper in Typst, as a preview of what JOSS makes of it.

    Headings, paragraphs, lists, emphasis, code, links, superscripts and citations are known; anything else is
    an error.
    """
    from markdown_it import MarkdownIt
    from yaml import safe_load

    _, head, body = re.split(r"^---\n", markdown, maxsplit=2, flags=re.MULTILINE)
    told = safe_load(head)
    title, tags = (
        json.dumps(words, ensure_ascii=False) for words in (told["title"], ", ".join(told["tags"]))
    )
    opening = [
        '#import "/docs/paper/style.typ": paper',
        f'#show: paper.with(title: {title}, kind: "Paper for the Journal of Open Source Software",',
        f"  keywords: {tags})",
    ]
    lists = 0
    blocks = ["\n".join(opening)]
    for token in MarkdownIt("commonmark").parse(body):
        match token.type:
            case "heading_open":
                blocks.append("=" * int(token.tag[1:]) + " ")
            case "paragraph_open":
                blocks.append("  " * (lists - 1) + "- " if lists else "")
            case "inline":
                blocks[-1] += "".join(map(_inline, token.children or []))
            case "bullet_list_open":
                lists += 1
            case "bullet_list_close":
                lists -= 1
            case "heading_close" | "paragraph_close" | "list_item_open" | "list_item_close":
                pass
            case kind:
                raise BindingError(f"joss.md: {kind} is not known here")
    if blocks[-1].strip() == "= References":
        blocks.pop()
    bibliography = f'#bibliography("/docs/paper/{told["bibliography"]}", title: "References", style: "apa")'
    return "\n\n".join([*blocks, bibliography]) + "\n"


_MARKS = {
    "em_open": "#emph[",
    "em_close": "]",
    "strong_open": "#strong[",
    "strong_close": "]",
    "softbreak": "\n",
}


def _inline(token: Any) -> str:
    if token.type in _MARKS:
        return _MARKS[token.type]
    match token.type:
        case "text":
            return _cited(re.sub(r"([\\#$*_@<>\[\]~`;]|/(?=/))", r"\\\1", token.content))
        case "code_inline":
            return f"#raw({json.dumps(token.content, ensure_ascii=False)})"
        case "link_open":
            return f"#link({json.dumps(token.attrs['href'])})["
        case "link_close":
            return "]"
        case kind:
            raise BindingError(f"joss.md: {kind} is not known here")


def _cited(text: str) -> str:
    """Return escaped text with its citations and superscripts as Typst has them."""

    def group(found: re.Match[str]) -> str:
        return "".join(f"#cite(<{key}>)" for key in re.findall(r"\\@([\w-]+)", found[0]))

    text = re.sub(r"\\\[\\@[^\]]*\\\]", group, text)
    text = re.sub(r"\\@([\w-]+)", r'#cite(<\1>, form: "prose")', text)
    return re.sub(r"\^([^\s^]+)\^", r"#super[\1]", text)


def set_pdf(name: str, source: str, out: Path) -> Path:
    """Write a paper's source and its PDF into a folder within the tree, and return the path of the PDF."""
    import typst

    out.mkdir(parents=True, exist_ok=True)
    (out / f"{name}.typ").write_text(source, encoding="utf-8")
    pdf = out / f"{name}.pdf"
    typst.compile(str(out / f"{name}.typ"), output=str(pdf), root=str(TOP), ignore_system_fonts=True)
    return pdf


def write(out: Path) -> list[Path]:
    """Write both papers, and what JOSS takes, into a folder within the tree; return the paths of the PDFs."""
    text = joss()
    pdfs = [set_pdf("article", article(), out), set_pdf("joss", joss_in_typst(text), out)]
    (out / "paper.md").write_text(text, encoding="utf-8")
    shutil.copy(PAPER / "references.bib", out)
    return pdfs


if __name__ == "__main__":
    for written in write(TOP / "out" / "paper"):
        print(written.relative_to(TOP), file=sys.stdout)
