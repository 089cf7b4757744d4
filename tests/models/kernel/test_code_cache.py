"""Code that is kept on disk is never stale, and what another process keeps meanwhile does it no harm."""

import math
import os
import shutil
import subprocess
import sys
import time
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from subprocess import PIPE
from types import SimpleNamespace

import pytest
from llvmlite import binding

import cointoss.models.kernel.code_cache as code_cache
from cointoss.models.kernel.base_folder import base_folder
from cointoss.models.kernel.code_cache import UNUSED, cache_folder, remove_unused
from cointoss.models.kernel.fork.code_files import CodeFiles
from cointoss.models.kernel.libm import with_digest
from tests.helpers.modules import write

TOP = Path(code_cache.__file__).parents[2]
IMPORT = "from cointoss.models.kernel.compiled import compiled\n"
CALLEE = IMPORT + "\n\n@compiled\ndef part(x):\n    return {} * x\n"
CALLER = IMPORT + "from {} import part\n\n\n@compiled\ndef whole(x):\n    return part(x) + {}\n"


USER = IMPORT + "\n\n@compiled\ndef difference(p):\n    return p.a - p.b\n"
FORK = """
import gc, os, sys
import numba

if WARM:
    numba.njit("f8(f8)")(lambda x: x)
gc.freeze()
for line in sys.stdin:
    process = os.fork()
    if process == 0:
        folder, script = eval(line)
        os.chdir(folder)
        sys.path.insert(0, folder)
        os.environ["NUMBA_CACHE_DIR"] = os.path.join(folder, "cache")
        exec(script, {"__name__": "__main__"})
        sys.stdout.flush()
        os._exit(0)  # to take numba down would take longer than most scripts
    print("|", os.waitpid(process, 0)[1], flush=True)
"""
"""A process with numba, WARM from having compiled, and none of ours, imported: it forks for each script."""


@contextmanager
def forking(*, warm):
    """Return what runs a script in a folder, in a process of its own, and returns the numbers it prints."""
    asked = [sys.executable, "-c", FORK.replace("WARM", str(warm))]
    with subprocess.Popen(asked, env={"PATH": ""}, stdin=PIPE, stdout=PIPE, text=True) as process:
        questions, answers = process.stdin, process.stdout
        assert questions is not None
        assert answers is not None

        def run_in(folder, script):
            print((str(folder), script), file=questions, flush=True)
            lines = []
            while not (line := answers.readline()).startswith("|"):
                assert line, "the process that forks has ended"
                lines.append(line)
            assert line == "| 0\n", lines
            return [float(word) for word in "".join(lines).split()]

        yield run_in
        questions.close()


@pytest.fixture(scope="module")
def run():
    with forking(warm=True) as run_in:
        yield run_in


@pytest.fixture
def run_caller(run, folder):
    """Return the answer, and what was read from disk: of the caller for Python, and of it and its callee."""
    script = (
        "from cointoss.analytic.caller import whole, part\n"
        "print(whole(10.0))\n"
        "print(whole.read)\n"
        "for f in (whole, part):\n"
        "    print(sum(f.dispatcher.stats.cache_hits.values()))"
    )
    return lambda: run(folder, script)


@pytest.fixture
def folder(tmp_path):
    """A package with the kernel, and a function of it that calls one of another module."""
    for package in ("", "models", "analytic"):
        (tmp_path / "cointoss" / package).mkdir()
        # Without it the installed package would be found first.
        (tmp_path / "cointoss" / package / "__init__.py").touch()
    shutil.copytree(TOP / "models" / "kernel", tmp_path / "cointoss" / "models" / "kernel")
    write(tmp_path, "cointoss.analytic.callee", CALLEE.format(2.0))
    write(tmp_path, "cointoss.analytic.caller", CALLER.format("cointoss.analytic.callee", 1))
    return tmp_path


