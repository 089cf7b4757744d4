"""The four models of the coin that Figs 18 to 23 release, and what they fall in."""

from cointoss import Air
from cointoss.study import BLUE, GREEN, SKY, VERMILION

MODELS = {
    "3D imperfect": ("fig18_3d_imperfect", GREEN),
    "3D ideal": ("fig18_3d_ideal", BLUE),
    "2D imperfect": ("fig18_2d_imperfect", SKY),
    "2D ideal": ("fig18_2d_ideal", VERMILION),
}
"""The scenarios of the models, and their colours."""
MEDIA = {"vacuum": Air(), "air": Air(normal=0.8, tangential=0.2)}
