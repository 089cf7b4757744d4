"""The hash of a module's sources, and what compiled functions must keep to for it to be theirs."""

import ast
import importlib
import inspect
import pkgutil

import pytest

import cointoss
from cointoss.models.kernel.fork.functions import CompiledFunction
from cointoss.models.kernel.sources import imported, source_hash
from tests.helpers.modules import write


def all_compiled():
    functions = {
        value
        for found in pkgutil.walk_packages(cointoss.__path__, "cointoss.")
        for value in vars(importlib.import_module(found.name)).values()
        if isinstance(value, CompiledFunction)
    }
    assert len(functions) > 200
    return functions


def test_no_compiled_function_assigns_an_array_to_a_slice():
    """To compile `a[:] = b` takes seconds, for the text of its error: see `copy_into`."""
    for function in all_compiled():
        for node in ast.walk(ast.parse(inspect.getsource(function.py_func))):
            if isinstance(node, ast.Assign) and ast.unparse(node.value) not in ("0", "0.0", "np.inf"):
                for part in ast.walk(ast.List(node.targets)):
                    assert not isinstance(part, ast.Slice), (function, ast.unparse(node))


def test_every_compiled_function_that_one_calls_is_in_its_hash():
    """A callee's module is imported, in one of the ways that `source_hash` reads."""
    for function in all_compiled():
        names = function.py_func.__globals__
        for name in function.py_func.__code__.co_names:
            callee = names.get(name)
            module = getattr(callee, "__module__", None)
            if isinstance(callee, CompiledFunction) and module != function.__module__:
                assert module in imported(function.__module__), (function, callee)


@pytest.mark.parametrize(
    "source",
    [
        "import cointoss.models.room.far",
        "import os, cointoss.models.room.far as near",
        "if True: import cointoss.models.room.far",
        "from cointoss.models.room \\\n    import far",
        "from .room import far",
        "from .room.far import a",
        "from . import room; from .room import far",
        "from cointoss.models.room.far import a, b",
        "from cointoss.models.room import (\n    other,\n    far as near,  # )\n)",
        "def f():\n    from cointoss.models.room import far\n",
        "from cointoss.models.room.package import a",
    ],
)
def test_the_hash_is_of_all_that_is_imported(tmp_path, source):
    hashes = []
    for a in (1, 2):
        folder = tmp_path / str(a)
        write(folder, "cointoss.models.room.package.__init__", "from cointoss.models.room.far import a\n")
        write(folder, "cointoss.models.near", source + "\n")
        write(folder, "cointoss.models.room.far", f"a = b = {a}\n")
        hashes.append(source_hash("cointoss.models.near", folder / "cointoss"))
    assert hashes[0] != hashes[1]
