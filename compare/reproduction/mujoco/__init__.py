"""Studies of MuJoCo's contacts, a module each, as `REPRODUCTION`."""
