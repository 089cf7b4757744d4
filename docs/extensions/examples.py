"""Run the commands and the Python of the pages as a reader would, each page in an empty folder.

`make docs` runs all. This runs one page:

    PYTHONPATH=. .venv/bin/python docs/extensions/examples.py docs/TUTORIAL.md
"""

import os
import re
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from traceback import format_exc
from typing import Any

from tests.helpers.pages import PAGES, TOP, Block, blocks, commands, is_synopsis, not_answered, printed_by

NOT_RUN = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))["not_run"]
"""Patterns of what is not run, by the reason."""
LONG = 20.0
"""Processor time [s] from which a page must say how long an example takes."""
HANGS = "3600"
"""Time [s] after which a command is ended, and has failed."""
ANSWERS = re.compile(r"cointoss (find|fit|flips|conform|reproduce) ")
"""Commands whose exit status 1 is an answer: none found, a case missed."""
LASTING = re.compile(
    r"\b(takes?|took|in|for)\b[^.]{0,60}\b(\d\S*|an?|one|two|few|half a) (s|seconds?|min|minutes?|hours?)\b"
)
"""Words that say how long something takes."""


def reason(page: Path, code: str) -> str | None:
    """Return why an example is not run."""
    said = ((why, pattern) for why, patterns in NOT_RUN.items() for pattern in patterns)
    return next((why for why, pattern in said if re.search(pattern, f"{page.name}: {code}")), None)


def examples(block: Block) -> list[str]:
    """Return the commands of a block that can be run, or its Python."""
    called = [command for command in commands(block.text) if not is_synopsis(command)]
    return [block.text] if block.language == "python" else called


def run_command(command: str) -> str:
    """Run a command in the shell; return its answer."""
    ran = subprocess.run(
        ["timeout", HANGS, "bash", "-c", command],
        env=os.environ | {"PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
    )
    if ran.returncode > bool(ANSWERS.match(command)) or "Traceback" in ran.stderr:
        raise ChildProcessError(f"exit status {ran.returncode}: {ran.stderr.strip()[-400:]}")
    return ran.stdout


def fault(block: Block, code: str, names: dict[str, Any]) -> str:
    """Run a command, or Python with the names of the blocks above; return what is wrong, or nothing."""
    try:
        answer = printed_by(code, names) if block.language == "python" else run_command(code)
    except (Exception, SystemExit):
        return format_exc(limit=-2).strip()
    return "\n".join(not_answered(block, code, answer))


def run_page(page: Path) -> Iterator[str]:
    """Run the examples of a page in this folder; yield a line for each that is not run, fails or is slow."""
    names: dict[str, Any] = {"__name__": "page"}
    count = 0
    for block in blocks(page):
        if block.file:
            Path(block.file).write_text(f"{block.text}\n", encoding="utf-8")
        for code in examples(block):
            told = (
                code if code.startswith("cointoss ") else f"the Python that begins {code.splitlines()[0]!r}"
            )
            if why := reason(page, code):
                yield f"not run, {why}: {told}"
                continue
            before, count = sum(os.times()[:4]), count + 1
            if wrong := fault(block, code, names):
                yield f"FAILED: {told}\n    {wrong}"
            spent = sum(os.times()[:4]) - before
            if spent > LONG and not LASTING.search(f"{block.above} {block.text} {block.below}"):
                yield f"takes {spent:.0f} s of processor time, which the page doesn't say: {told}"
    if count:
        yield f"examples: {count}, {sum(os.times()[:4]):.0f} s of processor time"


def run_apart(page: Path) -> str:
    """Run the examples of a page in a process and a folder of their own; return the lines about them."""
    settings = {"PYTHONPATH": str(TOP), "MPLBACKEND": "agg", "TQDM_DISABLE": "1"}
    with tempfile.TemporaryDirectory() as folder:
        ran = subprocess.run(
            [sys.executable, __file__, "--here", page],
            cwd=folder,
            env=os.environ | settings,
            capture_output=True,
            text=True,
        )
    said = ran.stdout if ran.returncode == 0 else f"{ran.stdout}FAILED: {ran.stderr}"
    return "".join(f"{page.name}: {line}\n" for line in said.splitlines())


def main(arguments: list[str]) -> int:
    """Run the pages that are named, or all, two at a time; return the exit status."""
    if arguments[:1] == ["--here"]:
        for line in run_page(Path(arguments[1])):
            print(line, flush=True)
        return 0
    pages = [Path(name).resolve() for name in arguments] or PAGES
    with ThreadPoolExecutor(2) as workers:
        runs = [workers.submit(run_apart, page) for page in pages]
        for run in as_completed(runs):
            print(run.result(), end="", flush=True)
    return int(any(": FAILED: " in run.result() for run in runs))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
