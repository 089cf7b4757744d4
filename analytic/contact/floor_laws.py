"""The contact laws that hold a coin in sustained contact, and their friction there."""

from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.models.body import Rules
from cointoss.models.kernel.compiled import compiled
from cointoss.models.laws import ContactLaw

# In sustained contact a perfectly rough floor is nearly the limit of Coulomb's: it lets go a point that it
# could only hold by pulling.
_ROUGH = 1e4


@compiled
def supports_contact(law: ContactLaw) -> bool:
    """Return whether a law supports sustained contact: a smooth, a Coulomb and a perfectly rough floor do."""
    return law == ContactLaw.SMOOTH or law == ContactLaw.COULOMB or law == ContactLaw.PERFECTLY_ROUGH


@compiled
def friction_in_contact(rules: Rules) -> FloorFriction:
    """Return the `FloorFriction` of sustained contact: none on slip if smooth, large if perfectly rough."""
    mu = rules.friction if rules.law == ContactLaw.COULOMB else 0.0
    if rules.law == ContactLaw.PERFECTLY_ROUGH:
        mu = _ROUGH
    return FloorFriction(mu, rules.rolling_friction, rules.pivoting_friction)
