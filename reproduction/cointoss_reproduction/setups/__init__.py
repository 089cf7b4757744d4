"""What figures, claims and studies share: coins, releases, impacts, counts, and the form of a study."""
