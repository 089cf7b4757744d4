"""The engines by their names, imported only when they are used."""

from enum import StrEnum
from importlib.metadata import version

from models.outcomes import Outcomes
from models.records import Toss
from models.releases import Releases
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


def toss_many(engine: Engine, scenario: Scenario, releases: Releases, contact: str = "spring") -> Outcomes:
    """Toss a coin by one engine once from each release.

    Args:
        engine: which.
        scenario: what to toss; its own release is not used.
        releases: the states at time 0.
        contact: how MuJoCo realises the restitution, "spring" or "one_step".

    Raises:
        UnsupportedError: for what the engine doesn't model.
        ValueError: for a release that a scenario with this coin and air would refuse.
    """
    if engine is Engine.ANALYTIC:
        import analytic

        return analytic.toss_many(scenario, releases)
    import coin_mj

    return coin_mj.toss_many(scenario, releases, realisation=coin_mj.Realisation(contact))


def require_supported(engine: Engine, scenario: Scenario, contact: str = "spring") -> None:
    """Refuse what an engine doesn't model, before the first toss.

    Args:
        engine: which.
        scenario: what to toss.
        contact: how MuJoCo realises the restitution, "spring" or "one_step".

    Raises:
        UnsupportedError: naming field, value and what is accepted.
    """
    if engine is Engine.MUJOCO:
        from coin_mj import Realisation
        from coin_mj.toss import require_supported as require

        require(scenario, Realisation(contact))


def settings(engine: Engine, contact: str = "spring") -> dict[str, str | float]:
    """Give the settings with which an engine makes many tosses; another result may follow from others.

    Args:
        engine: which.
        contact: how MuJoCo realises the restitution, "spring" or "one_step".
    """
    if engine is Engine.ANALYTIC:
        from analytic.flight.equations_of_motion import TOLERANCE

        return {"tolerance": TOLERANCE}
    from coin_mj import MANY, Realisation

    resolved: dict[str, str | float] = (
        {"step": MANY.step}
        if Realisation(contact) is Realisation.ONE_STEP
        else {"stiffness": MANY.stiffness, "steps": MANY.steps}
    )
    return {
        "contact": contact,
        "friction": MANY.friction.value,
        **resolved,
        "flight_angle": MANY.flight_angle,
    }


def versions(engine: Engine) -> dict[str, str]:
    """Give the versions of what makes an engine's tosses."""
    packages = ["cointoss", "numba", "numpy", *(["mujoco"] if engine is Engine.MUJOCO else [])]
    return {package: version(package) for package in packages}
