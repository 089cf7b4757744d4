"""The lab's page: what is true of it when it is ready, what it shows and saves, and how to work it."""

import json
from urllib.parse import parse_qs

from tests.helpers.coins_shown import box

SPIN, HEIGHT = "release.angular_velocity.eta", "release.position.z"
WHOLE = "document.getElementById('map').ariaBusy === 'false'"
TOSSED = r"/ \d+\.\d{4} s\. /.test(document.getElementById('outcome').textContent)"
COUNTED = "document.getElementById('share').dataset.whole === 'true'"
ADDRESSED = "location.hash.length > 1"
RESTED = """
new Promise((kept) => {
  let address = location.hash, since = performance.now();
  const look = () => {
    if (location.hash !== address) [address, since] = [location.hash, performance.now()];
    if (performance.now() - since > 600) kept(); else requestAnimationFrame(look);
  };
  look();
})
"""
"""Waits until the address has been the same for longer than it takes to be written."""
SAVED = """
window.saved = [];
URL.createObjectURL = (blob) => { window.saved.push(blob); return "#saved"; };
"""
"""A script that keeps what a page saves."""
SEQUENCES = """
[...document.querySelectorAll("#sequences .row[role=img]")].map((row) => [row.querySelector("b").textContent,
  [...row.querySelectorAll("span")].map((cell) => cell.textContent).join("")])
"""


def saved(page, button):
    """Return the text of the file that a button saves."""
    clicks(page, button)
    page.wait_for("window.saved.length === 1")
    return page.value("window.saved.pop().text()")


def clicks(page, *ids):
    """Click elements, one after the other."""
    for id_ in ids:
        page.value(f"document.getElementById('{id_}').click()")


def slides(page, field, value, least="input.min"):
    """Move the slider of a field to a value, which may begin elsewhere."""
    page.value(
        f"""(() => {{
          const input = document.querySelector("[data-field='{field}']");
          Object.assign(input, {{ min: {least}, value: {value} }}).dispatchEvent(new Event("input"));
        }})()"""
    )


def place_of(page, u, v):
    """Return where a part of both sides of the map is on the page; the margins are those of map_view.js."""
    left, top, width, height = box(page, "map")
    return left + 74 + u * (width - 74 - 14), top + 10 + (1 - v) * (height - 10 - 52)


def state(page):
    """Return what the address says, by name, once it has all."""
    page.wait_for(ADDRESSED)
    page.value(RESTED)
    return {name: values[0] for name, values in parse_qs(page.value("location.hash")[1:]).items()}


def sequences(page):
    """Return the faces that are shown of each toss, by its name."""
    return dict(page.value(SEQUENCES))


def go(page, address):
    """Show the state of an address, and wait until all of it is there."""
    wanted = json.dumps(address)
    cleared = "document.getElementById('outcome').textContent = ''"
    page.value(f"if (location.hash !== {wanted}) {{ {cleared}; location.hash = {wanted}; }} 0")
    page.wait_for(f"{TOSSED} && {WHOLE}")
