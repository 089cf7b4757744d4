"""An impact obeys every equation of impact that the paper prints, or its correction."""

import numpy as np
import pytest

from cointoss.models.laws import ContactLaw
from tests.helpers.draws import PAPER_LAWS, PAPER_OFFSET
from tests.helpers.impacts import draw_impact, struck
from tests.helpers.printed_equations import EQUATIONS as PRINTED

COUNT = 50
EXACT = 1e-10
"""Agreement asked for, relative to the size of the terms."""


class Struck:
    """One impact by a contact law, in the symbols of section 4.3."""

    def __init__(self, rng, law, from_B=False):
        self.case, y = draw_impact(rng, law)
        row, after, _ = struck(self.case, y)
        self.m, self.J = self.case.coin.mass, self.case.coin.inertia_about_C
        self.v, self.v_after, self.w, self.w_after = y[3:6], after[3:6], y[10:13], after[10:13]
        self.e, self.S = y[6:10], row["impulse"]
        self.A = row["point"] - (0 if from_B else np.array(self.case.coin.center_of_mass))
        self.speed = np.abs(self.v).max() + np.abs([self.w, self.w_after]).max() * self.case.coin.radius
        self.spin_size = np.abs(self.J).max() * np.abs([self.w, self.w_after]).max()
        self.spin_size += np.abs(self.S).max() * self.case.coin.radius

    @property
    def symbols(self):
        J, values = self.J, {"chi": self.case.floor.restitution}
        values |= {"J_xi": J[0, 0], "J_eta": J[1, 1], "J_zeta": J[2, 2]}
        values |= {"J_xi_eta": -J[0, 1], "J_xi_zeta": -J[0, 2], "J_eta_zeta": -J[1, 2]}
        values |= {f"e{i}": self.e[i] for i in range(4)}
        for i, (x, xi) in enumerate(zip("xyz", ("xi", "eta", "zeta"), strict=True)):
            values |= {f"v{x}": self.v[i], f"v{x}_after": self.v_after[i], f"S_{x}": self.S[i]}
            values |= {f"w_{xi}": self.w[i], f"w_{xi}_after": self.w_after[i], f"{xi}_A": self.A[i]}
        return values


def printed_90(symbols):
    """Give eq. (90) with the subscripts that it prints: J_ξξ, J_ηξ, J_ζξ in the places of J_ξζ, J_ηζ, J_ζ."""
    literal = {"J_xi_xi": "J_xi", "J_eta_xi": "J_xi_eta", "J_zeta_xi": "J_xi_zeta"}
    return PRINTED[90](**symbols, **{name: symbols[meant] for name, meant in literal.items()})


def corrected_90(symbols):
    """Give eq. (90) with J_ξζ, J_ηζ, J_ζ."""
    meant = {"J_xi_xi": "J_xi_zeta", "J_eta_xi": "J_eta_zeta", "J_zeta_xi": "J_zeta"}
    return PRINTED[90](**symbols, **{name: symbols[other] for name, other in meant.items()})


@pytest.mark.parametrize("law", PAPER_LAWS)
def test_every_law_obeys_eqs_86_to_90(law):
    rng = np.random.default_rng(40 + int(law))
    for _ in range(COUNT):
        impact = Struck(rng, law)
        symbols = impact.symbols
        assert abs(PRINTED[86](**symbols)) < EXACT * impact.speed
        assert (
            np.abs(impact.m * (impact.v_after - impact.v) - impact.S).max() < EXACT * np.abs(impact.S).max()
        )
        assert abs(PRINTED[88](**symbols)) < EXACT * impact.spin_size
        assert abs(PRINTED[89](**symbols)) < EXACT * impact.spin_size
        assert abs(corrected_90(symbols)) < EXACT * impact.spin_size


def test_eq_90_fails_with_the_subscripts_printed():
    rng = np.random.default_rng(50)
    errors = []
    for _ in range(COUNT):
        impact = Struck(rng, ContactLaw.SMOOTH)
        # For S = S_z ẑ the terms in J are all that can fail.
        errors.append(abs(printed_90(impact.symbols)) / impact.spin_size)
    assert min(errors) > 1e-4
    assert np.median(errors) > 1e-2


def test_the_perfectly_rough_coin_obeys_eqs_91_and_92_and_the_smooth_one_does_not():
    rng = np.random.default_rng(51)
    for _ in range(COUNT):
        rough = Struck(rng, ContactLaw.PERFECTLY_ROUGH)
        assert abs(PRINTED[91](**rough.symbols)) < EXACT * rough.speed
        assert abs(PRINTED[92](**rough.symbols)) < EXACT * rough.speed
        smooth = Struck(rng, ContactLaw.SMOOTH)
        slip = abs(PRINTED[91](**smooth.symbols)) + abs(PRINTED[92](**smooth.symbols))
        assert slip > 1e-3 * smooth.speed


def ideal_and_imperfect(rng, law, count, **options):
    """Draw impacts until there are `count` each of the ideal and of the imperfect coin."""
    ideal, imperfect = [], []
    while min(len(ideal), len(imperfect)) < count:
        impact = Struck(rng, law, **options)
        offset = np.abs(impact.case.coin.center_of_mass).max()
        assert offset in (0, abs(PAPER_OFFSET[0]))
        (imperfect if offset else ideal).append(impact)
    return ideal[:count], imperfect[:count]


def test_the_smooth_ideal_coin_obeys_eqs_93_to_97_and_the_imperfect_one_does_not():
    ideal, imperfect = ideal_and_imperfect(np.random.default_rng(52), ContactLaw.SMOOTH, COUNT)
    for impact in ideal:
        gained = impact.m * (impact.v_after - impact.v)
        assert abs(PRINTED[93](**impact.symbols)) < EXACT * impact.speed
        assert gained[:2].tolist() == [0, 0]
        assert gained[2] == pytest.approx(impact.S[2], rel=EXACT)
        for form in (PRINTED[95], PRINTED[96], PRINTED[97]):
            assert abs(form(**impact.symbols)) < EXACT * impact.spin_size
    errors = [abs(PRINTED[95](**impact.symbols)) / impact.spin_size for impact in imperfect]
    assert np.median(errors) > 1e-3, "the products of inertia count"


def test_the_contact_point_is_measured_from_the_mass_centre():
    _, imperfect = ideal_and_imperfect(np.random.default_rng(53), ContactLaw.SMOOTH, COUNT, from_B=True)
    newton = [abs(PRINTED[86](**impact.symbols)) / impact.speed for impact in imperfect]
    turning = [abs(PRINTED[88](**impact.symbols)) / impact.spin_size for impact in imperfect]
    assert min(np.median(newton), np.median(turning)) > 1e-3


def test_keeping_all_slip_takes_friction():
    rng = np.random.default_rng(54)
    shares = []
    for _ in range(COUNT):
        S = Struck(rng, ContactLaw.SLIP_PRESERVING).S
        shares.append(np.hypot(S[0], S[1]) / abs(S[2]))
    assert np.median(shares) > 0.1, "a frictionless floor would give none"
