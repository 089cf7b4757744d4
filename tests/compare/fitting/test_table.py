"""Tables as phyphox, Tracker and a person write them, and what is wrong with others."""

import os

import numpy as np
import pytest

from cointoss import Observed, analytic, load
from cointoss.compare.fitting.errors import ObservationError
from cointoss.compare.fitting.table import read_seen
from cointoss.compare.output.answer import path_csv
from cointoss.models.unused import UnusedFieldWarning

SD = {"time": 0.001, "height": 0.002, "attitude": 0.03}


@pytest.fixture
def read(tmp_path):
    """Read the text of a table, by default with standard deviations."""

    def read_text(text: str, sd=SD) -> Observed:
        (path := tmp_path / "seen.csv").write_text(text, encoding="utf-8")
        return read_seen(path, sd)

    return read_text


HEARD = {
    "touch_times": [1.2, 1.55, 1.8],
    "touch_sd": [0.001] * 3,
    "touch_numbers": [1, 2, 3],
    "times": [],
}


@pytest.mark.parametrize(
    ("text", "due"),
    [
        ("t\n1.2\n1.55\n1.8\n", HEARD),
        ("# heard\nTime (s)\n1.2\n1.55\n1.8\n", HEARD),
        ('"Time (ms)"\n1200\n1550\n1800\n', HEARD),
        ("t [s]; sd_t [ms]\n1,2;1\n1,55;1\n1,8;1\n", HEARD),
        # As phyphox exports them.
        ('"Start (s)","Stop 1 (s)","Stop 2 (s)","Stop 3 (s)"\n1.2,1.55,1.8,0\n', HEARD),
        ('"Bounce 0 (s)"\t"Height 0 (m)"\t"Bounce 1 (s)"\t"Bounce 2 (s)"\n1,2\t0,3\t1,55\t1,8\n', HEARD),
        (
            "t,touch,face,z (mm),tilt (deg),sd_t\n"
            "0.1,,,300,90,\n0.2,1,H,,,0.002\n0.5,3,?,,,0.002\n0.6,,,nan,45,\n",
            {
                "touch_numbers": [1, 3],
                "faces": [1, 0],
                "touch_sd": [0.002, 0.002],
                "tilts": [np.pi / 2, np.pi / 4],
                "heights": [0.3, np.nan],
            },
        ),
    ],
)
def test_a_table_says_what_was_seen(read, text, due):
    found = read(text)
    for name, values in due.items():
        assert getattr(found, name).tolist() == pytest.approx(values, nan_ok=True), name


def test_heights_as_tracker_exports_them(read):
    with pytest.warns(UnusedFieldWarning, match="column x: not used"):
        found = read(
            "#multi:\ncoin\t\t\t\nt\tx\ty\t\n0.000E0\t1.2E-1\t3.0E-1\t\n8.3E-3\t1.2E-1\t\t\n1.67E-2\t0\t2.9E-1\t\n"
        )
    np.testing.assert_array_equal(found.times, [0.0, 8.3e-3, 1.67e-2])
    np.testing.assert_array_equal(found.heights, [0.3, np.nan, 0.29])
    assert found.count == 2


def test_a_path_that_this_program_wrote(read):
    states = analytic.toss(load("fig24a")).sample([0.1, 0.2])
    with pytest.warns(UnusedFieldWarning, match="x, y, v_x"):
        found = read(path_csv(states, load("fig24a")))
    np.testing.assert_array_equal(found.heights, states.position[:, 2])
    np.testing.assert_allclose(found.quaternions, states.quaternion)


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("t\n" + 140_000 * "1" + "\n", "field larger than field limit"),
        ("", "no column of times; accepted: t or time;"),
        ("a,b\n1,2\n", "no column of times"),
        ("t\n0.1\nx\n", "column t: row 2 is 'x', accepted: a number"),
        ("t (kg)\n0.1\n", "column t: in kg, accepted: a unit of time, such as s"),
        ("t,tilt (g)\n0.1,3\n", "column tilt: in g, accepted: a unit of angle, such as rad"),
        ("Start (m),Stop (m)\n1,2\n", "column Start: in m, accepted: a unit of time, such as s"),
        ("t (ms)\n0.1\nx\n", r"column t: row 2 is 'x', accepted: a number \[ms\]"),
        ("t (ms)\n300\n# later\n200\n", "column t: row 2 is 200 ms, accepted: times in their order"),
        ("t,z\n0,1\n0.1,1e10\n", "column z: row 2 is 1e10, accepted: numbers within"),
        ("t,touch,z\n0,,1\n0.1,0,\n", "column touch: row 2 is 0, accepted: rising whole numbers from 1"),
        ("t,touch,z\n0,,1\n0.1,1.5,\n", "column touch: row 2 is 1.5, accepted: whole numbers up to"),
        ("t,touch,tilt (deg)\n0,1,\n0.1,,190\n", "column tilt: row 2 is 190 deg, accepted: angles from 0"),
        ("t,time\n0,0\n", "columns t and time; accepted: one of them"),
        ("t,y,y\n0,0,0\n", "columns y and y; accepted: one of them"),
        ("t,z\n0\n", "row 1 has 1 cells"),
        ("t,z\n,1\n", "column t: row 1 is empty, accepted: numbers within"),
        ("t,e0\n0,1\n", "accepted: all of e0, e1, e2 and e3"),
        ("Start (s),Stop (s)\n1,2\n3,4\n", "2 rows of touches"),
        ("t,face\n0.1,H\n0.2,X\n", "column face: row 2 is X, accepted: H, T or "),
        ("t,z\n" + "0.1,0.2\n" * 20_001, "20,001 frames; accepted: at most 20,000"),
        ("t\n" + "0.1\n" * 20_001, "20,001 touches; accepted: at most 20,000"),
        ("t\n", "nothing was seen"),
    ],
)
def test_what_is_wrong_is_named_with_its_file(read, text, named):
    with pytest.raises(ObservationError, match=rf"seen\.csv: .*{named}"):
        read(text)


def test_a_row_without_its_deviation_is_named(read):
    with pytest.raises(
        ObservationError, match=r"column sd_t: row 2 is empty, accepted: a standard deviation"
    ):
        read("t,sd_t\n0.1,1\n0.2,\n", {})


def test_what_is_no_file_of_text_is_refused(tmp_path):
    for name, content in (("gone", None), ("bytes", b"\xff\xfe\x00"), ("large", b"t\n" * 6_000_000)):
        if content is not None:
            (tmp_path / name).write_bytes(content)
        with pytest.raises(ObservationError, match=f"{name}: .*accepted: a CSV file"):
            read_seen(tmp_path / name, SD)
    with pytest.raises(ObservationError, match="/dev/zero: more than 10000000 bytes; accepted: a CSV file"):
        read_seen("/dev/zero", SD)


def test_a_pipe_is_a_table_and_one_that_nobody_writes_to_is_refused(tmp_path):
    os.mkfifo(tmp_path / "seen.csv")
    with pytest.raises(ObservationError, match=r"seen.csv: can't be read \(a pipe that nobody writes to\)"):
        read_seen(tmp_path / "seen.csv", SD)
    read, write = os.pipe()
    os.write(write, b"t\n0.1\n0.2\n")
    os.close(write)
    found = read_seen(f"/dev/fd/{read}", SD)
    assert found.touch_times.tolist() == [0.1, 0.2]
    os.close(read)
