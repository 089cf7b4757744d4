"""Models of bodies with MuJoCo's settings for a bounce, and the recipe that gives them friction, too."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import mujoco

from cointoss_bounce.contact import ContactSettings

RECIPE = 'cone="elliptic" impratio="1e-6" noslip_iterations="20"'
"""Options with which a ball has restitution and Coulomb friction together."""
FLOOR = '<geom name="floor" type="plane" size="0 0 1"/>'
"""A plane, as an element of a model."""


def model_of(contact: ContactSettings, bodies: str, option: str = "", more: str = "") -> mujoco.MjModel:
    """Return the model of bodies that are stepped as a contact's settings say.

    Args:
        contact: the settings; the geoms have to name them themselves.
        bodies: elements of <worldbody>.
        option: further attributes of <option>.
        more: elements beside <worldbody>.
    """
    opening = contact.option.replace("<option ", f"<option {option} ")
    return mujoco.MjModel.from_xml_string(f"<mujoco>{opening}<worldbody>{bodies}</worldbody>{more}</mujoco>")


def rubbing_pair(contact: ContactSettings, one: str, two: str, friction: float) -> str:
    """Return a <pair> of geoms with the contact's settings and a friction that damps all slip in one step."""
    return (
        f'<pair geom1="{one}" geom2="{two}" condim="3" friction="{friction} {friction} 0 0 0" '
        f'{contact.geom} solreffriction="0 {-1 / contact.timestep!r}"/>'
    )


def sliding_ball(
    contact: ContactSettings, radius: float, friction: float, option: str = RECIPE
) -> mujoco.MjModel:
    """Return the model of a ball without weight and a plane that rub."""
    body = f'<body><freejoint/><geom name="ball" size="{radius}" mass="1"/></body>'
    pair = f"<contact>{rubbing_pair(contact, 'floor', 'ball', friction)}</contact>"
    return model_of(contact, FLOOR + body, f'gravity="0 0 0" {option}', pair)
