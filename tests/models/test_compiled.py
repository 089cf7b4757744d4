"""Compiled functions are called by Python, by each other and by numba's, and what is kept is never stale."""

import ast
import importlib
import inspect
import os
import pickle
import pkgutil
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from enum import IntEnum
from pathlib import Path
from subprocess import PIPE
from typing import Any, NamedTuple

import numba
import numpy as np
import pytest
from numba.core.runtime.nrt import rtsys

import models.kernel.code_cache as code_cache
from models.kernel.code_cache import UNUSED, CodeFiles, cache_folder, remove_unused
from models.kernel.compiled import CompiledFunction, compiled, inlined
from models.kernel.sources import PACKAGES, imported, source_hash
from models.kernel.vectors import add

TOP = Path(code_cache.__file__).parents[2]
IMPORT = "from models.kernel.compiled import compiled\n"
CALLEE = IMPORT + "\n\n@compiled\ndef part(x):\n    return {} * x\n"
CALLER = IMPORT + "from {} import part\n\n\n@compiled\ndef whole(x):\n    return part(x) + {}\n"


class Kind(IntEnum):
    ODD = 1


class Pair(NamedTuple):
    first: float
    second: float


@compiled
def squares(n):
    if n < 0:
        raise ValueError("fewer than none")
    return np.arange(n) ** 2.0


@compiled
def squares_from(pair, n, kind=Kind.ODD):
    found = squares(n)
    return found + pair.first, kind, "ab"[:1] == "a"


class Disk(NamedTuple):
    area: float | None


class Cylinder(NamedTuple):
    base: Disk
    height: float | None


@compiled
def volume(cylinder):
    """Of a disk 0; numba can multiply no None."""
    height = cylinder.height
    if cylinder.base.area is None:
        return np.inf
    return cylinder.base.area * height if height is not None and cylinder.base.area is not None else 0.0


class Table(NamedTuple):
    scale: float
    numbers: np.ndarray


@compiled
def scaled_sum(n):
    table = Table(2.0, np.ones(n))
    for row in range(n):
        table = Table(table.scale, table.numbers + row)
    return table.scale * table.numbers.sum()


FORK = """
import os, sys
import numba

for line in sys.stdin:
    process = os.fork()
    if process == 0:
        folder, script = eval(line)
        os.chdir(folder)
        sys.path.insert(0, folder)
        os.environ["NUMBA_CACHE_DIR"] = os.path.join(folder, "cache")
        exec(script, {"__name__": "__main__"})
        break
    print("|", os.waitpid(process, 0)[1], flush=True)
"""
"""A process with numba, and none of ours, imported, which takes longer than a script: it forks for each."""


@pytest.fixture(scope="module")
def run():
    """Return what runs a script in a folder, in a process of its own, and returns the numbers it prints."""
    asked = [sys.executable, "-c", FORK]
    with subprocess.Popen(asked, env={"PATH": ""}, stdin=PIPE, stdout=PIPE, text=True) as forking:
        questions, answers = forking.stdin, forking.stdout
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


@pytest.fixture
def run_caller(run, folder):
    """Return the answer, and what was read from disk: of the caller for Python, and of it and its callee."""
    script = (
        "from analytic.caller import whole, part\n"
        "print(whole(10.0))\n"
        "for f in (whole.from_python, whole, part):\n"
        "    print(sum(f.stats.cache_hits.values()))"
    )
    return lambda: run(folder, script)


@pytest.fixture
def folder(tmp_path):
    for package in ("models", "analytic"):
        (tmp_path / package).mkdir()
        # Without it the installed package would be found first.
        (tmp_path / package / "__init__.py").touch()
    shutil.copytree(TOP / "models" / "kernel", tmp_path / "models" / "kernel")
    return tmp_path


def write(folder, module, source):
    file = folder.joinpath(*module.split(".")).with_suffix(".py")
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(source)
    # Python would run it for any source of the same length and of the same second.
    for bytecode in file.parent.glob(f"__pycache__/{file.stem}.*.pyc"):
        bytecode.unlink()


