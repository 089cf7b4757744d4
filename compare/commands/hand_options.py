"""The options of a hand, which the commands that toss by hand share."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import click

from cointoss.compare.commands.common import (
    ChoiceType,
    CountType,
    Given,
    ReadPlace,
    naming_options,
    quantity,
    refuse,
)

if TYPE_CHECKING:
    from cointoss.models.hand import Hand
    from cointoss.models.scenario import Scenario

_OPTIONS = (
    click.option(
        "--hand",
        "hand_file",
        type=ReadPlace("a hand's file in TOML"),
        is_eager=True,
        metavar="FILE.toml",
        help="A hand's file, with the names of these options: height, speed, spin, psi, psi_scatter, "
        "tilt, scatter, up, spun, caught. An option overrides the value in the file.",
    ),
    click.option(
        "--height",
        type=quantity("m"),
        show_default="1 m",
        help="Height of the mass centre at the release.",
    ),
    click.option("--speed", type=quantity("m/s"), show_default="2 m/s", help="Speed upwards."),
    click.option(
        "--spin",
        type=quantity("rad/s"),
        show_default="120 rad/s",
        help="Rate at which the coin's normal goes round the angular momentum.",
    ),
    click.option(
        "--psi",
        type=quantity("rad"),
        show_default="90 deg",
        help="Angle between normal and angular momentum; less than 90 deg: the coin wobbles.",
    ),
    click.option(
        "--psi-scatter",
        type=quantity("rad"),
        show_default="10 deg, as of people; 0 deg with --hand, --psi or --spun",
        help="Standard deviation of psi.",
    ),
    click.option(
        "--tilt",
        type=quantity("rad"),
        show_default="0 deg",
        help="Standard deviation of the coin's tilt at the release, about each of two horizontal axes.",
    ),
    click.option(
        "--scatter",
        type=quantity(""),
        show_default="10 %",
        help="Standard deviation of height, speed and spin.",
    ),
    click.option(
        "--up",
        type=ChoiceType(["heads", "either"]),
        show_default="heads",
        help="The side that is up at the release; either: both are as likely.",
    ),
    click.option(
        "--spun",
        is_flag=True,
        default=None,
        help="The coin is spun on its edge: it turns about the vertical at --spin, and --psi is the angle of "
        "its normal to the vertical.",
    ),
    click.option(
        "--caught",
        type=quantity("m"),
        help="Height at which a hand catches the coin; by default the scenario's [ending] caught, if it has "
        "one.",
    ),
    click.option(
        "--seed", type=CountType(0, 2**32), default=0, show_default=True, help="Seed of the releases."
    ),
)


def hand_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options of a hand, and its seed, to a command."""
    for option in reversed(_OPTIONS):
        command = option(command)
    return command


def chosen_hand(given: dict[str, Any], described: "Scenario") -> "tuple[Hand, Scenario]":
    """Return the hand of a command's options, and the scenario whose coin it catches where it does.

    Args:
        given: the options, of which those of the hand are taken out.
        described: the scenario.

    Raises:
        ScenarioError: for what is wrong with the hand's file, or a scenario in which it spins no coin.
    """
    from dataclasses import fields, replace

    from cointoss.models.errors import ScenarioError
    from cointoss.models.hand import OF_A_TOSS, Hand, load_hand

    file = given.pop("hand_file")
    options = {item.name: given.pop(item.name, None) for item in fields(Hand)}
    typed = {name: value for name, value in options.items() if value is not None}
    for name in OF_A_TOSS:
        if typed.get("spun") and name in typed:
            raise click.UsageError(f"--{name} {typed[name]}: accepted: only without --spun")
    says_psi = "psi" in typed or "spun" in typed
    usual = load_hand(file) if file is not None else Hand() if says_psi else Hand.people()
    values = {name: one.value if isinstance(one, Given) else one for name, one in typed.items()}
    with naming_options({name: (f"--{name.replace('_', '-')}", one) for name, one in typed.items()}):
        hand = replace(usual, **values)
    try:
        return hand, hand.scenario(described)
    except ScenarioError as error:
        if hand.spun:
            raise
        where = f"--caught {typed['caught']}" if "caught" in typed else f"{file}: caught = {hand.caught:g}"
        refuse(f"{where}: accepted: {str(error).partition('accepted: ')[2]}")