@pytest.mark.parametrize(
    "callee",
    ["cointoss.analytic.callee", "cointoss.analytic.room.callee", "cointoss.models.room.deeper.callee"],
)
def test_an_edit_compiles_anew_what_it_can_change_and_no_more(folder, callee, run_caller):
    write(folder, "cointoss.analytic.__init__", "from cointoss.analytic.other import unused\n")
    write(folder, "cointoss.analytic.other", "unused = 0\n")
    write(folder, "cointoss.analytic.caller", CALLER.format(callee, 1))
    write(folder, callee, CALLEE.format(2.0))
    assert run_caller() == [21, 0, 0, 0]
    assert run_caller() == [21, 1, 0, 0], "what is kept for Python needs nothing of its callees"
    write(folder, callee, CALLEE.format(3.0))
    assert run_caller() == [31, 0, 0, 0]
    write(folder, "cointoss.analytic.caller", CALLER.format(callee, 2))
    assert run_caller() == [32, 0, 0, 1]
    write(folder, "cointoss.analytic.other", "unused = 1\n")
    assert run_caller() == [32, 1, 0, 0]


def test_plain_mode_compiles_anew_what_an_edit_can_change(folder, run):
    script = (
        "import os\nos.environ['COINTOSS_COMPILER'] = 'plain'\n"
        "from cointoss.analytic.caller import part, whole\n"
        "print(whole(10.0), *(sum(f.stats.cache_hits.values()) for f in (whole, part)))"
    )
    assert run(folder, script) == [21, 0, 0]
    assert run(folder, script) == [21, 1, 0]
    write(folder, "cointoss.analytic.callee", CALLEE.format(3.0))
    assert run(folder, script) == [31, 0, 0]


def write_libm(folder, factor):
    """Write a file of musl's functions whose sine multiplies."""
    sine = f"define double @musl.sin(double %x) {{ %y = fmul double %x, {factor} ret double %y }}"
    code = binding.parse_assembly(sine).as_bitcode()
    (folder / "cointoss" / "models" / "kernel" / "musl.bc").write_bytes(with_digest(code))


def test_code_that_calls_musl_is_kept_apart_and_computes_nothing_by_the_system(folder, run):
    """LLVM would compute the sine of a constant by the system's function when it compiles."""
    write(folder, "cointoss.analytic.callee", "import math\n" + CALLEE.format("math.sin(3.0)"))
    calling = "from cointoss.analytic.caller import whole\nprint(whole(10.0), whole.read)"
    musl = f"import os\nos.environ['COINTOSS_LIBM'] = 'musl'\n{calling}"
    write_libm(folder, "2.0")
    assert run(folder, musl) == [61, 0]
    assert run(folder, calling) == [10 * math.sin(3.0) + 1, 0]
    assert run(folder, musl) == [61, 1]
    assert run(folder, calling) == [10 * math.sin(3.0) + 1, 1]
    write_libm(folder, "3.0")
    assert run(folder, musl) == [91, 0]


@pytest.mark.parametrize("kept", [slice(0), slice(-1), slice(None, None, -1)])
def test_a_damaged_file_of_musls_functions_is_refused_in_one_line(folder, run, kept):
    write_libm(folder, "2.0")
    file = folder / "cointoss" / "models" / "kernel" / "musl.bc"
    file.write_bytes(file.read_bytes()[kept])
    refusal = f"COINTOSS_LIBM = 'musl': {file} is damaged; remove it, and make libm builds it"
    script = (
        "import os\nos.environ['COINTOSS_LIBM'] = 'musl'\n"
        "try:\n    import cointoss.analytic.caller\n"
        f"except ImportError as error:\n    print(int(str(error) == {refusal!r}))"
    )
    assert run(folder, script) == [1]


@pytest.mark.parametrize(
    ("function", "refusal"),
    [
        ("math.erf", "compiled code calls erf, which is not among acos, "),
        ("numba.njit(lambda x: math.sin(x))", "numba's own code calls sin of the system"),
    ],
)
def test_what_musl_is_not_asked_for_is_refused(folder, run, function, refusal):
    callee = "import math\nimport numba\n" + CALLEE.replace("\n\n@", f"\nfunction = {function}\n\n@", 1)
    write(folder, "cointoss.analytic.callee", callee.format("function(x)"))
    write_libm(folder, "2.0")
    script = (
        "import os\nos.environ['COINTOSS_LIBM'] = 'musl'\n"
        "from cointoss.analytic.caller import whole\n"
        "try:\n    whole(10.0)\n"
        f"except Exception as error:\n    print(int({refusal!r} in str(error)))"
    )
    assert run(folder, script) == [1]


CHANGES = {
    "edited": f"open('cointoss/analytic/callee.py', 'w').write({CALLEE.format('3.00')!r})",
    "replaced by an older one": (
        "import os; os.replace('cointoss/analytic/older.py', 'cointoss/analytic/callee.py')"
    ),
}


