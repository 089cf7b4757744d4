"""The states in which hands release coins, of what is drawn for each."""

import math

from cointoss.models.attitude import quaternion_from_angles, quaternion_product, turn_by
from cointoss.models.geometry import tilt_sine_of
from cointoss.models.kernel.arrays import Table, copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, Vector, apply, dot, scale


@compiled
def tossed_states(J: Matrix, J_inverse: Matrix, draws: Table, tilts: Table, states: Table) -> None:
    """Write the states of coins that are tossed flat, or tilted from there.

    Args:
        J: inertia about C, body frame [kg m²].
        J_inverse: its inverse.
        draws: height [m], speed upwards [m/s] and spin [rad/s], ψ and the azimuth of L in the coin's frame
            [rad], and 1 where the other side is up, else 0, (n, 6).
        tilts: turns about x and y, with the angular momentum, by their length, (n, 2) [rad].
        states: where they go, (n, 13).
    """
    for i in range(len(draws)):
        psi, aside, turned = draws[i, 3], draws[i, 4], draws[i, 5]
        across = math.sin(psi)
        direction = (across * math.cos(aside), across * math.sin(aside), math.cos(psi))
        w = apply(J_inverse, scale(J[0][0] * draws[i, 2], direction))
        # The other side comes up by a half turn about ξ; the angular velocity in space stays.
        e, w = (1 - turned, turned, 0.0, 0.0), (w[0], (1 - 2 * turned) * w[1], (1 - 2 * turned) * w[2])
        e = quaternion_product(turn_by((tilts[i, 0], tilts[i, 1], 0.0)), e)
        copy_into(states[i], (0.0, 0.0, draws[i, 0], 0.0, 0.0, draws[i, 1], *e, *w))


@compiled
def spun_states(center: Vector, radius: float, thickness: float, draws: Table, states: Table) -> None:
    """Write the states of coins whose rim touches the floor, C at rest, turning about the vertical.

    Args:
        center: C from B, body frame [m].
        radius: r [m].
        thickness: h [m].
        draws: spin [rad/s], ψ and φ [rad], and 1 where the other side is up, else 0, (n, 4).
        states: where they go, (n, 13).
    """
    for i in range(len(draws)):
        phi, turned = draws[i, 2], draws[i, 3]
        psi = turned * math.pi + (1 - 2 * turned) * draws[i, 1]
        # The vertical in the body's frame, for angles 0, ψ, φ.
        up = (math.sin(psi) * math.sin(phi), math.sin(psi) * math.cos(phi), math.cos(psi))
        height = radius * tilt_sine_of(up) + thickness / 2 * abs(up[2]) + dot(up, center)
        e, w = quaternion_from_angles((0.0, psi, phi)), scale(draws[i, 0], up)
        copy_into(states[i], (0.0, 0.0, height, 0.0, 0.0, 0.0, *e, *w))
