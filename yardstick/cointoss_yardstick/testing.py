"""A plugin of pytest for tests of an engine, loaded by `pytest -p cointoss_yardstick.testing`."""

from collections.abc import Iterator

import pytest

from cointoss_yardstick.simulators.simulator import Simulator, simulator_of
from cointoss_yardstick.suite.agreeing import assert_agrees, assert_met
from cointoss_yardstick.suite.case import Case, cases

__all__ = ["assert_agrees", "assert_met", "cointoss_case", "cointoss_engine"]


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option that names the engine."""
    parser.getgroup("cointoss").addoption(
        "--cointoss-engine",
        help="The engine under test: package.module:name, or an entry point cointoss.engines.",
    )


@pytest.fixture(scope="session")
def cointoss_engine(request: pytest.FixtureRequest) -> Iterator[Simulator]:
    """Return the engine that the option --cointoss-engine names; without it the test fails."""
    given = request.config.getoption("--cointoss-engine")
    if not given:
        pytest.fail(
            "--cointoss-engine: missing; accepted: package.module:name, or an entry point cointoss.engines"
        )
    with simulator_of(given) as engine:
        yield engine


@pytest.fixture(params=cases(), ids=lambda case: case.name)
def cointoss_case(request: pytest.FixtureRequest) -> Case:
    """Return a case of the suite: a test that asks for it runs once for each."""
    return request.param
