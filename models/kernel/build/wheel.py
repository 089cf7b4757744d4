"""Puts the engines into a wheel, as libraries and for a browser: hatchling runs it when it builds one."""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

MODULES = ("cointoss.models.entries", "cointoss.analytic.entries", "cointoss.coin_mj.entries")
"""The tables of entries, a library each."""
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


class Engines(BuildHookInterface[Any]):
    """Adds the libraries of one system, and names the wheel after it.

    `COINTOSS_SYSTEM` chooses the system, by default this one; `COINTOSS_ENGINES` is a folder that has its
    libraries already, as `make wheels` builds them, the one for NVIDIA's cards, and the engine for a browser.
    """

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build what the wheel carries; an editable install builds its own at its first toss.

        Raises:
            SystemExit: where an engine can't be built, in one line.
        """
        if self.target_name != "wheel" or version == "editable":
            return
        asked = os.environ.get("COINTOSS_SYSTEM")
        if asked is not None and asked not in PLATFORMS:
            raise SystemExit(f"COINTOSS_SYSTEM = {asked!r}: accepted: {', '.join(PLATFORMS)}")
        self._made = Path(tempfile.mkdtemp())
        home = self._made / "cointoss"
        shutil.copytree(
            Path(self.root, "cointoss"), home, ignore=shutil.ignore_patterns("__pycache__"), symlinks=True
        )
        for part in ("models", "analytic", "coin_mj", "compare"):
            (home / part).unlink(missing_ok=True)
            (home / part).symlink_to(Path(self.root, part), target_is_directory=True)
        about = self._made / f"cointoss_dynamics-{self.metadata.version}.dist-info"
        about.mkdir()
        (about / "METADATA").write_text(f"Name: cointoss-dynamics\nVersion: {self.metadata.version}\n")
        named = {"PYTHONPATH": str(self._made)}
        this = subprocess.run(
            [sys.executable, "-c", "from cointoss.models.kernel.library import SYSTEM; print(SYSTEM)"],
            env={**os.environ, **named},
            capture_output=True,
            text=True,
            check=True,
        ).stdout.strip()
        system = asked or this
        if system not in PLATFORMS:
            raise SystemExit(
                f"cointoss-dynamics: there is no engine for {system}; there is: {', '.join(PLATFORMS)}"
            )
        folder = Path(os.environ.get("COINTOSS_ENGINES") or self._built(system, named))
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

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:  # noqa: ARG002
        """Remove what was made meanwhile."""
        if hasattr(self, "_made"):
            shutil.rmtree(self._made)

    def _built(self, system: str, named: dict[str, str]) -> Path:
        folder = self._made / "engines"
        folder.mkdir()
        browser = folder / Path(BROWSER).name
        if Path(self.root, BROWSER).is_file():
            shutil.copyfile(Path(self.root, BROWSER), browser)  # is kept where it is of these sources
        build = [sys.executable, "-m", "cointoss.models.kernel.build"]
        commands = {
            f"the engine of {module}": [*build, module, "--out", folder, "--carried", "--system", system]
            for module in MODULES
        }
        commands["engine.wasm"] = [sys.executable, "-m", "cointoss.compare.web.wasm.build", browser]
        for what, command in commands.items():
            if subprocess.run(command, env={**os.environ, **named}, check=False).returncode:
                raise SystemExit(f"cointoss-dynamics: {what} could not be built for {system}")
        return folder
