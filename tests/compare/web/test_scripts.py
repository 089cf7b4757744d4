"""Names and comments that are HTML or JavaScript stay text: in a report, the page of a map, a notebook."""

import json
import shutil
from html.parser import HTMLParser

import pytest

from cointoss import analytic, read_map
from cointoss.compare.lab import static
from cointoss.compare.report.comparison import Comparison
from cointoss.compare.report.map_section import MapSection
from cointoss.compare.report.page import render
from cointoss.models.reading import parse
from tests.helpers.explored import SCENARIO

HOSTILE = [
    "<script>document.title = 'run'</script>",
    "</script><script>document.title = 'run'</script>",
    "</pre></title></textarea><img src=x onerror=\"document.title = 'run'\">",
    "\"' onmouseover=\"document.title = 'run'\" '",
    "--><!-- <script> {{ 7 * 7 }} {% raw %} &lt;b&gt; &amp; ]]> \\u003cb>",
]
NAME = "<script>document.title='run'<script><img src=x onerror=document.title='run'>\"'&lt;{{7}}<!--.zarr"


class Parsed(HTMLParser):
    """The elements of a page with the names of their attributes, its texts, and what its scripts hold."""

    def __init__(self, text):
        super().__init__()
        self.elements, self.texts, self.comments, self._open = [], [], 0, ""
        self.scripts = {}
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, tuple(name for name, _ in attrs)))
        self._open = dict(attrs).get("id") or tag

    def handle_endtag(self, tag):
        self.elements.append((tag, "end"))
        self._open = ""

    def handle_comment(self, data):
        self.comments += bool(data)

    def handle_data(self, data):
        self.texts.append(data.strip())
        self.scripts[self._open] = data


def report(words):
    """Return the report of a toss, with those words wherever a person may have written them."""
    text = f"# {words}\n{SCENARIO}# {words}"
    scenario = parse(text, words)
    share = {"compared": 1, "agreeing": 1}
    numbers = {
        "axes": {words: {"field": "release.position.z", "unit": "m", "start": 0.0, "stop": 1.0, "count": 2}},
        "after": None,
        "fractions": {"analytic": {words: 1.0}, "mujoco": {words: 1.0}},
        "agreement": {"distance": 2.0, "away": share, "near": share, "undecided": 0},
        "untrusted": None,
        "settings": {"analytic": {words: words}},
        "command": words,
    }
    return render(
        Comparison(
            name=words,
            text=text,
            tosses=(analytic.toss(scenario),),
            absent={"mujoco": words},
        ),
        no_video=words,
        maps=MapSection(picture=b"", numbers=numbers),
    )


@pytest.mark.parametrize("words", HOSTILE)
def test_a_report_shows_them_as_they_are(words):
    plain, hostile = Parsed(report("one of mine")), Parsed(report(words))
    assert hostile.elements == plain.elements
    assert hostile.comments == plain.comments == 1
    assert json.loads(hostile.scripts["data"]) == json.loads(plain.scripts["data"])
    for shown in (f"{words}: one coin, two engines", f"{words}: how does this coin come down?", words):
        assert shown in hostile.texts
    assert hostile.texts == [text.replace("one of mine", words) for text in plain.texts]


@pytest.fixture(scope="module")
def named(map_path, tmp_path_factory):
    folder = shutil.copytree(map_path, tmp_path_factory.mktemp("named") / NAME)
    described = json.loads((folder / "zarr.json").read_text("utf-8"))
    described["attributes"]["name"] = NAME
    (folder / "zarr.json").write_text(json.dumps(described), encoding="utf-8")
    return folder


@pytest.fixture
def failing(monkeypatch):
    """Return what lets MuJoCo fail in some words."""

    def fails(words):
        monkeypatch.setattr(static, "toss_by_mujoco", lambda *_, **__: {"engine": "mujoco", "problem": words})

    return fails


@pytest.mark.parametrize("words", HOSTILE)
def test_a_static_page_holds_them_as_data(map_path, named, tmp_path, failing, words):
    pages = []
    for path, told in ((map_path, "out of reach"), (named, words)):
        failing(told)
        static.write_static(path, tmp_path / "page.html")
        pages.append(Parsed((tmp_path / "page.html").read_text("utf-8")))
    expected, found = pages
    assert found.elements == expected.elements
    assert found.comments == expected.comments
    data = json.loads(found.scripts["data"])
    assert data["saved"]["name"] == NAME
    assert {each["toss"]["problem"] for each in data["tosses"]} == {words}


def test_a_browser_runs_none_of_them_and_a_frame_keeps_them_inside(page, named, tmp_path, failing):
    failing(words := "".join(HOSTILE))
    frame = read_map(named).cointoss.page()
    found = Parsed(frame._repr_html_())
    attributes = ("title", "sandbox", "loading", "style", "srcdoc")
    assert found.elements == [("iframe", attributes), ("iframe", "end")]
    (tmp_path / "notebook.html").write_text(f"<title>mine</title>{frame._repr_html_()}", encoding="utf-8")
    (inside,) = page.open_frames((tmp_path / "notebook.html").as_uri(), 1)
    assert page.value("document.title") == "mine"
    assert page.value("document.querySelector('iframe').srcdoc") == frame.page
    assert page.value("document.querySelector('iframe').title") == f"map of {NAME}: 2 g, 25 mm"
    assert page.value("document.querySelectorAll('img, script').length") == 0
    inside.wait_for("document.getElementById('outcome').textContent.includes('MuJoCo: <script>')")
    assert inside.value("document.title") == f"{NAME}: 2 g, 25 mm: the coin lab"
    assert inside.text("name") == f"{NAME}: 2 g, 25 mm"
    assert inside.text("outcome").count(words) == 1
    assert inside.value("document.querySelectorAll('img, #outcome script, #name *').length") == 0
    assert inside.complaints() == []
