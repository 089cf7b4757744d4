"""The film of a toss, by either engine or both, and stills; imports output."""
