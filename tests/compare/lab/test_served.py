"""The lab's server: what its page asks for, and what it refuses."""

import json
import threading
from base64 import b64decode
from contextlib import suppress
from dataclasses import replace
from urllib.parse import urlencode

import numpy as np
import pytest
import xarray as xr

import cointoss
from cointoss import analytic, coin_mj
from cointoss.analytic.entries import toss_each
from cointoss.compare.lab import served
from cointoss.compare.lab.saved import saved_map
from cointoss.compare.lab.tosses import toss_by_mujoco
from cointoss.compare.web.server import LONGEST_TARGET
from cointoss.models.answers import ANSWER
from cointoss.models.batch import rows_of
from cointoss.models.devices import Device
from cointoss.models.fields import FIELDS
from cointoss.models.reading import parse
from cointoss.models.rows import row_of
from tests.helpers.cards import with_card
from tests.helpers.explored import FIELDS as SHOWN
from tests.helpers.explored import SCENARIO, asked, got, sent, serving, small_map

CASE = cointoss.load("fig24a").replace("ending.max_impacts", 4)
SPIN, RESTITUTION = "release.angular_velocity.eta", "floor.restitution"


@pytest.fixture(name="lab", scope="module")
def _lab():
    with serving(served.ServedLab(CASE, 0, Device.CPU)) as lab:
        yield lab


def numbers(*more, row=None):
    """Return a scenario's row and more numbers as a page sends them."""
    return np.array([*(row_of(CASE) if row is None else row), *more], dtype="<f8").tobytes().hex()


def target(*ends, row=None, **more):
    """Return what a page asks for."""
    given = {"numbers": numbers(*(ends or (20, 60, 0.5, 0.9)), row=row), "x": SPIN, "y": RESTITUTION}
    return f"/map?{urlencode({**given, 'columns': 7, 'rows': 5, 'after': '1', 'trust': '0', **more})}"


@pytest.mark.parametrize("after", ["final", "0", "2"])
@pytest.mark.parametrize("trust", [0, 1])
def test_a_map_is_that_of_the_entry_that_a_page_calls(lab, after, trust):
    """Values that are none are answered as such."""
    status, headers, body = got(lab.port, target(20, 60, 0.3, 1.5, after=after, trust=trust))
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


def test_a_map_by_mujoco_is_finer_by_mujoco(tmp_path):
    options = ("--engine", "mujoco", "--contact", "spring")
    with serving(small_map(tmp_path, *options, size=(2, 2))) as lab:
        codes = np.frombuffer(got(lab.port, target(after="3"))[2], np.int8)
        assert got(lab.port, target(trust=1))[0] == 400
    spins, restitutions = np.meshgrid(np.linspace(20, 60, 7), np.linspace(0.5, 0.9, 5))
    rows = rows_of(CASE, 35, {SPIN: spins.ravel(), RESTITUTION: restitutions.ravel()})
    due, one_step = (
        coin_mj.toss_rows(rows, settings=replace(coin_mj.MANY, contact=contact)).after(3)
        for contact in ("spring", "one_step")
    )
    assert np.array_equal(codes, due)
    assert not np.array_equal(codes, one_step)
    assert not np.array_equal(codes, analytic.toss_rows(rows).after(3))


def test_a_spin_is_about_the_axis_of_its_scenario(lab):
    """As the page has it, whose engine knows the components."""
    plain = got(lab.port, target())[2]
    assert got(lab.port, target(x="release.spin"))[2] == plain
    still = CASE.replace("release.angular_velocity", [0, 0, 0])
    assert got(lab.port, target(row=row_of(still), x="release.spin"))[0] == 400


