"""The restitution of an impact by the speed of approach: constant, by a power law, of a viscous contact."""

from cointoss.models.body import Rules
from cointoss.models.kernel.compiled import compiled

# The Padé approximant of Müller and Pöschel, Phys. Rev. E 84 (2011) 021302, in s = √(a/_SQUARE) v^(1/10).
_LINEAR, _SQUARE, _CUBE, _FOURTH = 0.501086, 1.15345, 0.577977, 0.532178
_SHORTEST = 4 / 5
"""The least share that the impacts of a geometric chatter have in the time of a viscous one."""


@compiled
def varies(rules: Rules) -> bool:
    """Return whether the restitution depends on the speed of approach, but for its threshold."""
    return rules.restitution > 0 and (rules.restitution_exponent > 0 or rules.restitution_viscous > 0)


@compiled
def restitution_at_speed(rules: Rules, speed: float) -> float:
    """Return χ of an impact: 0 up to the threshold, above it `elastic_restitution`.

    Args:
        rules: the floor.
        speed: normal speed of approach [m/s].
    """
    if rules.restitution_threshold > 0 and speed <= rules.restitution_threshold:
        return 0.0
    return elastic_restitution(rules, speed)


@compiled
def elastic_restitution(rules: Rules, speed: float) -> float:
    """Return min(1, χ (v/v₀)^-p) V(v), the restitution at a speed v without regard to the threshold.

    It never grows with the speed [m/s], on which `chatter_restitution` and `largest_restitution` rest.
    """
    if not varies(rules):
        return rules.restitution
    return power_restitution(rules, speed) * viscous_restitution(rules.restitution_viscous, speed)


@compiled
def power_restitution(rules: Rules, speed: float) -> float:
    """Return min(1, χ (v/v₀)^-p): p = 1/4 of plastic flow (Johnson, Contact Mechanics, 1985, 11.5).

    Args:
        rules: the floor, with χ > 0.
        speed: v [m/s].
    """
    chi, power = rules.restitution, (max(speed, 0.0) / rules.restitution_speed) ** rules.restitution_exponent
    return chi / power if chi < power else 1.0


@compiled
def viscous_restitution(a: float, speed: float) -> float:
    """Return V(v) = 1 - a v^(1/5) + (3/5) a² v^(2/5) - ... of Hertz's contact with viscous loss.

    Args:
        a: of the scenario's floor [(s/m)^(1/5)].
        speed: v [m/s].
    """
    square = a / _SQUARE * max(speed, 0.0) ** 0.2
    s = square**0.5
    kept = 1 + _LINEAR * s
    return kept / (kept + square * (_SQUARE + s * (_CUBE + s * _FOURTH)))


@compiled
def largest_restitution(rules: Rules) -> float:
    """Return the largest restitution that an impact may have: that just above the threshold."""
    return elastic_restitution(rules, rules.restitution_threshold)


@compiled
def chatter_restitution(rules: Rules, speed: float) -> float:
    """Return χ of impacts with constant restitution that last no less than those to come from a speed on.

    As the restitution e never grows with the speed, the speeds of approach to come, this one among them, add
    up to at most ∫ du/(1 - e(u)) from 0 to v. By the power law e is at most that at the threshold, and
    without one 1: such impacts never chatter. By the viscous law (1 - e(u))/u^(1/5) falls with u, so that the
    integral is at most 5/4 v/(1 - e(v)). docs/ENDINGS.md has the proof.

    Args:
        rules: the floor.
        speed: v, normal speed of approach, above the threshold [m/s].
    """
    if not varies(rules):
        return rules.restitution
    most = power_restitution(rules, rules.restitution_threshold)
    if rules.restitution_viscous == 0:
        return most
    return 1 - _SHORTEST * (1 - most * viscous_restitution(rules.restitution_viscous, speed))


@compiled
def elastic_speed(rules: Rules) -> float:
    """Return v₀ χ^(1/p), up to which the power law has the restitution 1; 0 without the law [m/s]."""
    if rules.restitution_exponent == 0 or not varies(rules):
        return 0.0
    return rules.restitution_speed * rules.restitution ** (1 / rules.restitution_exponent)
