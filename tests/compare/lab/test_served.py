"""The lab's server: the map that its page asks for, what it refuses, and the command that serves it."""

import threading
import webbrowser
from urllib.parse import urlencode

import numpy as np
import pytest

import cointoss
from cointoss.analytic.entries import toss_each
from cointoss.compare.lab import served
from cointoss.models.answers import ANSWER
from cointoss.models.batch import rows_of
from cointoss.models.devices import Device
from cointoss.models.fields import FIELDS
from cointoss.models.rows import row_of
from tests.helpers.cards import with_card
from tests.helpers.command_line import cointoss as command
from tests.helpers.explored import asked, got, serving

CASE = cointoss.load("fig24a").replace("ending.max_impacts", 4)
SPIN, RESTITUTION = "release.angular_velocity.eta", "floor.restitution"


@pytest.fixture(name="server")
def _server():
    with serving(served.ServedLab(CASE, 0, Device.CPU)) as lab:
        yield lab


def target(*ends, row=None, **more):
    """Return what a page asks for."""
    numbers = np.array([*(row_of(CASE) if row is None else row), *(ends or (20, 60, 0.5, 0.9))], dtype="<f8")
    given = {"numbers": numbers.tobytes().hex(), "x": SPIN, "y": RESTITUTION, "columns": 7, "rows": 5}
    return f"/map?{urlencode({**given, 'after': '1', 'trust': '0', **more})}"


@pytest.mark.parametrize("after", ["final", "0", "2"])
@pytest.mark.parametrize("trust", [0, 1])
def test_a_map_is_that_of_the_entry_that_a_page_calls(server, after, trust):
    """Values that are none are answered as such."""
    status, headers, body = got(server.port, target(20, 60, 0.3, 1.5, after=after, trust=trust))
    assert (status, headers["content-type"]) == (200, "application/octet-stream")
    spins, restitutions = np.meshgrid(np.linspace(20, 60, 7), np.linspace(0.3, 1.5, 5))
    is_scenario = restitutions.ravel() <= 1
    most = 4 if after == "final" else int(after) + 1
    changed = {SPIN: spins.ravel(), RESTITUTION: restitutions.ravel(), "ending.max_impacts": most}
    answers = np.empty((35, len(ANSWER)))
    toss_each(rows_of(CASE, 35, changed), 0 if not trust else 2 if after == "final" else 1, answers)
    found = dict(zip(ANSWER, answers.T, strict=True))
    is_touch = (after != "final") & (found["impacts"] == most)
    codes, *trusted = np.frombuffer(body, dtype=np.int8).reshape(1 + trust, 35)
    due = np.where(is_touch, found["last_face"], found["outcome"])
    assert np.array_equal(codes, np.where(is_scenario, due, -2))
    assert {1, 2, -2} <= set(codes)
    if trust:
        due = found["outcome_certain"] == 1 if after == "final" else found["trusted_impacts"] >= most
        assert np.array_equal(trusted[0], due & is_scenario)
        assert 1 in trusted[0]


NO_ROW = np.where(np.arange(len(FIELDS)) == 1, -1.0, row_of(CASE))
WRONG = [
    *("/map", "/map?x=1", f"{target()}&more=1"),
    *(target(**{name: text}) for name in ("x", "y") for text in ("", "spin", "floor.contact", "nothing")),
    *(
        target(**{name: text})
        for name in ("columns", "rows")
        for text in ("", "1", "4097", "-5", "1e3", "9" * 12)
    ),
    *(target(after=text) for text in ("", "-1", "1000000", "none")),
    *(target(trust=text) for text in ("", "2", "true")),
    *(target(numbers=text) for text in ("", "00", "g" * 800, "0" * 798)),
    *(target(*ends) for ends in ((np.nan, 60, 0.5, 0.9), (20, np.inf, 0.5, 0.9), (20, 60, -1e308, 1e308))),
    *(
        target(row=NO_ROW),
        target(row=np.full(len(FIELDS), np.nan)),
        target(y=SPIN),
        target(x="ending.max_impacts"),
    ),
]


@pytest.mark.parametrize("wrong", WRONG)
def test_what_is_no_map_is_refused_in_a_line(server, wrong):
    status, headers, body = got(server.port, wrong)
    assert (status, headers["content-type"]) == (400, "text/plain; charset=utf-8")
    assert body.count(b"\n") == 1
    assert b"accepted" in body


def test_the_page_may_ask_its_server_and_nobody_else(server):
    status, headers, body = got(server.port, "/")
    assert status == 200
    for policy in (headers["content-security-policy"], body.decode()):
        assert "default-src 'none'" in policy
        assert "connect-src 'self'" in policy
    assert got(server.port, target(), host="evil.example")[0] == 403
    assert got(server.port, target(), "Sec-Fetch-Site: cross-site")[0] == 403
    assert got(server.port, target(), method="POST")[0] == 405
    assert got(server.port, "/nothing")[0] == 404


def test_a_map_that_nobody_waits_for_any_more_is_given_up(server, monkeypatch):
    made, begun, may_go_on, pieces = [], threading.Event(), threading.Event(), served.pieces

    def slow(batch, how):
        for number, piece in enumerate(pieces(batch, how)):
            made.append(len(batch))
            if number == 0 and len(batch) > 35:
                begun.set()
                may_go_on.wait()
            yield piece

    monkeypatch.setattr(served, "pieces", slow)
    with asked(server.port, target(columns=600, rows=400)):
        begun.wait()
    may_go_on.set()
    assert got(server.port, target())[0] == 200
    assert made == [240_000, 35]


def test_a_map_is_tossed_on_the_card(monkeypatch):
    with serving(served.ServedLab(CASE, 0, Device.CPU)) as lab:
        _, _, due = got(lab.port, target(columns=80, rows=60))
    card = with_card(monkeypatch)
    for device in (Device.CUDA, Device.AUTO):
        card.given.clear()
        with serving(served.ServedLab(CASE, 0, device)) as lab:
            assert got(lab.port, target(columns=80, rows=60))[2] == due
        assert sum(card.given) == 4800
    card.left = 0
    with serving(served.ServedLab(CASE, 0, Device.CUDA)) as lab:
        status, _, body = got(lab.port, target())
    assert (status, body) == (503, b"`device` cuda: the card was lost; accepted: cpu, auto\n")


def test_the_command_serves_the_page_where_a_device_is_named(monkeypatch):
    opened = []
    monkeypatch.setattr(webbrowser, "open", lambda url: opened.append(url) or True)
    monkeypatch.setattr(served.ServedLab, "serve_forever", lambda _: None)
    answered = command("lab", "--device", "auto")
    assert (answered.exit_code, answered.stderr) == (0, "")
    assert answered.stdout == f"{opened[0]}\n"
    assert opened[0].startswith("http://127.0.0.1:")
