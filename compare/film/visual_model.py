"""The MuJoCo model to look at: a coin whose faces differ in colour, brightness and letter."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import mujoco

from cointoss.coin_mj.model.scene import described, shape_thickness
from cointoss.compare.output.style import LETTERS
from cointoss.models.scenario import Scenario


def build_visual_model(scenario: Scenario, *, extent: float, tile: float) -> mujoco.MjModel:
    """Build a model to look at: heads golden with a dark H, tails blue with a white T. It has no contacts.

    Args:
        scenario: what is tossed.
        extent: of the scene that the camera sees [m].
        tile: side of the floor's tiles [m].
    """
    spec = described(scenario, shape_thickness(scenario))
    r, half = scenario.coin.radius, shape_thickness(scenario) / 2
    spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    spec.stat.extent = extent
    # In extents: what is nearer to the camera, or farther, is not drawn.
    spec.visual.map.znear, spec.visual.map.zfar = min(0.01, r / extent), 20
    # What is not seen takes time: the sky, of which no camera sees anything, a map of shadows (see
    # `add_shadow`), and facets smaller than a pixel.
    spec.delete(spec.texture("sky"))
    spec.light("sun").castshadow = False
    spec.visual.quality.numslices, spec.visual.quality.numstacks = 48, 2
    spec.material("floor").texrepeat = (0.5 / tile, 0.5 / tile)
    body = spec.body("coin")
    skin = max(0.04 * half, 0.004 * r)
    for side, face, letter in ((1, "heads", "H"), (-1, "tails", "T")):
        z = side * max(half, skin)
        shapes = [
            body.add_geom(type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=(0.94 * r, skin, 0), material=face),
            *(
                body.add_geom(
                    type=mujoco.mjtGeom.mjGEOM_BOX,
                    size=(width * r, height * r, 2 * skin),
                    pos=(x * r, y * r, 0),
                    material=f"{face}_letter",
                )
                for x, y, width, height in LETTERS[letter]
            ),
        ]
        for geom in shapes:
            geom.pos[2] = z
            geom.contype, geom.conaffinity, geom.mass = 0, 0, 0
    return spec.compile()
