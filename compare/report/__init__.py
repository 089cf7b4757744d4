"""The side-by-side report of one scenario."""