@pytest.mark.parametrize("callee", ["analytic.callee", "analytic.room.callee", "models.room.deeper.callee"])
def test_an_edit_compiles_anew_what_it_can_change_and_no_more(folder, callee, run_caller):
    write(folder, "analytic.__init__", "from analytic.other import unused\n")
    write(folder, "analytic.other", "unused = 0\n")
    write(folder, "analytic.caller", CALLER.format(callee, 1))
    write(folder, callee, CALLEE.format(2.0))
    assert run_caller() == [21, 0, 0, 0]
    assert run_caller() == [21, 1, 0, 0], "what is kept for Python needs nothing of its callees"
    write(folder, callee, CALLEE.format(3.0))
    assert run_caller() == [31, 0, 0, 0]
    write(folder, "analytic.caller", CALLER.format(callee, 2))
    assert run_caller() == [32, 0, 0, 1]
    write(folder, "analytic.other", "unused = 1\n")
    assert run_caller() == [32, 1, 0, 0]


def test_code_of_a_source_edited_since_it_was_imported_is_not_kept(folder, run):
    """Its folder is named by the source as it is when the function is compiled."""
    write(folder, "analytic.callee", CALLEE.format(2.0))
    write(folder, "analytic.caller", CALLER.format("analytic.callee", 1))
    calling = "from analytic.caller import whole, part\n{}\nprint(whole(10.0), part(10.0))"
    editing = f"open('analytic/callee.py', 'w').write({CALLEE.format('3.00')!r})"
    assert run(folder, calling.format(editing)) == [21, 20]
    assert run(folder, calling.format("")) == [31, 30]


def test_code_of_a_source_replaced_by_an_older_one_is_not_kept(folder, run):
    write(folder, "analytic.older", CALLEE.format(3.0))
    os.utime(folder / "analytic" / "older.py", (1e9, 1e9))
    write(folder, "analytic.callee", CALLEE.format(2.0))
    write(folder, "analytic.caller", CALLER.format("analytic.callee", 1))
    calling = "import os\nfrom analytic.caller import whole\n{}\nprint(whole(10.0))"
    assert run(folder, calling.format("os.replace('analytic/older.py', 'analytic/callee.py')")) == [21]
    assert run(folder, calling.format("")) == [31]


def test_damaged_files_of_code_are_made_anew(folder, run_caller):
    write(folder, "analytic.callee", CALLEE.format(2.0))
    write(folder, "analytic.caller", CALLER.format("analytic.callee", 1))
    assert run_caller() == [21, 0, 0, 0]
    for ending in ("nbi", "nbc"):
        for damaged in (b"", b"garbage"):
            for file in folder.glob(f"cache/*/*.{ending}"):
                file.write_bytes(damaged)
            assert run_caller() == [21, 0, 0, 0]
            assert run_caller() == [21, 1, 0, 0]


def test_kept_code_calls_what_another_process_has_compiled_anew(folder, run, run_caller):
    """A process that compiles the callee alone numbers its functions otherwise."""
    write(folder, "analytic.callee", CALLEE.format(2.0))
    write(folder, "analytic.caller", CALLER.format("analytic.callee", 1))
    write(folder, "analytic.above", CALLER.format("analytic.caller", 5).replace("part", "whole as part", 1))
    assert run_caller()[0] == 21
    for kept in folder.glob("cache/cointoss-analytic.callee-*"):
        shutil.rmtree(kept)
    others = "\n".join(f"@compiled\ndef f{i}(x):\n    return x\nf{i}(1.0)" for i in range(5))
    run(folder, f"{IMPORT}{others}\nfrom analytic.callee import part\npart(1.0)")
    assert run(folder, "from analytic.above import whole\nprint(whole(10.0))") == [26]


def test_a_function_kept_for_python_works_where_it_was_kept_for_callers_too(folder, run):
    """Python's wrapper makes an array by constants that the code for callers does not have."""
    source = IMPORT + "import numpy as np\n\n\n@compiled\ndef part(x):\n    return np.full(3, x), x\n"
    write(folder, "analytic.callee", source)
    above = "from {} import part\n\n\n@compiled\ndef {}(x):\n    return part(x)[0][1] + {}\n"
    for name in ("one", "two"):
        write(folder, f"analytic.{name}", IMPORT + above.format("analytic.callee", name, 1))
    script = "from analytic.{0} import {0}, part\nprint({0}(10.0))\nprint(part(3.0)[0].sum())"
    assert run(folder, script.format("one")) == [11, 9]
    assert run(folder, script.format("two")) == [11, 9]


