"""The lab's page: what is true of it when it is ready, what it saves, and how to go to a state."""

import json

SPIN, HEIGHT = "release.angular_velocity.eta", "release.position.z"
WHOLE = "document.getElementById('map').ariaBusy === 'false'"
TOSSED = r"/ \d+\.\d{4} s\. /.test(document.getElementById('outcome').textContent)"
COUNTED = "document.getElementById('share').dataset.whole === 'true'"
ADDRESSED = "location.hash.length > 1"
SAVED = """
window.saved = [];
URL.createObjectURL = (blob) => { window.saved.push(blob); return "#saved"; };
"""
"""A script that keeps what a page saves."""


def saved(page, button):
    """Return the text of the file that a button saves."""
    page.value(f"document.getElementById('{button}').click()")
    page.wait_for("window.saved.length === 1")
    return page.value("window.saved.pop().text()")


def go(page, address):
    """Show the state of an address, and wait until all of it is there."""
    wanted = json.dumps(address)
    cleared = "document.getElementById('outcome').textContent = ''"
    page.value(f"if (location.hash !== {wanted}) {{ {cleared}; location.hash = {wanted}; }} 0")
    page.wait_for(TOSSED)
    page.wait_for(WHOLE)
