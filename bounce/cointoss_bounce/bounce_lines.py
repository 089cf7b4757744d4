"""What is printed of the bounce of two geoms."""

import numpy as np

from cointoss_bounce.arrays import Array
from cointoss_bounce.pair import LONGEST, PairBounce, PairOutcome
from cointoss_bounce.points import SHARE
from cointoss_bounce.rest_lines import rest_lines

DEEP = "*"
"""Marks a depth that may let a body through."""
GAINS = "+"
"""Marks an energy that is more after the contact than before."""
COARSE = "~"
"""Marks a restitution that is likely to be another with a shorter step."""
MEANINGS = {
    PairOutcome.STAYS: "the geoms do not part; they lie on or stick in each other, as deep as shown",
    PairOutcome.LASTS: f"the contact goes on for more than {LONGEST} steps, and the geoms still move",
    PairOutcome.PASSES: "the geoms part on the wrong sides, or pass each other's middle within a step",
    PairOutcome.MISSES: "the approach starts against a force of the model, such as a spring, that ends it",
    PairOutcome.TURNED: "after a step they are so deep in each other that the contact pushes aside",
    PairOutcome.ASIDE: "MuJoCo's normal is not that of the approach, or turns from it, as at an edge",
    PairOutcome.OTHER_SPEED: f"something else changes the speed by more than {100 * SHARE:g} % on the way",
    PairOutcome.CHANGES: f"{COARSE} the points' speed changes by more than {100 * SHARE:g} % in the step in "
    "which they meet or part; take a shorter step",
}
"""What outcomes mean, where a line needs it."""


def bounce_lines(found: PairBounce) -> str:
    """Return how two geoms bounce off each other, line by line."""
    solref = " ".join(f"{number:g}" for number in found.solref)
    friction = f' friction="{found.friction:g}"' if found.condim > 1 else ""
    approach = (
        "as an impulse between the geoms moves the joints: "
        f"a body turns by {found.turning:.3g} rad on each metre of the way"
        if found.turning
        else "straight: no body turns"
    )
    return (
        f'mixed       solref="{solref}" solimp="{found.solimp}" condim="{found.condim}"{friction}\n'
        f"integrator  {found.integrator}, {1e3 * found.timestep:g} ms\n{_margin(found)}"
        f"approach    {approach}\n\n{bounce_table(found)}\n\n{rest_lines(found)}"
    )


def _margin(found: PairBounce) -> str:
    """Return the line of the distance from which the contact pushes, as MuJoCo reads it; none for 0."""
    return (
        f"margin      the contact pushes from {1e3 * found.margin:g} mm on: margin, since MuJoCo 3.9, "
        f"not margin - gap; gap, {1e3 * found.gap:g} mm more, only lists it\n"
        if found.margin or found.gap
        else ""
    )


def bounce_table(found: PairBounce) -> str:
    """Return the bounce at each speed, line by line, and what its marks mean."""
    columns = [
        ["speed [m/s]", *(f"{speed:g}" for speed in found.speeds)],
        ["restitution", *map(_range, found.restitutions, found.outcomes)],
        ["with gravity", *map(_range, found.with_gravity, found.outcomes_with_gravity)],
        ["energy kept", *map(_energy, found.energy_kept)],
        ["lasts [ms]", *(_mean(1e3 * lasts, ".3g") for lasts in found.durations)],
        ["depth [mm]", *(_depth(depth, found.thinnest) for depth in found.depths)],
    ]
    aligned = [
        [f"{cell:{side}{max(map(len, cells))}}" for cell in cells]
        for side, cells in zip("><<>>>", columns, strict=True)
    ]
    lines = ["  ".join(cells) for cells in zip(*aligned, strict=True)]
    seen = {end for row in (*found.outcomes, *found.outcomes_with_gravity) for end in row}
    notes = [f"{end}: {meaning}" for end, meaning in MEANINGS.items() if end in seen]
    if (found.depths > found.thinnest).any():
        notes.append(
            f"{DEEP} deeper than half of the thinner geom, {2e3 * found.thinnest:.3g} mm thick: what is no "
            "plane may let it through"
        )
    if _gains(found.energy_kept):
        notes.append(
            f"{GAINS} gains energy: at one phase or more, the geoms part with more energy than they came with"
        )
    phases = f"the mean over {len(found.outcomes[0])} phases of a step, in brackets the least and the largest"
    return "\n".join([f"Restitution: {phases}.", *lines, *notes, *found.notes])


def _range(values: Array, outcomes: tuple[PairOutcome, ...]) -> str:
    """Return the mean and the range over the phases of a step, or how many do not part."""
    others = [
        end
        for end in PairOutcome
        if end not in {PairOutcome.REBOUNDS, PairOutcome.CHANGES} and end in outcomes
    ]
    if others:
        return ", ".join(f"{outcomes.count(outcome)} of {len(outcomes)} {outcome}" for outcome in others)
    return f"{values.mean():.4f} [{values.min():.4f}, {values.max():.4f}]" + (
        COARSE if PairOutcome.CHANGES in outcomes else ""
    )


def _mean(values: Array, how: str) -> str:
    return "-" if np.isnan(values).any() else f"{values.mean():{how}}"


def _energy(kept: Array) -> str:
    return _mean(kept, ".4f") + (GAINS if _gains(kept) else "")


def _gains(kept: Array) -> bool:
    """Return whether an energy grows, as it is printed."""
    return bool((kept.round(4) > 1).any())


def _depth(depth: float, thinnest: float) -> str:
    if np.isnan(depth):
        return "-"
    return f"{1e3 * depth:.3g}" + (DEEP if depth > thinnest else "")
