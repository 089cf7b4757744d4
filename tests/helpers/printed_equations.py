"""The paper's equations of motion and impact as they are printed, slips and all.

Strzalko et al. 2008. Each function takes the symbols of its equation by name and gives the left side less the
right, or for an equation of motion the left side alone; they serve numbers and SymPy's symbols alike. Symbols
that an equation lacks are passed over.

Names: J_xi .. moments and J_xi_eta .. products of inertia; e0 .. Euler parameters, d0 .. their first and
dd0 .. their second derivatives; w_xi .. the angular velocity in the body frame and dw_xi .. its derivative.
In an impact w_xi_after, vx_after .. are those after it; S_x .. the impulse; xi_A .. the contact point.
"""


def eq_16(*, e0, e1, e2, e3, d0, d1, d2, d3, **_):
    """Give the rows of Ω_ξ by eq. (16); in the middle, where "asym." is printed, stands 0."""
    return [
        [0, 2 * (-d3 * e0 + d2 * e1 - d1 * e2 + d0 * e3), 2 * (d2 * e0 + d3 * e1 - d0 * e2 - d1 * e3)],
        [0, 0, 0],
        [2 * (d3 * e0 + d2 * e1 - d1 * e2 - d0 * e3), 0, 0],
    ]


def eq_17(*, e0, e1, e2, e3, d0, d1, d2, d3, **_):
    """Give ω_ξ, ω_η, ω_ζ by eq. (17)."""
    return [
        2 * (d1 * e0 - d0 * e1 - d3 * e2 + d2 * e3),
        2 * (d2 * e0 + d3 * e1 - d0 * e2 - d1 * e3),
        2 * (d3 * e0 - d2 * e1 + d1 * e2 - d0 * e3),
    ]


def eq_18(*, e0, e1, e2, e3, dd0, dd1, dd2, dd3, **_):
    """Give the derivatives of ω_ξ, ω_η, ω_ζ by eq. (18)."""
    return [
        2 * (-e1 * dd0 + e0 * dd1 + e3 * dd2 - e2 * dd3),
        2 * (-e2 * dd0 - e3 * dd1 + e0 * dd2 + e1 * dd3),
        2 * (-e3 * dd0 + e2 * dd1 - e1 * dd2 + e0 * dd3),
    ]


def eq_19(*, e0, e1, e2, e3, d0, d1, d2, d3, **_):
    """Give ω_x, ω_y, ω_z by eq. (19)."""
    return [
        2 * (d1 * e0 - d0 * e1 + d3 * e2 - d2 * e3),
        2 * (d2 * e0 - d3 * e1 - d0 * e2 + d1 * e3),
        2 * (d3 * e0 + d2 * e1 - d1 * e2 - d0 * e3),
    ]


def eq_26(
    *, J_eta, J_eta_zeta, J_xi, J_xi_eta, J_xi_zeta, J_zeta, dw_eta, dw_xi, dw_zeta, w_eta, w_xi, w_zeta, **_
):
    """Give the left side of eq. (26)."""
    return (
        J_xi * dw_xi
        + (J_zeta - J_eta) * w_eta * w_zeta
        - J_xi_zeta * dw_zeta
        - J_xi_eta * dw_eta
        + J_eta_zeta * (w_zeta**2 - w_eta**2)
        + (J_xi_eta * w_zeta - J_xi_zeta * w_eta) * w_xi
    )


def eq_27(
    *, J_eta, J_eta_zeta, J_xi, J_xi_eta, J_xi_zeta, J_zeta, dw_eta, dw_xi, dw_zeta, w_eta, w_xi, w_zeta, **_
):
    """Give the left side of eq. (27)."""
    return (
        J_eta * dw_eta
        + (J_xi - J_zeta) * w_xi * w_zeta
        - J_xi_eta * dw_xi
        - J_eta_zeta * dw_zeta
        + J_xi_zeta * (w_xi**2 - w_zeta**2)
        + (J_eta_zeta * w_xi - J_xi_eta * w_zeta) * w_eta
    )


def eq_28(
    *, J_eta, J_eta_zeta, J_xi, J_xi_eta, J_xi_zeta, J_zeta, dw_eta, dw_xi, dw_zeta, w_eta, w_xi, w_zeta, **_
):
    """Give the left side of eq. (28)."""
    return (
        J_zeta * dw_zeta
        + (J_eta - J_xi) * w_xi * w_eta
        - J_eta_zeta * dw_eta
        - J_xi_zeta * dw_xi
        + J_xi_eta * (w_eta**2 - w_xi**2)
        + (J_xi_zeta * w_eta - J_eta_zeta * w_xi) * w_zeta
    )


