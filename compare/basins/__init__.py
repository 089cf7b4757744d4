"""Measures of an outcome map and its pictures; imports output.

An outcome map is a plain array (y, x) of the codes of `Outcome`. Neither undecided nor transient is one to
measure: such a pixel is left out of all but its own fraction, and each measure says how.
"""
