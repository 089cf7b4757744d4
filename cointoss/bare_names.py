"""Bare names in a checkout: `import analytic` gives `cointoss.analytic`, and no second copy of it."""

import sys
from collections.abc import Sequence
from importlib import import_module, util
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import NoReturn


class _SameModule(MetaPathFinder, Loader):
    """Finds NAME.part as `cointoss.NAME.part` for the names that were opened."""

    def __init__(self) -> None:
        self.names: set[str] = set()
        self._own: dict[str, ModuleSpec | None] = {}

    def find_spec(
        self, fullname: str, _path: Sequence[str] | None, _target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if fullname.partition(".")[0] not in self.names or util.find_spec(f"cointoss.{fullname}") is None:
            return None
        return ModuleSpec(fullname, self)

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        module = import_module(f"cointoss.{spec.name}")
        self._own[spec.name] = module.__spec__
        return module

    def exec_module(self, module: ModuleType) -> None:
        """Give the module, which has run, its own name again: the import has written the bare one into it."""
        bare = module.__spec__
        assert bare is not None
        module.__spec__ = self._own.pop(bare.name)

    def get_code(self, fullname: str) -> NoReturn:
        """Refuse `python -m NAME.part`."""
        raise ImportError(f"{fullname}: accepted: python -m cointoss.{fullname}")


_finder = _SameModule()


def open_as_part(name: str) -> None:
    """Let a folder of the checkout that is imported as `name` be `cointoss.name`, with all that is in it."""
    if _finder not in sys.meta_path:
        sys.meta_path.insert(0, _finder)
    _finder.names.add(name)
    sys.modules[name] = import_module(f"cointoss.{name}")
