"""Builds an engine: `python -m cointoss.models.kernel.build MODULE --out FOLDER [--system SYSTEM ...]`."""

import argparse
import hashlib
import json
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from importlib import import_module
from importlib.util import find_spec, module_from_spec
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

from cointoss.models.kernel.base_folder import write_whole
from cointoss.models.kernel.digests import ENGINES, HOME, digest_of
from cointoss.models.kernel.library import AVX2, RELEASE, Entry
from cointoss.models.kernel.manifest import BROWSER, CUDA, MANIFEST, SUFFIX, SYSTEM, Made

if TYPE_CHECKING:
    from cointoss.models.kernel.build.linking import System


def build(module: str, out: Path, systems: Sequence[str], *, carried: bool) -> None:
    """Build the library of an engine for each system.

    Args:
        module: the engine's table of entries.
        out: the folder that gets each library, and a manifest beside it.
        systems: by their names.
        carried: whether a wheel is to carry the libraries: their names then have no digest.

    Raises:
        RuntimeError: where it can't be done, in one line.
    """
    from cointoss.models.kernel.build import linking, lowering

    before = {path: digest_of(path) for part in ENGINES for path in (HOME / part).rglob("*.py")}
    table = alone(module)
    assembled = _assembler() if CUDA in systems else None  # is read as a source
    known = [name for name in (*linking.SYSTEMS, CUDA) if entries_of(table, name)]
    if unknown := [name for name in systems if name not in known]:
        raise RuntimeError(f"{', '.join(unknown)}: accepted: {', '.join(known)}")
    symbols, ready = symbols_of(table, *systems), dict[str, bytes]()
    code = lowering.lowered(asked_of(table, *systems))
    # Some are imported where they are first compiled.
    sources = {name: before.get(HOME / name) or digest_of(HOME / name) for name in read_sources()}
    if any(digest_of(HOME / name) != digest for name, digest in sources.items()):
        raise RuntimeError("its sources have changed while they were compiled: build it again")
    forms = {each.symbol_of(lacks): each.form for each in entries_of(table) for lacks in each.variants}
    with tempfile.TemporaryDirectory() as folder:
        for name in systems:
            like, kept = (
                (BROWSER, symbols_of(table, BROWSER)) if name == BROWSER else ("linux-x86_64", symbols)
            )
            if like not in ready:
                ready[like] = lowering.prepared(code, linking.SYSTEMS[like].targets[""], kept)
            if assembled is not None and name == CUDA:
                library = assembled(ready[like], symbols_of(table, CUDA)[0], Path(folder))
            else:
                library = _linked(ready[like], kept, linking.SYSTEMS[name], Path(folder), carried=carried)
            digest = hashlib.sha256(library).hexdigest()
            stem = f"{module.split('.')[-2]}-{name}" + ("" if carried else f"-{digest[:16]}")
            write_whole(out / f"{stem}{SUFFIX}", library)
            manifest = Made(module, name, digest, {} if carried else sources, forms)
            write_whole(out / f"{stem}{MANIFEST}", json.dumps(manifest._asdict()).encode())


def _assembler() -> Callable[[bytes, str, Path], bytes]:
    """Return what makes the library for cards of a module of code and the symbol of an entry."""
    from cointoss.models.kernel.build import device

    return lambda code, entry, folder: device.assembled(device.ptx_of(code, entry), folder)[0]


def _linked(code: bytes, symbols: Sequence[str], system: "System", folder: Path, *, carried: bool) -> bytes:
    """Return the library of a module of code for a system: for all its processors, or this one."""
    from cointoss.models.kernel.build import linking, lowering

    is_known = not carried and processor() in system.targets
    kinds = {processor(): system.targets[processor()]} if is_known else system.targets
    codes, shown = [], list(system.shown)
    for end, target in kinds.items():
        new = {symbol: symbol + end for symbol in symbols}
        again = {RELEASE: RELEASE + end} if codes else {}
        codes.append(lowering.object_code(code, target, new | again))
        shown += new.values()
    return linking.link(codes, shown, system, folder)


def alone(module: str) -> ModuleType:
    """Return a module without what its package imports for Python, in a process that does nothing else."""
    package = find_spec(module.rpartition(".")[0])
    if package is None:
        raise RuntimeError(f"{module}: there is no such package")
    sys.modules[package.name] = module_from_spec(package)
    return import_module(module)


def processor() -> str:
    """Return what symbols for this processor end with."""
    from llvmlite import binding

    return AVX2 if binding.get_host_cpu_features().get("avx2") else ""


def entries_of(table: object, *systems: str) -> list[Entry[..., object]]:
    """Return the entries of a table, all or those that one of some systems has."""
    has = [each for each in vars(table).values() if isinstance(each, Entry)]
    some = {CUDA, BROWSER}.issuperset(systems) and systems
    return [each for each in has if not some or set(some) & set(each.elsewhere)]


def asked_of(table: object, *systems: str) -> list[Any]:
    """Return what is asked of a table of entries, all or those of some systems, for `lowering.lowered`.

    Raises:
        RuntimeError: where two entries have one name.
    """
    from cointoss.models.kernel.build.lowering import EntryRequest

    asked = [
        EntryRequest(each.symbol_of(lacks), each.function, *each.kinds, lacks)
        for each in entries_of(table, *systems)
        for lacks in each.variants
    ]
    if len({each.symbol for each in asked}) < len(asked):
        raise RuntimeError(f"{table}: two entries have one name")
    return asked


def symbols_of(table: object, *systems: str) -> list[str]:
    """Return the symbols of a table's entries, of all or those of some systems."""
    return [each.symbol for each in asked_of(table, *systems)]


def read_sources() -> Iterator[str]:
    """Yield the paths of the engines' files that this process has imported, in the project's folder."""
    yield "models/kernel/build/__main__.py"
    for name, module in sorted(sys.modules.items()):
        file = getattr(module, "__file__", None)
        home, *parts = name.split(".")
        if file and home == "cointoss" and parts and parts[0] in ENGINES:
            path = Path(*parts)
            yield (
                path / "__init__.py" if hasattr(module, "__path__") else path.with_suffix(".py")
            ).as_posix()


def main() -> int:
    """Build what the arguments name, and return the exit status."""
    parser = argparse.ArgumentParser(prog="python -m cointoss.models.kernel.build", description=__doc__)
    parser.add_argument("module")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--system", action="append")
    parser.add_argument("--carried", action="store_true")
    given = parser.parse_args()
    try:
        build(given.module, given.out, given.system or [SYSTEM], carried=given.carried)
    except (RuntimeError, OSError, ImportError) as problem:
        print(problem, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
