"""Options made of a record: their kinds, their help, the rules between them, and back to words."""

from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any, Literal
from unittest.mock import patch

import click
import pytest
from click.testing import CliRunner

from cointoss import analytic
from cointoss.compare.commands.common import Given, quantity
from cointoss.compare.commands.options import one_of, only_with, options_of, without, words_of
from cointoss.compare.output.accepted import Form, Within, Written
from cointoss.compare.output.language import in_options
from cointoss.models.errors import ScenarioError
from tests.helpers.command_line import refused


class Pair(tuple[str, str]):
    """Two words."""

    def __str__(self) -> str:
        """Return the text that it was."""
        return ":".join(self)


class Colour(StrEnum):
    """Of the two."""

    RED = "red"
    DARK_BLUE = "dark-blue"


@dataclass(frozen=True, kw_only=True)
class Look:
    """How it is drawn."""

    colour: Colour = Colour.RED
    """The colour."""
    pair: Annotated[tuple[str, str] | None, Form("A:B", lambda text: Pair(text.split(":")))] = None
    """Two words."""


@dataclass(frozen=True, kw_only=True)
class Wish(Look):
    """What is asked for."""

    to_do: str
    """What to do, told
    in two lines."""
    engine: Literal["analytic", "mujoco"] = "analytic"
    """The engine."""
    count: Annotated[int | None, Within(1, 9)] = None
    """How many."""
    out: Annotated[tuple[Path, ...], Written(("",)), Form("FILE")] = ()
    """Files."""
    with_: Annotated[Given | None, quantity("m")] = None
    """A length."""
    no_video: bool = False
    """No video."""


taken: list[Wish] = []


@click.command()
@options_of(
    Wish,
    one_of("count", "no_video"),
    only_with("pair", "engine=mujoco", "no_video"),
    without("with_", "engine=mujoco", "out"),
    completed={"to_do": lambda: ["walk", "work"]},
)
def wish(asked: Wish) -> None:
    """Take it."""
    taken.append(asked)


def given(*words: str) -> Wish:
    """Return the record that words fill."""
    answered = CliRunner().invoke(wish, words, catch_exceptions=False)
    assert answered.exit_code == 0, answered.output
    return taken.pop()


def test_each_kind_of_field_is_read():
    assert given("--to-do", "walk") == Wish(to_do="walk")
    found = given(
        *("--to-do", "work", "--engine", "mujoco", "--count", "3", "--out", "a", "--out", "b"),
        *("--colour", "dark-blue", "--pair", "1:2"),
    )
    assert (found.engine, found.count, found.out) == ("mujoco", 3, (Path("a"), Path("b")))
    assert (found.colour, found.pair) == (Colour.DARK_BLUE, ("1", "2"))
    assert given("--to-do", "walk", "--with", "2 cm").with_ == Given("2 cm", 0.02)


@pytest.mark.parametrize(
    ("typed", "said"),
    [
        ("--count 2 --no-video", "--count and --no-video: accepted: one of them"),
        ("--pair 1:2", "--pair 1:2: accepted: only beside --engine mujoco or --no-video"),
        ("--pair 1:2 --engine analytic", "only beside --engine mujoco or --no-video"),
        ("--with 2m --out a", "--with 2m: accepted: only without --out"),
        ("--with 2m --engine mujoco", "--with 2m: accepted: only without --engine mujoco"),
        ("--count 12", "'--count': 12; accepted: an integer >= 1 and <= 9"),
        ("--colour green", "'--colour': green; accepted: red, dark-blue"),
    ],
)
def test_what_excludes_or_lacks_another_is_refused(typed, said):
    answered = CliRunner().invoke(wish, ["--to-do", "walk", *typed.split()])
    assert answered.exit_code == 2
    assert said in answered.output


CONTACT_STEPS = replace(analytic.FINE, contact_steps=5)
VARY = "--vary height=0.2:0.6"


@pytest.mark.parametrize(
    ("line", "function", "arguments"),
    [
        (
            "fit a.csv table --vary restitution=0.1:0.9 --sd-time 1ms --starts 7 --seed 3",
            "fitting.fit.fit",
            {"starts": 7, "seed": 3, "device": "cpu"},
        ),
        (
            "fit a.csv table --sd-time 1ms --sd-height 2mm --sd-attitude 3deg",
            "fitting.table.read_seen",
            {1: {"time": "1ms", "height": "2mm", "attitude": "3deg"}},
        ),
        (
            f"find table {VARY} --sequence HT --outcome tails --tosses 9 --seed 4",
            "find.find.find_telling",
            {"sequence": "HT", "outcome": "tails", "tosses": 9, "seed": 4},
        ),
        ("flips b.csv table --tosses 5 --seed 6", "flips.hand_fit.flips", {"tosses": 5, "seed": 6}),
        (
            f"shares table {VARY}:2 --tosses 8 --seed 2 --engine mujoco",
            "shares.plan.plan_of",
            {"tosses": 8, "seed": 2, "engines": ("mujoco",)},
        ),
        ("toss table --margin --contact-steps 5", "metrics.margin.margins", {"settings": CONTACT_STEPS}),
    ],
)
@pytest.mark.usefixtures("here")
def test_an_option_is_handed_to_its_argument(line, function, arguments):
    Path("a.csv").write_text("t (s)\n1.2\n1.5\n")
    Path("b.csv").write_text("same,flips\n1,2\n")
    with patch(f"cointoss.compare.{function}", side_effect=ScenarioError("enough")) as called:
        assert refused(*line.split()) == "cointoss: enough\n"
    given = dict[Any, Any](enumerate(called.call_args.args), **called.call_args.kwargs)
    assert {name: given[name] for name in arguments} == arguments


def test_a_record_goes_back_to_the_words_that_fill_it():
    words = ["--to-do", "a b", "--out", "a", "--out", "b", "--no-video", "--colour", "dark-blue"]
    assert words_of(given(*words)) == words


def test_keywords_in_a_message_are_options_on_the_command_line():
    assert (
        in_options("`resume` goes on, `contact_steps`: see x`y")
        == "--resume goes on, --contact-steps: see x`y"
    )