@pytest.mark.parametrize("is_reversed", [False, True])
def test_a_map_is_told_pixel_by_pixel(server, map_path, is_reversed):
    _, headers, body = got(server.port, "/saved")
    assert headers["content-type"] == "application/json"
    told = json.loads(body)
    found = cointoss.read_map(map_path)
    assert told == saved_map(found.isel(x=slice(None, None, -1)) if is_reversed else found, "map.zarr")
    with xr.open_dataset(map_path, engine="zarr") as store:
        for name, kind in (("outcome", "<i1"), ("impacts", "<i4")):
            array = np.frombuffer(b64decode(told["arrays"][name]), kind).reshape(18, 24)
            assert np.array_equal(array, store[name].to_numpy())
        x, y = told["axes"]
        assert (x["values"], y["values"]) == tuple(store[field].values.tolist() for field in SHOWN)
    assert (x["field"], x["word"], x["unit"]) == (SPIN, "spin about η", "rad/s")
    assert (told["after"], told["stride"], told["margin"], told["title"]) == (1, 1, None, "coin: 2 g, 25 mm")


def test_a_toss_by_mujoco_goes_on_to_its_end(server):
    case = parse(SCENARIO, "here").replace("ending.max_impacts", 1000)
    found = json.loads(got(server.port, f"/toss?numbers={numbers(row=row_of(case))}")[2])
    toss = coin_mj.toss(case)
    assert (found["engine"], found["sequence"], found["outcome"]) == ("mujoco", toss.sequence, toss.outcome)
    assert found["path"]["time"][-1] > found["end_time"] + 0.05
    assert min(found["later_times"]) >= found["end_time"] - 1e-6
    first = np.array(found["path"]["time"]) < toss.impacts.time[0]
    states = toss.sample(np.array(found["path"]["time"])[first])
    assert np.allclose(np.reshape(found["path"]["position"], (-1, 3))[first], states.position, atol=1e-6)
    assert analytic.toss(case).sequence[:2] == found["sequence"][:2]
    knurled = toss_by_mujoco(case.replace("floor.contact", "knurled"), None)
    assert 'floor.contact = "knurled": accepted by the MuJoCo engine' in knurled["problem"]


