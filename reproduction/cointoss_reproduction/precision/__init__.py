"""Planar tosses in long arithmetic, for studies of the limit of fine accuracy; imports output."""
