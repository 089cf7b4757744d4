"""A thick coin on its edge: whether it comes upright and stands; imports the modes and resets."""
