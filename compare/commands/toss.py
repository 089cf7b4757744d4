"""`cointoss toss`: one toss, printed."""

from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

import click

from cointoss.compare.commands.common import (
    SCENARIO_HELP,
    CountType,
    Place,
    contact_option,
    engine_option,
    plain_errors,
    print_json,
)
from cointoss.compare.commands.names import scenario_argument


@click.command(epilog=SCENARIO_HELP)
@scenario_argument
@engine_option
@contact_option
@click.option("--max-impacts", type=CountType(1, 1_000_000), help="Stop after this number of impacts.")
@click.option(
    "--contact-steps",
    type=CountType(1, 1_000_000_000),
    help="Stop after this number of steps of sustained contact and after it; by default an engine's own.",
)
@click.option(
    "--flight-steps",
    type=CountType(1, 1_000_000_000),
    help="Stop after this number of steps of flight, in MuJoCo; by default 250,000.",
)
@click.option("--all", "whole", is_flag=True, help="Print every impact and contact, not only the first.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON, in full precision.")
@click.option("--trajectory", type=Place(), help="Also write the path to this .csv file.")
@click.option(
    "--margin", is_flag=True, help="Also find the least changes of the release that change the outcome."
)
def toss(
    scenario: str,
    engine: str,
    contact: str | None,
    max_impacts: int | None,
    contact_steps: int | None,
    flight_steps: int | None,
    whole: bool,
    as_json: bool,
    trajectory: Path | None,
    margin: bool,
) -> None:
    """Toss one coin and print its impacts."""
    if margin and engine != "analytic":
        raise click.UsageError(f"--margin --engine {engine}: accepted: only by the analytic engine")
    if contact is not None and engine != "mujoco":
        raise click.UsageError(f"--contact {contact}: accepted: only beside --engine mujoco")
    if flight_steps is not None and engine != "mujoco":
        raise click.UsageError(f"--flight-steps {flight_steps}: accepted: only beside --engine mujoco")
    with plain_errors(scenario):
        from cointoss.models.stages import stage

        with stage("getting ready"):  # what is imported takes long on a busy machine
            from cointoss.compare.engines import Engine
            from cointoss.compare.film.back_end import require_mujoco
            from cointoss.compare.output import answer
            from cointoss.compare.output.files import is_stream, require_file, write_text
            from cointoss.models.reading import load

            described = load(scenario)
            if engine == Engine.MUJOCO:
                require_mujoco()
            package = Engine(engine).package
        if trajectory is not None and not is_stream(trajectory):
            require_file(trajectory, ".csv", scenario)
        if max_impacts is not None:
            described = described.replace("ending.max_impacts", max_impacts)
        given = {"contact": contact, "contact_steps": contact_steps, "flight_steps": flight_steps}
        chosen = {name: value for name, value in given.items() if value is not None}
        settings = replace(package.FINE, **chosen)
        result = package.toss(described, settings=settings)
        if trajectory is not None:
            times = answer.path_times(result)
            write_text(trajectory, answer.path_csv(result.sample(times), described))
        extra, unproved = [], ""
        if margin:
            from cointoss.compare.metrics.margin import is_planar, margins

            prove, lacking = None, [name for name in ("flint", "numba") if find_spec(name) is None]
            if is_planar(described) and lacking:
                unproved = f'want of {" and ".join(lacking)}: pip install "cointoss-dynamics[reproduce]"'
            elif is_planar(described):  # a proof takes intervals in long arithmetic
                from cointoss.compare.reproduction.precision.proved_change import proved_change as prove
                from cointoss.compare.reproduction.precision.proved_change import refusal

                unproved = refusal(described)
                if contact_steps is not None:
                    unproved = f"--contact-steps: {contact_steps}, accepted: none"
            extra = margins(described, None if unproved else prove, settings=settings)
        if as_json:
            told = {
                item.quantity.name: {"change": item.finite, "proved": item.proved, "unit": item.quantity.unit}
                for item in extra
            }
            made = {
                "scenario": described.as_tables(),
                "settings": settings.as_dict(),
            }
            print_json({**answer.as_json(result), **made, **({"margin": told} if margin else {})}, engine)
        else:
            why = [f"proved    none, for {unproved}"] if unproved else []
            click.echo("\n".join([answer.as_lines(result, whole=whole), *(one.line for one in extra), *why]))