@pytest.mark.parametrize("change", CHANGES)
def test_code_of_a_source_changed_since_it_was_imported_is_not_kept(folder, run, change):
    """Its folder is named by the source as it is when the function is compiled."""
    write(folder, "cointoss.analytic.older", CALLEE.format(3.0))
    os.utime(folder / "cointoss" / "analytic" / "older.py", (1e9, 1e9))
    calling = "from cointoss.analytic.caller import whole, part\n{}\nprint(whole(10.0), part(10.0))"
    assert run(folder, calling.format(CHANGES[change])) == [21, 20]
    assert run(folder, calling.format("")) == [31, 30]


def test_damaged_files_of_code_are_made_anew(folder, run_caller):
    assert run_caller() == [21, 0, 0, 0]

    def half_flipped(kept):
        return kept[: len(kept) // 2] + bytes(255 - byte for byte in kept[len(kept) // 2 :])

    for ending in ("nbi", "nbc"):
        for damage in (lambda _: b"", half_flipped):
            for file in [*folder.glob(f"cache/*/*.{ending}"), *folder.glob("cache/*/*.code")]:
                file.write_bytes(damage(file.read_bytes()))
            assert run_caller() == [21, 0, 0, 0]
            assert run_caller() == [21, 1, 0, 0]
    (machine_code,) = folder.glob("cache/*/*.code")
    machine_code.write_bytes(half_flipped(machine_code.read_bytes()))
    assert run_caller() == [21, 0, 1, 1], "it is made of the code for callers"


def test_no_bit_of_a_file_can_change_unseen(tmp_path):
    CodeFiles(str(tmp_path), "function", "source").save("numbers", "code for numbers")
    files = sorted(tmp_path.iterdir())
    assert [file.suffix for file in files] == [".nbc", ".nbi"]
    for file in files:
        whole = file.read_bytes()
        for bit in range(8 * len(whole)):
            flipped = bytearray(whole)
            flipped[bit // 8] ^= 1 << bit % 8
            file.write_bytes(flipped)
            assert CodeFiles(str(tmp_path), "function", "source").load("numbers") is None
        file.write_bytes(whole)
        assert CodeFiles(str(tmp_path), "function", "source").load("numbers") == "code for numbers"
    assert CodeFiles(str(tmp_path), "function", "another source").load("numbers") is None


def test_code_that_another_user_could_have_written_is_not_run(tmp_path, monkeypatch):
    found = CodeFiles(str(tmp_path), "function", "source")
    mask = os.umask(0)
    try:
        found.save("numbers", "code for numbers")
    finally:
        os.umask(mask)
    for file in tmp_path.iterdir():
        assert file.stat().st_mode & 0o777 == 0o600, "whatever the mask"
        for mode in (0o620, 0o602):
            file.chmod(mode)
            assert found.load("numbers") is None
        file.chmod(0o600)
    assert found.load("numbers") == "code for numbers"
    monkeypatch.setattr(os, "geteuid", lambda: tmp_path.stat().st_uid + 1)
    assert found.load("numbers") is None


def test_code_is_kept_in_a_folder_of_the_user_alone(tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "chosen"))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "caches"))
    assert code_cache.base_folder.__wrapped__() == tmp_path / "chosen"
    assert (tmp_path / "chosen").stat().st_mode & 0o777 == 0o700
    owner = tmp_path.stat().st_uid
    monkeypatch.setattr(os, "geteuid", lambda: owner + 1)
    elsewhere = code_cache.base_folder.__wrapped__()
    assert elsewhere.name.startswith("cointoss-")
    assert not elsewhere.is_relative_to(tmp_path)
    elsewhere.rmdir()


def test_kept_code_calls_what_another_process_has_compiled_anew(folder, run, run_caller):
    """A process that compiles the callee alone numbers its functions otherwise."""
    write(
        folder,
        "cointoss.analytic.above",
        CALLER.format("cointoss.analytic.caller", 5).replace("part", "whole as part", 1),
    )
    assert run_caller()[0] == 21
    for kept in folder.glob("cache/cointoss.analytic.callee-*"):
        shutil.rmtree(kept)
    others = "\n".join(f"@compiled\ndef f{i}(x):\n    return x\nf{i}(1.0)" for i in range(5))
    run(folder, f"{IMPORT}{others}\nfrom cointoss.analytic.callee import part\npart(1.0)")
    assert run(folder, "from cointoss.analytic.above import whole\nprint(whole(10.0))") == [26]


