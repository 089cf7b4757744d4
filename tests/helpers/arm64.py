"""The tosses of `bits` by a program for arm64, run in an emulator, against those of this machine, to the bit.

`make arm64` runs it; Debian's package qemu-user has the emulator.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from cointoss.compare.web.wasm.fields import row_of
from cointoss.models.records import Ending, Outcome
from tests.helpers.bits import cases, tossed

TRIPLE, EMULATOR = "aarch64-unknown-linux-musl", "qemu-aarch64"
IMPACTS, PIECES = 8192, 16384
"""Rows that there is room for."""
PROGRAM = """
#include <stdint.h>
#include <stdio.h>

int toss_one(const int64_t *given, int64_t *answer, void **error);

static double row[WIDE], answer[7], impacts[IMPACTS][6], pieces[PIECES][15], sizes[2];

#define LINE(x) 0, 0, sizeof x / 8, 8, (int64_t)x, sizeof x / 8, 8
#define TABLE(x) 0, 0, sizeof x / 8, 8, (int64_t)x, sizeof x / sizeof *x, sizeof *x / 8, sizeof *x, 8

int main(void)
{
    const int64_t given[] = {LINE(row), LINE(answer), TABLE(impacts), TABLE(pieces), LINE(sizes)};
    while (fread(row, sizeof row, 1, stdin) == 1) {
        int64_t none = 0;
        void *error = 0;
        if (toss_one(given, &none, &error) || sizes[0] > IMPACTS || sizes[1] > PIECES) return 1;
        fwrite(sizes, sizeof sizes, 1, stdout);
        fwrite(answer, sizeof answer, 1, stdout);
        fwrite(pieces[(int)sizes[1] - 1], sizeof *pieces, 1, stdout);
        fwrite(impacts, sizeof *impacts, sizes[0], stdout);
    }
    return 0;
}
"""
"""In C: reads rows of scenarios, and writes their tosses."""


def program(folder, wide):
    """Compile the engine and the program for arm64, in this process, which can compile nothing else."""
    from numba import types

    from cointoss.compare.web.wasm import interface
    from cointoss.compare.web.wasm.compiler import object_code

    numbers, table = (types.Array(types.float64, n, "C") for n in (1, 2))
    kinds = (numbers, numbers, table, table, numbers)
    (folder / "engine.o").write_bytes(object_code({"toss_one": (interface.toss_one, kinds)}, TRIPLE, ""))
    (folder / "main.c").write_text(PROGRAM)
    rooms = (f"-DWIDE={wide}", f"-DIMPACTS={IMPACTS}", f"-DPIECES={PIECES}")
    command = [sys.executable, "-m", "ziglang", "cc", "-target", "aarch64-linux-musl", "-static", *rooms]
    subprocess.run([*command, "main.c", "engine.o", "-lm", "-o", "program"], cwd=folder, check=True)


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


def main():
    """Print how many tosses are the same, and which are not; return the exit status."""
    if shutil.which(EMULATOR) is None:
        print(f"needs {EMULATOR}, on Debian in the package qemu-user", file=sys.stderr)
        return 2
    drawn = cases()
    rows = np.array([row_of(case) for case in drawn.values()])
    of_libm = {"musl": tossed(COINTOSS_LIBM="musl")["one"], "the system": tossed()["one"]}
    with tempfile.TemporaryDirectory() as folder:
        own = {**os.environ, "NUMBA_CACHE_DIR": folder, "COINTOSS_LIBM": "musl"}
        compiling = [sys.executable, "-m", "tests.helpers.arm64", folder, str(rows.shape[1])]
        subprocess.run(compiling, env=own, check=True)
        command = [EMULATOR, str(Path(folder, "program"))]
        done = subprocess.run(command, input=rows.tobytes(), capture_output=True, check=True)
    found = dict(zip(drawn, read(np.frombuffer(done.stdout)), strict=True))
    for libm, there in of_libm.items():
        for each in there.values():
            del each["states"]
        other = [name for name in drawn if found[name] != there[name]]
        print(f"with the functions of {libm} {len(drawn) - len(other)} of {len(drawn)} tosses are the same")
        if libm == "musl":
            print("".join(f"  {name} differs\n" for name in other), end="")
    return int(any(found[name] != of_libm["musl"][name] for name in drawn))


if __name__ == "__main__":
    if len(sys.argv) == 1:
        sys.exit(main())
    program(Path(sys.argv[1]), int(sys.argv[2]))
