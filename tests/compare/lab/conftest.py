"""What the tests of the lab share."""

import pytest

from cointoss.compare.web.wasm import carried


@pytest.fixture(autouse=True)
def _built(monkeypatch):
    """Let the package carry some engine."""
    monkeypatch.setattr(carried, "engine_bytes", lambda: bytes(500_000))
