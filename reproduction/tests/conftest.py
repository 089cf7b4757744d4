"""The fixtures and settings of the tests of cointoss, which those of its studies share."""

from tests.conftest import fresh_back_end, pytest_collection_modifyitems, without_horizon

__all__ = ["fresh_back_end", "pytest_collection_modifyitems", "without_horizon"]
