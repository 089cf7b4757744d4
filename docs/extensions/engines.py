"""What docs/ENGINES.md and docs/MUJOCO.md include of what the studies of docs/reproduction/ have found."""

import tomllib
from pathlib import Path

import pandas as pd
from papers import the_one

from cointoss.study import table
from cointoss_reproduction.frame.cells import read_table
from cointoss_reproduction.frame.claim import Claim, read_claims
from cointoss_reproduction.frame.files import TABLE, folder_of

PAGES = {"laws": "ENGINES.md", "ports": "ENGINES.md", "ends": "MUJOCO.md"}
"""The page that includes each block."""
SHOWN = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
"""The claims of each table, each by its study and words of it."""
BY = "law | analytic | MuJoCo, spring | MuJoCo, one step | native cone, spring | native cone, one step"


def blocks(out: Path) -> dict[str, str]:
    """Return the blocks by the names of their files; `out` has all that was reproduced."""
    return {"laws": laws(out), "ports": ports(out), "ends": ends(out)}


def claim_of(out: Path, study: str, words: str) -> Claim:
    """Return the one claim of a study that has these words."""
    return the_one(read_claims(folder_of(study, out) / "claims.json"), "claim", words)


def laws(out: Path) -> str:
    """Return which engine fulfils which contact law, and how exactly."""
    fits = read_table(folder_of("mujoco-laws", out) / TABLE).dropna(subset="realisation")
    most = claim_of(out, "mujoco-laws", "MuJoCo realises neither").criteria[0].threshold
    # Without friction there is no cone: the contact is the same.
    cones = {native: fits[_is_native(fits, native)] for native in (False, True)}
    rows = [
        [law, f"yes: {claim_of(out, *SHOWN['laws'][law.split()[0]]).criteria[0].measured:.0e}"]
        + [
            _nearest(own[(own.law == law) & (own.realisation == by)], most)
            for own in cones.values()
            for by in ("spring", "one_step")
        ]
        for law in fits.law.unique()
    ]
    return table(BY, rows, words=True)


def _is_native(fits: pd.DataFrame, native: bool) -> pd.Series:
    return (fits.contact.str.contains("native") == native) | (fits.contact == "frictionless")


def _nearest(fits: pd.DataFrame, most: float) -> str:
    """Return whether a kind of contacts makes a law, and the median and worst error of the nearest."""
    nearest = fits.loc[fits["median"].idxmin()]
    verdict = "yes" if nearest["median"] < most else "no"
    errors = f"{nearest['median']:.0e} ({nearest['worst']:.0e})"
    return f"{verdict}: {errors}, {nearest['contact'].removeprefix('native cone, ')}"


def ports(out: Path) -> str:
    """Return what to expect of what one may port, with the numbers that say so."""
    rows = []
    for ported, (study, words) in SHOWN["ports"].items():
        claim = claim_of(out, study, words)
        numbers = "; ".join(each.found for each in claim.criteria)
        rows.append([ported, claim.claim, claim.verdict, numbers, f"`reproduce {study}`"])
    return table("if you port | expect that | verdict | measured | printed by", rows, words=True)


def ends(out: Path) -> str:
    """Return how many tosses MuJoCo ends as the analytic engine does, with each of its settings."""
    return f"Both engines trust all impacts of some tosses; {claim_of(out, *SHOWN['ends']).mujoco}."
