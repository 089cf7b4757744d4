"""`cointoss reproduce`: the list, unknown names, places in the way, failed claims, files that are whole."""

import subprocess
import sys

import pytest

from compare.reproduction import runner, studies
from tests.helpers.command_line import cointoss

FAKE = """
from compare.reproduction.runner import Figure, Made

def run(folder, progress):
    (folder / "numbers.json").write_text("new")
    progress(1, 1)
    {ending}

FIGURE = Figure(title="a fake", seconds=0, files=("numbers.json", "gone.png"), run=run)
"""
ENDINGS = {
    "good": 'return Made(text="as drawn", failed=())',
    "doubtful": 'return Made(text="as drawn", failed=("two and two are five",))',
    "broken": "raise KeyboardInterrupt",
}


@pytest.fixture
def fakes(tmp_path, monkeypatch):
    folder = tmp_path / "figures"
    folder.mkdir()
    for name, ending in ENDINGS.items():
        (folder / f"fake_{name}.py").write_text(FAKE.format(ending=ending))
    monkeypatch.setattr(studies, "__path__", [*studies.__path__, str(folder)])
    yield
    for name in ENDINGS:
        sys.modules.pop(f"{studies.__name__}.fake_{name}", None)


@pytest.mark.usefixtures("fakes")
def test_without_a_name_it_lists_what_there_is():
    answered = cointoss("reproduce")
    assert answered.exit_code == 0
    lines = answered.stdout.splitlines()
    assert [line.split()[0] for line in lines] == runner.names()
    for line, name in zip(lines, runner.names(), strict=True):
        figure = runner.find(name)
        assert figure.title in line
        assert f"({figure.seconds:g} s)" in line
    assert "contact-laws" in runner.names()


def test_names_are_found_without_importing_what_they_name():
    script = (
        "import sys\nfrom compare.reproduction import runner\n"
        "assert 'contact-laws' in runner.names()\n"
        "heavy = {'numba', 'numpy', 'matplotlib', 'compare.reproduction.studies.contact_laws'}\n"
        "print(sorted(heavy & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["no-such"], "no-such: no such name; accepted: "),
        (["contact-laws", "no-such"], "no-such: no such name; accepted: "),
        (["contact_laws"], "contact_laws: no such name; accepted: "),
        (["contact-laws"], "--out DIR"),
        ([], "NAME one of: "),
    ],
)
def test_wrong_names_and_missing_arguments_are_exit_status_2(tmp_path, arguments, told):
    out = [] if told == "--out DIR" else ["--out", tmp_path / "out"]
    answered = cointoss("reproduce", *arguments, *out)
    assert answered.exit_code == 2
    assert answered.stdout == ""
    assert told in answered.stderr
    assert "contact-laws" in answered.stderr
    assert len(answered.stderr.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.usefixtures("fakes")
def test_files_are_written_and_the_results_printed(tmp_path):
    old = tmp_path / "out" / "fake-good"
    old.mkdir(parents=True)
    for name in ("numbers.json", "gone.png", "mine.txt"):
        (old / name).write_text("old")
    answered = cointoss("reproduce", "fake-good", "--out", tmp_path / "out")
    assert (answered.exit_code, answered.stdout, answered.stderr) == (0, "as drawn\n", "")
    assert {path.name: path.read_text() for path in old.iterdir()} == {
        "numbers.json": "new",
        "mine.txt": "old",
    }


@pytest.mark.usefixtures("fakes")
def test_a_claim_that_fails_is_exit_status_1_and_keeps_the_evidence(tmp_path):
    answered = cointoss("reproduce", "fake-doubtful", "fake-good", "--out", tmp_path / "out")
    assert answered.exit_code == 1
    assert answered.stdout == "as drawn\nas drawn\n"
    assert answered.stderr == "cointoss: fake-doubtful: two and two are five: not confirmed\n"
    assert (tmp_path / "out" / "fake-doubtful" / "numbers.json").read_text() == "new"


@pytest.mark.usefixtures("fakes")
def test_an_interrupted_run_leaves_everything_as_it_was(tmp_path):
    answered = cointoss("reproduce", "fake-broken", "--out", tmp_path / "out")
    assert answered.exit_code == 1
    assert not (tmp_path / "out").exists()


@pytest.mark.usefixtures("fakes")
def test_what_is_in_the_way_is_refused_before_any_work(tmp_path):
    (tmp_path / "file").write_text("mine")
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "fake-broken").write_text("mine")
    (tmp_path / "taken" / "fake-broken" / "gone.png").mkdir(parents=True)
    for out, named in (
        (tmp_path / "file", "file: accepted: a folder"),
        (tmp_path / "out", "fake-broken: accepted: a folder"),
        (tmp_path / "taken", "gone.png: accepted: a new name or a regular file"),
    ):
        # Run, the good one would print and the broken one would abort.
        answered = cointoss("reproduce", "fake-good", "fake-broken", "--out", out)
        assert answered.exit_code == 2
        assert answered.stdout == ""
        assert named in answered.stderr
        assert len(answered.stderr.splitlines()) == 1
    assert (tmp_path / "file").read_text() == (tmp_path / "out" / "fake-broken").read_text() == "mine"
    assert not (tmp_path / "out" / "fake-good").exists()
