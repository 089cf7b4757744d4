"""Count the words of prose in README and on the pages of docs/, without tables, code and what tools write."""

import re
from pathlib import Path

DOCS = Path(__file__).parents[1]
USERS = ("README.md", "TUTORIAL.md", "COMMANDS.md", "SCENARIO.md", "PYTHON.md", "MUJOCO.md", "howto/*.md")
"""The pages that a user reads; of PREDICTABILITY too the part above its first section."""
FIRST_SCREEN = "PREDICTABILITY.md"
MOST_OF_USERS, MOST = 12_000, 32_000
"""Words of the pages for users, and of all below docs/."""
LEFT_OUT = (
    r"\A---\n[\s\S]*?\n---\n",  # what a page sets
    r"^(`{3,}|:{3,})[\s\S]*?^\1$",  # code, and directives
    r"<!--[\s\S]*?-->",
    r"<[^<>]*>",
    r"^\|.*$",
    r"^(?: {4,}|\t)\S.*$",
    r"\]\([^)]*\)",
)


def prose(page: str) -> str:
    """Return the prose of a page of Markdown, with its headings and the texts of its links."""
    for pattern in LEFT_OUT:
        page = re.sub(pattern, " ", page, flags=re.MULTILINE)
    return page


def words(page: str) -> int:
    """Return how many words of prose a page of Markdown has: what holds a letter or a digit."""
    return sum(re.search(r"\w", word) is not None for word in prose(page).split())


def counted(docs: Path) -> dict[Path, int]:
    """Return the words of README and of each page below docs/ that a person wrote."""
    pages = [docs.parent / "README.md", *sorted(docs.rglob("*.md"))]
    return {
        page: words(page.read_text(encoding="utf-8"))
        for page in pages
        if not {"made", "reproduction"} & set(page.parts)
    }


def of_users(docs: Path) -> dict[Path, int]:
    """Return the words of the pages for users."""
    first = (docs / FIRST_SCREEN).read_text(encoding="utf-8").partition("\n## ")[0]
    pages = {page for name in USERS for page in [*docs.glob(name), *docs.parent.glob(name)]}
    return {page: n for page, n in counted(docs).items() if page in pages} | {
        docs / FIRST_SCREEN: words(first)
    }


if __name__ == "__main__":
    for title, pages, most in (
        ("pages for users", of_users(DOCS), MOST_OF_USERS),
        ("all below docs/", {page: n for page, n in counted(DOCS).items() if DOCS in page.parents}, MOST),
    ):
        print(f"{title}: {sum(pages.values()):,} words of at most {most:,}")
        for page, count in pages.items():
            print(f"{count:7,}  {page.relative_to(DOCS.parent)}")
