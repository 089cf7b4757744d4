"""Cosines and sines on every machine the nearest floats."""

import numpy as np
from flint import arb, ctx, fmpq

from cointoss.models.kernel.circle import on_circle


def test_cosines_and_sines_are_rounded_correctly(monkeypatch):
    monkeypatch.setattr(ctx, "prec", 200)
    for n, count in ((512, 129), (96, 96), (24, 24), (7, 7)):
        turns = [fmpq(2 * i, n) for i in range(count)]
        cosines, sines = on_circle(n, count)
        assert cosines.tolist() == [float(arb.cos_pi_fmpq(turn).mid()) for turn in turns]
        assert sines.tolist() == [float(arb.sin_pi_fmpq(turn).mid()) for turn in turns]
        assert not np.signbit(np.concatenate([cosines, sines])[np.concatenate([cosines, sines]) == 0]).any()
