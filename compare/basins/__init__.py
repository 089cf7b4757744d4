"""Measures of an outcome map and its pictures; imports output.

An outcome map is a plain array (y, x) of the codes of `Outcome`. Undecided is not an outcome:
an undecided pixel is left out of every measure except its own fraction, and each measure says how.
"""
