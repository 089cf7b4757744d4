"""MuJoCo's contact settings in the words of engines that read no model of MuJoCo: Newton and Genesis."""

import math

from cointoss_bounce.contact import ContactSettings

FIRMEST = 0.999
"""The largest restitution of a spring of Genesis, whose damping ratio is positive."""


def newton_settings(contact: ContactSettings) -> str:
    """Return a contact's settings as attributes of a shape of Newton, which its SolverMuJoCo takes.

    The mode 1, SOLREF_MODE_RAW, passes the solref on. Without it `ShapeConfig.ke` and `kd` stand for a time
    constant of at least two steps.
    """
    solimp = ", ".join(contact.solimp.split())
    stiffness, damping = contact.solref
    return "\n".join(
        [
            "SolverMuJoCo.register_custom_attributes(builder)  # before the shapes are added",
            "custom_attributes={  # of one of the two shapes, as in builder.add_shape_sphere",
            f'    "mujoco:solref": ({stiffness!r}, {damping!r}), "mujoco:solref_mode": 1,',
            f'    "mujoco:geom_solimp": ({solimp}),',
            '    "mujoco:geom_priority": 1, "mujoco:condim": 1,',
            "}",
            f'SolverMuJoCo(model, integrator="{contact.integrator.lower()}")  # dt = {contact.timestep!r}',
        ]
    )


def genesis_settings(contact: ContactSettings) -> str:
    """Return a contact's settings as the sol_params of both geoms, which Genesis mixes by their mean.

    With -k and -b as solref MuJoCo has the stiffness k/d² and the damping b/d, d the impedance; with a time
    constant T and a damping ratio z it has 1/(d T z)² and 2/(d T). So T = 2/b and z = b/(2 √k).
    """
    stiffness, damping = (-number for number in contact.solref)
    constant, ratio = 2 / damping, damping / (2 * math.sqrt(stiffness))
    solimp = ", ".join(contact.solimp.split())
    return "\n".join(
        [
            f"sim_options=gs.options.SimOptions(dt={contact.timestep!r}, substeps=1)",
            f"rigid_options=gs.options.RigidOptions(integrator=gs.integrator.{contact.integrator})",
            "for geom in (*one.geoms, *two.geoms):  # of both entities",
            f"    geom.set_sol_params(({constant!r}, {ratio!r}, {solimp}))",
        ]
    )
