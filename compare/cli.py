"""The command line: `cointoss`."""

import difflib
import os
import sys
from functools import cached_property
from importlib import import_module
from io import TextIOWrapper
from mmap import mmap
from typing import Any, NoReturn

import click

from cointoss.compare.commands.common import ARGUMENTS, refuse
from cointoss.compare.output.interruption import run_to_exit
from cointoss.models.distribution import DISTRIBUTION
from cointoss.models.errors import meant

COMMANDS = {
    "basin": "Map the outcome over two fields of a scenario.",
    "compare": "Toss one coin by several engines and write a report.",
    "explore": "Show a map in the browser: click a pixel, see both engines toss it.",
    "find": "Find a toss that shows a sequence of faces, or ends on its edge.",
    "fit": "Find the values of a scenario's fields that explain what was seen of a coin, or that none do.",
    "flips": "Say whether a coin is fair, and how much a hand wobbles, from counts of flips.",
    "hands": "Toss a scenario's coin many times as a hand does, and count how often its first side "
    "is up again.",
    "lab": "Toss coins in the browser: a map that follows sliders, and each of its tosses.",
    "scenarios": "List the scenarios that come with the package, or print the file of one.",
    "shares": "Count how often a coin tossed by hand shows heads, tails or its edge, along a field.",
    "toss": "Toss one coin and print its impacts.",
    "video": "Film one toss, drawn by MuJoCo, until the coin lies still.",
}
"""The commands, each in a module of its name, which is imported when it is called; and what each does."""
OF_OTHERS = {
    "bounce": (
        "cointoss-bounce",
        "Print how two geoms of your own MuJoCo model bounce off each other.",
    ),
    "conform": (
        "cointoss-yardstick",
        "Test an engine on cases with known answers, and print a card of its errors.",
    ),
    "reproduce": ("cointoss-reproduction", "Compute the paper's figures and the studies."),
    "solref": (
        "cointoss-bounce",
        "Print settings of MuJoCo or another simulator for a restitution, or the restitution "
        "of given settings.",
    ),
}
"""Commands that are offered by another distribution: its name, and what each does."""
NO_MEMORY = "out of memory, or of threads; accepted: more of them for this process, see ulimit -a"
"""What is said where memory ends."""
_ROOM = 160 << 20
"""Address space that every command takes [bytes]; pydantic's Rust code aborts the process where it ends."""
_LACKING = (
    "can't start new thread",
    "failed to map segment",
    "Cannot allocate memory",
    "without exception set",  # Python had no memory for the exception
    "without setting an exception",
)
"""What the errors say of a system that refused memory or a thread, beside `MemoryError`."""


