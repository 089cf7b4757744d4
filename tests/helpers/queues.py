"""The queue of an entry's rows, as cards run it, built for this processor."""

import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from tests.helpers.command_line import HERE


@dataclass(frozen=True)
class BuiltQueue:
    """What was built of a table's entry."""

    library: Path
    ptx: str

    def assembled(self, folder: Path) -> str:
        """Return what the assembler says of it."""
        from cointoss.models.kernel.build import device

        return device.assembled(self.ptx, folder)[1]


def queue_of(module: str, folder: Path) -> BuiltQueue:
    """Build the queue of a table's entry, in a process of its own."""
    subprocess.run([sys.executable, "-m", __name__, module, str(folder)], check=True, env=HERE)
    return BuiltQueue(folder / "queue.so", (folder / "queue.ptx").read_text())


def main(module: str, out: str) -> None:
    """Build the queue of a module's entry into a folder."""
    from cointoss.models.kernel.build import device
    from cointoss.models.kernel.build.__main__ import alone, asked_of
    from cointoss.models.kernel.build.linking import SYSTEMS, link
    from cointoss.models.kernel.build.lowering import lowered, prepared
    from cointoss.models.kernel.manifest import CUDA, SYSTEM

    asked, system, folder = asked_of(alone(module), CUDA), SYSTEMS[SYSTEM], Path(out)
    (entry,), target = (each.symbol for each in asked), system.targets[""]
    code, machine = prepared(lowered(asked), target, [entry]), target.machine()
    object_file = machine.emit_object(device.queue_module(code, entry, target, machine, on_card=False))
    with tempfile.TemporaryDirectory() as aside:
        (folder / "queue.so").write_bytes(link([object_file], ["queue"], system, Path(aside)))
    (folder / "queue.ptx").write_text(device.ptx_of(code, entry))


if __name__ == "__main__":
    main(*sys.argv[1:])