def test_a_function_kept_for_python_works_where_it_was_kept_for_callers_too(folder, run):
    """Python's wrapper makes an array by constants that the code for callers does not have."""
    source = IMPORT + "import numpy as np\n\n\n@compiled\ndef part(x):\n    return np.full(3, x), x\n"
    write(folder, "cointoss.analytic.callee", source)
    above = "from {} import part\n\n\n@compiled\ndef {}(x):\n    return part(x)[0][1] + {}\n"
    for name in ("one", "two"):
        write(folder, f"cointoss.analytic.{name}", IMPORT + above.format("cointoss.analytic.callee", name, 1))
    script = "from cointoss.analytic.{0} import {0}, part\nprint({0}(10.0))\nprint(part(3.0)[0].sum())"
    assert run(folder, script.format("one")) == [11, 9]
    assert run(folder, script.format("two")) == [11, 9]


def test_python_calls_what_was_only_kept_for_callers(folder, run):
    """Then nothing is compiled but Python's wrapper, for which numba has not yet read how to make one."""
    part = "\n\n@compiled\ndef part(x, text):\n    return np.full(3, x), text\n"
    write(folder, "cointoss.analytic.callee", f"{IMPORT}import numpy as np\n{part}")
    caller = "from {} import part\n\n\n@compiled\ndef whole(x):\n    return part(x, 'ab')[0][1]\n"
    write(folder, "cointoss.analytic.caller", IMPORT + caller.format("cointoss.analytic.callee"))
    assert run(folder, "from cointoss.analytic.caller import whole\nprint(whole(10.0))") == [10]
    script = (
        "from cointoss.analytic.callee import part\n"
        "numbers, text = part(3.0, 'abcd')\n"
        "print(sum(numbers), len(text))\n"
        "of = part.dispatcher\n"
        "print(*(sum(f.stats.cache_misses.values()) for f in (of.from_python, of)))"
    )
    assert run(folder, script) == [9, 4, 1, 0]
    assert run(folder, script) == [9, 4, 0, 0]


def test_code_kept_for_python_is_called_without_numba(folder):
    script = "import sys\nfrom cointoss.analytic.caller import whole\nprint(whole(1.0))\n"
    script += "print(int('numba' in sys.modules))"
    for imported in (1, 0):
        done = subprocess.run(
            [sys.executable, "-c", script],
            cwd=folder,
            env={"PATH": "", "NUMBA_CACHE_DIR": str(folder / "cache")},
            capture_output=True,
            text=True,
            check=True,
        )
        assert done.stdout.split() == ["3.0", str(imported)]


def test_text_passes_by_numba_as_kept_code(folder):
    """To read it numba would import all that it can compile."""
    write(
        folder, "cointoss.analytic.callee", IMPORT + "\n\n@compiled\ndef size(text):\n    return len(text)\n"
    )
    script = "import sys\nfrom cointoss.analytic.callee import size\nprint(size('abc'))\n"
    imported = "print(int('numba.np.linalg' in sys.modules))"
    with forking(warm=False) as run:
        assert run(folder, script + imported) == [3, 1]
        assert run(folder, script + imported) == [3, 0]


def test_named_tuples_with_other_fields_are_other_types(folder, run):
    """A function need not import the named tuple that it is given, so an edit there is not in its hash."""
    tuples = "from typing import NamedTuple\n\n\nclass Pair(NamedTuple):\n    {}: float\n    {}: float\n"
    write(folder, "cointoss.analytic.user", USER)
    script = (
        "from cointoss.analytic.{0} import difference\nfrom cointoss.models.pair import Pair\n"
        "print(difference({1}))"
    )
    nested = IMPORT + "from cointoss.analytic.user import difference as of\n"
    write(
        folder, "cointoss.analytic.inner", nested + "\n\n@compiled\ndef difference(p):\n    return of(p[1])\n"
    )
    for names, answer in (("ab", -2), ("ba", 2)):
        write(folder, "cointoss.models.pair", tuples.format(*names))
        assert run(folder, script.format("user", "Pair(1.0, 3.0)")) == [answer]
        assert run(folder, script.format("inner", "(0.0, Pair(1.0, 3.0))")) == [answer]


