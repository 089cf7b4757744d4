"""The explorer's server answers what its page asks, and nothing else."""

import json
import queue
import threading
from base64 import b64decode
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress

import numpy as np
import pytest
import xarray as xr

from cointoss import analytic, read_map
from cointoss.compare.explorer import server as serving
from cointoss.compare.explorer.finer import toss_tile
from cointoss.compare.explorer.page_files import page_files
from cointoss.models.reading import parse
from tests.helpers.explored import FIELDS, SCENARIO, asked, got, sent


def is_refused(answer, status):
    found, headers, body = answer
    assert found == status, body
    assert headers["content-type"].startswith("text/plain")
    assert "default-src 'none'" in headers["content-security-policy"]
    text = body.decode()
    assert text.endswith("\n")
    assert len(text.splitlines()) == 1
    return text


def test_the_page_and_its_files_are_served(server):
    for name, content in {**page_files(), "": page_files()["index.html"]}.items():
        status, headers, body = got(server.port, f"/{name}")
        assert (status, body) == (200, content)
        assert headers["x-content-type-options"] == "nosniff"
        assert headers["cache-control"] == "no-store"
    assert got(server.port, "/main.js")[1]["content-type"] == "text/javascript; charset=utf-8"
    assert {"index.html", "main.js", "style.css", "three.module.min.js", "LICENSE"} <= set(page_files())


def test_three_is_shipped_with_its_licence_and_asks_for_nothing_else():
    files = page_files()
    assert b"MIT License" in files["LICENSE"]
    assert b"three.js authors" in files["LICENSE"]
    own = b"".join(content for name, content in files.items() if not name.startswith("three."))
    assert b"https://" not in own
    assert own.count(b"http://") == own.count(b"http://www.w3.org/2000/svg") == 1


@pytest.fixture
def busy(monkeypatch):
    """Let no toss end before it may; return the places that are tossed, in turn, and what lets them end."""
    tossed, may_end = queue.Queue(), threading.Event()

    def toss_pixel(_sweep, x, _y, engine):
        tossed.put(x)
        may_end.wait()
        return {"engine": engine}

    monkeypatch.setattr(serving, "toss_pixel", toss_pixel)
    yield tossed, may_end
    may_end.set()


def test_the_map_and_a_tile_do_not_wait_for_tosses(server, busy):
    tossed, _ = busy
    with asked(server.port, "/toss?x=40&y=0.4&engine=analytic"):
        assert tossed.get() == 40
        assert got(server.port, "/map")[0] == 200
        assert got(server.port, "/tile?level=3&column=2&row=1")[0] == 200


def test_a_toss_that_nobody_waits_for_any_more_is_given_up(server, busy):
    tossed, may_end = busy
    with ThreadPoolExecutor() as pool:
        first = asked(server.port, "/toss?x=40&y=0.4&engine=analytic")
        assert tossed.get() == 40
        for _ in range(20):
            asked(server.port, "/toss?x=41&y=0.4&engine=analytic").close()
        # It sends no more, and waits for its answer.
        last = pool.submit(got, server.port, "/toss?x=42&y=0.4&engine=analytic")
        may_end.set()
        status, _, body = last.result()
    assert (status, json.loads(body)) == (200, [{"engine": "analytic"}])
    assert (tossed.get(), tossed.empty()) == (42, True)
    assert first.recv(1 << 16).startswith(b"HTTP/1.0 200 OK\r\n")
    first.close()


METHODS = "POST HEAD PUT DELETE OPTIONS TRACE CONNECT FOO get"


@pytest.mark.parametrize("method", METHODS.split())
def test_other_methods_are_refused(server, method):
    answer = got(server.port, "/", "Content-Length: 3", method=method)
    is_refused(answer, 405)
    assert answer[1]["allow"] == "GET"


HOSTS = " evil.example 127.0.0.1 localhost 127.0.0.1:1 {}.evil.example 127.0.0.1:{}0 [::1]:{}"


@pytest.mark.parametrize("host", HOSTS.split(" "))
@pytest.mark.parametrize("target", ["/", "/map", "/toss?x=40&y=0.4", "/nothing"])
def test_a_foreign_host_is_refused(server, host, target):
    is_refused(got(server.port, target, host=host.replace("{}", str(server.port)) or " "), 403)


def test_a_host_that_is_missing_or_there_twice_is_refused(server):
    is_refused(sent(server.port, b"GET / HTTP/1.1\r\n\r\n"), 403)
    is_refused(got(server.port, "/", "Host: evil.example"), 403)
    is_refused(got(server.port, "/", f"Host: 127.0.0.1:{server.port}"), 403)
    assert got(server.port, "/", host=f"localhost:{server.port}")[0] == 200


@pytest.mark.parametrize("site", ["cross-site", "same-site"])
def test_the_requests_of_other_pages_are_refused(server, site):
    is_refused(got(server.port, "/toss?x=40&y=0.4", f"Sec-Fetch-Site: {site}"), 403)


