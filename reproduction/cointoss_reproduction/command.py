"""`cointoss reproduce`: the paper's figures and the studies."""

import os
import shutil
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import click

from cointoss.study import Place, completing, plain_errors, refuse


def _names() -> list[str]:
    from cointoss_reproduction.frame.runner import names

    return [*names(), "all"]


@click.command()
@click.argument("names", nargs=-1, metavar="[NAME ...]", **completing(_names))
@click.option(
    "--out",
    type=Place(),
    help="Folder of the results, each in its reproduction/NAME/; made if missing.",
)
@click.option("--quick", is_flag=True, help="Compute the smaller version of each that has one.")
@click.option(
    "--check",
    "kept",
    is_flag=False,
    flag_value="docs",
    metavar="[DIR]",
    help="Compare the numbers with those in DIR/reproduction/NAME, else in docs; after the names.",
)
@click.option(
    "--older",
    "kept_here",
    is_flag=False,
    flag_value="docs",
    metavar="[DIR]",
    help="List what DIR, else docs, holds that was made by other engines than those here; after the names.",
)
@click.pass_context
def reproduce(
    ctx: click.Context,
    names: tuple[str, ...],
    out: Path | None,
    quick: bool,
    kept: str | None,
    kept_here: str | None,
) -> None:
    """Compute the paper's figures and the studies anew.

    Each NAME writes its data, tables, pictures and page and checks its claims; `all` computes all figures of
    the paper and writes REPRODUCTION.md, claims.csv and gallery.html. Without NAME, list the names. Exit
    status 1: a claim comes out otherwise than known; with --check, a verdict changes or a number
    is off; with --older, something is.
    """
    from cointoss.study import drawing_problem, require_folder, require_mujoco, stage
    from cointoss_reproduction.frame import gallery, printing, runner
    from cointoss_reproduction.frame.claim import unexpected

    with plain_errors("reproduce"):
        # Figures may hold stills: the back end is chosen before MuJoCo is imported.
        if names and not os.environ.get("MUJOCO_GL"):
            drawing_problem()
        require_mujoco()
    known = runner.names()
    pages, asked = names == ("all",), " ".join(names)
    if pages:
        names = tuple(gallery.of_paper())
    for name in names:
        if name not in known:
            ctx.fail(f"{name}: no such name; accepted: {', '.join(known)}")
    if kept_here is not None:
        if out is not None or kept is not None:
            ctx.fail("--older: not with --out or --check; accepted: one of them")
        sys.exit(_list_older(names or tuple(known), Path(kept_here)))
    if kept is not None:
        if not names:
            ctx.fail("--check: comes after the names; accepted: NAME ... --check [DIR]")
        if out is not None:
            ctx.fail("--out: not with --check, which writes nothing; accepted: one of them")
        sys.exit(0 if _agree(names, Path(kept), quick=quick) else 1)
    if not names and out is None:
        width = max(map(len, known)) + 2
        for name in known:
            found = runner.find(name)
            place = f"{found.paper}: " if found.paper else ""
            click.echo(f"{name:{width}}{place}{found.title} ({found.seconds:g} s)")
        return
    if out is None:
        ctx.fail(f"--out: missing; accepted: {ctx.command_path} {asked} --out DIR")
    if not names:
        ctx.fail(f"NAME: missing; accepted: all, or one of: {', '.join(known)}")
    with plain_errors(str(out)):
        require_folder(out, gallery.PAGES if pages else ())
        for name in names:
            runner.require_writable(name, out)
        width = min(shutil.get_terminal_size((100, 24)).columns, 120)
        failed = []
        for name in names:
            with stage(name, "parts") as progress:
                result = runner.reproduce(name, out, progress, quick=quick)
            if name != names[0]:
                click.echo()
            click.echo(printing.page(name, result, runner.folder_of(name, out), width))
            failed += [f"{name}: {claim}" for claim in unexpected(result.claims, quick=quick)]
        if pages:
            gallery.write(out, names, quick=quick)
    for claim in failed:
        click.echo(f"cointoss: {claim}: another verdict than the known one", err=True)
    sys.exit(1 if failed else 0)


def _list_older(names: tuple[str, ...], kept: Path) -> int:
    """Print which results in a folder are older than the engines here, and return 1 where any is, else 0."""
    from cointoss_reproduction.frame import checking, provenance, runner

    found = 0
    for name in names:
        folder = runner.folder_of(name, kept)
        try:
            checking.require_run(folder, quick=None)
            with plain_errors(name):
                why = provenance.older(folder)
        except checking.RunError as error:
            why = str(error)
        if why:
            click.echo(f"{name}: {why}")
            found = 1
    return found


def _agree(names: tuple[str, ...], kept: Path, *, quick: bool) -> bool:
    """Compute results anew, print how they compare with those in a folder, and return whether all agree."""
    from cointoss.study import stage
    from cointoss_reproduction.frame import checking, runner

    for name in names:
        try:
            checking.require_run(runner.folder_of(name, kept), quick=quick)
        except checking.RunError as error:
            refuse(str(error))
    agree = True
    for name in names:
        timed = runner.find(name).timed
        with plain_errors(name), TemporaryDirectory() as aside:
            with stage(name, "parts") as progress:
                runner.reproduce(name, Path(aside), progress, quick=quick)
            folder = runner.folder_of(name, kept)
            found = checking.check(folder, runner.folder_of(name, Path(aside)), timed=timed)
        click.echo(checking.in_words(name, str(folder), found, timed=timed))
        agree = agree and found.agrees
    return agree
