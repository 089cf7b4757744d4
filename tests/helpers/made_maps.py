"""Outcome maps made by formulas, with known answers."""

import numpy as np

from cointoss.models.records import Outcome

HEADS, TAILS, EDGE, UNDECIDED = Outcome.HEADS, Outcome.TAILS, Outcome.EDGE, Outcome.UNDECIDED


def faces(heads):
    """Heads where true, else tails."""
    return np.where(heads, HEADS, TAILS).astype(np.int8)


def halves(ny, nx):
    """Heads on the left half, tails on the right."""
    return np.tile(faces(np.arange(nx) < nx // 2), (ny, 1))


def stripes(ny, nx, width):
    """Upright stripes of one width, heads first."""
    return np.tile(faces(np.arange(nx) // width % 2 == 0), (ny, 1))


def hyperbolas(x, y):
    """The faces change where x y is a whole number."""
    return faces(np.floor(np.outer(y, x)) % 2 == 0)


def cantor(levels):
    """Colour the gaps of the middle-third Cantor set by turns of level, on 3^levels points of a line."""
    line = np.array([TAILS], dtype=np.int8)
    for level in range(levels):
        line = np.concatenate([line, np.full(len(line), HEADS if level % 2 else TAILS), line])
    return line.astype(np.int8)


def correlation(distance, scale, hurst):
    """Give the Gaussian fields' correlation at a distance."""
    return np.exp(-((distance / scale) ** (2 * hurst)))


def gaussian_faces(shape, *, scale, hurst, random):
    """Draw the sign of a Gaussian field (y, x), or line (x,), with that correlation.

    Its boundary has the codimension `hurst`: α = hurst at small distances.
    """
    sides = [2 * n for n in shape]  # twice: made on a torus, whose far half is cut off
    around = [np.minimum(np.arange(n), n - np.arange(n)) for n in sides]
    distance = np.sqrt(sum(np.square(part) for part in np.meshgrid(*around, indexing="ij")))
    power = np.fft.fftn(correlation(distance, scale, hurst)).real.clip(0) / distance.size
    noise = random.normal(size=sides) + 1j * random.normal(size=sides)
    field = np.fft.fftn(np.sqrt(power) * noise).real
    return faces(field[tuple(slice(n) for n in shape)] > 0)


def uncertain_fraction(distance, scale, hurst):
    """Give the chance that, of three points in line so far apart, an outer one lacks the middle's sign.

    Three Gaussians share their sign with the chance 1/4 + (sum of the arcsines of their correlations)/(2π).
    """
    once, twice = (np.arcsin(correlation(part * distance, scale, hurst)) for part in (1, 2))
    return 0.75 - (2 * once + twice) / (2 * np.pi)


def line(text):
    """Outcomes by their letters; ? is undecided."""
    return np.array([{"H": HEADS, "T": TAILS, "E": EDGE, "?": UNDECIDED}[letter] for letter in text], np.int8)
