"""Four numbers side by side, which LLVM keeps in one vector: each is computed by itself."""

from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled

Four = tuple[float, float, float, float]
NONE: Four = (0.0, 0.0, 0.0, 0.0)


@compiled
def read_four(table: Array, row: int, column: int) -> Four:
    """Return four numbers of a row of a table, from this column on."""
    return table[row, column], table[row, column + 1], table[row, column + 2], table[row, column + 3]


@compiled
def write_four(table: Array, row: int, column: int, a: Four) -> None:
    """Set what `read_four` returns."""
    table[row, column], table[row, column + 1] = a[0], a[1]
    table[row, column + 2], table[row, column + 3] = a[2], a[3]


@compiled
def times(factor: float, a: Four) -> Four:
    """Return four numbers times a factor."""
    return factor * a[0], factor * a[1], factor * a[2], factor * a[3]


@compiled
def plus(a: Four, b: Four) -> Four:
    """Return a + b, of four numbers each."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]


@compiled
def minus(a: Four, b: Four) -> Four:
    """Return a - b, of four numbers each."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]


@compiled
def add_product(total: Four, a: Four, factor: float) -> Four:
    """Return a sum, (4,), with the product of four numbers and a factor added."""
    return (
        total[0] + a[0] * factor,
        total[1] + a[1] * factor,
        total[2] + a[2] * factor,
        total[3] + a[3] * factor,
    )


@compiled
def add_products(total: Four, a: Four, b: Four) -> Four:
    """Return a sum, (4,), with the products of four numbers and four others added."""
    return (
        total[0] + a[0] * b[0],
        total[1] + a[1] * b[1],
        total[2] + a[2] * b[2],
        total[3] + a[3] * b[3],
    )
