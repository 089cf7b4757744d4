"""`cointoss reproduce`: the list, unknown names, places in the way, failed claims, files that are whole."""

import json
import subprocess
import sys

import pytest

from cointoss_reproduction import studies
from cointoss_reproduction.frame import runner
from tests.helpers.command_line import cointoss, refused

FAKE = """
from dataclasses import dataclass
from cointoss_reproduction.frame.claim import Claim, Criterion
from cointoss_reproduction.frame.result import Reproduction, Result

@dataclass
class Numbers:
    sum: int

def make(progress):
    progress(1, 1)
    return Result(
        claims=[Claim(claim="two and two are five", criteria=[Criterion("sum", {sum}, "=", 5, "five")])],
        data=Numbers({sum}),
        tables="as **drawn**",
    )

REPRODUCTION = Reproduction(title="a fake", seconds=0, make=make, draw={{}})
"""
COMPILED = "__import__('cointoss.models.kernel.compiled', fromlist=['by_numba']).by_numba(lambda: 5)()"
SUMS = {
    "compiled": COMPILED,
    "good": "5",
    "doubtful": "4",
    "broken": "(_ for _ in ()).throw(KeyboardInterrupt)",
}


@pytest.fixture
def fakes(tmp_path, monkeypatch):
    folder = tmp_path / "figures"
    folder.mkdir()
    for name, value in SUMS.items():
        (folder / f"fake_{name}.py").write_text(FAKE.format(sum=value))
    monkeypatch.setattr(studies, "__path__", [*studies.__path__, str(folder)])
    yield
    for name in SUMS:
        sys.modules.pop(f"{studies.__name__}.fake_{name}", None)


@pytest.mark.usefixtures("fakes")
def test_without_a_name_it_lists_what_there_is():
    answered = cointoss("reproduce")
    assert answered.exit_code == 0
    lines = answered.stdout.splitlines()
    assert [line.split()[0] for line in lines] == runner.names()
    for line, name in zip(lines, runner.names(), strict=True):
        found = runner.find(name)
        assert found.title in line
        assert f"({found.seconds:g} s)" in line
    assert "contact-laws" in runner.names()


def test_names_are_found_without_importing_what_they_name():
    script = (
        "import sys\nfrom cointoss_reproduction.frame import runner\n"
        "assert 'contact-laws' in runner.names()\n"
        "heavy = {'numba', 'numpy', 'matplotlib', 'cointoss_reproduction.studies.contact_laws'}\n"
        "print(sorted(heavy & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.usefixtures("fakes")
def test_files_are_written_and_the_results_printed(tmp_path):
    old = tmp_path / "out" / "reproduction" / "fake-good"
    old.mkdir(parents=True)
    for name in ("numbers.json", "data.npz", "mine.txt"):
        (old / name).write_text("old")
    answered = cointoss("reproduce", "fake-good", "--out", tmp_path / "out")
    assert (answered.exit_code, answered.stderr) == (0, "")
    assert answered.stdout.startswith("as drawn\n\n✓ holds: two and two are five\n")
    assert answered.stdout.endswith(f"\n\nfake-good: 1 holds\n{old}\n")
    assert sorted(path.name for path in old.iterdir()) == [
        "claims.json",
        "mine.txt",
        "numbers.json",
        "provenance.json",
    ]
    assert json.loads((old / "numbers.json").read_text()) == {"sum": 5}
    assert (old / "mine.txt").read_text() == "old"


@pytest.mark.usefixtures("fakes")
def test_a_claim_that_fails_is_exit_status_1_and_keeps_the_evidence(tmp_path):
    answered = cointoss("reproduce", "fake-doubtful", "fake-good", "--out", tmp_path / "out")
    assert answered.exit_code == 1
    counts = [line for line in answered.stdout.splitlines() if line.startswith("fake-")]
    assert counts == ["fake-doubtful: 1 does not hold", "fake-good: 1 holds"]
    told = "cointoss: fake-doubtful: two and two are five: another verdict than the known one\n"
    assert answered.stderr == told
    folder = tmp_path / "out" / "reproduction" / "fake-doubtful"
    assert json.loads((folder / "numbers.json").read_text()) == {"sum": 4}


@pytest.mark.usefixtures("fakes")
def test_an_interrupted_run_leaves_everything_as_it_was(tmp_path):
    answered = cointoss("reproduce", "fake-broken", "--out", tmp_path / "out")
    assert answered.exit_code == 130
    assert not (tmp_path / "out").exists()


@pytest.mark.usefixtures("fakes")
def test_without_numba_a_study_with_functions_of_its_own_says_in_a_line_what_it_needs(tmp_path, monkeypatch):
    monkeypatch.delitem(sys.modules, "cointoss.models.kernel.by_numba", raising=False)
    monkeypatch.setitem(sys.modules, "numba", None)
    told = refused("reproduce", "fake-compiled", "--out", tmp_path / "out")
    needs = 'fake-compiled: needs numba: pip install "cointoss-dynamics[reproduce]"'
    assert told == f"cointoss: {needs}\n"
    assert not (tmp_path / "out").exists()


@pytest.mark.usefixtures("fakes")
def test_what_is_in_the_way_is_refused_before_any_work(tmp_path):
    (tmp_path / "file").write_text("mine")
    (tmp_path / "out" / "reproduction").mkdir(parents=True)
    (tmp_path / "out" / "reproduction" / "fake-broken").write_text("mine")
    (tmp_path / "taken" / "reproduction" / "fake-broken" / "data.npz").mkdir(parents=True)
    for out, named in (
        (tmp_path / "file", "file: is no folder; accepted: a folder"),
        (tmp_path / "out", "fake-broken: is no folder; accepted: a folder"),
        (tmp_path / "taken", "data.npz: is a folder; accepted: a new name or a regular file"),
    ):
        # Run, the good one would print and the broken one would abort.
        assert named in refused("reproduce", "fake-good", "fake-broken", "--out", out)
    assert (
        (tmp_path / "file").read_text()
        == (tmp_path / "out" / "reproduction" / "fake-broken").read_text()
        == "mine"
    )
    assert not (tmp_path / "out" / "reproduction" / "fake-good").exists()
