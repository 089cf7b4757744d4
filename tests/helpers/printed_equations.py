"""The paper's equations of motion and impact as they are printed, slips and all.

Strzalko et al. 2008. Each is text that gives the left side less the right, or for an equation of motion the
left side alone, and serves numbers and SymPy's symbols alike.

Names: J_xi .. moments and J_xi_eta .. products of inertia; e0 .. Euler parameters, d0 .. their first and
dd0 .. their second derivatives; w_xi .. the angular velocity in the body frame and dw_xi .. its derivative.
In an impact w_xi_after, vx_after .. are those after it; S_x .. the impulse; xi_A .. the contact point.
"""

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Equation:
    """A formula by its number."""

    name: str
    text: str

    def __call__(self, **symbols: Any) -> Any:
        """Return its value; symbols that it lacks are passed over."""
        return eval(self.text, {}, symbols)

    def corrected(self, *changes: tuple[str, str]) -> "Equation":
        """Return it with parts of its text replaced, wherever they stand."""
        text = self.text
        for printed, meant in changes:
            assert printed in text
            text = text.replace(printed, meant)
        return Equation(f"corrected {self.name}", text)


_TEXTS = {
    # The rows of Ω_ξ; in the middle, where "asym." is printed, stands 0.
    16: """
        [[0, 2*(-d3*e0 + d2*e1 - d1*e2 + d0*e3), 2*(d2*e0 + d3*e1 - d0*e2 - d1*e3)], [0, 0, 0],
        [2*(d3*e0 + d2*e1 - d1*e2 - d0*e3), 0, 0]]
    """,
    # ω_ξ, ω_η, ω_ζ; their derivatives; ω_x, ω_y, ω_z.
    17: """
        [2*(d1*e0 - d0*e1 - d3*e2 + d2*e3), 2*(d2*e0 + d3*e1 - d0*e2 - d1*e3),
        2*(d3*e0 - d2*e1 + d1*e2 - d0*e3)]
    """,
    18: """
        [2*(-e1*dd0 + e0*dd1 + e3*dd2 - e2*dd3), 2*(-e2*dd0 - e3*dd1 + e0*dd2 + e1*dd3),
        2*(-e3*dd0 + e2*dd1 - e1*dd2 + e0*dd3)]
    """,
    19: """
        [2*(d1*e0 - d0*e1 + d3*e2 - d2*e3), 2*(d2*e0 - d3*e1 - d0*e2 + d1*e3),
        2*(d3*e0 + d2*e1 - d1*e2 - d0*e3)]
    """,
    # Left sides of equations of motion; the right side of (33) is 0.
    26: """
        J_xi*dw_xi + (J_zeta - J_eta)*w_eta*w_zeta - J_xi_zeta*dw_zeta - J_xi_eta*dw_eta
        + J_eta_zeta*(w_zeta**2 - w_eta**2) + (J_xi_eta*w_zeta - J_xi_zeta*w_eta)*w_xi
    """,
    27: """
        J_eta*dw_eta + (J_xi - J_zeta)*w_xi*w_zeta - J_xi_eta*dw_xi - J_eta_zeta*dw_zeta
        + J_xi_zeta*(w_xi**2 - w_zeta**2) + (J_eta_zeta*w_xi - J_xi_eta*w_zeta)*w_eta
    """,
    28: """
        J_zeta*dw_zeta + (J_eta - J_xi)*w_xi*w_eta - J_eta_zeta*dw_eta - J_xi_zeta*dw_xi
        + J_xi_eta*(w_eta**2 - w_xi**2) + (J_xi_zeta*w_eta - J_eta_zeta*w_xi)*w_zeta
    """,
    30: """
        2*((-e1*d0 + e0*d1 + e3*d2 - e2*d3)*(2*J_xi_eta*(-e3*d0 + e2*d1 - e1*d2 + e0*d3)
        + 2*J_xi_zeta*(e2*d0 + e3*d1 - e0*d2 - e1*d3)) + (-e3*d0 + e2*d1 - e1*d2 + e0*d3)
        *(2*J_eta_zeta*(-e3*d0 + e2*d1 - e1*d2 + e0*d3) + 2*J_zeta*(-e2*d0 - e3*d1 + e0*d2 + e1*d3))
        - (-e2*d0 - e3*d1 + e0*d2 + e1*d3)*(2*J_eta*(-e3*d0 + e2*d1 - e1*d2 + e0*d3)
        + 2*J_eta_zeta*(-e2*d0 - e3*d1 + e0*d2 + e1*d3)) + J_xi_zeta*(e3*dd0 - e2*dd1 + e1*dd2 - e0*dd3)
        + J_xi_eta*(e2*dd0 + e3*dd1 - e0*dd2 - e1*dd3) + J_xi*(-e1*dd0 + e0*dd1 + e3*dd2 - e2*dd3))
    """,
    31: """
        4*J_zeta*(e3*d0 - e2*d1 + e1*d2 - e0*d3)*(-e1*d0 + e0*d1 + e3*d2 - e2*d3) + 4*J_xi*(-e3*d0 + e2*d1
        - e1*d2 + e0*d3)*(-e1*d0 + e0*d1 + e3*d2 - e2*d3) + 4*J_eta_zeta*(e2*d0 + e3*d1 - e0*d2 - e1*d3)
        *(e1*d0 - e0*d1 - e3*d2 + e2*d3) + J_xi_zeta*(-4*(e3*d0 - e2*d1 + e1*d2 - e0*d3)**2
        + 4*(e1*d0 - e0*d1 - e3*d2 + e2*d3)**2) + 2*J_eta_zeta*(e3*dd0 - e2*dd1 + e1*dd2 - e0*dd3)
        + 2*J_eta*(-e2*dd0 - e3*dd1 + e0*dd2 + e1*dd3)
        - 2*J_xi_eta*(2*(e3*d0 - e2*d1 + e1*d2 - e0*d3)*(e2*d0 + e3*d1 - e0*d2 - e1*d3) - e1*dd0 + e0*dd1
        + e3*dd2 - e2*dd3)
    """,
    32: """
        2*((-e2*d0 - e3*d1 + e0*d2 + e1*d3)*(2*J_xi_eta*(-e2*d0 - e3*d1 + e0*d2 + e1*d3)
        + 2*J_eta*(-e1*d0 + e0*d1 + e3*d2 - e2*d3)) - (-e1*d0 + e0*d1 + e3*d2 - e2*d3)
        *(2*J_xi*(-e2*d0 - e3*d1 + e0*d2 + e1*d3) + 2*J_xi_eta*(-e1*d0 + e0*d1 + e3*d2 - e2*d3)) + (-e3*d0
        + e2*d1 - e1*d2 + e0*d3)*(2*J_xi_zeta*(-e2*d0 - e3*d1 + e0*d2 + e1*d3)
        + 2*J_eta_zeta*(e1*d0 - e0*d1 - e3*d2 + e2*d3)) + J_zeta*(-e3*dd0 + e2*dd1 - e1*dd2 + e0*dd3)
        + J_eta_zeta*(e2*dd0 + e3*dd1 - e0*dd2 - e1*dd3) + J_xi_zeta*(e1*dd0 - e0*dd1 - e3*dd2 + e2*dd3))
    """,
    33: "d0**2 + d1**2 + d2**2 + d3**2 + e0*dd0 + e1*dd1 + e2*dd2 + e3*dd3",
    34: """
        2*(m*r**2*(e3*d0 - e2*d1 + e1*d2 - e0*d3)*(e2*d0 + e3*d1 - e0*d2 - e1*d3)
        - 1/6*m*(h**2 + 3*r**2)*(e3*d0 - e2*d1 + e1*d2 - e0*d3)*(e2*d0 + e3*d1 - e0*d2 - e1*d3)
        - 1/12*m*(h**2 + 3*r**2)*(e1*dd0 - e0*dd1 - e3*dd2 + e2*dd3))
    """,
    35: """
        1/6*m*(12*r**2*(e3*d0 - e2*d1 + e1*d2 - e0*d3)*(-e1*d0 + e0*d1 + e3*d2 - e2*d3)
        + 2*(h**2 + 3*r**2)*(e3*d0 - e2*d1 + e1*d2 - e0*d3)*(e1*d0 - e0*d1 - e3*d2 + e2*d3)
        - (h**2 + 3*r**2)*(e2*dd0 + e3*dd1 - e0*dd2 - e1*dd3))
    """,
    36: """
        1/3*m*((h**2 + 3*r**2)*(e3*d0 - e2*d1 + e1*d2 - e0*d3)*(e2*d0 + e3*d1 - e0*d2 - e1*d3)
        + (h**2 + 3*r**2)*(e2*d0 + e3*d1 - e0*d2 - e1*d3)*(-e1*d0 + e0*d1 + e3*d2 - e2*d3)
        + 3*r**2*(-e3*dd0 + e2*dd1 - e1*dd2 + e0*dd3))
    """,
    37: """
        2*(2*J_zeta*(-e3*d0 + e2*d1 - e1*d2 + e0*d3)*(-e2*d0 - e3*d1 + e0*d2 + e1*d3)
        - 2*J_eta*(-e3*d0 + e2*d1 - e1*d2 + e0*d3)*(-e2*d0 - e3*d1 + e0*d2 + e1*d3)) + 2*J_xi_eta*(-e3*d0
        + e2*d1 - e1*d2 + e0*d3)*(-e1*d0 + e0*d1 + e3*d2 - e2*d3) + J_xi_eta*(e2*dd0 + e3*dd1 - e0*dd2
        - e1*dd3) + J_xi*(-e1*dd0 + e0*dd1 + e3*dd2 - e2*dd3)
    """,
    38: """
        4*J_zeta*(e3*d0 - e2*d1 + e1*d2 - e0*d3)*(-e1*d0 + e0*d1 + e3*d2 - e2*d3) + 4*J_xi*(-e3*d0 + e2*d1
        - e1*d2 + e0*d3)*(-e1*d0 + e0*d1 + e3*d2 - e2*d3) + 2*J_eta*(-e2*dd0 - e3*dd1 + e0*dd2 + e1*dd3)
        - 2*J_xi_eta*(2*(e3*d0 - e2*d1 + e1*d2 - e0*d3)*(e2*d0 + e3*d1 - e0*d2 - e1*d3) - e1*d0 + e0*d1
        + e3*d2 - e2*d3)
    """,
    39: """
        4*J_eta*(e3*d0 - e2*d1 + e1*d2 - e0*d3)*(e2*d0 + e3*d1 - e0*d2 - e1*d3)
        + 4*J_xi_eta*(e2*d0 + e3*d1 - e0*d2 - e1*d3)**2 + 4*J_xi_eta*(e3*d0 - e2*d1 + e1*d2 - e0*d3)
        *(-e1*d0 + e0*d1 + e3*d2 - e2*d3) + 4*J_xi*(e2*d0 + e3*d1 - e0*d2 - e1*d3)
        *(-e1*d0 + e0*d1 + e3*d2 - e2*d3) + 2*J_zeta*(-e3*dd0 + e2*dd1 - e1*dd2 + e0*dd3)
    """,
    41: "2*J_xi*(-e1*dd0 + e0*dd1 + e3*dd2 - e2*dd3)",
    42: "-2*J_xi_eta*(-e1*d0 + e0*d1 + e3*d2 - e2*d3)",
    43: "-4*J_xi_eta*(e1*d0 - e0*d1 - e3*d2 + e2*d3)**2",
    # Of impact, left side less right.
    86: """
        (2*e0**2 + 2*e3**2 - 1)*(w_xi_after*eta_A - w_eta_after*xi_A) + (2*e0*e1 + 2*e2*e3)
        *(w_zeta_after*xi_A - w_xi_after*zeta_A) + (2*e1*e3 - 2*e0*e2)*(w_eta_after*zeta_A
        - w_zeta_after*eta_A) + vz_after - (-chi)*((2*e0**2 + 2*e3**2 - 1)*(w_xi*eta_A - w_eta*xi_A)
        + (2*e0*e1 + 2*e2*e3)*(w_zeta*xi_A - w_xi*zeta_A)
        + (2*e1*e3 - 2*e0*e2)*(w_eta*zeta_A - w_zeta*eta_A) + vz)
    """,
    88: """
        2*zeta_A*S_y*e0**2 - 2*eta_A*S_z*e0**2 - 2*e2*eta_A*S_x*e0 - 2*e3*zeta_A*S_x*e0 + 2*e1*eta_A*S_y*e0
        + 2*e1*zeta_A*S_z*e0 + J_xi*w_xi_after - J_xi_eta*w_eta_after - J_xi_zeta*w_zeta_after
        - 2*e1*e3*eta_A*S_x + 2*e1*e2*zeta_A*S_x - 2*e2*e3*eta_A*S_y + 2*e2**2*zeta_A*S_y - zeta_A*S_y
        - 2*e3**2*eta_A*S_z + eta_A*S_z + 2*e2*e3*zeta_A*S_z
        - (J_xi*w_xi - J_xi_eta*w_eta - J_xi_zeta*w_zeta)
    """,
    89: """
        -2*zeta_A*S_x*e0**2 + 2*xi_A*S_z*e0**2 + 2*e2*xi_A*S_x*e0 - 2*e1*xi_A*S_y*e0 - 2*e3*zeta_A*S_y*e0
        + 2*e2*zeta_A*S_z*e0 - J_xi_eta*w_xi_after + J_eta*w_eta_after - J_eta_zeta*w_zeta_after
        + 2*e1*e3*xi_A*S_x - 2*e1**2*zeta_A*S_x + zeta_A*S_x + 2*e2*e3*xi_A*S_y - 2*e1*e2*zeta_A*S_y
        + 2*e3**2*xi_A*S_z - xi_A*S_z - 2*e1*e3*zeta_A*S_z
        - (-J_xi_eta*w_xi + J_eta*w_eta - J_eta_zeta*w_zeta)
    """,
    90: """
        2*eta_A*S_x*e0**2 - 2*xi_A*S_y*e0**2 + 2*e3*xi_A*S_x*e0 + 2*e3*eta_A*S_y*e0 - 2*e1*xi_A*S_z*e0
        - 2*e2*eta_A*S_z*e0 - J_xi_xi*w_xi_after - J_eta_xi*w_eta_after + J_zeta_xi*w_zeta_after
        - 2*e1*e2*xi_A*S_x + 2*e1**2*eta_A*S_x - eta_A*S_x - 2*e2**2*xi_A*S_y + xi_A*S_y + 2*e1*e2*eta_A*S_y
        - 2*e2*e3*xi_A*S_z + 2*e1*e3*eta_A*S_z - (-J_xi_xi*w_xi - J_eta_xi*w_eta + J_zeta_xi*w_zeta)
    """,
    91: """
        (2*e0*e2 + 2*e1*e3)*(w_xi_after*eta_A - w_eta_after*xi_A) + (2*e1*e2 - 2*e0*e3)
        *(w_zeta_after*xi_A - w_xi_after*zeta_A) + (2*e0**2 + 2*e1**2 - 1)
        *(w_eta_after*zeta_A - w_zeta_after*eta_A) + vx_after
    """,
    92: """
        (2*e2*e3 - 2*e0*e1)*(w_xi_after*eta_A - w_eta_after*xi_A) + (2*e0**2 + 2*e2**2 - 1)
        *(w_zeta_after*xi_A - w_xi_after*zeta_A) + (2*e1*e2 + 2*e0*e3)
        *(w_eta_after*zeta_A - w_zeta_after*eta_A) + vy_after
    """,
    95: """
        J_xi*w_xi_after + (-2*eta_A*e0**2 + 2*e1*zeta_A*e0 - 2*e3**2*eta_A + eta_A + 2*e2*e3*zeta_A)*S_z
        - J_xi*w_xi
    """,
    96: """
        J_eta*w_eta_after + (2*xi_A*e0**2 + 2*e2*zeta_A*e0 + 2*e3**2*xi_A - xi_A - 2*e1*e3*zeta_A)*S_z
        - J_eta*w_eta
    """,
    97: """
        J_zeta*w_zeta_after + (-2*e1*xi_A*e0 - 2*e2*eta_A*e0 - 2*e2*e3*xi_A + 2*e1*e3*eta_A)*S_z
        - J_zeta*w_zeta
    """,
}
_TEXTS[93] = _TEXTS[86]
EQUATIONS = {number: Equation(f"eq. ({number})", " ".join(text.split())) for number, text in _TEXTS.items()}
