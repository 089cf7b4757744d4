"""Write the tables of docs/ENGINES.md, from what the studies of docs/reproduction/ have found."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from places import fill

from cointoss.compare.output.tables import table
from cointoss_reproduction.frame.claim import Claim, read_claims
from cointoss_reproduction.frame.result import folder_of
from cointoss_reproduction.studies.mujoco_laws.study import REALISED

PAGE = "ENGINES.md"
ANALYTIC = {
    "(a)": ("fig17", "(a) sharp edge:"),
    "(b)": ("fig17", "(b) knurled:"),
    "(c)": ("fig17", "(c) perfectly rough:"),
    "(d)": ("fig17", "(d) smooth (1):"),
    "(e)": ("fig17", "(e) smooth (2):"),
    "(f)": ("fig17", "(f) developed friction:"),
    "coulomb": ("contact-laws", "smooth and coulomb"),
}
"""The claim, by its study and how it begins, whose first number says how exactly a law is fulfilled."""
PORTED = {
    "a restitution by one step of fixed length": ("mujoco-situations", "a stiffness of"),
    "one setting for bodies of every mass": ("mujoco-bodies", "neither the restitution"),
    "a body that turns while it touches": ("mujoco-bodies", "a body that the impact turns"),
    "a box that lands flat": ("mujoco-bodies", "a box that lands flat"),
    "MuJoCo's default `solimp`": ("mujoco-bodies", "with MuJoCo's default solimp"),
    "speculative contacts": ("mujoco-bodies", "with speculative contacts"),
    "a body that comes to rest": ("mujoco-situations", "with the recommended settings"),
    "damping without a stiffness": ("mujoco-situations", "without the stiffness"),
    "a body that tumbles between its bounces": ("mujoco-situations", "in flight implicitfast"),
    "a ball that slides as it bounces": ("mujoco-situations", "a ball that slides"),
    "MuJoCo's native friction cone": ("mujoco-laws", "MuJoCo's native cone"),
    "laws that stop the slip along the edge, or across it": ("mujoco-laws", "MuJoCo realises neither"),
    "MuJoCo's rolling friction": ("mujoco-resistance", "by MuJoCo's default"),
    "rolling and torsional friction together": ("mujoco-resistance", "in its cone rolling"),
    "a law that must never add energy": ("contact-laws", "smooth and coulomb"),
    "(a), (b) or (c) on a coin": ("contact-laws", "sharp_edge, knurled and perfectly_rough pull"),
    "a toss in air up to its end": ("endings", "in air the engines' ends"),
}
"""What one may port, with the claim that says what to expect, by its study and how it begins."""


def blocks(out: Path) -> dict[str, str]:
    """Return the tables by the names of their places on the page.

    Args:
        out: of all that was reproduced.
    """
    return {"laws": laws(out), "ports": ports(out)}


def laws(out: Path) -> str:
    """Return which engine fulfils which contact law, and how exactly."""
    found = json.loads((folder_of("mujoco-laws", out) / "numbers.json").read_text(encoding="utf-8"))
    rows = []
    for law in found["fits"]:
        study, begins = ANALYTIC[law.split()[0]]
        exact = claim_of(out, study, begins).criteria[0]
        spring, one_step = found["fits"][law], found["one_step"][law]
        rows.append(
            [
                law,
                f"yes: {exact.measured:.0e}",
                _nearest(spring, native=False),
                _nearest(one_step, native=False),
                _nearest(spring, native=True),
                _nearest(one_step, native=True),
            ]
        )
    of_paper = "`reproduce fig17`; coulomb: `reproduce contact-laws`"
    rows.append(["printed by", of_paper, *["`reproduce mujoco-laws`"] * 4])
    head = [
        "law",
        "analytic",
        "MuJoCo, spring",
        "MuJoCo, one step",
        "native cone, spring",
        "native cone, one step",
    ]
    return table(head, rows, words=True)


def _nearest(fits: Mapping[str, Any], *, native: bool) -> str:
    """Return whether a kind of contacts makes a law, and the median and worst error of the nearest."""
    # Without friction there is no cone: the contact is the same.
    own = {name: fit for name, fit in fits.items() if ("native" in name) is native}
    kind = {"frictionless": fits["frictionless"], **own}
    name, (median, worst, _) = min(kind.items(), key=lambda fit: fit[1][0])
    verdict, contact = "yes" if median < REALISED else "no", name.removeprefix("native cone, ")
    return f"{verdict}: {median:.0e} ({worst:.0e}), {contact}"


def ports(out: Path) -> str:
    """Return what to expect of what one may port, with the numbers that say so."""
    rows = []
    for ported, (study, begins) in PORTED.items():
        claim = claim_of(out, study, begins)
        numbers = "; ".join(f"{each.quantity}: {each.value}" for each in claim.criteria)
        rows.append([ported, claim.claim, claim.verdict, numbers, f"`reproduce {study}`"])
    return table(["if you port", "expect that", "verdict", "measured", "printed by"], rows, words=True)


def claim_of(out: Path, study: str, begins: str) -> Claim:
    """Return the one claim of a study that begins so."""
    claims = read_claims(folder_of(study, out) / "claims.json")
    (claim,) = (claim for claim in claims if claim.claim.startswith(begins))
    return claim


def write(out: Path) -> None:
    """Write the tables into their places on the page in `out`."""
    fill(out / PAGE, blocks(out))
