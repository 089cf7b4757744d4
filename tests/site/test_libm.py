"""The package and the engine in a browser give the same tosses, to the last bit."""

import pytest

from cointoss.models.records import Outcome
from tests.helpers.bits import MANY, cases, numbers_of, numbers_of_many
from tests.helpers.corpus import CLASSES
from tests.helpers.engine_page import changes, written


@pytest.fixture(scope="module")
def here():
    """The numbers of each toss by the package."""
    return {name: numbers_of(case) for name, case in cases().items()}


def in_page(loaded, case):
    """Return the numbers of a toss by the engine in a page, as `numbers_of` returns them."""
    return loaded.value(
        f"""(() => {{
          const toss = engine.toss({written(case)}), end = toss.endTime;
          const times = Array.from({{ length: 11 }}, (_, i) => (i === 10 ? end : i * (end / 10)));
          return {{
            ending: toss.ending, outcome: toss.outcome, certain: toss.outcomeCertain,
            trusted: toss.trustedImpacts, time: end,
            impacts: toss.impacts.map(({{ time, energy, impulse }}) => [time, energy, ...impulse]),
            states: [...toss.path(times).states],
          }};
        }})()"""
    )


def test_every_number_of_a_toss_is_the_same(loaded, here):
    """Impacts, states, horizon and ending: by every law, in every air, with resistance, in contact."""
    differing = [
        name
        for name, case in cases().items()
        if in_page(loaded, case) | {"end": here[name]["end"]} != here[name]
    ]
    assert differing == []
    assert sum(len(each["impacts"]) for each in here.values()) > 1000


def test_many_tosses_are_the_same(loaded):
    for kind in CLASSES:
        given = f"{written(kind.scenario)}, {changes(kind.starts(MANY))}, 'certain'"
        names = {"outcome": "outcome", "impacts": "impacts", "end_time": "endTime"}
        names |= {"trusted_impacts": "trustedImpacts", "outcome_certain": "outcomeCertain"}
        taken = ", ".join(f"{ours}: [...all.{theirs}]" for ours, theirs in names.items())
        found = loaded.value(f"workers.tossEach({given}).then((all) => ({{ {taken} }}))")
        assert found == numbers_of_many(kind)
        assert len(set(found["outcome"]) - {Outcome.UNDECIDED.value}) >= 1
