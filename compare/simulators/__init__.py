"""Engines of anybody, which are asked for states alone; imports metrics, engines and output."""
