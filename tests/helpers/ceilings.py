"""Count the statements of each folder, and hold them against their ceilings, which only sink."""

import ast
import sys
import tomllib
from collections.abc import Mapping
from pathlib import Path

TOP = Path(__file__).parents[2]
FILE = Path(__file__).with_suffix(".toml")


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


def exceeded(ceilings: Mapping[str, int], counts: Mapping[str, int]) -> list[str]:
    """Return a line for each folder that has more statements than its ceiling."""
    return [
        f"{folder}: {counts[folder]} statements, accepted: {ceiling}, its ceiling in {FILE.name}; "
        "remove as many, or raise it in a commit of its own with its reason"
        for folder, ceiling in ceilings.items()
        if counts[folder] > ceiling
    ]


def sunk(ceilings: Mapping[str, int], counts: Mapping[str, int]) -> str:
    """Return the file of ceilings in which each is at most what its folder has."""
    lines = (f'"{folder}" = {min(ceiling, counts[folder])}\n' for folder, ceiling in ceilings.items())
    head = FILE.read_text(encoding="utf-8").partition('"')[0]
    return head + "".join(lines)


def main(arguments: list[str]) -> int:
    """Print the folders above their ceilings, or with --sink lower the others; return the exit status."""
    ceilings = tomllib.loads(FILE.read_text(encoding="utf-8"))
    counts = {folder: counted(folder) for folder in ceilings}
    if arguments == ["--sink"]:
        FILE.write_text(sunk(ceilings, counts), encoding="utf-8")
    for line in (found := exceeded(ceilings, counts)):
        print(line, file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
