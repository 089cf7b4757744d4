"""The paper's claims in words and those of papers it cites, a module each, as `REPRODUCTION`."""
