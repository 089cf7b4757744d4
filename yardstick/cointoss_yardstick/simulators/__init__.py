"""Engines of anybody, which are asked for states alone."""
