"""What is printed of settings for a bounce, and of the bounce of given settings."""

from math import floor, inf, isfinite, log10

from cointoss_bounce.backends import Backend
from cointoss_bounce.bodies import BALL, body_of
from cointoss_bounce.contact import GRAVITY, text_of
from cointoss_bounce.drops import SPEED
from cointoss_bounce.flight import energy_change
from cointoss_bounce.inverse import Rebounds
from cointoss_bounce.own_law import EngineBounce
from cointoss_bounce.recipe import Bounce, exact_of
from cointoss_bounce.rest import Rest, depth_at_rest, rest_of

FAILS = 0.2
"""A formula that is further off than this part of itself fails."""


def solref_lines(found: Bounce | EngineBounce | Rebounds) -> str:
    """Return settings and what they do, line by line."""
    match found:
        case Rebounds():
            return _rebounds(found)
        case EngineBounce():
            return "\n".join(
                [found.settings, "", *(f"{name:11} {text}" for name, text in found.notes.items())]
            )
        case Bounce():
            return _settings(found)


def _settings(found: Bounce) -> str:
    """Return the settings for a bounce, and what they do, line by line."""
    spring, own = found.spring, found.backend.takes_xml
    alone = 1e6 * depth_at_rest(found.contact)
    rest = [
        _rest(found.rest, found.solimp),
        f"on several points the depth is 1/4 to 2 times (1 - d) g/k = {alone:.3g} um: --body measures it",
    ]
    integrators = ", any but discrete, which errs more" if spring else ", or Euler; not RK4, not discrete"
    body = f"{'an' if found.body[0] in 'aeiou' else 'a'} {found.body}"
    flight = f"a brick at 10 turns a second {_change(found.flight)} of its energy in half a second"
    if not spring and own:
        exact = exact_of(found)
        sinking = rest_of(exact).sinking
        rest.append(
            f'solref="{text_of(exact.solref)}" would be exact, and sink {1e6 * sinking:.3g} um/s at rest'
        )
        flight += f"; by RK4 {energy_change('RK4', found.timestep):+.0e}: --spring"
    return "\n".join(
        [
            found.settings,
            "",
            f"integrator  {found.integrator}" + (integrators if own else ""),
            f"backend     {found.backend}: {found.backend.remark}",
            f"error       {_at_most(found.error)} at worst in the restitution, "
            f"of {body} that touches at 16 phases" + ("" if own else ", by MuJoCo"),
            f"            {_at_most(found.error_with_weight)} with weight at {SPEED:g} m/s; {_slower(found)}",
            "            more if the impact turns the body, by its speed and DT: bounce measures it",
            *_weight(found),
            f"depth       up to {1e3 * found.depth:.3g} mm into the floor for each m/s, whatever the mass",
            f"floor       {_floor(found)}",
            *_column("rest", rest),
            f"flight      {flight}",
            *_column("friction", _friction(found)),
        ]
    )


def _friction(found: Bounce) -> list[str]:
    """Return what friction the contact has, line by line."""
    slips = f"slip at some {1e6 * found.creep:.2g} um/s" if found.creep < 1e-3 else "slip out"
    if found.backend is Backend.GENESIS:
        return [
            "at least 0.01, MuJoCo's own friction, which lifts a body that slides unless RigidOptions has",
            f"contact_resolution=gs.contact_resolution.signorini, and lets a body that it holds {slips}",
        ]
    three = '"mujoco:condim": 3' if found.backend is Backend.NEWTON else 'condim="3"'
    return [
        f"none: a stack slides apart; {three} has MuJoCo's own friction, which lifts a body that",
        f"slides, and lets a body that it holds {slips};",
        "docs/MUJOCO.md of cointoss says how to avoid both",
    ]


