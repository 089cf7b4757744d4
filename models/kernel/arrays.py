"""Arrays of numbers in compiled code."""

from cointoss.models.kernel.compiled import compiled


@compiled
def copy_into(target, source):
    """Copy as many numbers as `target` has from `source`, an array or a tuple.

    In compiled code `target[:] = source` costs seconds of compiling, for the text of an error.
    """
    for i in range(len(target)):
        target[i] = source[i]
