"""350,757 flips by 48 people, and distributions over people of p, the probability of the same side."""

from importlib import resources

import numpy as np
import pandas as pd
from scipy.stats import expon, norm

from cointoss import Flips
from cointoss.study import CAUGHT, Array, People, PeopleFit, quadrature, wobbling

WOBBLING = wobbling(CAUGHT)
"""People who wobble, and catch the coin."""
NORMAL = People(norm(), (-11.0, 11.0), lambda x, latent: x[1] + x[0] * latent, start=(0.01, 0.5))
"""p is normal, whatever made it; its parameters are its standard deviation and its mean."""
EXPONENTIAL = People(expon(), (0.0, 60.0), lambda x, latent: 0.5 + x[0] * latent, start=(0.01,))
"""p - 1/2 is exponential, whatever made it; its parameter is its mean."""


def read_started() -> tuple[Flips, Flips]:
    """Return the counts of Bartoš et al. (2025) of flips that started with heads up, and with tails up."""
    path = resources.files(__name__.rpartition(".")[0]) / "same_side_flips.csv"
    count = {name: column.to_numpy() for name, column in pd.read_csv(str(path)).items()}
    heads, tails = (
        Flips(same=count[f"{side}_to_{side}"], flips=count[f"{side}_to_{side}"] + count[f"{side}_to_{other}"])
        for side, other in (("heads", "tails"), ("tails", "heads"))
    )
    return heads, tails


def read_flips() -> Flips:
    """Return the counts of Bartoš et al. (2025), whichever side was up at first."""
    heads, tails = read_started()
    return Flips(same=heads.same + tails.same, flips=heads.flips + tails.flips)


def without(flips: Flips, person: int) -> Flips:
    """Return the counts of all but one person."""
    return Flips(same=np.delete(flips.same, person), flips=np.delete(flips.flips, person))


def quantiles(people: People, parameters: Array, parts: Array) -> Array:
    """Return the p below which parts of the people are, (n,) to (n,); p must grow with the latent number."""
    return people.probability(parameters, people.latent.ppf(parts))


def spread_of(found: PeopleFit) -> float:
    """Return the standard deviation of p over people."""
    latent, weights = quadrature(found.people, found.parameters, 1)
    of_latent = weights * found.people.latent.pdf(latent)
    p = found.people.probability(found.parameters, latent)
    return float(np.sqrt(of_latent @ (p - of_latent @ p) ** 2))
