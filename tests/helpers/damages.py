"""Damages the engines' code, and says whether the tests see it.

    python -m tests.helpers.damages [N ...]

applies the damages of `damages.toml`, or those with these numbers, one by one in a copy of this checkout, and
runs for each the test that must fail. It exits with status 1 where one passes.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

from cointoss.models.kernel.base_folder import base_folder

ROOT = Path(__file__).parents[2]
HOUSES = ("bounce", "reproduction", "yardstick")
COPIED = ("pyproject.toml", "cointoss", "models", "analytic", "coin_mj", "compare", *HOUSES, "tests")
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


_TABLE = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
DAMAGES = [Damage(file, **damage) for file, damages in _TABLE.items() for damage in damages]


def is_compiled(damage: Damage) -> bool:
    """Return whether the tests need an engine's library: the analytic engine's also run without one."""
    return not damage.file.startswith("analytic/")


def copy_checkout(folder: Path) -> Path:
    """Copy this checkout and the engines built so far into a folder, and return where the checkout lies."""
    tree, unread = folder / "checkout", shutil.ignore_patterns("node_modules", ".*")
    tree.mkdir()
    for name in COPIED:
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, tree / name, symlinks=True, ignore=unread)
        else:
            shutil.copy2(ROOT / name, tree / name)
    # What a damage leaves as it was need not be built again.
    shutil.copytree(base_folder(), folder / "code", ignore=shutil.ignore_patterns("*.lock"))
    return tree


def status_of(tree: Path, tests: Iterable[str], *, compiled: bool) -> tuple[int, str]:
    """Run tests in a copy of the checkout until one fails; return pytest's status and its lines."""
    # No bytecode of a damaged module may outlive it.
    environment = os.environ | {
        "COINTOSS_CACHE": str(tree.parent / "code"),
        "PYTHONDONTWRITEBYTECODE": "1",
        "PYTHONPATH": os.pathsep.join(str(tree / house) for house in HOUSES),
    }
    command = [sys.executable, "-m", "pytest", "-q", "-x", "-m", "", "-p", "no:cacheprovider"]
    command += dict.fromkeys(tests)
    if not compiled:
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
    whole = file.read_bytes()
    file.write_text(damage.applied_to(whole.decode()), encoding="utf-8")
    status, lines = status_of(tree, [damage.test], compiled=is_compiled(damage))
    file.write_bytes(whole)
    if status not in (0, _FAILED):
        raise RuntimeError(lines)
    return status == _FAILED


def main(words: Sequence[str]) -> int:
    """Apply damages, print of each whether it is caught, and return the exit status."""
    known = {str(number): damage for number, damage in enumerate(DAMAGES, 1)}
    if unknown := [word for word in words if word not in known]:
        print(f"N = {unknown[0]}: accepted: numbers from 1 to {len(known)}", file=sys.stderr)
        return 2
    chosen = {word: known[word] for word in words} if words else known
    with tempfile.TemporaryDirectory() as folder:
        tree = copy_checkout(Path(folder))
        for compiled in (False, True):
            tests = [each.test for each in chosen.values() if is_compiled(each) == compiled]
            status, lines = status_of(tree, tests, compiled=compiled) if tests else (0, "")
            if status != 0:
                print(f"A test fails without a damage:\n{lines}", file=sys.stderr)
                return 2
        missed = 0
        for number, damage in chosen.items():
            caught = is_caught(tree, damage)
            missed += not caught
            before, after = (" ".join(text.split()) for text in (damage.before, damage.after))
            what = f"{damage.file}: {before} -> {after or 'nothing'}"
            print(f"{number:>3} {'caught' if caught else 'NOT CAUGHT':10} {what}", flush=True)
    print(f"{len(chosen) - missed} of {len(chosen)} damages are caught")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
