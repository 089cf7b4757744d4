"""`make docs` runs the examples of the pages, and says which it doesn't run, and which fail."""

import re
from importlib import import_module

import pytest

from tests.helpers.pages import PAGES, blocks

examples = import_module("examples")
PAGE = """
Save the coin as `coin.toml`:

```toml
[coin]
```

    cointoss toss table --max-impacts 1
    {line}

```python
from pathlib import Path

print("coin" in Path("{file}").read_text(encoding="utf-8"))  # {answer}
```

    cointoss lab
"""
RIGHT = {"line": "engine    analytic", "file": "coin.toml", "answer": "True"}


def said_of(folder, monkeypatch, **changed):
    """Return the lines about a page, without the time that it took."""
    monkeypatch.chdir(folder)
    (folder / "PAGE.md").write_text(PAGE.format_map(RIGHT | changed), encoding="utf-8")
    *said, took = examples.run_page(folder / "PAGE.md")
    assert re.fullmatch(r"examples: \d, \d+ s of processor time", took)
    return said


def test_the_examples_of_a_page_run_but_those_on_the_list(tmp_path, monkeypatch):
    left = "not run, opens a browser, or serves until it is stopped: cointoss lab"
    assert said_of(tmp_path, monkeypatch) == [left]


@pytest.mark.parametrize(
    ("changed", "problem"),
    [
        ({"line": "engine    mujoco"}, "- engine    mujoco"),
        ({"answer": "False"}, "- False\n+ True"),
        ({"file": "page.toml"}, "No such file or directory: 'page.toml'"),
        (
            {"line": "engine    analytic\n\n    cointoss toss fig24a > gone/a.txt"},
            "No such file or directory",
        ),
    ],
)
def test_an_example_that_fails_is_seen(tmp_path, monkeypatch, changed, problem):
    failed, _ = said_of(tmp_path, monkeypatch, **changed)
    assert failed.startswith("FAILED: ")
    assert failed.endswith(problem)


def test_each_pattern_of_the_list_is_that_of_an_example():
    named = [
        f"{page.name}: {code}"
        for page in PAGES
        for block in blocks(page)
        for code in examples.examples(block)
    ]
    patterns = [pattern for patterns in examples.NOT_RUN.values() for pattern in patterns]
    assert [one for one in patterns if not any(re.search(one, code) for code in named)] == []
