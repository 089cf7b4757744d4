"""Outcome maps: a grid over two fields of a scenario, tossed into a Zarr store; imports report and below."""