def eq_30(
    *,
    J_eta,
    J_eta_zeta,
    J_xi,
    J_xi_eta,
    J_xi_zeta,
    J_zeta,
    e0,
    e1,
    e2,
    e3,
    d0,
    d1,
    d2,
    d3,
    dd0,
    dd1,
    dd2,
    dd3,
    **_,
):
    """Give the left side of eq. (30)."""
    return 2 * (
        (-e1 * d0 + e0 * d1 + e3 * d2 - e2 * d3)
        * (
            2 * J_xi_eta * (-e3 * d0 + e2 * d1 - e1 * d2 + e0 * d3)
            + 2 * J_xi_zeta * (e2 * d0 + e3 * d1 - e0 * d2 - e1 * d3)
        )
        + (-e3 * d0 + e2 * d1 - e1 * d2 + e0 * d3)
        * (
            2 * J_eta_zeta * (-e3 * d0 + e2 * d1 - e1 * d2 + e0 * d3)
            + 2 * J_zeta * (-e2 * d0 - e3 * d1 + e0 * d2 + e1 * d3)
        )
        - (-e2 * d0 - e3 * d1 + e0 * d2 + e1 * d3)
        * (
            2 * J_eta * (-e3 * d0 + e2 * d1 - e1 * d2 + e0 * d3)
            + 2 * J_eta_zeta * (-e2 * d0 - e3 * d1 + e0 * d2 + e1 * d3)
        )
        + J_xi_zeta * (e3 * dd0 - e2 * dd1 + e1 * dd2 - e0 * dd3)
        + J_xi_eta * (e2 * dd0 + e3 * dd1 - e0 * dd2 - e1 * dd3)
        + J_xi * (-e1 * dd0 + e0 * dd1 + e3 * dd2 - e2 * dd3)
    )


def eq_31(
    *,
    J_eta,
    J_eta_zeta,
    J_xi,
    J_xi_eta,
    J_xi_zeta,
    J_zeta,
    e0,
    e1,
    e2,
    e3,
    d0,
    d1,
    d2,
    d3,
    dd0,
    dd1,
    dd2,
    dd3,
    **_,
):
    """Give the left side of eq. (31)."""
    return (
        4 * J_zeta * (e3 * d0 - e2 * d1 + e1 * d2 - e0 * d3) * (-e1 * d0 + e0 * d1 + e3 * d2 - e2 * d3)
        + 4 * J_xi * (-e3 * d0 + e2 * d1 - e1 * d2 + e0 * d3) * (-e1 * d0 + e0 * d1 + e3 * d2 - e2 * d3)
        + 4 * J_eta_zeta * (e2 * d0 + e3 * d1 - e0 * d2 - e1 * d3) * (e1 * d0 - e0 * d1 - e3 * d2 + e2 * d3)
        + J_xi_zeta
        * (
            -4 * (e3 * d0 - e2 * d1 + e1 * d2 - e0 * d3) ** 2
            + 4 * (e1 * d0 - e0 * d1 - e3 * d2 + e2 * d3) ** 2
        )
        + 2 * J_eta_zeta * (e3 * dd0 - e2 * dd1 + e1 * dd2 - e0 * dd3)
        + 2 * J_eta * (-e2 * dd0 - e3 * dd1 + e0 * dd2 + e1 * dd3)
        - 2
        * J_xi_eta
        * (
            2 * (e3 * d0 - e2 * d1 + e1 * d2 - e0 * d3) * (e2 * d0 + e3 * d1 - e0 * d2 - e1 * d3)
            - e1 * dd0
            + e0 * dd1
            + e3 * dd2
            - e2 * dd3
        )
    )


