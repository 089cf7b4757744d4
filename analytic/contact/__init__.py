"""A toss as a hybrid automaton: its modes of contact, guards and resets; imports impact, flight and below."""
