"""README and the pages of docs/: their blocks of code, commands, and the answers that they show."""

import re
from dataclasses import dataclass
from math import isclose
from pathlib import Path

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
    """A block of code on a page: its language where a fence names one, its text, the paragraphs around."""

    language: str
    text: str
    above: str
    below: str

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


def shown_below(block: str, command: str) -> list[str]:
    """Return what a block shows of the answer to its only command."""
    if len(commands(block)) > 1:
        return []
    lines = joined(block).partition(command)[2].splitlines()[1:]
    return [line for line in lines if line.strip() and not line.strip().startswith(("...", "…", "#"))]


def not_answered(block: str, command: str, stdout: str) -> list[str]:
    """Return the lines that a block shows and the answer has not, numbers to a part in a thousand or 1e-9."""
    answer = [_words(line) for line in stdout.splitlines()]
    shown = shown_below(block, command)
    return [line for line in shown if not any(_is_same(_words(line), given) for given in answer)]


def not_printed(code: str, stdout: str) -> list[str]:
    """Return the comments behind a `print` in a block of Python that were not printed."""
    printed = [_words(line) for line in stdout.splitlines()]
    return [line for line in ANSWERED.findall(code) if _words(line) not in printed]


def _words(line: str) -> list[str]:
    return line.replace(",", "").split()


def _is_same(shown: list[str], given: list[str]) -> bool:
    return len(shown) == len(given) and all(
        a == b
        or (_is_number(a) and _is_number(b) and isclose(float(a), float(b), rel_tol=1e-3, abs_tol=1e-9))
        for a, b in zip(shown, given, strict=True)
    )


def _is_number(text: str) -> bool:
    return re.fullmatch(r"[-+]?\d+(\.\d*)?(e[-+]?\d+)?", text) is not None
