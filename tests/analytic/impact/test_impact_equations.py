"""An impact obeys every equation of impact that the paper prints, or its correction."""

import numpy as np
import pytest

from cointoss.models.laws import ContactLaw
from tests.helpers.draws import PAPER_LAWS
from tests.helpers.impacts import draw_impact, struck
from tests.helpers.printed_equations import EQUATIONS as PRINTED

COUNT = 50
EXACT = 1e-10
"""Agreement asked for, relative to the size of the terms."""
OF_SPIN = {88, 89, 90, 95, 96, 97}
"""Equations of angular momentum; the others are of velocities."""
MEANT = {"J_xi_xi": "J_xi_zeta", "J_eta_xi": "J_eta_zeta", "J_zeta_xi": "J_zeta"}
"""What eq. (90) must have in place of its subscripts."""
AS_PRINTED = {"J_xi_xi": "J_xi", "J_eta_xi": "J_xi_eta", "J_zeta_xi": "J_xi_zeta"}


def left_over(law, equation, kind, subscripts, from_B):
    """Return what an equation leaves of an impact, relative to the size of its terms, over `COUNT` impacts.

    Args:
        law: of contact.
        equation: its number.
        kind: of coin: "ideal", "imperfect" or "any".
        subscripts: of eq. (90).
        from_B: whether A is measured from B, not from C.
    """
    rng, found = np.random.default_rng([equation, int(law)]), []
    while len(found) < COUNT:
        case, y = draw_impact(rng, law)
        row, after, _ = struck(case, y)
        coin, S, J = case.coin, row["impulse"], case.coin.inertia_about_C
        if kind != "any" and (kind == "ideal") == any(coin.center_of_mass):
            continue
        A = row["point"] - (0 if from_B else np.array(coin.center_of_mass))
        symbols = {"chi": case.floor.restitution, **{f"e{i}": y[6 + i] for i in range(4)}}
        symbols |= {"J_xi": J[0, 0], "J_eta": J[1, 1], "J_zeta": J[2, 2]}
        symbols |= {"J_xi_eta": -J[0, 1], "J_xi_zeta": -J[0, 2], "J_eta_zeta": -J[1, 2]}
        for i, (x, xi) in enumerate(zip("xyz", ("xi", "eta", "zeta"), strict=True)):
            symbols |= {f"v{x}": y[3 + i], f"v{x}_after": after[3 + i], f"S_{x}": S[i]}
            symbols |= {f"w_{xi}": y[10 + i], f"w_{xi}_after": after[10 + i], f"{xi}_A": A[i]}
        fastest = np.abs([y[10:13], after[10:13]]).max()
        size = np.abs(y[3:6]).max() + fastest * coin.radius
        if equation in OF_SPIN:
            size = np.abs(J).max() * fastest + np.abs(S).max() * coin.radius
        literal = {name: symbols[other] for name, other in subscripts.items()}
        found.append(abs(PRINTED[equation](**symbols, **literal)) / size)
    return found


@pytest.mark.parametrize(
    ("law", "equation", "kind"),
    [
        *((law, equation, "any") for law in PAPER_LAWS for equation in (86, 88, 89, 90)),
        *((ContactLaw.PERFECTLY_ROUGH, equation, "any") for equation in (91, 92)),
        *((ContactLaw.SMOOTH, equation, "ideal") for equation in (93, 95, 96, 97)),
    ],
)
def test_an_impact_obeys_the_equations_of_its_law(law, equation, kind):
    assert max(left_over(law, equation, kind, MEANT, from_B=False)) < EXACT


@pytest.mark.parametrize(
    ("equation", "kind", "subscripts", "from_B", "of", "least"),
    [
        pytest.param(90, "any", AS_PRINTED, False, np.min, 1e-3, id="(90) with the subscripts printed"),
        pytest.param(91, "any", MEANT, False, np.min, 1e-3, id="of a rough floor along x on a smooth one"),
        pytest.param(92, "any", MEANT, False, np.min, 1e-3, id="of a rough floor along y on a smooth one"),
        pytest.param(95, "imperfect", MEANT, False, np.median, 1e-3, id="without the products of inertia"),
        pytest.param(88, "imperfect", MEANT, True, np.median, 1e-3, id="with A from the middle"),
    ],
)
def test_on_a_smooth_floor_an_equation_fails(equation, kind, subscripts, from_B, of, least):
    assert of(left_over(ContactLaw.SMOOTH, equation, kind, subscripts, from_B)) > least
