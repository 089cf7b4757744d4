"""The four models of the coin that Figs 18 to 23 release, and what they fall in."""

from cointoss import Air

MODELS = {
    "3D imperfect": "fig18_3d_imperfect",
    "3D ideal": "fig18_3d_ideal",
    "2D imperfect": "fig18_2d_imperfect",
    "2D ideal": "fig18_2d_ideal",
}
"""The scenarios of the models."""
MEDIA = {"vacuum": Air(), "air": Air(normal=0.8, tangential=0.2)}
