"""Taylor models: their enclosures hold what a function is, for every p."""

import math

import pytest
from flint import arb, arb_series, ctx

from cointoss_reproduction.precision.taylor_models import (
    ORDER,
    TaylorModel,
    UndecidedError,
    constant,
    varying,
    zero,
)


@pytest.fixture(autouse=True)
def precision():
    before = ctx.prec, ctx.cap
    ctx.prec, ctx.cap = 100, ORDER + 1
    yield
    ctx.prec, ctx.cap = before


def x():
    return varying(arb(0.4), arb(0.1))


FUNCTIONS = {
    "sums and products": (lambda x: 2 - x * x + x * 3 - (x - 1) + (-x), lambda x: 3 - x * x + x),
    "quotients": (lambda x: (x + 1) / (2 - x) + 1 / x, lambda x: (x + 1) / (2 - x) + 1 / x),
    "powers and roots": (lambda x: (x**3 + 1).sqrt(), lambda x: math.sqrt(x**3 + 1)),
    "sines": (
        lambda x: (3 * x).sin() + x.sin_cos()[0] * x.cos(),
        lambda x: math.sin(3 * x) + math.sin(2 * x) / 2,
    ),
    "inverse sines": (lambda x: x.asin(), math.asin),
    "absolute values": (lambda x: abs(x - 1) + abs(x), lambda x: abs(x - 1) + x),
}


def value_at(number: TaylorModel, p: float) -> arb:
    """Return the enclosure at one p: the series, with the remainder of the last order."""
    total = number.whole[ORDER]
    for k in reversed(range(ORDER)):
        total = total * p + number.middle[k]
    return total


@pytest.mark.parametrize("name", list(FUNCTIONS))
def test_a_function_lies_within_its_enclosures(name):
    model, exact = FUNCTIONS[name]
    found = model(x()).tightened()
    for p in (-1.0, -0.3, 0.0, 0.7, 1.0):
        true = exact(0.4 + 0.1 * p)
        assert abs(float(value_at(found, p).mid()) - true) <= float(value_at(found, p).rad()) + 1e-14
        assert found.whole[0].overlaps(arb(true, 1e-14))
        slope = (exact(0.4 + 0.1 * p + 1e-6) - exact(0.4 + 0.1 * p - 1e-6)) / 2e-6 * 0.1
        assert found.whole[1].overlaps(arb(slope, 1e-8))


def test_what_a_plain_enclosure_forgets_is_kept():
    """x - x² + (x² - x) is 0 for every p."""
    found = (x() - x() ** 2 + (x() ** 2 - x())).tightened()
    assert float(found.whole[0].rad()) < 1e-3


def test_a_zero_is_a_function_of_p():
    """s² = x has the root sqrt(x)."""
    found = zero(lambda s: (s**2 - x(), 2 * s), arb(0.4).sqrt(), arb(0.63, 0.09))
    for p in (-1.0, 0.2, 1.0):
        true = math.sqrt(0.4 + 0.1 * p)
        assert abs(float(value_at(found, p).mid()) - true) <= float(value_at(found, p).rad()) + 1e-14
    assert float(found.whole[0].rad()) < 0.1
    assert found.middle[1].overlaps(0.1 / (2 * arb(0.4).sqrt()))


def test_numbers_are_compared_for_all_p():
    assert x() > 0.29
    assert x() < 0.51
    assert not x() > 0.31
    assert not x() < 0.49
    assert x() + 1e-9 > x()


def test_a_sign_that_changes_leaves_an_absolute_value_its_enclosure():
    found = abs(x() - 0.4)
    assert float(found.upper()) == pytest.approx(0.1)
    assert found.middle[1] == 0


def test_a_number_that_may_be_zero_divides_nothing():
    for divide in (lambda: 1 / (x() - 0.4), lambda: x() / (x() - 0.35), lambda: x() / constant(arb(0, 1))):
        with pytest.raises(UndecidedError):
            divide()


def test_a_model_is_series_about_its_middle_and_about_every_point():
    found = TaylorModel(arb_series([1, 1]), arb_series([arb(1, 3), 1])).tightened()
    assert float(found.whole[0].rad()) == pytest.approx(1, rel=1e-6)
