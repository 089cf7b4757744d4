"""What the tests of the kernel share."""

import pytest

from tests.helpers.queues import queue_of
from tests.helpers.small import entries


@pytest.fixture(scope="session")
def queue(tmp_path_factory):
    """The queue of the small engine's rows, built for this processor."""
    return queue_of(entries.__name__, tmp_path_factory.mktemp("queue"))