NOT_FOUND = r"""
/nothing /zarr.json /map.zarr/zarr.json /../zarr.json /../../../../etc/passwd /..%2f..%2fetc%2fpasswd
/%2e%2e/%2e%2e/etc/passwd /....//etc/passwd /..\..\etc\passwd //etc/passwd /etc/passwd /page/index.html
/three/three.core.min.js /three/../index.html /./index.html /index.html/ /index.html?x=1 /index.html%00
/INDEX.HTML /server.py /__init__.py /map/ /toss/ /#map * index.html http://127.0.0.1/map file:///etc/passwd
~/.ssh/id_rsa
"""


@pytest.mark.parametrize("target", NOT_FOUND.split())
def test_what_is_not_of_the_page_is_not_found(server, target):
    text = is_refused(got(server.port, target), 404)
    assert "root:" not in text


NO_NUMBERS = """nan inf -inf 1e999 -1e999 0x20 4_0 %2040 40%20 40%0a %D9%A4%D9%A0 40;1 1e1000000 + forty
40'-- <script> 1000 -40 60.000001 19.999999 999999999999999999999999999999999999999999999999999999999999"""


NO_QUERIES = """
? ?x=40 ?y=0.4 ?x=40&y=0.4&z=1 ?x=40&x=41&y=0.4 ?x=40&y=0.4&engine= ?x=40&y=0.4&engine=python
?x=40&y=0.4&engine=analytic&engine=mujoco ?x&y ?x=40&y=0.7
"""


NO_TILES = "-1,0,0 31,0,0 99999999999,0,0 1,-1,0 1,0,99 1,99999999999,0 1,1.5,0 1,,0 a,0,0"


WRONG = [
    *(f"/toss?x={number}&y=0.4" for number in ["", *NO_NUMBERS.split()]),
    *(f"/toss{query}" for query in ["", *NO_QUERIES.split(), "?" + "&".join(f"x{i}=1" for i in range(50))]),
    *("/tile?level={}&column={}&row={}".format(*place.split(",")) for place in NO_TILES.split()),
]


@pytest.mark.parametrize("target", WRONG)
def test_wrong_and_huge_numbers_wrong_queries_and_tiles_that_are_none_are_refused(server, target):
    text = is_refused(got(server.port, target), 400)
    assert "accepted" in text
    assert "<" not in text


def test_what_is_no_request_is_refused_and_the_server_goes_on(server):
    is_refused(got(server.port, "/toss?x=" + "1" * 2000), 414)
    for noise in (
        b"\r\n\r\n",
        b"\x00\xff\x16\x03\x01",
        b"GET\r\n\r\n",
        b"GET / HTTP/9.9\r\n\r\n",
        b"GET / FTP/1.1\r\n\r\n",
    ):
        with suppress(IndexError, ValueError):  # it may also hang up without a word
            sent(server.port, noise)
    is_refused(got(server.port, "/", *(f"X-{i}: 1" for i in range(200))), 431)
    assert got(server.port, "/")[0] == 200


def test_the_map_is_told_pixel_by_pixel(server, map_path):
    _, _, body = got(server.port, "/map")
    told = json.loads(body)
    with xr.open_dataset(map_path, engine="zarr") as found:
        for name, kind in (("outcome", "<i1"), ("impacts", "<i4")):
            array = np.frombuffer(b64decode(told["arrays"][name]), kind).reshape(18, 24)
            assert np.array_equal(array, found[name].to_numpy())
    assert told["axes"]["x"] == {
        "field": FIELDS[0],
        "word": "spin about η",
        "unit": "rad/s",
        "start": 20.0,
        "stop": 60.0,
        "count": 24,
    }
    assert (told["after"], told["stride"], told["tossed"], told["margin"]) == (1, 1, 1.0, None)
    assert told["outcomes"]["1"] == {"label": "heads", "color": "#F5AB1F"}


def test_a_pixel_is_tossed_by_both_engines_to_its_end(server):
    _, _, body = got(server.port, "/toss?x=40.0&y=0.4")
    first, second = json.loads(body)
    assert (first["engine"], second["engine"]) == ("analytic", "mujoco")
    scenario = parse(SCENARIO, "here").replace(FIELDS[0], 40.0, FIELDS[1], 0.4)
    toss = analytic.toss(scenario)
    assert first["sequence"] == toss.sequence
    assert len(first["sequence"]) > 2  # the map shows the second touch
    assert (first["outcome"], first["trusted"]) == (str(toss.outcome), toss.trusted_impacts)
    times = np.array(first["path"]["time"])
    states = toss.sample(times.clip(0, toss.end_time))
    assert np.allclose(np.reshape(first["path"]["position"], (-1, 3)), states.position, atol=1e-6)
    assert np.allclose(np.reshape(first["path"]["quaternion"], (-1, 4)), states.quaternion, atol=2e-4)
    falling = times < toss.impacts.time[0] * (1 - 1e-6)
    assert falling.sum() > 10
    energy = np.array(first["path"]["energy"])
    assert np.allclose(energy[falling], energy[0], rtol=1e-4)
    assert energy[-1] < energy[0]
    assert json.loads(got(server.port, "/toss?x=40.0&y=0.4&engine=mujoco")[2]) == [second]


def test_a_tile_is_served(server, map_path):
    status, headers, body = got(server.port, "/tile?level=3&column=2&row=1")
    assert (status, headers["content-type"]) == (200, "application/octet-stream")
    assert body == toss_tile(read_map(map_path), 3, 2, 1).tobytes()