def eq_32(
    *,
    J_eta,
    J_eta_zeta,
    J_xi,
    J_xi_eta,
    J_xi_zeta,
    J_zeta,
    e0,
    e1,
    e2,
    e3,
    d0,
    d1,
    d2,
    d3,
    dd0,
    dd1,
    dd2,
    dd3,
    **_,
):
    """Give the left side of eq. (32)."""
    return 2 * (
        (-e2 * d0 - e3 * d1 + e0 * d2 + e1 * d3)
        * (
            2 * J_xi_eta * (-e2 * d0 - e3 * d1 + e0 * d2 + e1 * d3)
            + 2 * J_eta * (-e1 * d0 + e0 * d1 + e3 * d2 - e2 * d3)
        )
        - (-e1 * d0 + e0 * d1 + e3 * d2 - e2 * d3)
        * (
            2 * J_xi * (-e2 * d0 - e3 * d1 + e0 * d2 + e1 * d3)
            + 2 * J_xi_eta * (-e1 * d0 + e0 * d1 + e3 * d2 - e2 * d3)
        )
        + (-e3 * d0 + e2 * d1 - e1 * d2 + e0 * d3)
        * (
            2 * J_xi_zeta * (-e2 * d0 - e3 * d1 + e0 * d2 + e1 * d3)
            + 2 * J_eta_zeta * (e1 * d0 - e0 * d1 - e3 * d2 + e2 * d3)
        )
        + J_zeta * (-e3 * dd0 + e2 * dd1 - e1 * dd2 + e0 * dd3)
        + J_eta_zeta * (e2 * dd0 + e3 * dd1 - e0 * dd2 - e1 * dd3)
        + J_xi_zeta * (e1 * dd0 - e0 * dd1 - e3 * dd2 + e2 * dd3)
    )


def eq_33(*, e0, e1, e2, e3, d0, d1, d2, d3, dd0, dd1, dd2, dd3, **_):
    """Give the left side of eq. (33), whose right side is 0."""
    return d0**2 + d1**2 + d2**2 + d3**2 + e0 * dd0 + e1 * dd1 + e2 * dd2 + e3 * dd3


def eq_34(*, h, m, r, e0, e1, e2, e3, d0, d1, d2, d3, dd0, dd1, dd2, dd3, **_):
    """Give the left side of eq. (34)."""
    return 2 * (
        m * r**2 * (e3 * d0 - e2 * d1 + e1 * d2 - e0 * d3) * (e2 * d0 + e3 * d1 - e0 * d2 - e1 * d3)
        - (1 / 6)
        * m
        * (h**2 + 3 * r**2)
        * (e3 * d0 - e2 * d1 + e1 * d2 - e0 * d3)
        * (e2 * d0 + e3 * d1 - e0 * d2 - e1 * d3)
        - (1 / 12) * m * (h**2 + 3 * r**2) * (e1 * dd0 - e0 * dd1 - e3 * dd2 + e2 * dd3)
    )


def eq_35(*, h, m, r, e0, e1, e2, e3, d0, d1, d2, d3, dd0, dd1, dd2, dd3, **_):
    """Give the left side of eq. (35)."""
    return (
        (1 / 6)
        * m
        * (
            12 * r**2 * (e3 * d0 - e2 * d1 + e1 * d2 - e0 * d3) * (-e1 * d0 + e0 * d1 + e3 * d2 - e2 * d3)
            + 2
            * (h**2 + 3 * r**2)
            * (e3 * d0 - e2 * d1 + e1 * d2 - e0 * d3)
            * (e1 * d0 - e0 * d1 - e3 * d2 + e2 * d3)
            - (h**2 + 3 * r**2) * (e2 * dd0 + e3 * dd1 - e0 * dd2 - e1 * dd3)
        )
    )


def eq_36(*, h, m, r, e0, e1, e2, e3, d0, d1, d2, d3, dd0, dd1, dd2, dd3, **_):
    """Give the left side of eq. (36)."""
    return (
        (1 / 3)
        * m
        * (
            (h**2 + 3 * r**2)
            * (e3 * d0 - e2 * d1 + e1 * d2 - e0 * d3)
            * (e2 * d0 + e3 * d1 - e0 * d2 - e1 * d3)
            + (h**2 + 3 * r**2)
            * (e2 * d0 + e3 * d1 - e0 * d2 - e1 * d3)
            * (-e1 * d0 + e0 * d1 + e3 * d2 - e2 * d3)
            + 3 * r**2 * (-e3 * dd0 + e2 * dd1 - e1 * dd2 + e0 * dd3)
        )
    )


