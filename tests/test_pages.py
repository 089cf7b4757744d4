"""README and the pages of docs/: what they ask of the command line and name of the code is there."""

import re
import shlex
import sys
from importlib import import_module
from itertools import pairwise

import click
import pytest

import cointoss as package
import cointoss_bounce
import cointoss_yardstick
from cointoss.compare.cli import COMMANDS, OF_OTHERS, main
from cointoss.models.reading import parse
from tests.helpers.command_line import printed
from tests.helpers.pages import (
    DOCS,
    PAGES,
    TOP,
    blocks,
    commands,
    is_synopsis,
    not_answered,
)

sys.path.append(str(DOCS / "extensions"))
counting, examples = (import_module(name) for name in ("words", "examples"))
NOTEBOOKS = sorted(DOCS.glob("examples/*.md"))
WRITES = ("--out", "--png", "--static", "--report", "--poster", "--trajectory", "--gltf")
"""Options that name what a command writes."""


def subcommand(word: str) -> click.Command:
    found = main.get_command(click.Context(main), word)
    assert found is not None
    return found


def options(command: click.Command) -> set[str]:
    return {"--help"} | {
        name for parameter in command.params for name in parameter.opts if name.startswith("--")
    }


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_what_make_docs_does_not_run_of_a_page_is_known_and_its_scenarios_are_read(page):
    """Synopses, commands that take long, and scenarios."""
    for block in blocks(page):
        for command in commands(block.text):
            if is_synopsis(command) or examples.reason(page, command):
                known = options(subcommand(shlex.split(command)[1]))
                assert set(re.findall(r"--[a-z-]+", command)) <= known, command
        if "[coin]" in block.text and "[release]" in block.text and block.language in ("", "toml"):
            assert parse(block.text, page.name).coin.mass > 0


def test_each_command_of_the_pages_writes_to_a_name_of_its_own():
    """Followed one after the other in one folder, no command is refused what another has written."""
    named = []
    for page in PAGES:
        for block in blocks(page):
            for command in commands(block.text):
                words = shlex.split(command)
                if not is_synopsis(command) and words[1] != "reproduce":
                    named += [new for option, new in pairwise(words) if option in WRITES]
    assert len(named) > 8
    assert sorted(named) == sorted(set(named))


def test_long_tables_of_numbers_are_folded():
    """All but the table of verdicts, which is the contents of its pages."""
    found = []
    for page in sorted(set(DOCS.rglob("*.md")) - set(DOCS.glob("made/*.md"))):
        whole = re.sub(
            r"^```\{include\} (made/\w+\.md)\n```$",
            lambda found: (DOCS / found[1]).read_text(encoding="utf-8"),
            page.read_text(encoding="utf-8"),
            flags=re.MULTILINE,
        )
        text = re.sub(r"<details>.*?</details>", "", whole, flags=re.DOTALL)
        for rows in re.findall(r"^\|[ |:-]+\|\n((?:\|.*\n){6,})", text, re.MULTILINE):
            cells = [cell for row in rows.splitlines() for cell in row.split("|")[2:-1]]
            numbers = [cell for cell in cells if re.match(r"\s*-?\d", cell)]
            found += [page.name] if len(numbers) > len(cells) / 5 else []
    assert found == ["REPRODUCTION.md"]


@pytest.mark.parametrize("shelf", counting.MOST)
def test_the_pages_have_no_more_words_than_a_reader_has_patience_for(shelf):
    assert sum(counting.counted(DOCS)[shelf].values()) <= counting.MOST[shelf]


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda page: page.stem)
def test_a_notebook_has_code_that_parses_and_ends_with_exercises_and_solutions(notebook):
    """`make docs` runs them; a cell may begin with options between two lines of dashes."""
    cells = [block.text for block in blocks(notebook) if block.language == "{code-cell}"]
    code = [re.sub(r"\A---\n.*?\n---\n", "", cell, flags=re.DOTALL) for cell in cells]
    assert len([compile(cell, notebook.name, "exec") for cell in code]) >= 4
    assert max(len(line) for cell in code for line in cell.splitlines()) <= 88
    _, _, exercises = notebook.read_text(encoding="utf-8").partition("\n## Exercises\n")
    texts = re.split(r"^\d\. ", exercises, flags=re.MULTILINE)[1:]
    assert len(texts) >= 3
    solutions = [text.partition("<summary>Solution</summary>")[2] for text in texts]
    assert all("{code-cell}" in solution for solution in solutions)
    assert "\n## " not in exercises