NO_ROW = np.where(np.arange(len(FIELDS)) == 1, -1.0, row_of(CASE))
WRONG = [
    *("/map", "/map?", "/map?x=1", f"{target()}&more=1", f"{target()}&x={SPIN}", "/map?x&y", "/saved?x=1"),
    *(target(**{name: text}) for name in ("x", "y") for text in ("", "spin", "floor.contact", "nothing")),
    *(
        target(**{name: text})
        for name in ("columns", "rows")
        for text in ("", "1", "4097", "-5", "1e3", "9" * 12, "٤٠", "7 ", "<script>")
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
    *("/toss", "/toss?numbers=", f"/toss?numbers={numbers(1)}", f"/toss?numbers={numbers(row=NO_ROW)}"),
    f"/map?{'&'.join(f'x{i}=1' for i in range(50))}",
]


NOT_FOUND = r"""
/nothing /zarr.json /map.zarr/zarr.json /../zarr.json /../../../../etc/passwd /..%2f..%2fetc%2fpasswd
/%2e%2e/%2e%2e/etc/passwd /..\..\etc\passwd //etc/passwd /etc/passwd /lab.js /./index.html /index.html/
/index.html?x=1 /index.html%00 /INDEX.HTML /served.py /map/ /toss/ /#map * index.html http://127.0.0.1/map
file:///etc/passwd ~/.ssh/id_rsa
"""
METHODS = "POST HEAD PUT DELETE OPTIONS TRACE CONNECT FOO get"
HOSTS = [
    " ",
    "evil.example",
    "127.0.0.1",
    "localhost",
    "127.0.0.1:1",
    "127.0.0.1:{}0",
    "[::1]:{}",
    "{}.x.org",
]
PATHS = ("/", "/saved", "/toss?numbers=00", "/nothing")
ASKED = [
    *((400, wrong, [], {}) for wrong in WRONG),
    *((404, path, [], {}) for path in NOT_FOUND.split()),
    *((405, "/", ["Content-Length: 3"], {"method": method}) for method in METHODS.split()),
    *((403, path, [], {"host": host}) for path in PATHS for host in HOSTS),
    *((403, path, [f"Sec-Fetch-Site: {site}"], {}) for path in PATHS for site in ("cross-site", "same-site")),
    (403, "/", ["Host: evil.example"], {}),
    (403, "/", ["Host: 127.0.0.1:{}"], {}),
    (414, "/toss?numbers=" + "1" * 2000, [], {}),
    (431, "/", [f"X-{i}: 1" for i in range(200)], {}),
]
"""What is refused: status, and what is asked for with which headers, method and host; `{}` is the port."""


@pytest.mark.parametrize(
    ("status", "target", "headers", "more"),
    ASKED,
    ids=[f"{each[0]} {number}" for number, each in enumerate(ASKED)],
)
def test_what_is_no_query_of_the_page_is_refused_in_a_line(server, status, target, headers, more):
    at = {name: text.replace("{}", str(server.port)) for name, text in more.items()}
    lines = [line.replace("{}", str(server.port)) for line in headers]
    found, told, body = got(server.port, target, *lines, **at)
    assert (found, told["content-type"]) == (status, "text/plain; charset=utf-8"), body
    assert "default-src 'none'" in told["content-security-policy"]
    assert told["allow"] == "GET"
    assert body.count(b"\n") == 1
    assert b"accepted" in body
    assert b"<script>" not in body
    assert b"root:" not in body


def test_the_page_is_served_after_noise_and_loads_nothing_from_elsewhere(server):
    for noise in (b"", b"\x00\xff\x16\x03\x01", b"GET", b"GET / HTTP/9.9", b"GET / FTP/1.1"):
        with suppress(IndexError, ValueError):  # it may also hang up without a word
            sent(server.port, noise + b"\r\n\r\n")
    assert sent(server.port, b"GET / HTTP/1.1\r\n\r\n")[0] == 403
    # As long as a target may be, but for the map's query.
    assert got(server.port, f"/{'x' * (LONGEST_TARGET - 1)}")[0] == 404
    status, headers, body = got(server.port, "/", host=f"localhost:{server.port}")
    assert status == 200
    assert (headers["x-content-type-options"], headers["cache-control"]) == ("nosniff", "no-store")
    for policy in (headers["content-security-policy"], body.decode()):
        assert "default-src 'none'" in policy
        assert "connect-src 'self'" in policy


def test_a_map_that_nobody_waits_for_any_more_is_given_up(lab, monkeypatch):
    made, begun, may_go_on, pieces = [], threading.Event(), threading.Event(), served.pieces

    def slow(batch, how):
        for number, piece in enumerate(pieces(batch, how)):
            made.append(len(batch))
            if number == 0 and len(batch) > 35:
                begun.set()
                may_go_on.wait()
            yield piece

    monkeypatch.setattr(served, "pieces", slow)
    with asked(lab.port, target(columns=600, rows=400)):
        begun.wait()
    for _ in range(20):  # which wait for their turn
        asked(lab.port, target(columns=500, rows=400)).close()
    may_go_on.set()
    assert got(lab.port, target())[0] == 200
    assert made == [240_000, 35]


def test_a_map_is_tossed_on_the_card(map_path, monkeypatch):
    with serving(served.ServedLab(CASE, 0, Device.CPU)) as lab:
        _, _, due = got(lab.port, target(columns=80, rows=60))
    card = with_card(monkeypatch)
    for device in (Device.CUDA, Device.AUTO):
        card.given.clear()
        with serving(served.ServedLab(CASE, 0, device)) as lab:
            assert got(lab.port, target(columns=80, rows=60))[2] == due
        assert sum(card.given) == 4800
    card.left = 0
    for shown in (CASE, map_path):
        with serving(served.ServedLab(shown, 0, Device.CUDA)) as lab:
            status, _, body = got(lab.port, target())
        assert (status, body) == (503, b"`device` cuda: the card was lost; accepted: cpu, auto\n")
