"""The air's force and moment on the coin; imports numerics."""
