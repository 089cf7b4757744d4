"""Long tables of a page as files of comma-separated values."""

from cointoss.study import table
from cointoss_reproduction.frame.tables import OPEN, sheets

ROWS = [(f"a|{i}", f"{i}.5 % [{i}, 1{i}]", f"1,00{i}") for i in range(OPEN + 1)]


def test_an_estimate_becomes_three_columns_and_a_number_loses_its_commas():
    written = sheets(table("name | share | tosses", ROWS))
    assert written.keys() == {"table-1.csv"}
    head, first, *_ = written["table-1.csv"].splitlines()
    assert head == 'name,share [%],"share, low [%]","share, high [%]",tosses'
    assert first == "a|0,0.5,0,10,1000"
    assert sheets(table("name | share | tosses", ROWS[:OPEN])) == {}
