"""Every field of a scenario says what it means."""

import pytest
from pydantic import BaseModel

from cointoss.models.meanings import meanings
from cointoss.models.parts import Air, Coin, EndingCriteria, Floor, Release
from cointoss.models.scenario import Scenario


@pytest.mark.parametrize("part", [Scenario, Coin, Air, Floor, Release, EndingCriteria])
def test_every_field_but_the_tables_has_a_meaning(part):
    tables = {
        name
        for name, field in part.model_fields.items()
        if isinstance(field.annotation, type) and issubclass(field.annotation, BaseModel)
    }
    assert meanings(part).keys() == part.model_fields.keys() - tables
    assert all(meanings(part).values())
