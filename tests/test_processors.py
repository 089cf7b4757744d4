"""The same numbers on every kind of processor, for which NumPy, BLAS and the C library can take this one."""

import json
import re
from typing import Any

import pytest
from numpy._core import _multiarray_umath as core  # pyright: ignore[reportAttributeAccessIssue]

from tests.helpers.command_line import python

FEWEST = 3
"""The number of kinds that must be compared."""
KINDS = {
    "Prescott": ("SSE3", ""),
    "Sandybridge": ("AVX", ""),
    "Haswell": ("AVX2", "512|V4"),
    "Zen": ("AVX2", "512|V4"),
    "SkylakeX": ("AVX512_SKX", "none"),
}
"""By OpenBLAS's name: what such a processor has, and a pattern of those of NumPy's instructions it lacks."""
OLD = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F"}
"""The C library of a processor without fused products, as the first two are."""


def variables_of(kind: str, lacks: str) -> dict[str, Any]:
    """Return the variables by which this processor passes for another kind."""
    named = [name for name in core.__cpu_dispatch__ if core.__cpu_features__[name] and re.search(lacks, name)]
    without = {"OPENBLAS_CORETYPE": kind, "NPY_DISABLE_CPU_FEATURES": " ".join(named)}
    return without if lacks else without | OLD


@pytest.mark.slow
def test_releases_rows_tosses_and_settings_are_the_same_on_every_kind_of_processor():
    known = {kind: lacks for kind, (has, lacks) in KINDS.items() if core.__cpu_features__.get(has)}
    answers = {
        kind: python("-m", "tests.helpers.row_digests", **variables_of(kind, lacks))
        for kind, lacks in known.items()
    }
    print("compared:", ", ".join(answers))
    assert len(answers) >= FEWEST
    assert [one.stderr for one in answers.values() if one.returncode] == []
    first, *others = (json.loads(one.stdout) for one in answers.values())
    assert [[name for name in first if one[name] != first[name]] for one in others] == [[]] * len(others)
