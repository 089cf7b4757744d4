"""Hold the engines of this folder against the suite: each in an environment of its own, its cards beside it.

    python yardstick/adapters/measure.py [--environments DIR] [NAME[:SETTINGS] ...]

An environment is made where it is missing, of requirements.txt, of alone.txt without what that requires, and
of the packages for node in node.txt.
A card is what `cointoss conform --json` prints, without what cases.toml has too.
"""

import argparse
import json
import subprocess
import sys
import venv
from datetime import date
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
LIMIT = 900
"""How long one answer may take [s]: some of these engines compile first."""
KEPT = ("name", "status", "found", "error", "height", "order", "why")


def python_of(name: str, environments: Path) -> Path:
    """Return the Python of an engine's environment, made where it is missing."""
    folder = (environments / name / "venv").absolute()
    python = folder / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")
    if not python.exists():
        venv.create(folder, with_pip=True)
        install = [python, "-m", "pip", "install", "--quiet", "-r"]
        subprocess.run([*install, HERE / name / "requirements.txt"], check=True)
        if (alone := HERE / name / "alone.txt").exists():
            subprocess.run([*install, alone, "--no-deps"], check=True)
        if (of_node := HERE / name / "node.txt").exists():
            packages = of_node.read_text(encoding="utf-8").split()
            subprocess.run(["npm", "install", "--prefix", folder.parent, *packages], check=True)
    return python


def settings_of(name: str, python: Path) -> list[str]:
    """Return the names of an adapter's engines: one for each set of settings."""
    listed = (
        f"import adapters.{name}.engine as engine\n"
        "known = vars(engine).items()\n"
        "print('listed:', *(k for k, v in known if hasattr(v, 'simulate') and not isinstance(v, type)))"
    )
    told = subprocess.run([python, "-c", listed], cwd=HERE.parent, check=True, capture_output=True, text=True)
    return told.stdout.rpartition("listed:")[2].split()


def card_of(name: str, settings: str, python: Path) -> dict[str, Any]:
    """Return the card of an engine with one set of its settings."""
    engine = f"{python} -m adapters.{name}.engine:{settings}"
    command = [sys.executable, "-m", "cointoss", "conform", engine, "--json", "--time-limit", str(LIMIT)]
    answered = subprocess.run(command, cwd=HERE.parent, stdout=subprocess.PIPE, text=True)
    if answered.returncode not in (0, 1):
        raise SystemExit(f"{name}: {settings}: cointoss conform ended with status {answered.returncode}")
    card = {"engine": "", "date": str(date.today())} | json.loads(answered.stdout)
    for case in card["cases"]:
        runs = [[run["dt"], run["error"], run["processor_time"]] for run in case["runs"]]
        kept = {key: case[key] for key in KEPT}
        case.clear()
        case.update(kept, runs=runs)
    return card


def main() -> None:
    """Measure the engines that are named, or all."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument(
        "names",
        nargs="*",
        metavar="NAME",
        help="folders here, by default all; NAME:SETTINGS is one of its engines",
    )
    folder = HERE.parents[1] / "out" / "engines"
    parser.add_argument("--environments", type=Path, default=folder, metavar="DIR")
    asked = parser.parse_args()
    for wanted in asked.names or sorted(path.parent.name for path in HERE.glob("*/engine.py")):
        name, _, only = wanted.partition(":")
        python = python_of(name, asked.environments)
        for settings in [only] if only else settings_of(name, python):
            card = card_of(name, settings, python)
            text = json.dumps(card, separators=(",", ":")).replace('{"name"', '\n{"name"')
            (HERE / name / f"{settings}.json").write_text(text + "\n", encoding="utf-8")
            print(
                f"{card['engine']}: {sum(case['status'] == 'met' for case in card['cases'])} cases met",
                flush=True,
            )


if __name__ == "__main__":
    main()
