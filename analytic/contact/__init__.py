"""Sustained contact: its modes and the floor's force; imports impact, flight and below."""
