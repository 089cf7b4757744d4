"""Margins of a toss that long arithmetic proves, which `cointoss toss --margin` offers with the book."""

import pytest

from cointoss.compare.metrics.margin import QUANTITIES, margins, offered_proofs
from cointoss.models.reading import load
from tests.helpers.command_line import python

PROOFS = offered_proofs()
PROVED = {"height", "attitude about ξ", "spin about ξ"}


@pytest.mark.slow_after_first
@pytest.mark.parametrize("law", ["smooth", "perfectly_rough"])
def test_the_margin_of_a_planar_coin_in_vacuum_is_proved_from_below(law):
    vacuum = load("fig29").replace("air.normal", 0.0, "air.tangential", 0.0, "floor.restitution", 0.3)
    found = {one.quantity.name: one for one in margins(vacuum.replace("floor.contact", law), PROOFS)}
    assert {name for name, margin in found.items() if margin.proved} == PROVED
    for name in PROVED:
        assert 2**-14 * abs(found[name].change) < found[name].proved < abs(found[name].change)
        assert f"proved to be above {found[name].proved:.2g} {found[name].quantity.unit}" in found[name].line


@pytest.mark.parametrize("is_planar", [False, True])
def test_long_arithmetic_is_imported_only_where_a_margin_is_proved(tmp_path, is_planar):
    planar = load("fig29").replace("air", {}, "floor.restitution", 0.3)
    (tmp_path / "planar.toml").write_text(planar.to_toml())
    scenario = str(tmp_path / "planar.toml") if is_planar else "fig24a"
    code = (
        "import atexit, sys; from cointoss.compare.cli import main; atexit.register(lambda: "
        "print([name for name in sys.modules if 'reproduction' in name or 'flint' in name])); "
        f"main.main(['toss', {scenario!r}, '--margin'])"
    )
    ran = python("-c", code)
    *lines, imported = ran.stdout.splitlines()
    assert sum(line.startswith("margin ") for line in lines) == len(QUANTITIES)
    assert ("proved to be above" in ran.stdout) == is_planar
    assert (imported != "[]") == is_planar
