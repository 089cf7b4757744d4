"""Damages the code, and says whether the tests see it.

    python -m tests.helpers.damages [NAME ...]

applies the damages of `tests/damages/` one by one in copies of this checkout, on all cores, and runs for each
the test that must fail: those that are named (`compare.3`, or `compare` for all of compare.toml), all without
a name, and with `--recent` those of what the last commits changed, unless they need a library anew, as far as
ten minutes go. It exits with status 1 where one passes.

A file there has a list of damages for each damaged file: text that occurs once in it (`before`), what takes
its place (`after`), and the test that must fail, as pytest names it (`test`).
"""

import os
import shutil
import subprocess
import sys
import tempfile
import tomllib
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path
from queue import SimpleQueue
from time import monotonic
from typing import NamedTuple

from cointoss.models.kernel.base_folder import base_folder
from cointoss.models.kernel.manifest import MANIFEST, Made

ROOT = Path(__file__).parents[2]
HOUSES = ("bounce", "reproduction", "yardstick")
COPIED = ("pyproject.toml", "cointoss", "models", "analytic", "coin_mj", "compare", "docs", *HOUSES, "tests")
CHECKOUT = "checkout"
LANES = ("analytic/together.py", "analytic/contact/side_by_side.py", "models/kernel/vector_type.py")
COMMITS, LONGEST = 40, 600.0
"""Of `--recent`: the last commits, and the time after which none is begun [s]."""
_FAILED = 1
"""Status of pytest where a test failed; others say that it could not run them."""


class Damage(NamedTuple):
    """A change of one place in the code that makes it wrong."""

    file: str
    """From the root of the checkout."""
    before: str
    """Text that occurs once in the file."""
    after: str
    """What takes its place."""
    test: str
    """That must fail; as pytest names it."""

    def applied_to(self, source: str) -> str:
        """Return the source of the file with the damage.

        Raises:
            ValueError: where the text does not occur just once.
        """
        if source.count(self.before) != 1:
            raise ValueError(f"{self.file}: {self.before!r} occurs {source.count(self.before)} times")
        return source.replace(self.before, self.after)

    @property
    def source(self) -> str:
        """Of the file, without the damage."""
        return (ROOT / self.file).read_text(encoding="utf-8")

    @property
    def is_compiled(self) -> bool:
        """Whether an engine's library is made of the file."""
        return self.file in compiled()

    @property
    def runs_plainly(self) -> bool:
        """Whether the test runs without the library: but those of MuJoCo's steps and of lanes do."""
        return self.is_compiled and not self.file.startswith(("coin_mj/", *LANES))


@cache
def compiled() -> frozenset[str]:
    """Return the files that the libraries built so far are made of."""
    made = map(Made.read, (base_folder() / "engines").glob(f"*{MANIFEST}"))
    return frozenset(name for library in made if library for name in library.sources)


def read(path: Path) -> dict[str, Damage]:
    """Return the damages of a file by name."""
    table = tomllib.loads(path.read_text(encoding="utf-8"))
    found = [Damage(file, **damage) for file, damages in table.items() for damage in damages]
    return {f"{path.stem}.{number}": damage for number, damage in enumerate(found, 1)}


DAMAGES = {
    name: damage
    for path in sorted((ROOT / "tests" / "damages").glob("*.toml"))
    for name, damage in read(path).items()
}


def recent(damages: Mapping[str, Damage]) -> dict[str, Damage]:
    """Return the damages of what the last commits changed, the latest first, that need no library anew."""
    command = ["git", "log", f"-{COMMITS}", "--name-only", "--format="]
    changed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
    touched = {
        name: min(changed.index(file) for file in files)
        for name, damage in damages.items()
        if (files := {damage.file, damage.test.partition("::")[0]} & set(changed))
        and (damage.runs_plainly or not damage.is_compiled)
    }
    return {name: damages[name] for name in sorted(touched, key=touched.__getitem__)}


