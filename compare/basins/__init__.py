"""What is asked of an outcome map.

An outcome map is a plain array (y, x) of the codes of `models.records.Outcome`. Undecided is no outcome: a
pixel that is undecided is left out of every measure but its own fraction, and each measure says how.
"""
