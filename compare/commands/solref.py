"""`cointoss solref`: settings of MuJoCo for a bounce."""

import json
from dataclasses import asdict

import click

from cointoss.compare.commands.common import Count, Given, Quantity, naming_options, plain_errors


@click.command()
@click.option("--restitution", type=Quantity(""), required=True, metavar="E", help="From 0 to 1.")
@click.option(
    "--dt",
    type=Quantity("s"),
    required=True,
    metavar="DT",
    help="The model's timestep, such as 0.002 or 2ms.",
)
@click.option("--spring", is_flag=True, help="By a spring that lasts several steps, instead of in one.")
@click.option("--steps", type=Count(5, 500), help="Steps in the contact of a spring; by default 40.")
@click.option("--model", is_flag=True, help="Print a whole model instead: a ball over a plane.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON, in full precision.")
def solref(
    restitution: Given, dt: Given, spring: bool, steps: int | None, model: bool, as_json: bool
) -> None:
    """Print the settings with which a body bounces in MuJoCo.

    The error is that of a ball, measured now, at 16 phases of its touch between two steps.
    """
    if steps is not None and not spring:
        raise click.UsageError(f"--steps {steps}: accepted: only beside --spring")
    if model and as_json:
        raise click.UsageError("--model and --json: accepted: one of them")
    with plain_errors("solref"):
        from cointoss.compare.film.back_end import require_mujoco

        require_mujoco()
        from cointoss import coin_mj
        from cointoss.coin_mj.bounce import SPEED, SPRING_STEPS

        with naming_options({"restitution": ("--restitution", restitution), "timestep": ("--dt", dt)}):
            found = coin_mj.solref(
                restitution.value, dt.value, spring=spring, steps=SPRING_STEPS if steps is None else steps
            )
    if as_json:
        click.echo(json.dumps(asdict(found), indent=1))
    elif model:
        click.echo(found.model)
    else:
        others = "any but discrete, which errs more" if spring else "or Euler; not RK4, not discrete"
        click.echo(
            f"{found.option}\n<geom {found.geom}/>\n\n"
            f"integrator  {found.integrator}, {others}\n"
            f"error       {found.error:.0e} at worst, of a ball that touches at 16 phases of a step\n"
            f"            {found.error_with_weight:.0e} with weight, at {SPEED:g} m/s; more if slower\n"
            f"depth       up to {1000 * found.depth:.3g} mm into the floor for each m/s, whatever the mass\n"
            f'friction    with condim="1"; MuJoCo\'s own friction lifts a body that slides (docs/MUJOCO.md)'
        )
