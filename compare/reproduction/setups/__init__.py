"""What several figures share: their coins, grids of releases and random impacts."""
