"""The settings of the tests of cointoss, which those of bounces share."""

from tests.conftest import pytest_collection_modifyitems

__all__ = ["pytest_collection_modifyitems"]
