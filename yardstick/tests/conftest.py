"""The settings of the tests of cointoss, which those of the yardstick share."""

from tests.conftest import pytest_collection_modifyitems

__all__ = ["pytest_collection_modifyitems"]
