"""`cointoss basin`: a map of outcomes."""

import shlex
from dataclasses import replace

import click

from cointoss.compare.commands.common import SCENARIO_HELP, say
from cointoss.compare.commands.names import fields_in, scenario_argument
from cointoss.compare.commands.options import one_of, only_with, options_of, without, words_of
from cointoss.compare.commands.settings import set_option, with_scenario
from cointoss.compare.sweep.asked import Job, Source
from cointoss.models.devices import Device


@click.command(epilog=SCENARIO_HELP)
@scenario_argument
@set_option
@options_of(
    Job,
    one_of("resume", "overwrite"),
    one_of("engine", "compare"),
    only_with("contact", "engine=mujoco", "compare"),
    without("margin", "engine=mujoco", "compare"),
    without("trust", "engine=mujoco"),
    without("device", "scheduler"),
    only_with("report", "compare"),
    only_with("no_video", "report"),
    *(only_with(name, "png", "report") for name in ("palette", "boundaries", "size", "dpi")),
    completed=dict.fromkeys("xy", fields_in("cointoss.models.fields", "UNITS")),
)
@with_scenario
def basin(source: Source, asked: Job) -> None:
    """Map the outcome over two fields of a scenario.

    Each pixel is one toss. FIELD is a dotted path into the scenario, with components by name:
    release.position.z, release.angular_velocity.xi, floor.restitution. START and STOP are in SI or carry
    a unit; both are included.
    """
    from cointoss.models.stages import stage

    with stage("getting ready"):  # what is imported takes long on a busy machine
        from cointoss.compare.sweep.axes import parse_axis

        for text in (asked.x, asked.y):
            parse_axis(text, source.scenario)
        from cointoss.compare.sweep.job import make

    again = replace(asked, resume=True, overwrite=False, png=None, device=Device.CPU, scheduler=None)
    settings = (word for setting in source.settings for word in ("--set", setting))
    words = ["cointoss", "basin", source.name, *settings, *words_of(again)]
    for result in make(asked, source, shlex.join(words), say):
        click.echo(result)
