"""The lab that is served, in a browser: its map by the server is the map of the page alone."""

import pytest

import cointoss
from cointoss.compare.lab.served import ServedLab
from cointoss.models.devices import Device
from tests.helpers.explored import serving
from tests.helpers.lab import ADDRESSED, SAVED, go, saved

COIN = (
    "#coin.mass=0.002&coin.radius=0.0125&coin.thickness=0.002&floor.contact=smooth&floor.restitution=0.8"
    "&release.position.x=-0&release.position.y=0&release.position.z=0.4&release.angles.theta=0.3"
)
SPINS = "x=release.angular_velocity.eta:20:60&y=release.position.z:0.2:0.6"
PAST_ITS_BOUNDS = "x=release.angular_velocity.eta:20:60&y=floor.restitution:0.4:1.2"


@pytest.fixture(scope="module")
def served():
    """The lab, served."""
    with serving(ServedLab(cointoss.load("fig24a"), 0, Device.CPU)) as lab:
        yield lab


@pytest.fixture
def both(page, lab_path, served):
    """Return what shows an address on the page alone and on the served one, and gives the tables of both."""

    def tables(address):
        found = []
        page.call("Page.addScriptToEvaluateOnNewDocument", source=SAVED)
        for url in (lab_path.as_uri(), served.url):
            page.open(url, width=420)
            page.wait_for(ADDRESSED)
            go(page, address)
            assert page.text("problem") == ""
            found.append(saved(page, "csv"))
        return found

    return tables


@pytest.mark.parametrize("window", [f"{SPINS}&map=3&trust=1", f"{PAST_ITS_BOUNDS}&map=final"])
def test_the_map_by_the_server_is_that_of_the_page(page, both, served, window):
    alone, by_server = both(f"{COIN}&{window}")
    assert by_server == alone
    assert {"heads", "tails"} <= {line.split(",")[2] for line in alone.splitlines()}
    assert ("no scenario" in alone) == (PAST_ITS_BOUNDS in window)
    assert "not tossed" not in alone
    assert any(address.startswith(f"{served.url}map?") for address in page.asked())
    assert page.text("where") == "on this machine"
