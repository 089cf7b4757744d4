"""Count the statements of each folder, and hold them against ceilings, whose sums never rise."""

import ast
import re
import subprocess
import sys
import tomllib
from collections.abc import Mapping
from pathlib import Path

TOP = Path(__file__).parents[2]
FILE = Path(__file__).with_suffix(".toml")
NOT_OURS = "*.min.js"

Ceilings = Mapping[str, Mapping[str, int]]
"""Under "sums" that of each kind (houses, tests, javascript), and under each kind its folders' ceilings."""


def statements(source: str) -> int:
    """Return how many statements a source has; imports and docstrings are none."""
    return sum(isinstance(node, ast.stmt) and not _is_free(node) for node in ast.walk(ast.parse(source)))


def _is_free(node: ast.stmt) -> bool:
    match node:
        case ast.Import() | ast.ImportFrom() | ast.Expr(ast.Constant(str())):
            return True
        case _:
            return False


def counted(folder: str, top: Path = TOP) -> int:
    """Return how many statements all Python sources in a folder have."""
    return sum(statements(path.read_text(encoding="utf-8")) for path in sorted((top / folder).rglob("*.py")))


def lines(folder: str, top: Path = TOP) -> int:
    """Return how many lines our JavaScript in a folder has."""
    paths = [path for path in (top / folder).rglob("*.js") if not path.match(NOT_OURS)]
    return sum(len(path.read_text(encoding="utf-8").splitlines()) for path in paths)


def counts_of(ceilings: Ceilings) -> Ceilings:
    """Return what each folder with a ceiling has."""
    return {
        kind: {folder: (lines if kind == "javascript" else counted)(folder) for folder in ceilings[kind]}
        for kind in ceilings["sums"]
    }


def exceeded(ceilings: Ceilings, counts: Ceilings) -> list[str]:
    """Return a line for each folder above its ceiling, and for each kind whose ceilings are above its sum."""
    found = []
    for kind, most in ceilings["sums"].items():
        found += [
            f"{folder}: {counts[kind][folder]}, accepted: {ceiling}, its ceiling in {FILE.name}; "
            "remove as many, or raise it where others of its sum sink by as much"
            for folder, ceiling in ceilings[kind].items()
            if counts[kind][folder] > ceiling
        ]
        if (total := sum(ceilings[kind].values())) > most:
            found.append(f"{kind}: ceilings of {total} in all, accepted: {most}, their sum in {FILE.name}")
    return found


def risen(sums: Mapping[str, int], history: str) -> list[str]:
    """Return a line for each sum that is above one that the file has had, since a rise was last granted.

    Args:
        sums: by kind.
        history: the patches of the file, as of `git log -p`; a grant is a comment, "# Granted".
    """
    patches = history.split("diff --git ")
    granted = next((n for n, patch in enumerate(patches) if "\n+# Granted" in patch), len(patches))
    had = re.findall(rf"^\+({'|'.join(sums)}) = (\d+)$", "".join(patches[: granted + 1]), re.MULTILINE)
    least = {
        kind: min([int(sum_) for name, sum_ in had if name == kind], default=sums[kind]) for kind in sums
    }
    return [
        f"{kind}: a sum of {sums[kind]}, accepted: {least[kind]}, which it was; a sum never rises"
        for kind in sums
        if sums[kind] > least[kind]
    ]


def sunk(ceilings: Ceilings, counts: Ceilings) -> str:
    """Return the file with each ceiling at most what its folder has, and each sum that of its ceilings."""
    least = {
        kind: {folder: min(ceiling, counts[kind][folder]) for folder, ceiling in ceilings[kind].items()}
        for kind in ceilings["sums"]
    }
    sums = {kind: min(most, sum(least[kind].values())) for kind, most in ceilings["sums"].items()}
    parts = ["[sums]\n" + "".join(f"{kind} = {number}\n" for kind, number in sums.items())]
    parts += [
        f"[{kind}]\n" + "".join(f'"{folder}" = {number}\n' for folder, number in part.items())
        for kind, part in least.items()
    ]
    return FILE.read_text(encoding="utf-8").partition("[")[0] + "\n".join(parts)


def main(arguments: list[str]) -> int:
    """Print what is above its ceiling or sum, or with --sink lower the others; return the exit status."""
    ceilings = tomllib.loads(FILE.read_text(encoding="utf-8"))
    counts = counts_of(ceilings)
    if arguments == ["--sink"]:
        FILE.write_text(sunk(ceilings, counts), encoding="utf-8")
    log = ["git", "log", "-p", "--format=", "--", str(FILE)]  # none in an archive
    history = subprocess.run(log, cwd=TOP, capture_output=True, text=True, check=False).stdout
    for line in (found := exceeded(ceilings, counts) + risen(ceilings["sums"], history)):
        print(line, file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
