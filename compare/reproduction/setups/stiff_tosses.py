"""Many tosses by MuJoCo, each as stiff and as finely stepped as a single one."""

import coin_mj
from coin_mj import ContactSettings
from models.outcomes import Outcomes
from models.releases import Releases
from models.scenario import Scenario


def stiff_tosses(scenario: Scenario, releases: Releases) -> Outcomes:
    """Toss the coin once from each release by MuJoCo, with the contacts of `coin_mj.toss`.

    Those of `coin_mj.toss_many` are softer: faster, but their outcomes are less often those of an impact
    without duration.

    Args:
        scenario: what to toss; its own release is not used.
        releases: the states at time 0.
    """
    fine = ContactSettings()
    return coin_mj.toss_many(
        scenario, releases, stiffness=fine.stiffness, steps=fine.steps, flight_angle=fine.flight_angle
    )
