"""The command line: help, completion, imports, scenarios, and errors that are one line."""

import errno
import os
import subprocess
import sys
from unittest.mock import patch

import pytest
from click.testing import CliRunner

from cointoss.compare.cli import COMMANDS, NO_MEMORY, main
from cointoss.models.sources import scenario_text
from tests.helpers.command_line import HEAVY, HERE, cointoss, in_a_shell, python, refused


def test_a_field_that_nothing_uses_is_named_in_one_line_by_every_command(tmp_path):
    source = tmp_path / "slippery.toml"
    source.write_text(scenario_text("fig24a").replace('"smooth"', '"smooth"\nfriction = 0.3'))
    axes = ("--x", "release.position.z=0.4:0.5:2", "--y", "gravity=9:10:2")
    for arguments in (
        ("toss", source, "--max-impacts", 1),
        ("compare", source, "--engine", "mujko"),
        ("hands", source, "--tosses", 1),
        ("basin", source, *axes, "--after", 0, "--out", tmp_path / "map.zarr"),
    ):
        (told,) = (line for line in cointoss(*arguments).stderr.splitlines() if "floor.friction" in line)
        assert told.startswith(f"cointoss: {source}: floor.friction = 0.3: not used with contact = ")


@pytest.mark.parametrize(
    ("line", "asked"),
    [
        (
            "toss table --set mass=7.5 --set max_impacts=30000000",
            'coin.mass = 7.5 kg: is it g? write "7.5 g"',
        ),
        (
            "find fig24a --sequence H --vary thickness=1:30 --vary gravity=9:9",
            "coin.thickness = 30 m: is it",
        ),
        (
            "basin fig24a --x thickness=1:30:2 --y gravity=9:9:2 --out a.zarr",
            "coin.thickness = 30 m: is it",
        ),
        (
            "basin fig24a --x height=20:60:3 --y gravity=9:9:2 --out a.zarr",
            "release.position.z = 60 m: is it cm?",
        ),
        ("shares table --vary hand.height=1:300:2 --vary gravity=9:9:2", "hand.height = 300 m: is it mm?"),
    ],
)
@pytest.mark.usefixtures("here")
def test_a_number_in_another_unit_is_questioned_once_before_any_toss(line, asked):
    answered = cointoss(*line.split())
    question, refusal = answered.stderr.splitlines()
    assert question.startswith(f"cointoss: {line.split()[1]}: {asked}")
    assert "accepted: " in refusal
    assert answered.exit_code == 2


def test_without_a_command_it_prints_its_help():
    bare, helped = cointoss(), cointoss("--help")
    assert (bare.exit_code, bare.stdout, bare.stderr) == (0, helped.stdout, "")
    assert "Commands:" in bare.stdout


@pytest.mark.parametrize(
    ("line", "number", "names"),
    [
        ("cointoss sc", 1, ["scenarios"]),
        ("cointoss toss fig18", 2, [f"fig18_{n}d_{kind}" for n in (2, 3) for kind in ("ideal", "imperfect")]),
        ("cointoss basin fig29 --x release.po", 4, [f"release.position.{axis}=" for axis in "xyz"]),
        ("cointoss toss fig24a --set floor.roll", 4, ["floor.rolling_friction="]),
        ("cointoss fit gone.csv tab", 3, ["table"]),
        ("cointoss throw fig", 2, []),
    ],
)
def test_a_shell_completes_names(line, number, names):
    asking = {"_COINTOSS_COMPLETE": "bash_complete", "COMP_WORDS": line, "COMP_CWORD": str(number)}
    told = CliRunner().invoke(main, [], env=asking, prog_name="cointoss").stdout.split()
    assert [item for item in told if not item.startswith("file,")] == [f"plain,{name}" for name in names]
    assert ("file,fig18" in told) == ("toss fig18" in line)


def test_a_closed_pipe_ends_quietly_with_exit_status_1(tmp_path):
    reading, writing = os.pipe()
    os.close(reading)
    command = [sys.executable, "-c", "from cointoss.compare.cli import main; main()", "--help"]
    done = subprocess.run(command, cwd=tmp_path, env=HERE, stdout=writing, stderr=subprocess.PIPE)
    os.close(writing)
    assert (done.returncode, done.stderr) == (1, b"")


@pytest.mark.slow_after_first
@pytest.mark.parametrize(
    "command",
    [
        "toss fig24a --engine mujoco",
        "video fig24a --out film.mp4",
        "basin fig24a --x gravity=9:10:2 --y release.position.z=1:2:2 --compare --out map.zarr",
    ],
)
def test_a_back_end_that_is_none_is_one_line_and_exit_status_2(tmp_path, command):
    done = in_a_shell(f"export MUJOCO_GL=nonsense; cointoss {command}; echo $?", tmp_path)
    (said,) = done.stderr.splitlines()
    assert (done.stdout, "accepted as MUJOCO_GL: egl" in said) == ("2\n", True)
    assert list(tmp_path.iterdir()) == []


