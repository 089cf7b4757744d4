"""Names and comments that are HTML or JavaScript stay text: in the report, the explorer, and notebooks."""

import json
import shutil
from html.parser import HTMLParser

import pytest

from cointoss import analytic, read_map
from cointoss.compare.explorer import static
from cointoss.compare.explorer.page_files import page_files
from cointoss.compare.explorer.static import write_static
from cointoss.compare.report.comparison import Comparison
from cointoss.compare.report.map_section import MapSection
from cointoss.compare.report.page import render
from cointoss.models.reading import parse
from tests.helpers.explored import SCENARIO, got, serving

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
def static_page(tmp_path, monkeypatch):
    """Return what writes the static page of a map whose tosses all fail in those words."""

    def made(path, words):
        def toss_pixel(_sweep, _x, _y, engine, **_):
            return {"engine": engine.value, "problem": words}

        monkeypatch.setattr(static, "toss_pixel", toss_pixel)
        monkeypatch.setattr(static, "engine_data", lambda *_: None)
        write_static(path, tmp_path / "page.html")
        return tmp_path / "page.html"

    return made


@pytest.mark.parametrize("words", HOSTILE)
def test_a_static_page_holds_them_as_data(map_path, named, static_page, words):
    expected = Parsed(static_page(map_path, "out of reach").read_text("utf-8"))
    found = Parsed(static_page(named, words).read_text("utf-8"))
    assert found.elements == expected.elements
    assert found.comments == expected.comments
    data = json.loads(found.scripts["data"])
    assert data["map"]["name"] == NAME
    assert {toss["problem"] for pair in data["tosses"].values() for toss in pair} == {words}


def test_the_server_answers_them_as_data(named):
    with serving(named) as explorer:
        status, headers, body = got(explorer.port, "/map")
        page = got(explorer.port, "/")[2]
    assert (status, headers["content-type"]) == (200, "application/json")
    assert headers["x-content-type-options"] == "nosniff"
    assert json.loads(body)["name"] == NAME
    assert page == page_files()["index.html"]


def test_a_browser_runs_none_of_them(page, named, static_page):
    words = "".join(HOSTILE)
    page.open(f"{static_page(named, words).as_uri()}#x=40&y=0.4")
    page.wait_for("document.getElementById('outcome').textContent.includes('MuJoCo: <script>')")
    assert page.value("document.title") == f"{NAME}: 2 g, 25 mm: cointoss explore"
    assert page.text("name") == f"{NAME}: 2 g, 25 mm"
    assert page.text("outcome").count(words) == 2
    assert page.value("document.querySelectorAll('img, #outcome script, #name *').length") == 0


def test_a_frame_of_a_notebook_keeps_them_inside(page, named, tmp_path, monkeypatch):
    monkeypatch.setattr(static, "toss_pixel", lambda *_, **__: {"engine": "analytic", "problem": HOSTILE[1]})
    monkeypatch.setattr(static, "engine_data", lambda *_: None)
    frame = static.explore(read_map(named))
    found = Parsed(frame._repr_html_())
    attributes = ("title", "sandbox", "loading", "style", "srcdoc")
    assert found.elements == [("iframe", attributes), ("iframe", "end")]
    (tmp_path / "notebook.html").write_text(f"<title>mine</title>{frame._repr_html_()}", encoding="utf-8")
    (inside,) = page.open_frames((tmp_path / "notebook.html").as_uri(), 1)
    assert page.value("document.title") == "mine"
    assert page.value("document.querySelector('iframe').srcdoc") == frame.page
    assert page.value("document.querySelector('iframe').title") == f"map of {NAME}: 2 g, 25 mm"
    assert page.value("document.querySelectorAll('img, script').length") == 0
    assert inside.text("name") == f"{NAME}: 2 g, 25 mm"
    assert inside.value("document.querySelectorAll('img').length") == 0
    assert inside.complaints() == []
