"""The command line: `cointoss`."""

import difflib
import os
import sys
from functools import cached_property
from io import TextIOWrapper
from typing import Any, NoReturn

import click

from cointoss.compare.commands.basin import basin
from cointoss.compare.commands.bounce import bounce
from cointoss.compare.commands.common import ARGUMENTS, refuse
from cointoss.compare.commands.compare import compare
from cointoss.compare.commands.conform import conform
from cointoss.compare.commands.explore import explore
from cointoss.compare.commands.find import find
from cointoss.compare.commands.fit import fit
from cointoss.compare.commands.hands import hands
from cointoss.compare.commands.lab import lab
from cointoss.compare.commands.scenarios import scenarios
from cointoss.compare.commands.shares import shares
from cointoss.compare.commands.solref import solref
from cointoss.compare.commands.toss import toss
from cointoss.compare.commands.video import video
from cointoss.compare.output.interruption import run_to_exit
from cointoss.models.distribution import DISTRIBUTION
from cointoss.models.errors import meant

# The commands' modules import little: `cointoss --help` answers at once, a command brings what it needs.

NO_MEMORY = "out of memory, or of threads; accepted: more of them for this process, see ulimit -a"


class _Commands(click.Group):
    """The commands, each of whose failures is one line."""

    def __call__(self, *args: Any, **extra: Any) -> NoReturn:
        if isinstance(sys.stdout, TextIOWrapper) and sys.stdout.errors == "strict":
            # Windows' code pages have few letters; what they lack is a question mark.
            sys.stdout.reconfigure(errors="replace")
        run_to_exit(lambda: self.main(*args, **extra))

    def main(self, *args: Any, **extra: Any) -> NoReturn:
        try:
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
        except click.Abort:  # KeyboardInterrupt
            refuse("interrupted", status=130)
        except (ImportError, MemoryError, OSError, RuntimeError) as error:
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
    def offered(self) -> dict[str, click.Command]:
        """The commands of other packages, by the entry points that offer them."""
        from importlib.metadata import entry_points  # takes a tenth of a start

        return {point.name: point.load() for point in entry_points(group="cointoss.commands")}

    def list_commands(self, ctx: click.Context) -> list[str]:
        return sorted([*super().list_commands(ctx), *self.offered])

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        known = super().get_command(ctx, cmd_name) or self.offered.get(cmd_name)
        if known is None and not ctx.resilient_parsing:  # as where a shell completes
            names = self.list_commands(ctx)
            ctx.fail(f"{cmd_name}: no such command; {meant(cmd_name, names)}accepted: {', '.join(names)}")
        return known


@click.group(
    cls=_Commands,
    commands=[
        basin,
        bounce,
        compare,
        conform,
        explore,
        find,
        fit,
        hands,
        lab,
        scenarios,
        shares,
        solref,
        toss,
        video,
    ],
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
    others = [f"cointoss {name}" for name, each in group.commands.items() if asked in _options(each)]
    hint = f"; did you mean {near[0]}?" if near else f"; {' and '.join(others)} take it" if others else ""
    return (
        f"No such option '{asked}'{hint} (see {error.ctx.command_path if error.ctx else 'cointoss'} --help)"
    )


def _options(command: click.Command) -> list[str]:
    return [text for option in command.params for text in option.opts]


def _lacks_memory(error: BaseException) -> bool:
    """Return whether an error, or one that it arose from, is that the system refused memory or a thread."""
    said = ("can't start new thread", "failed to map segment", "Cannot allocate memory")
    behind: BaseException | None = error
    while behind is not None:
        if isinstance(behind, MemoryError) or any(words in str(behind) for words in said):
            return True
        behind = behind.__context__
    return False


if __name__ == "__main__":
    main()
