"""Coefficients of Dormand and Prince's Runge-Kutta pair of order 8(5,3).

Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, section II.5, and the code DOP853 with it.
"""

from collections.abc import Iterable

import numpy as np

STAGES = 12

# Of the stages before: for each stage its slopes' numbers and their weights.
_STAGE_WEIGHTS = (
    {},
    {0: 0.05260015195876773},
    {0: 0.0197250569845379, 1: 0.0591751709536137},
    {0: 0.02958758547680685, 2: 0.08876275643042054},
    {0: 0.2413651341592667, 2: -0.8845494793282861, 3: 0.924834003261792},
    {0: 0.037037037037037035, 3: 0.17082860872947386, 4: 0.12546768756682242},
    {0: 0.037109375, 3: 0.17025221101954405, 4: 0.06021653898045596, 5: -0.017578125},
    {
        0: 0.03709200011850479,
        3: 0.17038392571223998,
        4: 0.10726203044637328,
        5: -0.015319437748624402,
        6: 0.008273789163814023,
    },
    {
        0: 0.6241109587160757,
        3: -3.3608926294469414,
        4: -0.868219346841726,
        5: 27.59209969944671,
        6: 20.154067550477894,
        7: -43.48988418106996,
    },
    {
        0: 0.47766253643826434,
        3: -2.4881146199716677,
        4: -0.590290826836843,
        5: 21.230051448181193,
        6: 15.279233632882423,
        7: -33.28821096898486,
        8: -0.020331201708508627,
    },
    {
        0: -0.9371424300859873,
        3: 5.186372428844064,
        4: 1.0914373489967295,
        5: -8.149787010746927,
        6: -18.52006565999696,
        7: 22.739487099350505,
        8: 2.4936055526796523,
        9: -3.0467644718982196,
    },
    {
        0: 2.273310147516538,
        3: -10.53449546673725,
        4: -2.0008720582248625,
        5: -17.9589318631188,
        6: 27.94888452941996,
        7: -2.8589982771350235,
        8: -8.87285693353063,
        9: 12.360567175794303,
        10: 0.6433927460157636,
    },
)
_END_WEIGHTS = {
    0: 0.054293734116568765,
    5: 4.450312892752409,
    6: 1.8915178993145003,
    7: -5.801203960010585,
    8: 0.3111643669578199,
    9: -0.1521609496625161,
    10: 0.20136540080403034,
    11: 0.04471061572777259,
}
_ERROR_3_WEIGHTS = {
    0: -0.18980075407240762,
    5: 4.450312892752409,
    6: 1.8915178993145003,
    7: -5.801203960010585,
    8: -0.4226823213237919,
    9: -0.1521609496625161,
    10: 0.20136540080403034,
    11: 0.02265179219836082,
}
_ERROR_5_WEIGHTS = {
    0: 0.01312004499419488,
    5: -1.2251564463762044,
    6: -0.4957589496572502,
    7: 1.6643771824549864,
    8: -0.35032884874997366,
    9: 0.3341791187130175,
    10: 0.08192320648511571,
    11: -0.022355307863886294,
}


def _row(weights: dict[int, float]) -> list[float]:
    return [weights.get(stage, 0.0) for stage in range(STAGES)]


def _packed(numbers: Iterable[float]) -> list[float]:
    return [*numbers, *[0.0] * STAGES][:STAGES]


A = np.array([_row(weights) for weights in _STAGE_WEIGHTS])
"""Weights of the slopes in the point of each stage, (STAGES, STAGES)."""
B = np.array(_row(_END_WEIGHTS))
"""Weights of the slopes in the end of the step, (STAGES,)."""

_ROWS = (*_STAGE_WEIGHTS, _END_WEIGHTS, _ERROR_5_WEIGHTS, _ERROR_3_WEIGHTS)
END, ERROR_5, ERROR_3 = range(STAGES, len(_ROWS))
"""Numbers of the rows after those of the stages: the end of the step, and its error estimates."""
TERMS = np.array([len(weights) for weights in _ROWS])
"""How many slopes have a weight in each row, (STAGES + 3,)."""
WEIGHTED = np.array([_packed(weights) for weights in _ROWS], dtype=np.int64)
"""The numbers of the slopes that have a weight, row by row, `TERMS` of them in each, (STAGES + 3, STAGES)."""
WEIGHTS = np.array([_packed(weights.values()) for weights in _ROWS])
"""The weights of the slopes in `WEIGHTED`, in the same places."""
