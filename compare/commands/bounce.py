"""`cointoss bounce`: how two geoms of a user's own MuJoCo model bounce off each other."""

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import click

from cointoss.compare.commands.common import ReadPlace, WrittenPlace, plain_errors, print_json, refuse
from cointoss.compare.output.accepted import Written

if TYPE_CHECKING:
    from cointoss.coin_mj.bounces.pair import PairBounce


@click.command()
@click.argument("model", metavar="MODEL.xml", is_eager=True, type=ReadPlace("an XML file of MuJoCo"))
@click.argument("one", metavar="GEOM")
@click.argument("two", metavar="GEOM")
@click.option("--png", type=WrittenPlace(Written((".png",))), help="Draw the restitution over the speed.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON, in full precision.")
def bounce(model: Path, one: str, two: str, png: Path | None, as_json: bool) -> None:
    """Print how two geoms of your own MuJoCo model bounce off each other.

    GEOM is the name or the number of a geom. They come together at six speeds and eight phases of a step,
    stepped by plain mj_step with the options of the model, without gravity and with it: straight, where the
    joints let one move along the normal while no body turns. Then one comes to rest on the other. Other geoms
    touch nothing meanwhile. The model is read by MuJoCo's own loader and is not changed.
    """
    with plain_errors(str(model)):
        from cointoss.compare.film.back_end import require_mujoco
        from cointoss.compare.output.files import write_bytes

        require_mujoco()
        from cointoss import coin_mj
        from cointoss.models.errors import FieldError

        try:
            found = coin_mj.bounce(model, one, two)
        except FieldError as error:
            field = "" if error.field == "model" else f" {error.field} {error.value}:"
            refuse(f"{model}:{field} accepted: {error.accepted}")
        from cointoss.compare.output.bounce_plot import bounce_table, draw_bounce
        from cointoss.compare.output.plots import picture_bytes
        from cointoss.compare.output.rest_lines import rest_lines

        if png is not None:
            write_bytes(png, picture_bytes(draw_bounce(found)))
        if as_json:
            print_json(asdict(found), "mujoco")
            return
        solref = " ".join(f"{number:g}" for number in found.solref)
        friction = f' friction="{found.friction:g}"' if found.condim > 1 else ""
        click.echo(
            f'mixed       solref="{solref}" solimp="{found.solimp}" condim="{found.condim}"{friction}\n'
            f"integrator  {found.integrator}, {1e3 * found.timestep:g} ms\n{_margin(found)}"
            f"approach    {_approach(found)}\n\n{bounce_table(found)}\n\n{rest_lines(found)}"
        )
        if png is not None:
            click.echo(f"\npicture     {png}")


def _approach(found: "PairBounce") -> str:
    """Return how the geoms were thrown at each other, in words."""
    return (
        "as an impulse between the geoms moves the joints: "
        f"a body turns by {found.turning:.3g} rad on each metre of the way"
        if found.turning
        else "straight: no body turns"
    )


def _margin(found: "PairBounce") -> str:
    """Return the line of the distance from which the contact pushes, as MuJoCo reads it; none for 0."""
    return (
        f"margin      the contact pushes from {1e3 * found.margin:g} mm on: margin, since MuJoCo 3.9, "
        f"not margin - gap; gap, {1e3 * found.gap:g} mm more, only lists it\n"
        if found.margin or found.gap
        else ""
    )
