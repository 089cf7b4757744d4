"""A contact that lasts: its modes and the floor's force; imports impact, flight and below."""
