"""The law of the limit: how the exponent grows where a bouncing rotor hops slowly.

A rotor has nearly all its energy e in its spin W, W² = 8 (e - 1), and its centre falls to the height 1 at
the speed ν W. At the first passage at which an end would dip below the floor it would dip by D, uniform in
(0, π ν), for the phase is as good as random. It touches a little earlier, at the angle ν - sqrt(2 D) from
upright, where the end falls at W sqrt(2 D). Newton's impact leaves

    ν' = (1 + χ) sqrt(2 D) - ν,   and takes   (1 - χ)/(1 + χ) (W²/2) (ν + ν')²,

and the phase of the next passage turns by 8 (1 + χ)² e 2ν/(ν + ν') for each unit of this one's. With y = ν a,
a² = 4 e κ (1 - χ)/(1 + χ), E[stretch^β] = exp(∫ κ de) asks of each touch that

    2 (8 (1 + χ)² e)^β λ(β) = π a (1 + χ)²,

λ(β) the leading eigenvalue of ((y + y')/2y)^(1 - β) exp(-(y + y')²).
The integral over e up to χ e_0, about what the best first touch leaves of a fall, is B exp(2 β Λ). The kernel
does not depend on χ. All this asks for ν << 1 and ν W² >> 1.
"""

from functools import cache
from math import exp, log, pi

import numpy as np
from scipy.optimize import root_scalar

NODES, FARTHEST = 200, 6.0
"""The nodes of the quadrature in y, and its farthest point."""
LEAST, MOST = 0.05, 8.0
"""The bounds of β between which the exponent is sought."""
STEP = 1e-4
"""The step of β in the derivative."""


@cache
def eigenvalue(beta: float) -> float:
    """Return λ(β); the kernel is made symmetric by y^((1 - β)/2)."""
    x, weights = np.polynomial.legendre.leggauss(NODES)
    root = (x + 1) / 2 * FARTHEST**0.5
    y, weight = root**2, root * weights * FARTHEST**0.5
    both = y[:, None] + y
    kernel = (both / (2 * np.sqrt(np.outer(y, y)))) ** (1 - beta) * np.exp(-(both**2))
    return float(np.linalg.eigvalsh(kernel * np.sqrt(np.outer(weight, weight)))[-1])


def logarithm(chi: float, energy: float) -> float:
    """Return Λ, of the stretch of a touch that keeps ν, with the energy that a good first touch leaves.

    Args:
        chi: restitution.
        energy: of the release [m g r].
    """
    return log(8 * chi * energy * (1 + chi) ** 2)


def moment(beta: float, chi: float, energy: float) -> float:
    """Return ln E[stretch^β] in the limit.

    Args:
        beta: the power.
        chi: restitution.
        energy: of the release [m g r].
    """
    share = eigenvalue(beta) ** 2 / (2 * beta * pi**2 * (1 - chi) * (1 + chi) ** 3)
    return share * exp(2 * beta * logarithm(chi, energy))


def asked(beta: float, chi: float, energy: float) -> float:
    """Return the ln(r/ε) at which α has this value: the moment's slope.

    Args:
        beta: α.
        chi: restitution.
        energy: of the release [m g r].
    """
    below, above = (moment(beta + side, chi, energy) for side in (-STEP, STEP))
    return (above - below) / (2 * STEP)


def exponent(chi: float, energy: float, stretch: float) -> float:
    """Return α at an accuracy, where `asked` gives its `stretch`.

    It grows as ln(`stretch`)/(2 Λ) in the end, for λ falls ever more slowly.

    Args:
        chi: restitution.
        energy: of the release [m g r].
        stretch: ln(r/ε).
    """
    # At small β the eigenvalue diverges; the slope has its least value where the exponent may begin.
    betas = np.linspace(LEAST, 1.0, 60)
    start = betas[int(np.argmin([asked(beta, chi, energy) for beta in betas]))]
    return float(root_scalar(lambda beta: asked(beta, chi, energy) - stretch, bracket=(start, MOST)).root)
