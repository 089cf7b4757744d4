"""The options of a hand, which the commands that toss by hand share."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import click

from cointoss.compare.commands.common import Given, ReadPlace, naming_options, quantity, refuse
from cointoss.compare.output.accepted import Form, Within
from cointoss.compare.output.language import option_of

if TYPE_CHECKING:
    from cointoss.models.hand import Hand
    from cointoss.models.scenario import Scenario


@dataclass(frozen=True, kw_only=True)
class ByHand:
    """A hand, and the seed of its releases."""

    hand: Annotated[Path | None, ReadPlace("a hand's file in TOML"), Form("FILE.toml")] = None
    """A hand's file, with the names of these options: height, speed, spin, psi, psi_scatter, tilt, scatter,
    up, spun, caught. An option overrides the value in the file."""
    height: Annotated[Given | None, quantity("m")] = None
    """Height of the mass centre at the release; by default 1 m."""
    speed: Annotated[Given | None, quantity("m/s")] = None
    """Speed upwards; by default 2 m/s."""
    spin: Annotated[Given | None, quantity("rad/s")] = None
    """Rate at which the coin's normal goes round the angular momentum; by default 120 rad/s."""
    psi: Annotated[Given | None, quantity("rad")] = None
    """Angle between normal and angular momentum, by default 90 deg; less than 90 deg: the coin wobbles."""
    psi_scatter: Annotated[Given | None, quantity("rad")] = None
    """Standard deviation of psi; by default 10 deg, as of people, but 0 deg with --hand, --psi or --spun."""
    tilt: Annotated[Given | None, quantity("rad")] = None
    """Standard deviation of the coin's tilt at the release, about each of two horizontal axes; by default
    0 deg."""
    scatter: Annotated[Given | None, quantity("")] = None
    """Standard deviation of height, speed and spin; by default 10 %."""
    up: Literal["heads", "either"] | None = None
    """The side that is up at the release, by default heads; either: both are as likely."""
    spun: bool = False
    """The coin is spun on its edge: it turns about the vertical at --spin, and --psi is the angle of its
    normal to the vertical."""
    caught: Annotated[Given | None, quantity("m")] = None
    """Height at which a hand catches the coin; by default the scenario's [ending] caught, if it has one."""
    seed: Annotated[int, Within(0, 2**32)] = 0
    """Seed of the releases."""


def chosen_hand(asked: ByHand, described: "Scenario") -> "tuple[Hand, Scenario]":
    """Return the hand of a command's options, and the scenario whose coin it catches where it does.

    Args:
        asked: the options.
        described: the scenario.

    Raises:
        ScenarioError: for what is wrong with the hand's file, or a scenario in which it spins no coin.
    """
    from dataclasses import fields, replace

    from cointoss.models.errors import ScenarioError
    from cointoss.models.hand import OF_A_TOSS, Hand, load_hand

    options = {item.name: getattr(asked, item.name) for item in fields(Hand)}
    typed = {name: value for name, value in options.items() if value not in (None, False)}
    for name in OF_A_TOSS:
        if asked.spun and name in typed:
            raise click.UsageError(f"--{name} {typed[name]}: accepted: only without --spun")
    says_psi = "psi" in typed or asked.spun
    usual = load_hand(asked.hand) if asked.hand else Hand() if says_psi else Hand.people()
    values = {name: one.value if isinstance(one, Given) else one for name, one in typed.items()}
    with naming_options({name: (option_of(name), one) for name, one in typed.items()}):
        hand = replace(usual, **values)
    try:
        return hand, hand.scenario(described)
    except ScenarioError as error:
        if hand.spun:
            raise
        where = f"--caught {asked.caught}" if asked.caught else f"{asked.hand}: caught = {hand.caught:g}"
        refuse(f"{where}: accepted: {str(error).partition('accepted: ')[2]}")
