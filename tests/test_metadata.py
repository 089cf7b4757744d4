"""CITATION.cff, codemeta.json and .zenodo.json say of the project what pyproject.toml does."""

import json
import re
import tomllib
from pathlib import Path
from typing import Any

import pytest
from yaml import safe_load

from cointoss.compare.sweep import chunks
from cointoss.models import reading

TOP = Path(__file__).parents[1]
PROJECT = tomllib.loads((TOP / "pyproject.toml").read_text(encoding="utf-8"))["project"]
PAPER = "10.1016/j.physrep.2008.08.003"


def said_by(name: str) -> dict[str, Any]:
    """Return what a file says of the project, each thing under one name for all files."""
    text = (TOP / name).read_text(encoding="utf-8")
    told = safe_load(text) if name == "CITATION.cff" else json.loads(text)
    authors = told.get("authors") or told.get("author") or told.get("creators")
    return {
        "title": told["name"] if name == "codemeta.json" else told["title"],
        "version": told["version"],
        "license": told["license"].removeprefix("https://spdx.org/licenses/"),
        "authors": [author["name"] for author in authors],
        "keywords": told["keywords"],
        "papers": sorted(set(re.findall(r"\b10\.\d{4}/[\w.]+", text))),
    }


@pytest.mark.parametrize("name", ["CITATION.cff", "codemeta.json", ".zenodo.json"])
def test_a_file_says_what_pyproject_says(name):
    said = said_by(name)
    assert said.pop("title") == said_by("CITATION.cff")["title"]
    assert said == {
        "version": PROJECT["version"],
        "license": PROJECT["license"],
        "authors": [author["name"] for author in PROJECT["authors"]],
        "keywords": PROJECT["keywords"],
        "papers": [PAPER],
    }


@pytest.mark.parametrize("name", ["codemeta.json", ".zenodo.json"])
def test_a_description_is_that_of_pyproject(name):
    assert json.loads((TOP / name).read_text(encoding="utf-8"))["description"] == PROJECT["description"]


def test_the_name_of_the_index_and_the_python_are_in_codemeta():
    told = json.loads((TOP / "codemeta.json").read_text(encoding="utf-8"))
    assert told["identifier"] == PROJECT["name"]
    assert told["runtimePlatform"] == f"Python {PROJECT['requires-python']}"
    assert said_by("CITATION.cff")["title"].startswith("cointoss: ")


def test_support_has_the_numbers_of_the_files_that_are_kept():
    page = (TOP / "docs" / "SUPPORT.md").read_text(encoding="utf-8")
    assert f"the attribute `cointoss_map`, now {chunks.FORMAT} |" in page
    assert f"the attribute `cointoss_tosses`, now {chunks.TOSSES_FORMAT} |" in page
    assert f"the field `format`, now {reading.FORMAT}; without it, 1 |" in page
