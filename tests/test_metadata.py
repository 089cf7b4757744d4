"""CITATION.cff, codemeta.json and .zenodo.json say of the project what pyproject.toml does."""

import re
import tomllib
from pathlib import Path

import pytest
from yaml import safe_load

from cointoss.compare.sweep import chunks
from cointoss.models import reading
from tests.helpers.damages import HOUSES

TOP = Path(__file__).parents[1]
PROJECT = tomllib.loads((TOP / "pyproject.toml").read_text(encoding="utf-8"))["project"]
PAPER = "10.1016/j.physrep.2008.08.003"


@pytest.mark.parametrize(
    ("name", "title", "authors"),
    [
        ("CITATION.cff", "title", "authors"),
        ("codemeta.json", "name", "author"),
        (".zenodo.json", "title", "creators"),
    ],
)
def test_a_file_says_what_pyproject_says(name, title, authors):
    text = (TOP / name).read_text(encoding="utf-8")
    told = safe_load(text)  # JSON is YAML, too
    assert told[title] == safe_load((TOP / "CITATION.cff").read_text(encoding="utf-8"))["title"]
    assert [author["name"] for author in told[authors]] == [each["name"] for each in PROJECT["authors"]]
    assert told["license"].removeprefix("https://spdx.org/licenses/") == PROJECT["license"]
    # Not each file has a description, the name in the index and the version of Python.
    for key, of_project in {
        "version": PROJECT["version"],
        "keywords": PROJECT["keywords"],
        "description": PROJECT["description"],
        "identifier": PROJECT["name"],
        "runtimePlatform": f"Python {PROJECT['requires-python']}",
    }.items():
        assert told.get(key, of_project) == of_project
    assert set(re.findall(r"\b10\.\d{4}/[\w.]+", text)) == {PAPER}


def test_support_has_the_numbers_of_the_files_that_are_kept():
    for words in (
        f"the attribute `cointoss_map`, now {chunks.FORMAT} |",
        f"the attribute `cointoss_tosses`, now {chunks.TOSSES_FORMAT} |",
        f"the field `format`, now {reading.FORMAT}; without it, 1 |",
    ):
        assert words in (TOP / "docs" / "SUPPORT.md").read_text(encoding="utf-8")


def test_the_packages_carry_the_licence():
    """Their wheels take it from beside their `pyproject.toml`, and would be made without it too."""
    assert len({(TOP / house / "LICENSE").read_bytes() for house in ("", *HOUSES)}) == 1