HOMES = {name: f"cointoss.compare.commands.{name}" for name in COMMANDS} | {
    "bounce": "cointoss_bounce.command",
    "conform": "cointoss_yardstick.command",
    "reproduce": "cointoss_reproduction.command",
    "solref": "cointoss_bounce.command",
}
"""The module of each command."""


@pytest.mark.slow_after_first
@pytest.mark.parametrize(
    ("words", "status", "needed"),
    [
        ("--help", 0, set()),
        ("--version", 0, set()),
        ("toss --help", 0, set()),
        ("toss fig24a", 0, {"numpy", "pydantic", "cointoss.analytic"}),
        (
            "basin fig24a --x release.position.z=0.2:1:2 --y floor.restitution=0:1:2 --out {}/map.zarr",
            0,
            {"numpy", "pydantic", "zarr", "cointoss.analytic"},
        ),
        ("reproduce --list", 0, set()),
        ("toss fig24a --set restituton=0.5", 2, {"numpy", "pydantic"}),
        ("basin fig24a --x restituton=0:1:3 --y gravity=9:10:2 --out a.zarr", 2, {"numpy", "pydantic"}),
        ("find fig24a --sequence H --vary restituton=0:1", 2, {"numpy", "pydantic"}),
    ],
)
def test_a_command_imports_no_more_than_it_needs(words, status, needed, tmp_path):
    imported = set[str]()
    for folder in ("first", "second"):  # The first process keeps code, which the second runs.
        (tmp_path / folder).mkdir()
        script = (
            "import sys\nfrom click.testing import CliRunner\nfrom cointoss.compare.cli import main\n"
            f"assert CliRunner().invoke(main, sys.argv[1:]).exit_code == {status}\n"
            "print(*sys.modules)"
        )
        done = python("-c", script, *words.format(tmp_path / folder).split())
        assert done.returncode == 0, done.stderr
        imported = set(done.stdout.split())
    assert HEAVY & imported <= needed
    assert {name for name in HOMES if HOMES[name] in imported} <= {words.partition(" ")[0]}
    assert not {"scipy.integrate", "scipy.optimize", "scipy.special", "scipy.stats"} & imported


@pytest.mark.parametrize(
    ("line", "says"),
    [
        (
            "bounce a.xml 0 1",
            "cointoss: bounce: a command of cointoss-bounce, which is not installed; accepted: "
            "pip install cointoss-bounce (see main --help)\n",
        ),
        ("conform analytic", "pip install cointoss-yardstick"),
        ("compare fig24a --engine stick:Stick", "pip install cointoss-yardstick"),
    ],
)
def test_what_needs_another_distribution_says_which_to_install(line, says, monkeypatch):
    monkeypatch.setattr(main, "offered", {})
    monkeypatch.setattr("cointoss.compare.report.simulators.entry_points", lambda **_: ())
    assert says in refused(*line.split())


@pytest.mark.parametrize(("given", "used"), [({}, "1"), ({"OPENBLAS_NUM_THREADS": "3"}, "3")])
def test_matrices_get_one_thread_unless_more_are_asked_for(given, used):
    script = (
        f"import os; os.environ.pop('OPENBLAS_NUM_THREADS', None); os.environ.update({given})\n"
        "from cointoss.__main__ import main\n"
        "try: main()\nfinally: print(os.environ['OPENBLAS_NUM_THREADS'])"
    )
    assert python("-c", script, "--version").stdout.splitlines()[1:] == [used]


@pytest.mark.parametrize("kilobytes", [60_000, 130_000])
def test_too_little_memory_is_one_line(tmp_path, kilobytes):
    done = in_a_shell(f"ulimit -v {kilobytes}; cointoss toss fig24a --max-impacts 1", tmp_path)
    assert done.returncode != 0
    assert "Traceback" not in done.stderr
    assert done.stderr.count("\n") == 1


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (MemoryError(), NO_MEMORY),
        (RuntimeError("can't start new thread"), NO_MEMORY),
        (SystemError("error return without exception set"), NO_MEMORY),
        (SystemError("<function load> returned NULL without setting an exception"), NO_MEMORY),
        (OSError(errno.ENOMEM, os.strerror(errno.ENOMEM)), NO_MEMORY),
        (ImportError("a.so: failed to map segment from shared object", name="a"), NO_MEMORY),
        (OSError("the connection was lost"), "the connection was lost"),
    ],
)
def test_what_the_system_lacks_is_one_line_from_wherever_it_comes(error, said):
    with patch("cointoss.models.sources.named_scenarios", side_effect=error):
        answered = cointoss("scenarios")
    assert (answered.exit_code, answered.stderr) == (1, f"cointoss: {said}\n")


def test_other_failures_of_the_program_are_not_hidden():
    defect = patch("cointoss.models.sources.named_scenarios", side_effect=RuntimeError("a defect"))
    with defect, pytest.raises(RuntimeError, match="a defect"):
        cointoss("scenarios")
