"""The impact of one point on the floor: the contact laws; imports numerics."""
