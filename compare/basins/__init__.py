"""Measures of an outcome map, and pictures of it; imports output.

An outcome map is a plain array (y, x) of the codes of `Outcome`. The measures leave out
undecided and transient pixels, which count only in their own fractions; each measure says how.
"""
