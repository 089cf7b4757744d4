"""README and the pages of docs/: their blocks of code, commands, and the answers that they show."""

import re
from collections.abc import Iterable
from contextlib import redirect_stdout
from dataclasses import dataclass, replace
from difflib import ndiff
from io import StringIO
from pathlib import Path
from typing import Any

TOP = Path(__file__).parents[2]
DOCS = TOP / "docs"
PAGES = [TOP / "README.md", *sorted(DOCS.glob("*.md")), *sorted(DOCS.glob("howto/*.md"))]
PLACEHOLDER = re.compile(r"\[|\.\.\.|\b(?![HT]+\b)[A-Z]{2,}\b(?![-.\w]*[a-z])")
"""What a line of a synopsis has and a command that can be run has not."""
NAMED = re.compile(r"\A# ([\w-]+\.\w+)(?::|$)", re.MULTILINE)
"""The first line of a block that names its file."""
ANSWERED = re.compile(r"^ *print\(.*\)  # (.*)$", re.MULTILINE)
"""A line of Python that prints, with its answer in the comment."""
SAVED = re.compile(r"\b[Ss]ave\b[^.:]*\bas `([\w-]+\.\w+)`[^`]*\Z")
"""The end of a paragraph that names the file of the block below."""


@dataclass(frozen=True)
class Block:
    """A block of code on a page: its language where a fence names one, its text, the paragraphs around.

    Of Python, `answer` is the block of output below it.
    """

    language: str
    text: str
    above: str
    below: str
    answer: str = ""

    @property
    def file(self) -> str | None:
        """The name of the file that a reader saves the block as, where the page names one."""
        found = NAMED.search(self.text) or (None if commands(self.text) else SAVED.search(self.above))
        return found[1] if found else None


def blocks(page: Path) -> list[Block]:
    """Return the blocks of code of a page in their order, fenced ones and indented ones."""
    found, lines = [], page.read_text(encoding="utf-8").splitlines()
    start = 0
    while start < len(lines):
        end, language = start + 1, ""
        if lines[start].startswith("```"):
            language = lines[start][3:].strip()
            end = lines.index("```", end) + 1
            code = lines[start + 1 : end - 1]
        elif lines[start].startswith("    "):
            while end < len(lines) and (lines[end].startswith("    ") or not lines[end]):
                end += 1
            code = [line[4:] for line in lines[start:end]]
        else:
            start = end
            continue
        above = "\n".join(lines[:start]).rstrip().rpartition("\n\n")[2]
        below = "\n".join(lines[end:]).lstrip().partition("\n\n")[0]
        if language == "text":
            last = max(number for number, block in enumerate(found) if block.language == "python")
            found[last] = replace(found[last], answer="\n".join(code))
        else:
            found.append(Block(language, "\n".join(code), above, below))
        start = end
    return found


def commands(text: str) -> list[str]:
    """Return the lines of a block that call `cointoss`, continued lines joined and comments left out."""
    called = re.findall(r"^(?:\$ )?(cointoss .*)$", joined(text), flags=re.MULTILINE)
    return [re.sub(r"\s+#.*$", "", line) for line in called]


def joined(text: str) -> str:
    """Return the text of a block with its continued lines joined."""
    return re.sub(r"\\\n\s*", "", text)


def is_synopsis(command: str) -> bool:
    """Return whether a command has a placeholder, so that nobody can run it as it is."""
    return PLACEHOLDER.search(command) is not None


def printed_by(code: str, names: dict[str, Any]) -> str:
    """Run Python with the names of the blocks above; return what it prints."""
    with redirect_stdout(StringIO()) as told:
        exec(compile(code, "page", "exec"), names)
    return told.getvalue()


def shown(block: Block, code: str) -> list[str]:
    """Return what a block shows of the answer to its only command, or of what its Python prints."""
    if block.language == "python":
        return ANSWERED.findall(code) + block.answer.splitlines()
    if len(commands(block.text)) > 1:
        return []
    lines = joined(block.text).partition(code)[2].splitlines()[1:]
    return [line for line in lines if line.strip() and not line.strip().startswith(("...", "…", "#"))]


def not_answered(block: Block, code: str, stdout: str) -> list[str]:
    """Return the `departures` of what a block shows from the answer.

    Of a command's answer a page may show some lines, of what Python prints all or nothing.
    """
    lines = shown(block, code)
    departs = "-+" if block.language == "python" else "-"
    return [line for line in departures(lines, stdout) if lines and line[0] in departs]


def departures(lines: Iterable[str], answer: str) -> list[str]:
    """Return where lines depart from an answer: "- " a line that it has not, "+ " one that is not shown."""
    compared = ndiff([line.rstrip() for line in lines], [line.rstrip() for line in answer.splitlines()])
    return [line for line in compared if line[0] in "-+"]