def test_every_public_name_is_described_in_the_pages_of_the_api():
    text = "\n".join(page.read_text(encoding="utf-8") for page in DOCS.glob("api/*.md"))
    described = set(re.findall(r"^\.\. auto\w+:: (\S+)$", text, flags=re.MULTILINE))
    houses = (package.analytic, package.coin_mj, cointoss_bounce, cointoss_yardstick)
    public = {f"cointoss.{name}" for name in dir(package)}
    public |= {f"{house.__name__}.{name}" for house in houses for name in house.__all__}
    assert public - described == {
        "cointoss.models",
        "cointoss.analytic",
        "cointoss.coin_mj",
        "cointoss.__version__",
    }


def test_what_a_page_names_of_the_code_is_there():
    """Paths of files, and a function that a table says to lie in one."""
    files = r"`((?:analytic|bounce|coin_mj|compare|cointoss|models|yardstick|tests|docs)/[\w./-]*\w\.\w+)`"
    named = {(page, path) for page in PAGES for path in re.findall(files, page.read_text(encoding="utf-8"))}
    assert len(named) > 50
    assert [(page.name, path) for page, path in named if not (TOP / path).exists()] == []
    lies_in = re.findall(r"`(\w+)` in " + files, (DOCS / "DESIGN.md").read_text(encoding="utf-8"))
    assert len(lies_in) > 15
    for function, path in lies_in:
        assert re.search(
            rf"^(def|class) {function}\b", (TOP / path).read_text(encoding="utf-8"), re.MULTILINE
        )


def test_a_page_of_docs_leads_to_each_figure():
    """One that a person wrote: a table of all figures leads nowhere in particular."""
    own = [page for page in PAGES if page.name not in ("REPRODUCTION.md", "GALLERY.md")]
    text = "".join(page.read_text(encoding="utf-8") for page in own)
    figures = [page.relative_to(DOCS).as_posix() for page in DOCS.glob("reproduction/*/index.md")]
    assert len(figures) > 20
    assert [figure for figure in figures if f"]({figure})" not in text] == []


@pytest.mark.parametrize(
    ("page", "departs"),
    [
        ("    cointoss toss a\n\n    one 1\n    ...\n    three 3\n", []),
        ("    cointoss toss a\n\n    three 3\n    one 1\n", ["- one 1"]),
        ("    cointoss toss a\n\n    two 2.0\n", ["- two 2.0"]),
        ("```python\nprint(a)  # one 1\nprint(b)  # two 2\nprint(c)  # three 3\n```\n", []),
        ("```python\nprint(a)  # one 1\nprint(c)  # three 3\n```\n", ["+ two 2"]),
        ("```python\nprint(a)\n```\n\n```text\none 1\ntwo 2\nthree 3\n```\n", []),
        ("```python\nprint(a)\n```\n\n```text\none 1\ntwo 2\nfour 4\n```\n", ["- four 4", "+ three 3"]),
        ("```python\nprint(a)\n```\n", []),
    ],
)
def test_an_answer_that_is_not_the_one_shown_is_seen(tmp_path, page, departs):
    (tmp_path / "page.md").write_text(page, encoding="utf-8")
    (block,) = blocks(tmp_path / "page.md")
    code = next(iter(commands(block.text)), block.text)
    assert not_answered(block, code, "one 1\ntwo 2\nthree 3\n") == departs


@pytest.mark.parametrize(
    ("name", "help_"), sorted((COMMANDS | {name: text for name, (_, text) in OF_OTHERS.items()}).items())
)
def test_every_command_has_a_help_that_names_all_its_options(name, help_):
    assert subcommand(name).get_short_help_str(limit=1000) == help_
    answered = printed(name, "--help")
    assert len(options(subcommand(name))) > 1
    assert all(option in answered for option in options(subcommand(name)))
