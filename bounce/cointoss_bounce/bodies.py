"""The body that comes down on a plane in a measurement, and the model of both."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from dataclasses import dataclass
from math import isfinite

import mujoco

from cointoss_bounce.contact import ContactSettings
from cointoss_bounce.errors import FieldError

MODEL = """<mujoco>
  {option}
  <worldbody>
    <geom type="plane" size="0 0 1" condim="1"/>
    <body pos="0 0 {height!r}">
      <freejoint/>
      <geom type="{kind}" size="{size}" mass="{mass!r}" condim="1" priority="1"
            {contact}/>
    </body>
  </worldbody>
</mujoco>"""
"""A body over a plane."""
SIZES = {"sphere": 1, "box": 3, "cylinder": 2, "capsule": 2, "ellipsoid": 3}
"""The number of numbers in the size of each type."""
ACCEPTED = (
    "a type and its size [m] as in a <geom>, such as sphere 0.1, box 0.1 0.1 0.002, cylinder 0.05 0.001, "
    "capsule 0.02 0.1 or ellipsoid 0.1 0.1 0.05"
)


@dataclass(frozen=True)
class FlatBody:
    """A body that comes down flat, by its type and size in a <geom>."""

    kind: str
    size: tuple[float, ...]
    """The size in MuJoCo's order: radius, or half sizes [m]."""
    mass: float = 0.01
    """[kg]."""

    @property
    def height(self) -> float:
        """The height of the body's middle where it touches [m]."""
        return sum(self.size) if self.kind == "capsule" else self.size[-1]

    @property
    def thinnest(self) -> float:
        """Half of the body's thickness where it is thinnest [m]."""
        return self.size[0] if self.kind == "capsule" else min(self.size)

    def model(self, contact: ContactSettings, height: float) -> str:
        """Return the model of the body that starts at a height over a plane [m]."""
        return MODEL.format(
            option=contact.option,
            height=height,
            kind=self.kind,
            mass=float(self.mass),
            size=" ".join(f"{number!r}" for number in self.size),
            contact=contact.geom,
        )

    def compiled(self, contact: ContactSettings, height: float) -> mujoco.MjModel:
        """Return that model, compiled."""
        return mujoco.MjModel.from_xml_string(self.model(contact, height))

    def __str__(self) -> str:
        """Return it as it is given."""
        return " ".join([self.kind, *(f"{number:g}" for number in self.size)])


BALL = FlatBody("sphere", (0.01,))


def body_of(text: str | None, mass: float = BALL.mass) -> FlatBody:
    """Return the body that a text such as "box 0.1 0.1 0.002" describes.

    Args:
        text: type and size; None for a ball of 1 cm.
        mass: [kg].

    Raises:
        FieldError: naming the text and what is accepted.
    """
    kind, *numbers = str(BALL if text is None else text).split() or [""]
    try:
        size = tuple(float(number) for number in numbers)
    except ValueError:
        size = ()
    fits = len(size) == SIZES.get(kind, -1) and all(isfinite(n) and 1e-6 <= n <= 1e3 for n in size)
    if not fits:
        raise FieldError("body", text, ACCEPTED)
    return FlatBody(kind, size, mass)
