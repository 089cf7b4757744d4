"""`cointoss toss`: what it answers, in which form, and where it stops."""

from dataclasses import replace

import numpy as np
import pytest

from cointoss import analytic
from cointoss.compare.commands.settings import described
from cointoss.compare.output.answer import as_json
from cointoss.compare.sweep.basin import basin
from cointoss.compare.sweep.toss_many import toss_many
from cointoss.models.errors import ScenarioError
from cointoss.models.reading import load, parse
from cointoss.models.records import Ending, OtherOutcome, Outcome
from cointoss.models.sources import scenario_text
from tests.helpers.command_line import cointoss, in_a_shell
from tests.helpers.draws import scenario


def test_many_tosses_keep_no_impacts_and_may_have_more():
    case = scenario(ending={"max_impacts": 30_000_000, "max_time": 0.5})
    two = {"height": [0.4, 0.5]}
    assert toss_many(case, two).ending.values.tolist() == 2 * [str(Ending.MAX_TIME)]
    for trust in ("impacts", "certain"):
        with pytest.raises(ScenarioError, match=r"max_impacts = 30000000: .*12\.5 GB here"):
            toss_many(case, two, trust=trust)
    with pytest.raises(ScenarioError, match="max_impacts"):
        basin(case, x="gravity=9:10:2", y="coin.mass=1 g:2 g:2", trust=True)


def test_a_scenario_comes_through_a_pipe(tmp_path):
    (tmp_path / "coin.toml").write_text(scenario_text("fig24a"), encoding="utf-8")
    done = in_a_shell("cointoss toss <(cat coin.toml)", tmp_path)
    assert (done.stdout, done.stderr) == (cointoss("toss", "fig24a").stdout, "")


def test_another_outcome_is_told_with_the_impact_after_which_a_change_leads_to_it():
    other = OtherOutcome(outcome=Outcome.EDGE, change=2e-9, impact=12)
    told = as_json(replace(analytic.toss("fig24a"), other_outcome=other))["other_outcome"]
    assert told == {"outcome": "edge", "change": 2e-9, "after_impact": 12}


@pytest.mark.parametrize(
    ("typed", "field", "value"),
    [
        ("contact=knurled", "floor.contact", "knurled"),
        ('contact = "knurled"', "floor.contact", "knurled"),
        ("angles=[0, 0.3, 0]", "release.angles", [0, 0.3, 0]),
        ('position=[0, 0, "50 cm"]', "release.position", [0, 0, 0.5]),
        ("air={normal = 0.001, exponent = 0}", "air", {"normal": 0.001, "exponent": 0}),
        ("mass=2 g", "coin.mass", 0.002),
        (
            "inertia=[[1e-7,0,0], [0,1e-7,0], [0,0,2e-7]]",
            "coin.inertia",
            np.diag([1e-7, 1e-7, 2e-7]).tolist(),
        ),
    ],
)
def test_a_value_is_one_of_a_scenario_file(typed, field, value):
    found, text = described("fig24a", [typed])
    assert found == load("fig24a").replace(field, value) == parse(text, "changed")