def eq_37(*, J_eta, J_xi, J_xi_eta, J_zeta, e0, e1, e2, e3, d0, d1, d2, d3, dd0, dd1, dd2, dd3, **_):
    """Give the left side of eq. (37)."""
    return (
        2
        * (
            2 * J_zeta * (-e3 * d0 + e2 * d1 - e1 * d2 + e0 * d3) * (-e2 * d0 - e3 * d1 + e0 * d2 + e1 * d3)
            - 2 * J_eta * (-e3 * d0 + e2 * d1 - e1 * d2 + e0 * d3) * (-e2 * d0 - e3 * d1 + e0 * d2 + e1 * d3)
        )
        + 2 * J_xi_eta * (-e3 * d0 + e2 * d1 - e1 * d2 + e0 * d3) * (-e1 * d0 + e0 * d1 + e3 * d2 - e2 * d3)
        + J_xi_eta * (e2 * dd0 + e3 * dd1 - e0 * dd2 - e1 * dd3)
        + J_xi * (-e1 * dd0 + e0 * dd1 + e3 * dd2 - e2 * dd3)
    )


def eq_38(*, J_eta, J_xi, J_xi_eta, J_zeta, e0, e1, e2, e3, d0, d1, d2, d3, dd0, dd1, dd2, dd3, **_):
    """Give the left side of eq. (38)."""
    return (
        4 * J_zeta * (e3 * d0 - e2 * d1 + e1 * d2 - e0 * d3) * (-e1 * d0 + e0 * d1 + e3 * d2 - e2 * d3)
        + 4 * J_xi * (-e3 * d0 + e2 * d1 - e1 * d2 + e0 * d3) * (-e1 * d0 + e0 * d1 + e3 * d2 - e2 * d3)
        + 2 * J_eta * (-e2 * dd0 - e3 * dd1 + e0 * dd2 + e1 * dd3)
        - 2
        * J_xi_eta
        * (
            2 * (e3 * d0 - e2 * d1 + e1 * d2 - e0 * d3) * (e2 * d0 + e3 * d1 - e0 * d2 - e1 * d3)
            - e1 * d0
            + e0 * d1
            + e3 * d2
            - e2 * d3
        )
    )


def eq_39(*, J_eta, J_xi, J_xi_eta, J_zeta, e0, e1, e2, e3, d0, d1, d2, d3, dd0, dd1, dd2, dd3, **_):
    """Give the left side of eq. (39)."""
    return (
        4 * J_eta * (e3 * d0 - e2 * d1 + e1 * d2 - e0 * d3) * (e2 * d0 + e3 * d1 - e0 * d2 - e1 * d3)
        + 4 * J_xi_eta * (e2 * d0 + e3 * d1 - e0 * d2 - e1 * d3) ** 2
        + 4 * J_xi_eta * (e3 * d0 - e2 * d1 + e1 * d2 - e0 * d3) * (-e1 * d0 + e0 * d1 + e3 * d2 - e2 * d3)
        + 4 * J_xi * (e2 * d0 + e3 * d1 - e0 * d2 - e1 * d3) * (-e1 * d0 + e0 * d1 + e3 * d2 - e2 * d3)
        + 2 * J_zeta * (-e3 * dd0 + e2 * dd1 - e1 * dd2 + e0 * dd3)
    )


def eq_41(*, J_xi, e0, e1, e2, e3, dd0, dd1, dd2, dd3, **_):
    """Give the left side of eq. (41)."""
    return 2 * J_xi * (-e1 * dd0 + e0 * dd1 + e3 * dd2 - e2 * dd3)


def eq_42(*, J_xi_eta, e0, e1, e2, e3, d0, d1, d2, d3, **_):
    """Give the left side of eq. (42)."""
    return -2 * J_xi_eta * (-e1 * d0 + e0 * d1 + e3 * d2 - e2 * d3)


def eq_43(*, J_xi_eta, e0, e1, e2, e3, d0, d1, d2, d3, **_):
    """Give the left side of eq. (43)."""
    return -4 * J_xi_eta * (e1 * d0 - e0 * d1 - e3 * d2 + e2 * d3) ** 2


