"""The paper's figures and its table, a module each, as `REPRODUCTION`."""
