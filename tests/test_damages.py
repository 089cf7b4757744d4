"""The table of damages that the tests must see: each still applies to the code, and its test is there."""

import ast

import pytest

from tests.helpers.damages import DAMAGES, ROOT, Damage


def test_every_damage_changes_one_place_leaves_python_python_and_has_its_test():
    assert len(DAMAGES) > 60
    assert len({(damage.file, damage.before, damage.after) for damage in DAMAGES.values()}) == len(DAMAGES)
    for damage in DAMAGES.values():
        assert damage.after != damage.before
        damaged = damage.applied_to(damage.source)
        if damage.file.endswith(".py"):
            ast.parse(damaged)

        file, _, name = damage.test.partition("::")
        named = f"def {name.partition('[')[0]}("
        assert named in (ROOT / file).read_text(encoding="utf-8"), damage


@pytest.mark.parametrize("source", ["nothing of it", "twice: a < b, a < b"])
def test_a_damage_that_has_no_one_place_is_refused(source):
    with pytest.raises(ValueError, match=r"occurs [02] times"):
        Damage("file.py", "a < b", "a <= b", "").applied_to(source)