def eq_86(
    *,
    e0,
    e1,
    e2,
    e3,
    chi,
    eta_A,
    vz,
    vz_after,
    w_eta,
    w_eta_after,
    w_xi,
    w_xi_after,
    w_zeta,
    w_zeta_after,
    xi_A,
    zeta_A,
    **_,
):
    """Give eq. (86), left side less right."""
    return (
        (2 * e0**2 + 2 * e3**2 - 1) * (w_xi_after * eta_A - w_eta_after * xi_A)
        + (2 * e0 * e1 + 2 * e2 * e3) * (w_zeta_after * xi_A - w_xi_after * zeta_A)
        + (2 * e1 * e3 - 2 * e0 * e2) * (w_eta_after * zeta_A - w_zeta_after * eta_A)
        + vz_after
        - (
            -chi
            * (
                (2 * e0**2 + 2 * e3**2 - 1) * (w_xi * eta_A - w_eta * xi_A)
                + (2 * e0 * e1 + 2 * e2 * e3) * (w_zeta * xi_A - w_xi * zeta_A)
                + (2 * e1 * e3 - 2 * e0 * e2) * (w_eta * zeta_A - w_zeta * eta_A)
                + vz
            )
        )
    )


def eq_88(
    *,
    J_xi,
    J_xi_eta,
    J_xi_zeta,
    e0,
    e1,
    e2,
    e3,
    S_x,
    S_y,
    S_z,
    eta_A,
    w_eta,
    w_eta_after,
    w_xi,
    w_xi_after,
    w_zeta,
    w_zeta_after,
    zeta_A,
    **_,
):
    """Give eq. (88), left side less right."""
    return (
        2 * zeta_A * S_y * e0**2
        - 2 * eta_A * S_z * e0**2
        - 2 * e2 * eta_A * S_x * e0
        - 2 * e3 * zeta_A * S_x * e0
        + 2 * e1 * eta_A * S_y * e0
        + 2 * e1 * zeta_A * S_z * e0
        + J_xi * w_xi_after
        - J_xi_eta * w_eta_after
        - J_xi_zeta * w_zeta_after
        - 2 * e1 * e3 * eta_A * S_x
        + 2 * e1 * e2 * zeta_A * S_x
        - 2 * e2 * e3 * eta_A * S_y
        + 2 * e2**2 * zeta_A * S_y
        - zeta_A * S_y
        - 2 * e3**2 * eta_A * S_z
        + eta_A * S_z
        + 2 * e2 * e3 * zeta_A * S_z
        - (J_xi * w_xi - J_xi_eta * w_eta - J_xi_zeta * w_zeta)
    )


def eq_89(
    *,
    J_eta,
    J_eta_zeta,
    J_xi_eta,
    e0,
    e1,
    e2,
    e3,
    S_x,
    S_y,
    S_z,
    w_eta,
    w_eta_after,
    w_xi,
    w_xi_after,
    w_zeta,
    w_zeta_after,
    xi_A,
    zeta_A,
    **_,
):
    """Give eq. (89), left side less right."""
    return (
        -2 * zeta_A * S_x * e0**2
        + 2 * xi_A * S_z * e0**2
        + 2 * e2 * xi_A * S_x * e0
        - 2 * e1 * xi_A * S_y * e0
        - 2 * e3 * zeta_A * S_y * e0
        + 2 * e2 * zeta_A * S_z * e0
        - J_xi_eta * w_xi_after
        + J_eta * w_eta_after
        - J_eta_zeta * w_zeta_after
        + 2 * e1 * e3 * xi_A * S_x
        - 2 * e1**2 * zeta_A * S_x
        + zeta_A * S_x
        + 2 * e2 * e3 * xi_A * S_y
        - 2 * e1 * e2 * zeta_A * S_y
        + 2 * e3**2 * xi_A * S_z
        - xi_A * S_z
        - 2 * e1 * e3 * zeta_A * S_z
        - (-J_xi_eta * w_xi + J_eta * w_eta - J_eta_zeta * w_zeta)
    )


def eq_90(
    *,
    J_eta_xi,
    J_xi_xi,
    J_zeta_xi,
    e0,
    e1,
    e2,
    e3,
    S_x,
    S_y,
    S_z,
    eta_A,
    w_eta,
    w_eta_after,
    w_xi,
    w_xi_after,
    w_zeta,
    w_zeta_after,
    xi_A,
    **_,
):
    """Give eq. (90), left side less right."""
    return (
        2 * eta_A * S_x * e0**2
        - 2 * xi_A * S_y * e0**2
        + 2 * e3 * xi_A * S_x * e0
        + 2 * e3 * eta_A * S_y * e0
        - 2 * e1 * xi_A * S_z * e0
        - 2 * e2 * eta_A * S_z * e0
        - J_xi_xi * w_xi_after
        - J_eta_xi * w_eta_after
        + J_zeta_xi * w_zeta_after
        - 2 * e1 * e2 * xi_A * S_x
        + 2 * e1**2 * eta_A * S_x
        - eta_A * S_x
        - 2 * e2**2 * xi_A * S_y
        + xi_A * S_y
        + 2 * e1 * e2 * eta_A * S_y
        - 2 * e2 * e3 * xi_A * S_z
        + 2 * e1 * e3 * eta_A * S_z
        - (-J_xi_xi * w_xi - J_eta_xi * w_eta + J_zeta_xi * w_zeta)
    )