def test_python_calls_what_was_only_kept_for_callers(folder, run):
    """Then nothing is compiled but Python's wrapper, for which numba has not yet read how to make one."""
    part = "\n\n@compiled\ndef part(x, text):\n    return np.full(3, x), text\n"
    write(folder, "analytic.callee", f"{IMPORT}import numpy as np\n{part}")
    caller = "from {} import part\n\n\n@compiled\ndef whole(x):\n    return part(x, 'ab')[0][1]\n"
    write(folder, "analytic.caller", IMPORT + caller.format("analytic.callee"))
    assert run(folder, "from analytic.caller import whole\nprint(whole(10.0))") == [10]
    script = (
        "from analytic.callee import part\n"
        "numbers, text = part(3.0, 'abcd')\n"
        "print(sum(numbers), len(text))\n"
        "print(*(sum(f.stats.cache_misses.values()) for f in (part.from_python, part)))"
    )
    assert run(folder, script) == [9, 4, 1, 0]
    assert run(folder, script) == [9, 4, 0, 0]


def test_code_kept_for_python_is_read_without_what_numba_can_compile(folder, run):
    write(folder, "analytic.callee", CALLEE.format(2.0))
    write(folder, "analytic.caller", CALLER.format("analytic.callee", 1))
    script = "import sys\nfrom analytic.caller import whole\nprint(whole(1.0))\n"
    imported = "print(int('numba.np.linalg' in sys.modules))"
    assert run(folder, script + imported) == [3, 1]
    assert run(folder, script + imported) == [3, 0]


def test_named_tuples_with_other_fields_are_other_types(folder, run):
    """A function need not import the named tuple that it is given, so an edit there is not in its hash."""
    tuples = "from typing import NamedTuple\n\n\nclass Pair(NamedTuple):\n    {}: float\n    {}: float\n"
    write(folder, "analytic.user", IMPORT + "\n\n@compiled\ndef difference(p):\n    return p.a - p.b\n")
    script = "from analytic.{0} import difference\nfrom models.pair import Pair\nprint(difference({1}))"
    nested = IMPORT + "from analytic.user import difference as of\n"
    write(folder, "analytic.inner", nested + "\n\n@compiled\ndef difference(p):\n    return of(p[1])\n")
    for names, answer in (("ab", -2), ("ba", 2)):
        write(folder, "models.pair", tuples.format(*names))
        assert run(folder, script.format("user", "Pair(1.0, 3.0)")) == [answer]
        assert run(folder, script.format("inner", "(0.0, Pair(1.0, 3.0))")) == [answer]


@pytest.mark.parametrize("module", ["models.pair", "models.couple"])
def test_a_named_tuple_that_has_gone_since_is_no_error(folder, module, run):
    """What was kept for it names its type: where that has another name now, or no module, it is kept anew."""
    tuples = "from typing import NamedTuple\n\n\nclass {}(NamedTuple):\n    a: float\n    b: float\n"
    write(folder, "analytic.user", IMPORT + "\n\n@compiled\ndef difference(p):\n    return p.a - p.b\n")
    script = (
        "from analytic.user import difference\nfrom {} import {} as Two\nprint(difference(Two(1.0, 3.0)))\n"
        "print(sum(difference.from_python.stats.cache_hits.values()))"
    )
    write(folder, "models.pair", tuples.format("Pair"))
    assert run(folder, script.format("models.pair", "Pair")) == [-2, 0]
    (folder / "models" / "pair.py").unlink()
    write(folder, module, tuples.format("Couple"))
    assert run(folder, script.format(module, "Couple")) == [-2, 0]
    assert run(folder, script.format(module, "Couple")) == [-2, 1]


def all_compiled():
    functions = {
        value
        for package in PACKAGES
        for found in pkgutil.walk_packages(importlib.import_module(package).__path__, f"{package}.")
        for value in vars(importlib.import_module(found.name)).values()
        if isinstance(value, CompiledFunction)
    }
    assert len(functions) > 200
    return functions


def test_no_compiled_function_assigns_an_array_to_a_slice():
    """To compile `a[:] = b` takes seconds, for the text of its error: see `copy_into`."""
    for function in all_compiled():
        for node in ast.walk(ast.parse(inspect.getsource(function.py_func))):
            if isinstance(node, ast.Assign) and ast.unparse(node.value) not in ("0", "0.0", "np.inf"):
                for part in ast.walk(ast.List(node.targets)):
                    assert not isinstance(part, ast.Slice), (function, ast.unparse(node))


