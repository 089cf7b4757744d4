"""The engines by their names, imported only when they are used."""

from enum import StrEnum

from models.records import Toss
from models.scenario import Scenario


class Engine(StrEnum):
    """An engine's name."""

    ANALYTIC = "analytic"
    MUJOCO = "mujoco"


def toss(engine: Engine, scenario: Scenario, contact: str = "spring") -> Toss:
    """Toss a coin by one engine.

    Args:
        engine: which.
        scenario: what to toss.
        contact: how MuJoCo realises the restitution, "spring" or "one_step".

    Raises:
        UnsupportedError: for what the engine doesn't model.
    """
    if engine is Engine.ANALYTIC:
        import analytic

        return analytic.toss(scenario)
    import coin_mj

    return coin_mj.toss(scenario, realisation=coin_mj.Realisation(contact))
