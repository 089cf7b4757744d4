"""How far a toss can be trusted: its errors, carried from event to event; imports the rooms below."""
