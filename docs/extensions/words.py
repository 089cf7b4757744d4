"""Count the words of prose in README and on the pages of docs/, without tables, code and what tools write."""

import re
from pathlib import Path

DOCS = Path(__file__).parents[1]
USERS = ("README.md", "TUTORIAL.md", "COMMANDS.md", "SCENARIO.md", "PYTHON.md", "MUJOCO.md")
"""The pages for users, with the how-tos, and with the part of PREDICTABILITY above its first section."""
MOST = {"pages for users": 12_000, "all below docs/": 32_000}
LEFT_OUT = re.compile(
    r"\A---\n[\s\S]*?\n---\n"  # what a page sets
    r"|^(`{3,}|:{3,})[\s\S]*?^\1$"  # code, and directives
    r"|<!--[\s\S]*?-->|</?\w[^<>]*>|^\|.*$|^(?: {4,}|\t)\S.*$|\]\([^)]*\)",
    re.MULTILINE,
)


def words(page: str) -> int:
    """Return how many words with a letter or a digit the prose of a page has, headings and links included."""
    return sum(any(map(str.isalnum, word)) for word in LEFT_OUT.sub(" ", page).split())


def counted(docs: Path) -> dict[str, dict[str, int]]:
    """Return the words of each page that a person wrote: of those for users, and of all below docs/."""
    pages = {
        page.relative_to(docs).as_posix(): page.read_text(encoding="utf-8") for page in docs.rglob("*.md")
    }
    own = {
        name: text for name, text in sorted(pages.items()) if not name.startswith(("made/", "reproduction/"))
    }
    users = {"README.md": (docs.parent / "README.md").read_text(encoding="utf-8")}
    users |= {name: text for name, text in own.items() if name in USERS or name.startswith("howto/")}
    users["PREDICTABILITY.md"] = own["PREDICTABILITY.md"].partition("\n## ")[0]
    both = zip(MOST, (users, own), strict=True)
    return {title: {name: words(text) for name, text in texts.items()} for title, texts in both}


if __name__ == "__main__":
    for title, pages in counted(DOCS).items():
        print(f"{title}: {sum(pages.values()):,} words of at most {MOST[title]:,}")
        print(*(f"{count:7,}  {name}" for name, count in pages.items()), sep="\n")
