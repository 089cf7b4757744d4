"""The horizon of trust: errors of a toss, propagated from event to event; imports the rooms below."""
