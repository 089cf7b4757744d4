"""The floor's friction in sustained contact, by its contact law."""

from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.models.body import Rules
from cointoss.models.contact_laws.table import is_followed, is_rough, uses_friction
from cointoss.models.contour import Contour
from cointoss.models.kernel.compiled import compiled

# In sustained contact a perfectly rough floor is nearly the limit of Coulomb's: it lets go a point that it
# could only hold by pulling.
_ROUGH = 1e4


@compiled
def friction_in_contact(rules: Rules) -> FloorFriction:
    """Return the `FloorFriction` of sustained contact: the floor's if its law uses it, large if rough."""
    mu = rules.friction if is_followed(rules.law) and uses_friction(rules.law) else 0.0
    if is_rough(rules.law):
        mu = _ROUGH
    contour = Contour(rules.contour_friction, rules.contour_viscosity, rules.viscosity)
    return FloorFriction(mu, rules.rolling_friction, rules.pivoting_friction, contour)
