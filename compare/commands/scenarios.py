"""`cointoss scenarios`: the scenarios that come with the package."""

import click


@click.command()
def scenarios() -> None:
    """List the scenarios that come with the package, and what each is."""
    from cointoss.models.sources import named_scenarios, title_of

    names = named_scenarios()
    width = max(map(len, names)) + 2
    for name in names:
        click.echo(f"{name:{width}}{title_of(name)}")
