"""The tosses of `bits` by the libraries for arm64 and Windows, in emulators, against this machine's.

`make emulated` runs it. A small program in C loads each library, as Python does. Debian's packages qemu-user
and libc6-arm64-cross, and wine, have the emulators.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from cointoss.models.records import Ending, Outcome
from cointoss.models.rows import row_of
from tests.helpers.bits import cases, numbers_of

IMPACTS, PIECES = 8192, 16384
"""Rows that there is room for."""
EMULATORS = {
    "linux-aarch64": ("aarch64-linux-gnu", ["qemu-aarch64", "-L", "/usr/aarch64-linux-gnu"]),
    "win32-amd64": ("x86_64-windows-gnu", ["wine"]),
}
"""By the system of a library: the program's target as ziglang names it, and what runs it here."""
PROGRAM = """
#include <stdint.h>
#include <stdio.h>
#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#include <windows.h>
#define LOAD(file, name) (void *)GetProcAddress(LoadLibraryA(file), name)
#else
#include <dlfcn.h>
#define LOAD(file, name) dlsym(dlopen(file, RTLD_NOW), name)
#endif

static double row[WIDE], answer[7], impacts[IMPACTS][6], pieces[PIECES][15], sizes[2];

#define LINE(x) 0, 0, sizeof x / 8, 8, (int64_t)(intptr_t)x, sizeof x / 8, 8
#define AXES(x) sizeof x / sizeof *x, sizeof *x / 8, sizeof *x, 8
#define TABLE(x) 0, 0, sizeof x / 8, 8, (int64_t)(intptr_t)x, AXES(x)

int main(int count, char **arguments)
{
    const int64_t given[] = {LINE(row), LINE(answer), TABLE(impacts), TABLE(pieces), LINE(sizes)};
    int (*toss_one)(const int64_t *, int64_t *, void **) = LOAD(arguments[1], arguments[2]);
    if (!toss_one) return 3;
#ifdef _WIN32
    _setmode(_fileno(stdin), _O_BINARY);
    _setmode(_fileno(stdout), _O_BINARY);
#endif
    while (fread(row, sizeof row, 1, stdin) == 1) {
        int64_t none = 0;
        void *error = 0;
        if (toss_one(given, &none, &error) || sizes[0] > IMPACTS || sizes[1] > PIECES) return 1;
        fwrite(sizes, sizeof sizes, 1, stdout);
        fwrite(answer, sizeof answer, 1, stdout);
        fwrite(pieces[(int)sizes[1] - 1], sizeof *pieces, 1, stdout);
        fwrite(impacts, sizeof *impacts, (size_t)sizes[0], stdout);
    }
    return 0;
}
"""
"""In C: reads rows of scenarios, and writes their tosses by the symbol of a library."""


def read(answers):
    """Yield the numbers of each toss of the program, as `numbers_of` returns them, without its samples."""
    while len(answers):
        count, answer, piece = int(answers[0]), answers[2:9], answers[9:24]
        impacts, answers = answers[24 : 24 + 6 * count].reshape(count, 6), answers[24 + 6 * count :]
        yield {
            "ending": str(Ending(int(answer[1]))),
            "outcome": str(Outcome(int(answer[0]))),
            "certain": bool(answer[6]),
            "trusted": int(answer[5]),
            "time": float(answer[4]),
            "impacts": impacts[:, [0, 2, 3, 4, 5]].tolist(),
            "end": piece[2:].tolist(),
        }


def tossed(folder, system, symbol, rows):
    """Return the program's answers by a symbol of the library for a system, an array of numbers."""
    target, emulator = EMULATORS[system]
    program = folder / f"{system}.exe"
    if not program.exists():
        (folder / "main.c").write_text(PROGRAM)
        rooms = (f"-DWIDE={rows.shape[1]}", f"-DIMPACTS={IMPACTS}", f"-DPIECES={PIECES}")
        command = [
            sys.executable,
            "-m",
            "ziglang",
            "cc",
            "-target",
            target,
            *rooms,
            "main.c",
            "-o",
            program.name,
        ]
        subprocess.run(command, cwd=folder, check=True)
    library = f"analytic-{system}.so"
    environment = {**os.environ, "WINEDEBUG": "-all", "WINEPREFIX": str(folder / "wine")}
    done = subprocess.run(
        [*emulator, f"./{program.name}", library if system == "win32-amd64" else f"./{library}", symbol],
        cwd=folder,
        env=environment,
        input=rows.tobytes(),
        capture_output=True,
        check=True,
    )
    return np.frombuffer(done.stdout)


def main():
    """Print how many tosses are the same, and which are not; return the exit status."""
    drawn = cases()
    rows = np.array([row_of(case) for case in drawn.values()])
    here = {name: numbers_of(case) for name, case in drawn.items()}
    for each in here.values():
        del each["states"]
    differs = False
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        command = [
            sys.executable,
            "-m",
            "cointoss.models.kernel.build",
            "cointoss.analytic.entries",
            "--carried",
        ]
        named = [word for system in EMULATORS for word in ("--system", system)]
        subprocess.run([*command, "--out", made, *named], check=True)
        for system, (_, emulator) in EMULATORS.items():
            if shutil.which(emulator[0]) is None:
                print(f"{system}: not run, for want of {emulator[0]}")
                continue
            for end in ("", ".avx2") if system == "win32-amd64" else ("",):
                found = dict(zip(drawn, read(tossed(folder, system, f"toss_one{end}", rows)), strict=True))
                other = [name for name in drawn if found[name] != here[name]]
                print(
                    f"{system}, toss_one{end}: {len(drawn) - len(other)} of {len(drawn)} tosses are the same"
                )
                print("".join(f"  {name} differs\n" for name in other), end="")
                differs = differs or bool(other)
    return int(differs)


if __name__ == "__main__":
    sys.exit(main())
