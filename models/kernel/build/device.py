"""An entry as code for NVIDIA's cards: PTX by LLVM, machine code by NVIDIA's assembler."""

import subprocess
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from llvmlite import binding

from cointoss.models.kernel.build.lowering import LlvmTarget, foreign_to, optimise, with_parts
from cointoss.models.kernel.build.queue_code import of_queue
from cointoss.models.kernel.cuda import KINDS, REGISTERS

CARD = LlvmTarget("nvptx64-nvidia-cuda", "+ptx63", "sm_75")
"""The oldest cards for which there is an assembler still: their code in PTX is good for all later ones."""


def ptx_of(code: bytes, entry: str) -> str:
    """Return the PTX of threads that have an entry work on the rows of a queue.

    Args:
        code: the module of the engine, as LLVM's bitcode, for addresses of 64 bits.
        entry: the entry's symbol; it takes rows and answers first.

    Raises:
        RuntimeError: where it calls what a card does not have.
    """
    binding.set_option("", "-nvptx-fma-level=0")  # no product is fused with a sum
    machine = CARD.machine()
    module = queue_module(code, entry, CARD, machine, on_card=True)
    if foreign := foreign_to(module):
        raise RuntimeError(f"the engine calls {', '.join(sorted(foreign))}, which a card does not have")
    return machine.emit_assembly(module)


def queue_module(
    code: bytes, entry: str, target: LlvmTarget, machine: binding.TargetMachine, *, on_card: bool
) -> binding.ModuleRef:
    """Return the module of an engine of which `queue` alone is to be called, optimised for a target."""
    module = with_parts(code, of_queue(entry, on_card=on_card), ("queue",), target)
    optimise(module, target, machine)
    return module


def assembled(ptx: str, folder: Path) -> tuple[bytes, str]:
    """Return one file with the PTX and the machine code of some kinds of cards, and what the assembler says.

    Args:
        ptx: the code.
        folder: for what is made meanwhile.

    Raises:
        RuntimeError: where it can't be assembled, in one line.
    """
    source = folder / "queue.ptx"
    source.write_text(ptx)
    images, said = [], ""
    for kind in KINDS:
        made = folder / f"{kind}.cubin"
        options = ["-v", "-O3", "-maxrregcount", str(REGISTERS), f"-arch={kind}"]
        said += _told("ptxas", *options, str(source), "-o", str(made))
        images.append(f"--image3=kind=elf,sm={kind.removeprefix('sm_')},file={made}")
    images.append(f"--image3=kind=ptx,sm={CARD.processor.removeprefix('sm_')},file={source}")
    whole = folder / "queue.fatbin"
    _told("fatbinary", "--64", "--compress-all", f"--create={whole}", *images)
    return whole.read_bytes(), said


def _told(tool: str, *options: str) -> str:
    """Run one of NVIDIA's tools, and return what it says."""
    done = subprocess.run([str(_tools() / tool), *options], capture_output=True, text=True, check=False)
    if done.returncode:
        lines = (done.stderr or done.stdout).strip().splitlines() or ["it says nothing"]
        raise RuntimeError(f"{tool} failed: {lines[-1]}")
    return done.stdout + done.stderr


def _tools() -> Path:
    found: Any = find_spec("nvidia")
    for place in [] if found is None else found.submodule_search_locations:
        for folder in sorted(Path(place).glob("cu*/bin"), reverse=True):
            if (folder / "ptxas").is_file():
                return folder
    raise RuntimeError("ptxas is missing, which assembles it: pip install --group slow")
