"""The claims of a study fail where its cells are otherwise: each row of failing.toml."""

import tomllib
from pathlib import Path

import pytest

from cointoss_reproduction.frame.cells import read_table
from cointoss_reproduction.frame.files import TABLE
from saved import missed, saved

TABLES = tomllib.loads(Path(__file__).with_name("failing.toml").read_text(encoding="utf-8"))
ROWS = [
    pytest.param(study, row, id=f"{study}: {row['fails'][0]}") for study in TABLES for row in TABLES[study]
]


@pytest.mark.parametrize(("study", "row"), ROWS)
def test_claims_fail_where_cells_are_otherwise(study, row):
    cells = read_table(saved(study) / TABLE)
    chosen = cells.query(row["where"], engine="python")
    for column, other in row["cells"].items():
        cells.loc[chosen.index, column] = chosen.eval(other, engine="python")
    found = [claim[: len(start)] for claim, start in zip(missed(study, cells), row["fails"], strict=True)]
    assert found == row["fails"]
