"""The side-by-side report of one scenario; imports film, metrics and output."""