def _rebounds(found: Rebounds) -> str:
    """Return how a ball bounces with given settings, line by line."""
    theory = found.formula
    by = ["", "", "", ""]
    if theory is not None:
        by = [
            _by_formula(theory.restitution, found.restitution, f"{theory.restitution:.4f}", found),
            _by_formula(theory.duration, found.duration, f"{1e3 * theory.duration:.3g} ms", found),
            _by_formula(theory.depth, found.depth, f"{1e3 * theory.depth:.3g} mm", found),
            _by_formula(theory.rest, found.rest.depth, f"{1e6 * theory.rest:.3g} um deep", found)
            if found.body.startswith("sphere")
            else f"; by formula {1e6 * theory.rest:.3g} um deep on one point",
        ]
    return "\n".join(
        [
            f'mixed       solref="{text_of(found.solref)}" solimp="{found.solimp}"',
            f"restitution {found.restitution:.4f}, from {found.lowest:.4f} to {found.highest:.4f} "
            f"over 16 phases of a step{by[0]}",
            f"            {found.restitution_with_weight:.4f} with weight, at {SPEED:g} m/s",
            *_weight(found),
            f"duration    {1e3 * found.duration:.3g} ms{by[1]}",
            f"depth       up to {1e3 * found.depth:.3g} mm for each m/s{by[2]}{_deep(found)}",
            f"rest        {_rest(found.rest, found.solimp)}{by[3]}",
        ]
    )


def _weight(found: Bounce | Rebounds) -> list[str]:
    """Return the line of the weight that was measured with, where it is not the default."""
    if (found.mass, found.gravity) == (BALL.mass, GRAVITY):
        return []
    return [f"weight      that of {1e3 * found.mass:.6g} g under {found.gravity:.6g} m/s^2"]


def _deep(found: Rebounds) -> str:
    """Return at which speed the contact is deeper than half of the body that was measured, in words."""

    thinnest = body_of(found.body).thinnest
    fastest = thinnest / found.depth if found.depth else inf
    if fastest >= SPEED:
        return ""
    return (
        f"; above {fastest:.2g} m/s deeper than half of a {found.body}, {2e3 * thinnest:g} mm thick, "
        "which only a plane sends back"
    )


def _by_formula(theory: float, measured: float, text: str, found: Rebounds) -> str:
    """Return what theory says beside what was measured, and where it fails; nothing for infinity."""
    if not isfinite(theory):
        return ""
    if abs(theory - measured) <= FAILS * abs(theory):
        return f"; by formula {text}"

    steps = max(1, round(found.duration / found.timestep))
    plural = "s" if steps > 1 else ""
    return f"; by formula {text}, which fails here, in a contact of {steps} step{plural}"


def _slower(found: Bounce) -> str:
    """Return what weight costs at another speed, in words."""
    if found.spring:
        return "more at a lower speed v, about as 1/v"
    if not found.restitution:
        return "a ball stays on the floor"
    most = f"{_at_most(found.error)} + {found.weight_cost:.3g} g DT/v"
    return f"at a speed v up to {most}, while 2 g DT/v is far below E^2"


def _floor(found: Bounce) -> str:
    """Return which floors the body goes through, in words."""

    thickness = found.thickest_passed
    if thickness <= 0:
        return f"lets the body through nowhere, at up to {SPEED:g} m/s"
    return (
        f"lets the body through at {SPEED:g} m/s "
        f"if the floor is up to {1e3 * thickness:.3g} mm thick and no plane: "
        "the contact is deeper than half of both"
    )


def _column(name: str, lines: list[str]) -> list[str]:
    """Return lines beside a name, which stands once."""
    return [f"{name if number == 0 else '':11} {line}" for number, line in enumerate(lines)]


def _at_most(error: float) -> str:
    """Return an error with one digit, rounded up."""
    shown = f"{error:.0e}"
    return shown if float(shown) >= error else f"{error + 0.5 * 10 ** floor(log10(error)):.0e}"


def _change(part: float) -> str:
    """Return a change of energy in words."""
    return ("loses " if part < 0 else "gains ") + (
        f"{100 * abs(part):.2g} %" if abs(part) > 1e-4 else f"{abs(part):.0e}"
    )


def _rest(rest: Rest, solimp: str) -> str:
    """Return what a body does at rest, in words."""
    shallow, deep = (float(number) for number in solimp.split()[:2])
    # The impedance that grows with the depth carries more of a larger weight.
    bound = "at most " if shallow < deep else "at least " if shallow > deep else ""
    if rest.hop:
        return f"never still: it hops on, by {1e6 * rest.hop:.3g} um"
    if rest.sinking > 0:
        return f"sinks {1e6 * rest.sinking:.3g} um/s, n times as fast under n times its weight"
    does = f"rises {-1e6 * rest.sinking:.3g} um/s" if rest.sinking else "lies still"
    return f"{does}, {1e6 * rest.depth:.3g} um deep; {bound}n times as deep under n times its weight"
