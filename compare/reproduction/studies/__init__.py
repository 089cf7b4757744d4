"""Studies of the two engines, a module each, as `REPRODUCTION`."""