@pytest.mark.parametrize("module", ["cointoss.models.pair", "cointoss.models.couple"])
def test_a_named_tuple_that_has_gone_since_is_no_error(folder, module, run):
    """What was kept for it names its type: where that has another name now, or no module, it is kept anew."""
    tuples = "from typing import NamedTuple\n\n\nclass {}(NamedTuple):\n    a: float\n    b: float\n"
    write(folder, "cointoss.analytic.user", USER)
    script = (
        "from cointoss.analytic.user import difference\nfrom {} import {} as Two\n"
        "print(difference(Two(1.0, 3.0)))\n"
        "print(difference.read)"
    )
    write(folder, "cointoss.models.pair", tuples.format("Pair"))
    assert run(folder, script.format("cointoss.models.pair", "Pair")) == [-2, 0]
    (folder / "cointoss" / "models" / "pair.py").unlink()
    write(folder, module, tuples.format("Couple"))
    assert run(folder, script.format(module, "Couple")) == [-2, 0]
    assert run(folder, script.format(module, "Couple")) == [-2, 1]


def test_folders_long_unused_are_removed_when_one_is_made(tmp_path, monkeypatch):
    monkeypatch.setattr(code_cache, "base_folder", lambda: tmp_path)
    names = ("cointoss.a.b-0123456789abcdef", "cointoss.a.b-fedcba9876543210", "cointoss.maps")
    used, unused, foreign = (tmp_path / name for name in names)
    long_ago = time.time() - UNUSED - 60
    for folder in (used, unused, foreign):
        folder.mkdir()
        (folder / "file").touch()
        os.utime(folder, (long_ago, long_ago))
    os.utime(used)
    made = cache_folder.__wrapped__("cointoss.models.body")
    assert sorted(tmp_path.iterdir()) == sorted([used, foreign, made])
    os.utime(made, (0, 0))
    assert cache_folder.__wrapped__("cointoss.models.body") == made
    remove_unused(tmp_path)
    assert made.is_dir(), "what a process begins to use is kept"


def test_two_processes_that_keep_code_at_once_do_not_mix_it_up(tmp_path, monkeypatch):
    one, other, third = (CodeFiles(str(tmp_path), "function", "source") for _ in range(3))
    save_data = one._save_data

    def save_data_meanwhile(name, data):
        other.save("integers", "code for integers")
        save_data(name, data)

    # The other has read the index before the one wrote it.
    monkeypatch.setattr(other, "_load_index", dict)
    monkeypatch.setattr(one, "_save_data", save_data_meanwhile)
    one.save("numbers", "code for numbers")
    assert third.load("numbers") == "code for numbers"
    assert third.load("integers") == "code for integers"
    third.save("numbers", "the same once more")
    assert third.load("numbers") == "the same once more"
    assert len(list(tmp_path.glob("*.nbc"))) == 2


@pytest.mark.parametrize(
    "written",
    [
        "Path.mkdir",
        "CodeFiles._save_data = function.write_kept",
        "CodeFiles._save_index = function.write_kept",
    ],
)
def test_code_that_cannot_be_written_is_not_kept(folder, run, run_caller, written):
    (folder / "cache").mkdir()
    full_disk = (
        "from pathlib import Path\nfrom cointoss.models.kernel.fork import function\n"
        "from cointoss.models.kernel.fork.code_files import CodeFiles\n"
        "def full(*_, **__): raise OSError(28, 'No space left on device')\n"
        f"{written} = full\n"
    )
    assert run(folder, full_disk + "from cointoss.analytic.caller import whole\nprint(whole(10.0))") == [21]
    assert run_caller() == [21, 0, 0, 0]


def test_on_windows_code_is_kept_in_the_folder_of_local_data(tmp_path, monkeypatch):
    for name in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("LOCALAPPDATA", str(tmp_path))
    assert base_folder.__wrapped__() == tmp_path / "cointoss"


def test_on_windows_functions_are_compiled_by_what_numba_makes_public(monkeypatch):
    home = import_module("cointoss.models.kernel.compiled")
    assert home._is_tested.__wrapped__()
    monkeypatch.setattr(home, "sys", SimpleNamespace(platform="win32"))
    assert not home._is_tested.__wrapped__()
