"""`cointoss reproduce`: the paper's figures and the studies."""

import os
import shutil
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import click

from cointoss.study import (
    ChoiceType,
    Device,
    Written,
    WrittenPlace,
    completing,
    drawing_problem,
    meant,
    plain_errors,
    refuse,
    require_mujoco,
    stage,
)
from cointoss_reproduction.frame import runner

_LISTED = "a name that cointoss reproduce --list prints"


@click.command()
@click.argument("names", nargs=-1, metavar="[NAME ...]", **completing(lambda: [*runner.names(), "all"]))
@click.option(
    "--out",
    type=WrittenPlace(Written(kind="folder")),
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
@click.option("--list", "as_list", is_flag=True, help="Print the names and their titles; compute nothing.")
@click.option(
    "--device",
    type=ChoiceType([str(one) for one in Device]),
    default=str(Device.CPU),
    show_default=True,
    help="Device that computes the tosses: the CPU, an NVIDIA card, or the card where it is faster.",
)
@click.pass_context
def reproduce(
    ctx: click.Context,
    names: tuple[str, ...],
    out: Path | None,
    quick: bool,
    kept: str | None,
    kept_here: str | None,
    as_list: bool,
    device: str,
) -> None:
    """Compute the paper's figures and the studies.

    Each NAME writes its data, tables, pictures and page and checks its claims; `all` computes all figures of
    the paper and writes REPRODUCTION.md, claims.csv and gallery.html. Without NAME, list the names, as with
    --list. Exit status 1: a claim comes out otherwise than known; with --check, a verdict changes or a
    number is off; with --older, a result is older than the engines.
    """
    known = runner.names()
    asked = names
    if names == ("all",):
        from cointoss_reproduction.frame.gallery import of_paper

        names = tuple(of_paper())
    for name in names:
        if name not in known:
            ctx.fail(f"{name}: no such name; {meant(name, known)}accepted: {_LISTED}")
    if as_list:
        _list(names or tuple(known))
        return
    if kept_here is not None:
        if out is not None or kept is not None:
            ctx.fail("--older: not with --out or --check; accepted: one of them")
        sys.exit(1 if _list_older(names or tuple(known), Path(kept_here)) else 0)
    if kept is not None:
        if not names:
            ctx.fail("--check: comes after the names; accepted: NAME ... --check [DIR]")
        if out is not None:
            ctx.fail("--out: not with --check, which writes nothing; accepted: one of them")
        _ready(device)
        sys.exit(0 if _agree(names, Path(kept), quick=quick) else 1)
    if not names and out is None:
        _list(tuple(known))
        return
    if out is None:
        ctx.fail(f"--out: missing; accepted: {ctx.command_path} {' '.join(asked)} --out DIR")
    if not names:
        ctx.fail(f"NAME: missing; accepted: all, or {_LISTED}")
    _ready(device)
    sys.exit(1 if _write(names, out, quick=quick, pages=asked == ("all",)) else 0)


def _list(known: tuple[str, ...]) -> None:
    """Print the names of all that can be reproduced, with what the studies say of themselves."""
    width = max(map(len, known)) + 2
    for name in known:
        said = runner.told(name)
        place = f"{said['paper']}: " if "paper" in said else ""
        click.echo(f"{name:{width}}{place}{said['title']} ({said['seconds']:g} s)")


def _ready(device: str) -> None:
    """Choose MuJoCo's back end, before MuJoCo is imported, for figures may hold stills; and the device."""
    with plain_errors("reproduce"):
        if not os.environ.get("MUJOCO_GL"):
            drawing_problem()
        require_mujoco()
    from cointoss.study import Processor, usual

    processor, ctx = Processor(device), click.get_current_context()
    ctx.with_resource(usual(processor))
    ctx.call_on_close(
        lambda: processor.card and click.echo(f"cointoss: tossed by {processor.in_words}", err=True)
    )


def _write(names: tuple[str, ...], out: Path, *, quick: bool, pages: bool) -> list[str]:
    """Write what is computed and print it; return the claims that come out otherwise than known."""
    from cointoss.study import require_folder
    from cointoss_reproduction.frame import gallery, printing
    from cointoss_reproduction.frame.claim import unexpected

    width = min(shutil.get_terminal_size((100, 24)).columns, 120)
    failed: list[str] = []
    with plain_errors(str(out)):
        require_folder(out, gallery.PAGES if pages else ())
        for name in names:
            runner.require_writable(name, out)
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
    return failed


def _list_older(names: tuple[str, ...], kept: Path) -> bool:
    """Print which results in a folder are older than the engines here, and return whether any is."""
    from cointoss_reproduction.frame import checking, provenance

    found = False
    with plain_errors("--older"):
        for name in names:
            folder = runner.folder_of(name, kept)
            try:
                why = provenance.older(checking.read_run(folder, quick=None).made_of)
            except checking.RunError as error:
                why = str(error)
            if why:
                click.echo(f"{name}: {why}")
                found = True
    return found


def _agree(names: tuple[str, ...], kept: Path, *, quick: bool) -> bool:
    """Compute results anew, print how they compare with those in a folder, and return whether all agree."""
    from cointoss_reproduction.frame import checking

    try:
        runs = {name: checking.read_run(runner.folder_of(name, kept), quick=quick) for name in names}
    except checking.RunError as error:
        refuse(str(error))
    agree = True
    for name, there in runs.items():
        timed = runner.find(name).timed
        with plain_errors(name), TemporaryDirectory() as aside:
            with stage(name, "parts") as progress:
                runner.reproduce(name, Path(aside), progress, quick=quick, beside=Path(kept))
            here = checking.read_run(runner.folder_of(name, Path(aside)), quick=quick)
            found = checking.check(there, here, timed=timed)
        click.echo(checking.in_words(name, str(runner.folder_of(name, kept)), found, timed=timed))
        agree = agree and found.agrees
    return agree