def test_every_compiled_function_that_one_calls_is_in_its_hash():
    """A callee's module is imported, in one of the ways that `source_hash` reads."""
    for function in all_compiled():
        names = function.py_func.__globals__
        for name in function.py_func.__code__.co_names:
            callee = names.get(name)
            module = getattr(callee, "__module__", None)
            if isinstance(callee, CompiledFunction) and module != function.__module__:
                assert module in imported(function.__module__), (function, callee)


@pytest.mark.parametrize(
    "source",
    [
        "import models.room.far",
        "import os, models.room.far as near",
        "from models.room.far import a, b",
        "from models.room import (\n    other,\n    far as near,  # )\n)",
        "def f():\n    from models.room import far\n",
        "from models.room.package import a",
    ],
)
def test_the_hash_is_of_all_that_is_imported(tmp_path, source):
    hashes = []
    for a in (1, 2):
        folder = tmp_path / str(a)
        write(folder, "models.room.package.__init__", "from models.room.far import a\n")
        write(folder, "models.near", source + "\n")
        write(folder, "models.room.far", f"a = b = {a}\n")
        hashes.append(source_hash("models.near", folder))
    assert hashes[0] != hashes[1]


def test_every_package_with_compiled_functions_is_kept():
    users = {
        path.relative_to(TOP).parts[0]
        for package in ("models", "analytic", "coin_mj", "compare")
        for path in (TOP / package).rglob("*.py")
        if "@compiled" in path.read_text(encoding="utf-8")
    }
    assert users == set(PACKAGES)


def test_folders_long_unused_are_removed_when_one_is_made(tmp_path, monkeypatch):
    monkeypatch.setattr(code_cache, "_base", lambda: tmp_path)
    names = ("cointoss-a.b-0123456789abcdef", "cointoss-a.b-fedcba9876543210", "cointoss-maps")
    used, unused, foreign = (tmp_path / name for name in names)
    long_ago = time.time() - UNUSED - 60
    for folder in (used, unused, foreign):
        folder.mkdir()
        (folder / "file").touch()
        os.utime(folder, (long_ago, long_ago))
    os.utime(used)
    made = cache_folder.__wrapped__("models.body")
    assert sorted(tmp_path.iterdir()) == sorted([used, foreign, made])
    os.utime(made, (0, 0))
    assert cache_folder.__wrapped__("models.body") == made
    remove_unused(tmp_path)
    assert made.is_dir(), "what a process begins to use is kept"


def test_a_function_of_records_has_one_name_in_every_process():
    """Where its callers were kept by a process that knew another name, they would call nothing."""

    def count(rows):
        return len(rows)

    function = CompiledFunction(count)
    rows = np.zeros(3, [("time", float), ("face", np.int8)])
    assert function(rows) == 3
    (description,) = (made.fndesc for made in function.overloads.values())
    kind: Any = numba.typeof(rows)
    assert "6RecordILi" in description.mangled_name
    assert f"6RecordILi{kind.dtype._code}E" not in description.mangled_name


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


@pytest.mark.parametrize("written", ["Path.mkdir", "CodeFiles._save_data", "CodeFiles._save_index"])
def test_code_that_cannot_be_written_is_not_kept(folder, run, run_caller, written):
    write(folder, "analytic.callee", CALLEE.format(2.0))
    write(folder, "analytic.caller", CALLER.format("analytic.callee", 1))
    (folder / "cache").mkdir()
    full_disk = (
        "from pathlib import Path\nfrom models.kernel.code_cache import CodeFiles\n"
        "def full(*_, **__): raise OSError(28, 'No space left on device')\n"
        f"{written} = full\n"
    )
    assert run(folder, full_disk + "from analytic.caller import whole\nprint(whole(10.0))") == [21]
    assert run_caller() == [21, 0, 0, 0]


def test_python_calls_a_function_with_what_it_calls():
    found, kind, same = squares_from(Pair(1.0, 2.0), 3)
    assert np.array_equal(found, [1, 2, 5])
    assert kind is Kind.ODD
    assert same
    assert np.array_equal(squares_from(n=2, pair=Pair(2.0, 2.0))[0], [2, 3])
    with pytest.raises(ValueError, match="fewer than none"):
        squares_from(Pair(1.0, 2.0), -1)


