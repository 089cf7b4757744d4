"""Many tosses by the threads of a card: the engine's own code, lowered for its processors."""

import numpy as np

from cointoss.analytic.by_rows import NO_TRUST
from cointoss.analytic.entries import toss_apart
from cointoss.analytic.settings import ContactLimits
from cointoss.models.answers import NOT_TOSSED
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.base_folder import EngineMissingError
from cointoss.models.kernel.building import library_file
from cointoss.models.kernel.cuda import CardError, GraphicsCard
from cointoss.models.kernel.manifest import CUDA

SPACE, SPACE_OF_TRUST = 64 << 10, 1 << 20
"""Bytes of a thread's work space, without trust and with it; a toss that needs more is handed over."""


def toss_on_device(card: GraphicsCard, rows: Array, limits: ContactLimits, wanted: int, found: Array) -> None:
    """Toss rows on a card, each the same to the bit as by a processor.

    Args:
        card: the card.
        rows: of scenarios in vacuum or in air with b = 0, (n, m).
        limits: of sustained contact.
        wanted: `NO_TRUST`, `TRUST` or `CERTAIN`.
        found: where the answers go, (n, 7), see `cointoss.models.answers.ANSWER`. A toss that takes too long
            or needs more work space than a thread has is handed over to the caller: it is `NOT_TOSSED`.

    Raises:
        CardError: where the card fails, or there is no code for it.
    """
    space = SPACE if wanted == NO_TRUST else SPACE_OF_TRUST
    try:
        file = library_file(toss_apart.library.module, CUDA)
    except EngineMissingError as error:
        raise CardError(str(error)) from None
    numbers = toss_apart.numbers_of(rows[:1], found[:1], limits, wanted)
    card.work(file, numbers, rows, found, space)
    found[np.isnan(found[:, 0]), 0] = NOT_TOSSED
