"""Energy of a tumbling body: the order of each integrator."""

import pytest

from cointoss_bounce.flight import energy_change


@pytest.mark.parametrize(
    ("integrator", "order", "sign"),
    [("Euler", 1, 1), ("implicit", 1, -1), ("implicitfast", 1, -1), ("discrete", 1, -1), ("RK4", 4, 1)],
)
def test_the_change_of_energy_falls_as_the_integrators_order(integrator, order, sign):
    coarse, fine = (energy_change(integrator, dt) for dt in (1e-3, 5e-4))
    assert coarse * sign > 0
    assert coarse / fine == pytest.approx(2**order, rel=0.2)
    assert (abs(coarse) < 1e-7) == (integrator == "RK4")
