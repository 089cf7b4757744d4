"""Mirror images of tosses, exact to the bit: space is mirrored in y = 0, the coin in η = 0 or ζ = 0.

R becomes S R M with S = diag(1, -1, 1) and M = diag(1, -1, 1) or diag(1, 1, -1): a proper rotation, whose
Euler parameters are those of R with other signs, or in another order.
"""

from enum import Enum
from typing import Any

import numpy as np

from cointoss.models.records import Outcome
from cointoss.models.scenario import Scenario

SPACE = np.array([1.0, -1.0, 1.0])
"""What becomes of the components of a vector in space."""
_SWAPPED = {Outcome.HEADS: Outcome.TAILS, Outcome.TAILS: Outcome.HEADS}


class Mirror(Enum):
    """The plane in which the coin is mirrored."""

    ETA = (1.0, -1.0, 1.0)
    """η = 0: heads stays heads."""
    ZETA = (1.0, 1.0, -1.0)
    """ζ = 0: heads becomes tails."""

    @property
    def body(self) -> np.ndarray:
        """What becomes of the components of a vector in the body."""
        return np.array(self.value)

    @property
    def signs(self) -> dict[str, Any]:
        """What becomes of columns of impacts."""
        in_space = ("impulse", "position", "velocity_before", "velocity_after", "contact_velocity_before")
        turning = ("angular_velocity_before", "angular_velocity_after")
        # An angular velocity is an axial vector: det M = -1.
        of_body = {"point": self.body} | dict.fromkeys(turning, -self.body)
        return dict.fromkeys(in_space, SPACE) | of_body | {"time": 1, "energy": 1, "energy_change": 1}

    def outcome(self, outcome: Outcome) -> Outcome:
        """Return what becomes of an outcome."""
        return _SWAPPED.get(outcome, outcome) if self is Mirror.ZETA else outcome

    def sequence(self, faces: str) -> str:
        """Return what becomes of a sequence of faces."""
        return faces.translate(str.maketrans("HT", "TH")) if self is Mirror.ZETA else faces

    def coin(self, coin: dict[str, Any]) -> dict[str, Any]:
        """Return the mirror image of a coin."""
        image, M = dict(coin), self.body
        if "center_of_mass" in coin:
            image["center_of_mass"] = (M * coin["center_of_mass"]).tolist()
        if "inertia" in coin:
            image["inertia"] = (np.outer(M, M) * coin["inertia"]).tolist()
        return image

    def release(self, release: dict[str, Any]) -> dict[str, Any]:
        """Return the mirror image of a release, its parts given in full."""
        e0, e1, e2, e3 = release["quaternion"]
        turned = [e0, -e1, e2, -e3] if self is Mirror.ETA else [e1, e0, -e3, -e2]
        # An angular velocity is an axial vector: det M = -1.
        return {
            "position": (SPACE * release["position"]).tolist(),
            "velocity": (SPACE * release["velocity"]).tolist(),
            "quaternion": turned,
            "angular_velocity": (-self.body * release["angular_velocity"]).tolist(),
        }

    def scenario(self, case: Scenario) -> Scenario:
        """Return the mirror image of a scenario."""
        parts = case.as_tables()
        release = parts["release"] | {"quaternion": case.release.attitude}
        return Scenario.checked(parts | {"coin": self.coin(parts["coin"]), "release": self.release(release)})
