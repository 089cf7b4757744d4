"""Transcripts of commands and Python, with all they print; `python -m tests.helpers.golden` writes them anew.

A line of a transcript that begins with $ is a command; below it is what it prints, after ! what it says on
stderr, and after = its exit status where that is not 0. Beside `cointoss` and `mj-bounce` there are
`cat FILE`, `plain PAGE`, which prints the text of a page, `part FILE KEY`, which prints a part of JSON, and
`files`, which lists what was written. A line that begins with >>> is Python; below it is its value, or after
! its error. Versions are left out; a line after : is a remark.
"""

import json
import math
import re
import shlex
from contextlib import chdir
from functools import partial
from html import unescape
from pathlib import Path
from shutil import copy
from tempfile import TemporaryDirectory
from typing import Any

from tests.helpers.command_line import cointoss, mj_bounce

GOLDEN = Path(__file__).parents[1] / "compare" / "golden"
BOUNCE = Path(__file__).parents[2] / "bounce" / "tests" / "golden"
PROGRAMS = {"cointoss": cointoss, "mj-bounce": mj_bounce}
NUMBER = re.compile(r"(-?\d+(?:\.\d+)?(?:e[-+]?\d+)?)")
TAG = re.compile(r"(?s)<(script|style)\b.*?</\1>|<!--.*?-->|<[^>]*>")
VERSION = re.compile(r'(?m)(?<=": ")\d+\.\d+\.\d+[^"]*|^\d+\.\d+\.\d+\S*$')


def answer(command: str, given: set[str]) -> str:
    """Return what a command prints in this folder, says, and ends with, as in a transcript.

    Args:
        command: a line of a transcript.
        given: the files that were there before.
    """
    program, *words = shlex.split(command)
    if program == "files":
        written = (path for path in Path().rglob("*") if path.is_file() and path.name not in given)
        return "".join(sorted(f"{path}\n" for path in written))
    if program == "cat":
        return Path(words[0]).read_text(encoding="utf-8")
    if program == "part":
        return json.dumps(json.loads(Path(words[0]).read_text(encoding="utf-8"))[words[1]], indent=1) + "\n"
    if program == "plain":
        text = unescape(TAG.sub("\n", Path(words[0]).read_text(encoding="utf-8")))
        return "".join(f"{' '.join(line.split())}\n" for line in text.splitlines() if line.strip())
    answered = PROGRAMS[program](*words)
    said = "".join(f"! {line}\n" for line in answered.stderr.splitlines())
    return answered.stdout + said + (f"= {answered.exit_code}\n" if answered.exit_code else "")


def value(source: str, names: dict[str, Any]) -> str:
    """Return the value of a line of Python as a transcript has it; a statement changes the names."""
    try:
        found = eval(compile(source, "transcript", "eval"), names)
    except SyntaxError:
        exec(source, names)
        return ""
    except Exception as error:
        return f"! {type(error).__name__}: {error}\n"
    return "" if found is None else f"{found!r}\n"


def replayed(transcript: str, home: Path = GOLDEN) -> str:
    """Return a transcript of the same commands, in a new folder with the files of its home."""
    names: dict[str, Any] = {}
    files = [*(home / "files").iterdir()]
    answers = {
        "$": partial(answer, given={file.name for file in files}),
        ">>>": partial(value, names=names),
        ":": lambda _: "",
    }
    lines = [line for line in transcript.splitlines() if line.startswith(("$ ", ": ", ">>> "))]
    with TemporaryDirectory() as folder:
        for file in files:
            copy(file, folder)
        with chdir(folder):
            told = [answers[line.split()[0]](line.partition(" ")[2]) for line in lines]
    pairs = zip(lines, told, strict=True)
    return VERSION.sub("…", "".join(f"{line}\n{one}\n" if one else f"{line}\n" for line, one in pairs))


def assert_alike(found: str, golden: str) -> None:
    """Check that two transcripts have the same words, and numbers that are equal but for rounding.

    Small ones, as of residuals, have the same order of magnitude; below 1e-11 they are rounding.
    """
    ours, theirs = NUMBER.split(found), NUMBER.split(golden)
    assert ours[::2] == theirs[::2]
    for one, other in zip(map(float, ours[1::2]), map(float, theirs[1::2]), strict=True):
        is_small = 0 < abs(other) < 1e-4 and 0.1 < one / other < 10
        assert is_small or math.isclose(one, other, rel_tol=1e-6, abs_tol=1e-11), (one, other)


if __name__ == "__main__":
    for file in sorted([*GOLDEN.glob("*.txt"), *BOUNCE.glob("*.txt")]):
        file.write_text(replayed(file.read_text(encoding="utf-8"), file.parent), encoding="utf-8")
