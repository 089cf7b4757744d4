"""Puts the engines into a wheel, as libraries and for a browser: hatchling runs it when it builds one."""

import atexit
import os
import platform
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

MODULES = ("cointoss.models.entries", "cointoss.analytic.entries", "cointoss.coin_mj.entries")
"""The tables of entries, a library each."""
ENGINE = MODULES[1]
"""The one that a browser has, too."""
BROWSER = "compare/web/wasm/engine.wasm"
"""The place of the engine for a browser."""
PLATFORMS = {
    "linux-x86_64": "manylinux_2_17_x86_64",
    "linux-aarch64": "manylinux_2_17_aarch64",
    "darwin-arm64": "macosx_11_0_arm64",
    "darwin-x86_64": "macosx_10_15_x86_64",
    "win32-amd64": "win_amd64",
}
"""The platforms in a wheel's name, by the name of the system."""
SYSTEM = f"{sys.platform}-{platform.machine()}".lower()
"""This system, as `cointoss.models.kernel.manifest` names it, which can't be imported here."""


class Engines(BuildHookInterface[Any]):
    """Adds the libraries of one system, and names the wheel after it.

    `COINTOSS_SYSTEM` chooses the system, by default this one; `COINTOSS_ENGINES` is a folder that has its
    libraries already, as `make wheels` builds them, the one for NVIDIA's cards, and the engine for a browser.
    """

    def dependencies(self) -> "list[str]":
        """Return none beside those of pyproject.toml; an installer asks for them before it builds."""
        _system()
        return []

    def initialize(self, version: str, build_data: "dict[str, Any]") -> None:
        """Build what the wheel carries; an editable install builds its own at its first toss.

        Raises:
            SystemExit: where an engine can't be built, in one line.
        """
        if self.target_name != "wheel" or version == "editable":
            return
        system = _system()
        self._made = Path(tempfile.mkdtemp())
        atexit.register(shutil.rmtree, self._made)
        folder = Path(os.environ.get("COINTOSS_ENGINES") or self._built(system))
        libraries = [
            f"{module.split('.')[-2]}-{system}.so{end}" for module in MODULES for end in ("", ".json")
        ]
        places = {name: f"models/kernel/engines/{name}" for name in libraries}
        for name, place in {**places, Path(BROWSER).name: BROWSER}.items():
            if not (folder / name).is_file():
                raise SystemExit(f"cointoss-dynamics: {folder / name}: missing; make wheels builds it")
            build_data["force_include"][str(folder / name)] = f"cointoss/{place}"
        if not system.startswith("darwin"):
            for file in folder.glob("*-cuda.so*"):
                build_data["force_include"][str(file)] = f"cointoss/models/kernel/engines/{file.name}"
        build_data["tag"] = f"py3-none-{PLATFORMS[system]}"
        build_data["pure_python"] = False

    def _built(self, system: str) -> Path:
        """Build the engines of these sources, and return their folder."""
        home, folder = self._made / "cointoss", self._made / "engines"
        folder.mkdir()
        shutil.copytree(
            Path(self.root, "cointoss"), home, ignore=shutil.ignore_patterns("__pycache__"), symlinks=True
        )
        for part in ("models", "analytic", "coin_mj", "compare"):
            (home / part).unlink(missing_ok=True)
            (home / part).symlink_to(Path(self.root, part), target_is_directory=True)
        about = self._made / f"cointoss_dynamics-{self.metadata.version}.dist-info"
        about.mkdir()
        (about / "METADATA").write_text(f"Name: cointoss-dynamics\nVersion: {self.metadata.version}\n")
        # An installer may have put what builds them where its own process alone finds it.
        paths = os.pathsep.join([str(self._made), *filter(None, sys.path)])
        build = ["cointoss.models.kernel.build", "--out", str(folder), "--carried", "--system", system]
        for module in MODULES:
            more = ["--system", "wasm32"] if module == ENGINE else []
            _run([*build, module, *more], paths, f"the engine of {module} for {system}")
        made = [str(folder / Path(BROWSER).name), str(folder / f"{ENGINE.split('.')[-2]}-wasm32.so")]
        _run(["cointoss.compare.web.wasm.build", *made], paths, "engine.wasm")
        return folder


def _system() -> str:
    """Return the name of the system that is asked for.

    Raises:
        SystemExit: where there is no engine for it, or none of what builds engines or runs them; in one line.
    """
    if sys.version_info < (3, 11):  # noqa: UP036, pip looks for what builds an engine first
        raise SystemExit(f"cointoss-dynamics needs Python >= 3.11; this is {platform.python_version()}")
    system = os.environ.get("COINTOSS_SYSTEM") or SYSTEM
    if system not in PLATFORMS:
        raise SystemExit(f"cointoss-dynamics has no engine for {system}; accepted: {', '.join(PLATFORMS)}")
    if (sys.platform, system) == ("linux", SYSTEM) and platform.libc_ver()[0] != "glibc":
        raise SystemExit("cointoss-dynamics needs glibc: MuJoCo and numba have no packages for another Linux")
    return system


def _run(words: "list[str]", paths: str, what: str) -> None:
    """Run a module of Python.

    Raises:
        SystemExit: where it fails, with the last line that it says.
    """
    done = subprocess.run(
        [sys.executable, "-m", *words],
        env={**os.environ, "PYTHONPATH": paths},
        stderr=subprocess.PIPE,
        text=True,
        errors="replace",
        check=False,
    )
    if done.returncode:
        said = done.stderr.strip().splitlines() or [f"exit status {done.returncode}"]
        raise SystemExit(f"cointoss-dynamics: {what} could not be built: {said[-1]}")
