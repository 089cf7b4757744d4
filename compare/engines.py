"""The engines by their names, imported only when they are used."""

from enum import StrEnum
from importlib.metadata import version

import numpy as np

from models.outcomes import Outcomes
from models.records import Toss
from models.releases import Releases
from models.scenario import Release, Scenario, euler_parameters, vector


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


def toss_many(engine: Engine, scenario: Scenario, releases: Releases) -> Outcomes:
    """Toss a coin by one engine once from each release.

    Args:
        engine: which.
        scenario: what to toss; its own release is not used.
        releases: the states at time 0.

    Raises:
        UnsupportedError: for what the engine doesn't model.
        ValueError: for a release that a scenario with this coin and air would refuse.
    """
    if engine is Engine.ANALYTIC:
        import analytic

        return analytic.toss_many(scenario, releases)
    return _toss_each_in_mujoco(scenario, releases)


def _toss_each_in_mujoco(scenario: Scenario, releases: Releases) -> Outcomes:
    import coin_mj

    tosses = [
        coin_mj.toss(
            scenario.model_copy(
                update={
                    "release": Release(
                        position=vector(releases.position[i]),
                        velocity=vector(releases.velocity[i]),
                        quaternion=euler_parameters(releases.quaternion[i]),
                        angular_velocity=vector(releases.angular_velocity[i]),
                    )
                }
            )
        )
        for i in range(len(releases))
    ]
    faces = [toss.impacts.face[-1] if len(toss.impacts) else 0 for toss in tosses]
    return Outcomes(
        outcome=np.array([toss.outcome for toss in tosses], dtype=np.int8),
        ending=np.array([toss.ending for toss in tosses], dtype=np.int8),
        impacts=np.array([len(toss.impacts) for toss in tosses], dtype=np.int32),
        last_face=np.array(faces, dtype=np.int8),
        end_time=np.array([toss.end_time for toss in tosses], dtype=float),
    )


def require_supported(engine: Engine, scenario: Scenario) -> None:
    """Refuse what an engine doesn't model, before the first toss.

    Raises:
        UnsupportedError: naming field, value and what is accepted.
    """
    if engine is Engine.MUJOCO:
        from coin_mj import Realisation
        from coin_mj.toss import require_supported as require

        require(scenario, Realisation.SPRING)


def settings(engine: Engine) -> dict[str, str | float]:
    """Give the settings with which an engine makes many tosses; another result may follow from others."""
    if engine is Engine.ANALYTIC:
        from analytic.flight import TOLERANCE

        return {"tolerance": TOLERANCE}
    from coin_mj import ContactSettings

    contact = ContactSettings()
    return {
        "contact": contact.realisation.value,
        "friction": contact.friction.value,
        "stiffness": contact.stiffness,
        "steps": contact.steps,
    }


def versions(engine: Engine) -> dict[str, str]:
    """Give the versions of what makes an engine's tosses."""
    packages = ["cointoss", "numba", "numpy", *(["mujoco"] if engine is Engine.MUJOCO else [])]
    return {package: version(package) for package in packages}
