"""What the fields of a part of a scenario mean, as its class says below each."""

import ast
import inspect
from functools import cache
from itertools import pairwise
from textwrap import dedent

from pydantic import BaseModel


@cache
def meanings(part: type[BaseModel]) -> dict[str, str]:
    """Return the text below each field that has one, by the field's name.

    pydantic can read it too, but only when the class is made, so at the start of every command.
    """
    (definition,) = ast.parse(dedent(inspect.getsource(part))).body
    assert isinstance(definition, ast.ClassDef)
    meanings = {}
    for field, below in pairwise(definition.body):
        match field, below:
            case ast.AnnAssign(target=ast.Name(id=name)), ast.Expr(value=ast.Constant(value=str(text))):
                meanings[name] = inspect.cleandoc(text)
    return meanings
