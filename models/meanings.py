"""What the fields of a record mean, as its class says below each."""

import ast
import inspect
import sys
from functools import cache
from itertools import pairwise


@cache
def meanings(record: type) -> dict[str, str]:
    """Return the text below each field that has one, by the field's name.

    pydantic can read it too, but only when the class is made, so at the start of every command.
    """
    module = ast.parse(inspect.getsource(sys.modules[record.__module__]))
    definition = next(
        one for one in ast.walk(module) if isinstance(one, ast.ClassDef) and one.name == record.__name__
    )
    meanings = {}
    for field, below in pairwise(definition.body):
        match field, below:
            case ast.AnnAssign(target=ast.Name(id=name)), ast.Expr(value=ast.Constant(value=str(text))):
                meanings[name] = inspect.cleandoc(text)
    return meanings