class _Commands(click.Group):
    """The commands, each of whose failures is one line."""

    def __call__(self, *args: Any, **extra: Any) -> NoReturn:
        if isinstance(sys.stdout, TextIOWrapper) and sys.stdout.errors == "strict":
            # Windows' code pages have few letters; what they lack is a question mark.
            sys.stdout.reconfigure(errors="replace")
        run_to_exit(lambda: self.main(*args, **extra))

    def main(self, *args: Any, **extra: Any) -> NoReturn:
        try:
            mmap(-1, _ROOM).close()
            status = super().main(*args, **{"prog_name": "cointoss", **extra, "standalone_mode": False})
            if sys.stdout is not None:  # None where the shell has closed it
                sys.stdout.flush()
        except click.MissingParameter as error:
            refuse(_missing(error))
        except click.NoSuchOption as error:
            refuse(_no_such_option(error, self))
        except click.UsageError as error:
            command = error.ctx.command_path if error.ctx else "cointoss"
            refuse(f"{error.format_message().rstrip('.')} (see {command} --help)")
        except click.ClickException as error:  # of another distribution's command
            refuse(error.format_message(), status=error.exit_code)
        except click.Abort:  # KeyboardInterrupt
            refuse("interrupted", status=130)
        except (ImportError, MemoryError, OSError, RuntimeError, SystemError) as error:
            if _lacks_memory(error):
                refuse(NO_MEMORY, status=1)
            if isinstance(error, OSError) and error.errno is not None:
                # What standard output could not take is lost, or Python would report it again at its end.
                os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
                refuse(
                    f"{error.filename or 'standard output'}: can't be written ({error.strerror})", status=1
                )
            if isinstance(error, OSError):  # not of a file, as where a connection is lost
                refuse(str(error) or type(error).__name__, status=1)
            if isinstance(error, ImportError) and error.name is None:  # of a library, not of a module
                refuse(str(error))
            raise
        sys.exit(status)

    @cached_property
    def offered(self) -> dict[str, Any]:
        """The entry points by which other packages offer commands."""
        from importlib.metadata import entry_points  # takes a tenth of a start

        return {point.name: point for point in entry_points(group="cointoss.commands")}

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002
        return sorted({*COMMANDS, *self.offered})

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name in COMMANDS:
            return getattr(import_module(f"cointoss.compare.commands.{cmd_name}"), cmd_name)
        is_offered = cmd_name in self.offered
        if not is_offered and not ctx.resilient_parsing:  # as where a shell completes
            if cmd_name in OF_OTHERS:
                of = OF_OTHERS[cmd_name][0]
                ctx.fail(f"{cmd_name}: a command of {of}, which is not installed; accepted: pip install {of}")
            names = self.list_commands(ctx)
            ctx.fail(f"{cmd_name}: no such command; {meant(cmd_name, names)}accepted: {', '.join(names)}")
        return self.offered[cmd_name].load() if is_offered else None

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        offered = {
            name: OF_OTHERS[name][1] if name in OF_OTHERS else point.dist.metadata["Summary"]
            for name, point in self.offered.items()
        }
        listed = {name: click.Command(name, help=text) for name, text in (offered | COMMANDS).items()}
        click.Group(commands=listed).format_commands(ctx, formatter)


@click.group(
    cls=_Commands,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    invoke_without_command=True,
)
@click.version_option(package_name=DISTRIBUTION, prog_name="cointoss")
@click.pass_context
def main(ctx: click.Context) -> None:
    """Toss a coin by two engines, the analytic one of Strzalko et al. (2008) and MuJoCo, and compare."""
    if ctx.invoked_subcommand is None:
        click.echo(ctx.get_help())


def _missing(error: click.MissingParameter) -> str:
    """Return which parameter is missing, and what it takes."""
    parameter, command = error.param, error.ctx.command_path if error.ctx else "cointoss"
    assert parameter is not None
    name, accepted = parameter.human_readable_name, ARGUMENTS.get(parameter.human_readable_name)
    if isinstance(parameter, click.Option):
        name, about = parameter.opts[0], (parameter.help or "").rstrip(".")
        form = parameter.metavar or parameter.type.name.upper()
        accepted = f"{name} {form}, {about[:1].lower()}{about[1:]}"
    return f"{name}: missing; accepted: {accepted} (see {command} --help)"


def _no_such_option(error: click.NoSuchOption, group: click.Group) -> str:
    """Return which option a command does not have, and a near one of its own, or which commands have it."""
    asked, command = error.option_name, error.ctx.command if error.ctx else group
    near = difflib.get_close_matches(asked, _options(command), n=1, cutoff=0.75)
    arguments = [f"--{each.name}" for each in command.params if isinstance(each, click.Argument)]
    every = {name: group.get_command(click.Context(group), name) for name in COMMANDS}
    *more, last = [name for name, each in every.items() if each and asked in _options(each)] or [""]
    takers = f"{', '.join(more)} and {last} take" if more else f"{last} takes"
    hint = f"; did you mean {near[0]}?" if near else f"; cointoss {takers} it" if last else ""
    hint = f"; accepted: {asked[2:].upper()} without a name before it" if asked in arguments else hint
    return (
        f"No such option '{asked}'{hint} (see {error.ctx.command_path if error.ctx else 'cointoss'} --help)"
    )


def _options(command: click.Command) -> list[str]:
    return [text for option in command.params for text in option.opts if text.startswith("-")]


def _lacks_memory(error: BaseException | None) -> bool:
    """Return whether an error, or one that it arose from, is that the system refused memory or a thread."""
    is_such = isinstance(error, MemoryError) or any(words in str(error) for words in _LACKING)
    return is_such or (error is not None and _lacks_memory(error.__context__))


if __name__ == "__main__":
    main()