def test_no_references_are_counted_across_calls_that_cannot_fail():
    @compiled
    def double_first(numbers):
        numbers[0] *= 2
        return numbers[0]

    def sum_of_doubled(numbers):
        total = 0.0
        for _ in range(3):
            total += double_first(numbers) + double_first(numbers)
        return total

    summed = CompiledFunction(sum_of_doubled)
    assert summed(np.ones(1)) == 2 + 4 + 8 + 16 + 32 + 64
    (found,) = summed.from_python.overloads.values()
    assert "NRT_incref" not in found.library.get_llvm_str()


@pytest.mark.parametrize(("compile_part", "calls"), [(compiled, True), (inlined, False)])
def test_an_inlined_function_is_never_called(compile_part, calls):
    """LLVM would call this one, which is long, from two places."""

    def part(x):
        for _ in range(3):
            for k in (1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0):
                x = np.sin(k * x) + np.exp(np.cos(x + k)) + np.log(1 + np.tan(x * x) ** 2)
        return x

    compiled_part = compile_part(part)

    def sum_of_two(x):
        return compiled_part(x) + compiled_part(x + 1)

    whole = CompiledFunction(sum_of_two)
    assert whole(0.5) == pytest.approx(part(0.5) + part(1.5))
    (found,) = whole.from_python.overloads.values()
    defined = [line for line in found.library.get_llvm_str().splitlines() if line.startswith("define")]
    assert any("4part" in line for line in defined) is calls


@compiled
def first_of_sum(numbers, others):
    if len(numbers) != len(others):
        raise ValueError("not as many")
    return (numbers + others)[0]


def test_numba_finds_our_functions_beside_their_machine_code():
    """Machine code of ours may expect other arguments: numba's callers must not find it by its name."""

    @compiled
    def of_one(numbers):
        return first_of_sum(numbers, numbers) + first_of_sum(numbers, numbers)

    @numba.njit
    def of_two(numbers, others):
        return first_of_sum(numbers, others)

    assert of_one(np.ones(2)) == 4.0
    assert of_two(np.ones(2), np.ones(2)) == 2.0


def test_what_numba_compiles_calls_our_functions():
    @numba.njit
    def plain(n):
        return squares_from(Pair(1.0, 0.0), n)[0].sum()

    signature: Any = numba.types.float64(numba.types.int64)

    @numba.cfunc(signature)
    def pointer(n):
        return squares_from(Pair(1.0, 0.0), n)[0].sum()

    assert plain(3) == pointer.ctypes(3) == 8.0


def test_code_that_lacks_what_it_calls_is_refused():
    def whole(numbers):
        return first_of_sum(numbers, numbers)

    function, numbers = CompiledFunction(whole), np.ones(2)
    function.compile((numba.typeof(numbers),))
    (made,) = function.overloads.values()
    called = made.library.callees.copy()
    made.library.callees.clear()
    for caller in (function, numba.njit(lambda numbers: function(numbers))):
        with pytest.raises(RuntimeError, match=r"calls .*first_of_sum.*remove the folders"):
            caller(numbers)
    made.library.callees += called
    assert function(numbers) == 2.0


def test_threads_compile_once():
    def third(x):
        return squares_from(Pair(x, x), 5)[0][2]

    slow = CompiledFunction(third)

    with ThreadPoolExecutor(8) as pool:
        assert set(pool.map(slow, [1.0] * 8)) == {5.0}
    assert sum(slow.from_python.stats.cache_misses.values()) == 1


def test_a_function_is_pickled_by_its_name():
    assert pickle.loads(pickle.dumps(add)) is add


def test_arrays_within_tuples_are_freed():
    assert scaled_sum(3) == 2 * 3 * (1 + 0 + 1 + 2)
    counting = importlib.import_module("numba.core.runtime._nrt_python")
    counting.memsys_enable_stats()
    before = rtsys.get_allocation_stats()
    scaled_sum(3)
    after = rtsys.get_allocation_stats()
    counting.memsys_disable_stats()
    assert after.mi_alloc - before.mi_alloc == after.mi_free - before.mi_free > 0


@pytest.mark.parametrize(
    ("area", "height", "known"), [(2.0, 3.0, 6.0), (2.0, None, 0.0), (None, 3.0, np.inf)]
)
def test_what_a_field_that_is_none_rules_out_is_not_compiled(area, height, known):
    assert volume(Cylinder(Disk(area), height)) == known
