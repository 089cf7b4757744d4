"""The built site: its links lead somewhere, it needs no network, and its pictures are described."""

import pytest

from tests.helpers.lab import WHOLE
from tests.helpers.site import SITE, problems, read


@pytest.mark.parametrize("name", ["explorer.html", "gallery.html", "report/report.html"])
def test_a_page_that_the_site_takes_as_it_is_leads_back(name):
    """`problems` follows the link."""
    links = [address for address in read(SITE / name).linked if address.endswith("index.html")]
    assert links == [f"{'../' * name.count('/')}index.html"]


def test_every_link_leads_somewhere_and_nothing_comes_from_the_network():
    assert problems(SITE) == []


def test_a_state_of_the_lab_to_which_a_page_links_is_shown(page):
    linked = [
        address for path in SITE.glob("*.html") for address in read(path).linked if "lab.html#" in address
    ]
    for address in linked:
        page.open(f"{SITE.as_uri()}/{address}")
        page.wait_for(WHOLE)
        assert page.value("document.getElementById('problem').hidden"), address
    assert linked


GOOD = (
    '<h1 id="a">A</h1><a href="b.html#b">b</a><a href="#a">a</a><a href="https://example.org/x">x</a>'
    '<a href="lab.html#coin.mass=1&map=final">l</a>'
)


@pytest.mark.parametrize(
    ("wrong", "problem"),
    [
        ('<a href="c.html">c</a>', "c.html leads nowhere"),
        ('<a href="b.html#c">c</a>', "b.html#c has no such anchor"),
        ('<a href="#b">b</a>', "#b has no such anchor"),
        ('<a href="lab.html#coin.mas=1">l</a>', "lab.html#coin.mas=1 has no such field"),
        ('<a href="https:/example">x</a>', "https:/example is no address"),
        ('<img src="c.png" alt="c">', "c.png leads nowhere"),
        ('<img src="data:,">', "data:, has no alt"),
        ('<img src="data:," alt="data:,">', "data:, has no alt"),
        ('<script src="https://example.org/x.js"></script>', "loads https://example.org/x.js"),
        ('<link rel="stylesheet" href="//example.org/x.css">', "loads //example.org/x.css"),
        ("<style>@import 'https://example.org/x.css';</style>", "loads https://example.org/x.css"),
        ('<p style="background: url(https://example.org/x.png)">', "loads https://example.org/x.png"),
        ("a { src: url('https://example.org/f.woff') }", "loads https://example.org/f.woff"),
    ],
)
def test_a_problem_is_seen(tmp_path, wrong, problem):
    """And no other: the rest of the page has none."""
    name = "x.css" if wrong.startswith("a {") else "a.html"
    (tmp_path / "a.html").write_text(GOOD, encoding="utf-8")
    (tmp_path / "lab.html").touch()
    (tmp_path / "b.html").write_text('<p id="b"></p><img src="data:," alt="nothing">', encoding="utf-8")
    with (tmp_path / name).open("a", encoding="utf-8") as file:
        file.write(wrong)
    assert problems(tmp_path) == [f"{name}: {problem}"]
