"""The answers of the command line to bad input: one line each, what was given, and what is accepted."""

import shlex

import pytest

from tests.helpers.command_line import refused

AXES = "basin fig24a --x release.position.z=1:2:3 --y gravity=9:10:2"
FIND = "find fig24a --vary release.position.z=0.3:0.5"

# What stands in each answer.
ANSWERS = {
    # what is missing
    "toss": "SCENARIO: missing; accepted: a TOML file, or a name that cointoss scenarios lists",
    "explore": "MAP.zarr: missing; accepted: a map that cointoss basin made (see ",
    "basin fig24a": "--x: missing; accepted: --x FIELD=START:STOP:N, the field that varies along x, and its ",
    AXES: "--out: missing; accepted: --out MAP.zarr, the Zarr store to write (see ",
    "video fig24a": "--out: missing; accepted: --out PATH, the file to write: .mp4, .webm or .gif (see ",
    "solref --dt 0.002": "--restitution and --of: accepted: one of them",
    "find fig24a": "--vary: missing; accepted: --vary FIELD=START:STOP, a field",
    FIND: "--sequence, --outcome: none; accepted: one of them",
    "fit": "OBSERVED.csv: missing; accepted: a CSV file with the times of touches",
    "fit file fig24a": "--vary: missing; accepted: --vary FIELD=START:STOP, a field",
    "bounce model.xml ball": "GEOM: missing; accepted: the name or the number of a geom, twice (see ",
    "bounce gone.xml a b": "gone.xml: accepted: an XML file of MuJoCo that exists",
    "bounce file a b": "file: accepted: an XML file that MuJoCo loads (",
    "bounce file a b --png e.gif": "e.gif: another kind of file; accepted: a name that ends in .png",
    "solref --of '0.01 -1' --dt 0.002": "--of 0.01 -1: accepted: two numbers as in a <geom>: both ",
    "solref --of '0.01 x' --dt 0.002": "--of 0.01 x: accepted: two numbers as in a <geom>",
    "solref --of '0.01 1' --with '1' --dt 0.002": "--with 1: accepted: two numbers as in a <geom>",
    "solref --of '0.01 1' --dt 0.002 --integrator RK5": "--integrator RK5: accepted: Euler, RK4, ",
    "solref --of '0.01 1' --dt 0.002 --solimp hard": "--solimp hard: accepted: up to five numbers",
    "solref --of '0.01 1' --dt 0.002 --body 'box 1'": "--body box 1: accepted: only beside --restitution",
    "solref --restitution 0.5 --dt 2ms --with '1 1'": "--with 1 1: accepted: only beside --of",
    "solref --restitution 0.5 --dt 2ms --body 'box 1'": "--body box 1: accepted: a type and its size [m] ",
    "solref --restitution 0.5 --dt 2ms --backend brax": "'--backend': 'brax' is not one of 'mujoco', 'mjx'",
    "solref --restitution 0.8": "--dt: missing; accepted: --dt DT, the model's timestep, such as 0.002 ",
    "reproduce all": "--out: missing; accepted: main reproduce all --out DIR (see ",
    "reproduce --out out": "NAME: missing; accepted: all, or one of: accuracy-and-stripes, ",
    # names and choices
    "throw": "throw: no such command; accepted: basin, bounce, compare, ",
    "toss nofile": "nofile: no such file; accepted: a TOML file, or one of: contact_coulomb, ",
    "toss tabel": " (did you mean table?)",
    "lab no-such": "cointoss: no-such: ",
    "toss ''": "(no name): no such file; accepted: a TOML file, or one of: ",
    "compare fig24a --no-video --out ''": "'--out': an empty name; accepted: a path",
    "toss fig24a --engine bullet": "'--engine': 'bullet' is not one of 'analytic', 'mujoco' (",
    "video fig24a --out a.mp4 --camera below": "'--camera': 'below' is not one of 'overview', ",
    "toss fig24a --max-impact 3 --jsn": "No such option '--max-impact'",
    "toss fig24a --jsn": "No such option '--jsn'; did you mean --json? (see ",
    "toss fig24a --spin 50": "No such option '--spin'; cointoss hands and cointoss shares take it (see ",
    "toss fig24a --weight 5": "No such option '--weight' (see ",
    "reproduce nothing": "nothing: no such name; accepted: accuracy-and-stripes, ",
    "reproduce contact-laws no-such --out out": "no-such: no such name; accepted: ",
    "reproduce contact_laws --out out": "contact_laws: no such name; accepted: ",
    f"{FIND} --sequence ht": "sequence: 'ht', accepted: letters H and T",
    "shares fig24a --up tails": "'--up': 'tails' is not one of 'heads', 'either'",
    f"{AXES} --margin weight --out a.zarr": "margin weight: accepted: height, velocity x,",
    # settings of a scenario
    "toss fig24a --set restitutoin=0.5": (
        "fig24a: restitutoin: no field of a scenario; accepted: floor.restitution, numbers of coin, air, "
        "floor, release, ending, and gravity (did you mean floor.restitution?)\n"
    ),
    "toss fig24a --set restitution": "'--set': restitution; accepted: FIELD=VALUE, such as restitution=0.5, ",
    "toss fig24a --set restitution=": "'--set': restitution=; accepted: FIELD=VALUE",
    "toss fig24a --set restitution=1.5": "fig24a: floor.restitution = 1.5: accepted: a number >= 0 and <= 1",
    "toss fig24a --set contact=rough": 'fig24a: floor.contact = "rough": accepted: one of "sharp_edge", ',
    "toss fig24a --set 'height=40 s'": 'fig24a: release.position[2] = "40 s": accepted: a number in m',
    "toss fig24a --set velocity=[0,1]": "fig24a: release.velocity = [0, 1]: accepted: a list of 3 ",
    "compare fig24a --set coin=0.5 --out report": "fig24a: coin = 0.5: accepted: a table [coin] with mass",
    "video fig24a --set max_impacts=2.5 --out a.mp4": "fig24a: ending.max_impacts = 2.5: accepted: a whole ",
    f"{AXES} --set height=-1 --out a.zarr": "fig24a: release.position.z = -1.0: accepted: a coin above",
    "lab fig24a --set mass=0": "fig24a: coin.mass = 0: accepted: ",
    # numbers
    "toss fig24a --max-impacts 0": "'--max-impacts': 0; accepted: an integer >= 1 and <= 1000000 (",
    "toss fig24a --max-impacts 1e9": "'--max-impacts': 1e9; accepted: an integer >= 1 and ",
    "toss fig24a --contact-steps 0": "'--contact-steps': 0; accepted: an integer >= 1 and ",
    "hands fig24a --tosses 0": "'--tosses': 0; accepted: an integer >= 1 and <= 10000000 (",
    "find fig24a --sequence H --vary release.position.z=0.2:1e300": (
        "release.position.z = 1e300: accepted: a finite number within 1e+09"
    ),
    "find fig24a --sequence H --vary coin.radius=-2:-1": (
        "coin.radius=-2:-1: coin.radius = -2.0: accepted: a number >= 1e-09"
    ),
    "shares fig24a --to 60%": "--to 60%: accepted: a part from 0.01 % to 50 %",
    "shares fig24a --to 2": "--to 2: accepted: a part from 0.01 % to 50 %",
    "shares fig24a --height 2e9": "hand.height = 2e+09: accepted: a number >= -1e+09 and <= 1e+09 in m",
    "shares fig24a --vary coin.thickness=0:30:5": (
        "hand.height = 1: accepted: a coin above the floor: z >= 3.75 m (at coin.thickness = 7.5)"
    ),
    "shares fig24a --vary hand.psi=0:1": 'hand.psi = "0:1": accepted: START:STOP:N, such as 0.2:0.8:7',
    "shares fig24a --vary hand.height=1e300:1e308:2": (
        "hand.height = 1e300: accepted: a finite number within 1e+09"
    ),
    "solref --restitution 0.5 --dt x": "'--dt': x; accepted: a number in s, or a string with a ",
    "solref --restitution 0.5 --dt 0": "--dt 0: accepted: a number of seconds from 1e-7 to 0.1",
    "solref --restitution 0.5 --dt '2 m'": "'--dt': 2 m; accepted: a number in s, or ",
    "solref --restitution 120% --dt 2ms": "--restitution 120%: accepted: a number from 0 to 1",
    "solref --restitution 0 --dt 2ms --spring": "--restitution 0: accepted: a number from 0.01 to 1 by a ",
    "solref --restitution 0.5 --dt 2ms --spring --steps 2": "'--steps': 2; accepted: an integer",
    # numbers with units
    "hands fig24a --psi 100deg": "--psi 100deg: accepted: an angle from 0 to 90 deg",
    "hands fig24a --psi '2 rad'": "--psi 2 rad: accepted: an angle from 0 to 90 deg",
    "hands fig24a --psi x": "'--psi': x; accepted: a number in rad, or a string with a unit like ",
    "hands fig24a --psi-scatter '91 deg'": "--psi-scatter 91 deg: accepted: an angle from 0 to 90 deg",
    "hands fig24a --scatter 40%": "--scatter 40%: accepted: a part from 0 to 30 %",
    "hands fig24a --height '-3 cm'": "--height -3 cm: accepted: a length above 0, such as 1 m",
    "hands fig24a --speed -1": "--speed -1: accepted: a speed of 0 or more, such as 2 m/s",
    "hands fig24a --spin nan": "--spin nan: accepted: ",
    "hands fig24a --spin 1e7": "fig24a: hand.spin = 1e+07: accepted: a spin of at most 100000 sqrt(",
    "hands fig24a --caught '1 mm'": "--caught 1 mm: accepted: more than 0.0125399 m, so that the coin is ",
    "hands fig24a --caught '1 s'": "'--caught': 1 s; accepted: a number in m, or ",
    # what MuJoCo cannot do
    "toss contact_knurled --engine mujoco": 'contact_knurled: floor.contact = "knurled": accepted by the',
    "video contact_knurled --engine mujoco --out a.mp4": 'contact = "knurled": accepted by the MuJoCo engine',
    "video contact_knurled --engine both --out a.mp4": 'contact = "knurled": accepted by the MuJoCo engine',
    f"{AXES.replace('fig24a', 'contact_knurled')} --compare --out a.zarr": 'floor.contact = "knurled"',
    "toss fig29 --margin --engine mujoco": "--margin: accepted: only without --engine mujoco (see ",
    f"{AXES} --margin height --engine mujoco --out a.zarr": "--margin height: accepted: only without --",
    f"{AXES} --margin height --compare --out a.zarr": "--margin height: accepted: only without --compare",
    f"{AXES} --trust --engine mujoco --out a.zarr": "--trust: accepted: only without --engine mujoco",
    # what excludes another
    "shares fig24a --compare --engine analytic": "--engine and --compare: accepted: one of them",
    "shares fig24a --spun --caught '1 m'": "--caught 1 m: accepted: only without --spun",
    "solref --restitution 0.5 --dt 2ms --steps 40": "--steps 40: accepted: only beside --spring",
    "basin fig24a --x ending.max_impacts=1:3:3 --y gravity=9:10:2 --after 2 --out a.zarr": (
        "fig24a: ending.max_impacts: an axis beside after = 2; accepted: one of the two"
    ),
    f"{AXES} --resume --overwrite --out a.zarr": "one of them",
    f"{AXES} --compare --engine mujoco --out a.zarr": "one of them",
    f"{AXES} --palette safe --out a.zarr": "--palette safe: accepted: only beside --png or --report",
    f"{AXES} --contact one_step --out a.zarr": "accepted: only beside --engine mujoco or --compare",
    f"{AXES} --engine analytic --contact spring --out a.zarr": "only beside --engine mujoco or --compare",
    f"{AXES} --engine mujoco --contact hard --out a.zarr": "'spring', 'one_step'",
    f"{AXES} --report report --out a.zarr": "only beside --compare",
    f"{AXES} --compare --no-video --out a.zarr": "--no-video: accepted: only beside --report",
    f"{AXES} --engine mujoco --report report --out a.zarr": "only beside --compare",
    "toss fig24a --flight-steps 7": "--flight-steps 7: accepted: only beside --engine mujoco",
    "toss fig24a --contact one_step": "--contact one_step: accepted: only beside --engine mujoco",
    # axes of a map
    "basin fig24a --x floor.contact=0:1:3 --y gravity=9:10:2 --out a.zarr": "no numeric field",
    "basin fig24a --x heigth=0:1:10 --y gravity=9:10:2 --out a.zarr": (
        "fig24a: heigth: no numeric field of a scenario; accepted: release.position.z, numbers of coin, air, "
        "floor, release, ending, and gravity (did you mean release.position.z?)\n"
    ),
    "shares fig24a --vary heigth=1:2:3": "accepted: hand.height, numbers of hand, coin, air, floor, ",
    "basin fig24a --x gravity=9:9:3 --y coin.mass=1:2:2 --out a.zarr": "START = STOP",
    "basin fig24a --x release.position.z=-1:1:3 --y gravity=9:10:3 --out a.zarr": "above the floor",
    f"{AXES} --after -1 --out a.zarr": "accepted: an integer >= 0",
    f"{AXES} --png map.png --size 6 --out a.zarr": "WIDTHxHEIGHT",
    f"{AXES} --png map.png --size 0x4 --out a.zarr": "WIDTHxHEIGHT",
    "basin fig24a --x release.position.x=0:1:1000000 --y release.position.y=0:1:1000000 --out a.zarr": (
        "need up to 5,000"
    ),
    # places
    f"{AXES} --compare --report file --out a.zarr": "file: is no folder; accepted: a folder",
    f"{AXES} --compare --report file/report --out a.zarr": "can't be written",
    f"{AXES} --compare --report a.zarr --out a.zarr": "lies in the map a.zarr; ",
    f"{AXES} --compare --report a-mujoco.zarr/report --out a.zarr": "lies in the map a-mujoco.zarr; ",
    f"{AXES} --png map.gif --out a.zarr": "ends in .png",
    "compare fig24a --out file/below": "below: can't be written (",
    "toss fig24a --trajectory .": ".: another kind of file; accepted: a name that ends in .csv",
    "toss fig24a --trajectory no/path.csv": "no/path.csv: no folder no; accepted: a file in a folder that ",
    "compare fig24a --out file": "file: is no folder; accepted: a folder",
    "video fig24a --out a.avi": "a.avi: another kind of file; accepted: a name that ends in .mp4 or .webm",
    "video fig24a --out film": "film: another kind of file; accepted: a name that ends in .mp4 or .webm",
    "video fig24a --out a.mp4 --poster b.jpg": "b.jpg: another kind of file; accepted: a name that ends in",
    "video fig24a --out no/a.mp4": "no/a.mp4: no folder no; accepted: a file in a folder that exists",
    f"{AXES} --out a.map": "a.map: another kind of name; accepted: one that ends in .zarr",
    f"{AXES} --out no/a.zarr": "no/a.zarr: no folder no; accepted: a name in a folder that exists",
    "lab fig24a --out lab.txt": "lab.txt: another kind of file; accepted: a name that ends in .html",
    f"{FIND} --sequence H --out a.json": "a.json: another kind of file; accepted: a name that ends in .toml",
    "shares fig24a --out a.txt": "a.txt: another kind of file; accepted: a name that ends in .csv or .png",
    "shares fig24a --hand no.toml": "no.toml: can't be read (No such file or directory); accepted: a TOML",
    "fit gone.csv fig24a --vary floor.restitution=0.4:0.95": "gone.csv: no such file; accepted: a CSV file",
    "explore gone.zarr": "gone.zarr: no such folder; accepted: a map that cointoss basin made",
    "explore file": "file: is no folder; accepted: a map that cointoss basin made",
    f"{AXES} --out other.zarr": "other.zarr: is no map; accepted: a new name, or a map of cointoss",
}


@pytest.mark.parametrize("line", ANSWERS)
def test_bad_input_is_answered_in_one_line_with_what_is_accepted(line, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").write_text("")
    (tmp_path / "other.zarr").write_text("")
    assert ANSWERS[line] in refused(*shlex.split(line))
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "other.zarr"]
