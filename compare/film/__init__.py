"""The film of a toss, by either engine or both; imports output."""