def eq_91(*, e0, e1, e2, e3, eta_A, vx_after, w_eta_after, w_xi_after, w_zeta_after, xi_A, zeta_A, **_):
    """Give eq. (91), left side less right."""
    return (
        (2 * e0 * e2 + 2 * e1 * e3) * (w_xi_after * eta_A - w_eta_after * xi_A)
        + (2 * e1 * e2 - 2 * e0 * e3) * (w_zeta_after * xi_A - w_xi_after * zeta_A)
        + (2 * e0**2 + 2 * e1**2 - 1) * (w_eta_after * zeta_A - w_zeta_after * eta_A)
        + vx_after
    )


def eq_92(*, e0, e1, e2, e3, eta_A, vy_after, w_eta_after, w_xi_after, w_zeta_after, xi_A, zeta_A, **_):
    """Give eq. (92), left side less right."""
    return (
        (2 * e2 * e3 - 2 * e0 * e1) * (w_xi_after * eta_A - w_eta_after * xi_A)
        + (2 * e0**2 + 2 * e2**2 - 1) * (w_zeta_after * xi_A - w_xi_after * zeta_A)
        + (2 * e1 * e2 + 2 * e0 * e3) * (w_eta_after * zeta_A - w_zeta_after * eta_A)
        + vy_after
    )


def eq_93(
    *,
    e0,
    e1,
    e2,
    e3,
    chi,
    eta_A,
    vz,
    vz_after,
    w_eta,
    w_eta_after,
    w_xi,
    w_xi_after,
    w_zeta,
    w_zeta_after,
    xi_A,
    zeta_A,
    **_,
):
    """Give eq. (93), left side less right."""
    return (
        (2 * e0**2 + 2 * e3**2 - 1) * (w_xi_after * eta_A - w_eta_after * xi_A)
        + (2 * e0 * e1 + 2 * e2 * e3) * (w_zeta_after * xi_A - w_xi_after * zeta_A)
        + (2 * e1 * e3 - 2 * e0 * e2) * (w_eta_after * zeta_A - w_zeta_after * eta_A)
        + vz_after
        - (
            -chi
            * (
                (2 * e0**2 + 2 * e3**2 - 1) * (w_xi * eta_A - w_eta * xi_A)
                + (2 * e0 * e1 + 2 * e2 * e3) * (w_zeta * xi_A - w_xi * zeta_A)
                + (2 * e1 * e3 - 2 * e0 * e2) * (w_eta * zeta_A - w_zeta * eta_A)
                + vz
            )
        )
    )


def eq_95(*, J_xi, e0, e1, e2, e3, S_z, eta_A, w_xi, w_xi_after, zeta_A, **_):
    """Give eq. (95), left side less right."""
    return (
        J_xi * w_xi_after
        + (-2 * eta_A * e0**2 + 2 * e1 * zeta_A * e0 - 2 * e3**2 * eta_A + eta_A + 2 * e2 * e3 * zeta_A) * S_z
        - (J_xi * w_xi)
    )


def eq_96(*, J_eta, e0, e1, e2, e3, S_z, w_eta, w_eta_after, xi_A, zeta_A, **_):
    """Give eq. (96), left side less right."""
    return (
        J_eta * w_eta_after
        + (2 * xi_A * e0**2 + 2 * e2 * zeta_A * e0 + 2 * e3**2 * xi_A - xi_A - 2 * e1 * e3 * zeta_A) * S_z
        - (J_eta * w_eta)
    )


def eq_97(*, J_zeta, e0, e1, e2, e3, S_z, eta_A, w_zeta, w_zeta_after, xi_A, **_):
    """Give eq. (97), left side less right."""
    return (
        J_zeta * w_zeta_after
        + (-2 * e1 * xi_A * e0 - 2 * e2 * eta_A * e0 - 2 * e2 * e3 * xi_A + 2 * e1 * e3 * eta_A) * S_z
        - (J_zeta * w_zeta)
    )