def copied_to(folder: Path) -> Path:
    """Copy this checkout and the engines built so far into a folder, and return where the checkout lies."""
    tree, unread = folder / CHECKOUT, shutil.ignore_patterns("node_modules", ".*")
    tree.mkdir(parents=True)
    for name in COPIED:
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, tree / name, symlinks=True, ignore=unread)
        else:
            shutil.copy2(ROOT / name, tree / name)
    # What a damage leaves as it was need not be built again.
    shutil.copytree(base_folder(), folder / "code", ignore=shutil.ignore_patterns("*.lock"))
    return tree


def status_of(tree: Path, tests: Iterable[str], *, plainly: bool) -> tuple[int, str]:
    """Run tests in a copy of the checkout until one fails; return pytest's status and its lines."""
    # No bytecode of a damaged module may outlive it.
    environment = os.environ | {
        "COINTOSS_CACHE": str(tree.parent / "code"),
        "PYTHONDONTWRITEBYTECODE": "1",
        "PYTHONPATH": os.pathsep.join(str(tree / house) for house in HOUSES),
    }
    command = [sys.executable, "-m", "pytest", "-q", "-x", "-m", "", "-p", "no:cacheprovider"]
    command += dict.fromkeys(tests)
    if plainly:
        # numpy's numbers warn of what compiled code computes in silence.
        command += ["-p", "tests.helpers.plainly", "-W", "ignore::RuntimeWarning"]
    done = subprocess.run(command, cwd=tree, env=environment, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def is_caught(tree: Path, damage: Damage) -> bool:
    """Damage a copy of the checkout, return whether a test fails, and mend the copy.

    Raises:
        RuntimeError: where the tests could not be run.
    """
    file = tree / damage.file
    file.write_text(damage.applied_to(damage.source), encoding="utf-8")
    status, lines = status_of(tree, [damage.test], plainly=damage.runs_plainly)
    file.write_text(damage.source, encoding="utf-8")
    if status not in (0, _FAILED):
        raise RuntimeError(lines)
    return status == _FAILED


def main(words: Sequence[str]) -> int:
    """Apply damages, print of each whether it is caught, and return the exit status."""
    known = {name for damage in DAMAGES for name in (damage, damage.partition(".")[0])}
    if words != ["--recent"] and not known.issuperset(words):
        unknown = ", ".join(set(words) - known)
        print(f"NAME = {unknown}: accepted: --recent, {', '.join(DAMAGES)}", file=sys.stderr)
        return 2
    chosen, longest = recent(DAMAGES), LONGEST
    if words != ["--recent"]:
        chosen = {n: each for n, each in DAMAGES.items() if not words or {n, n.split(".")[0]} & set(words)}
        longest = float("inf")
    cores, trees = os.cpu_count() or 1, SimpleQueue[Path]()
    counts, begun = Counter[str](), monotonic()

    def tried(damage: Damage) -> str:
        if monotonic() - begun > longest:
            return "not tried"
        tree = trees.get()
        try:
            return "caught" if is_caught(tree, damage) else "NOT CAUGHT"
        finally:
            trees.put(tree)

    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(cores) as pool:
        for core in range(cores):
            trees.put(copied_to(Path(folder) / str(core)))
        for plainly in (True, False):
            tests = [each.test for each in chosen.values() if each.runs_plainly == plainly]
            tree = Path(folder) / "0" / CHECKOUT
            status, lines = status_of(tree, tests, plainly=plainly) if tests else (0, "")
            if status != 0:
                print(f"A test fails without a damage:\n{lines}", file=sys.stderr)
                return 2
        for (name, damage), word in zip(chosen.items(), pool.map(tried, chosen.values()), strict=True):
            before, after = (" ".join(text.split()) for text in (damage.before, damage.after))
            print(f"{name:<16} {word:10} {damage.file}: {before} -> {after or 'nothing'}", flush=True)
            counts[word] += 1
    print(", ".join(f"{count} {word}" for word, count in counts.items()))
    return 1 if counts["NOT CAUGHT"] else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
