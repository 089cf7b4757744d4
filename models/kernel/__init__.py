"""Compiled functions and the vectors they compute with; imports nothing of the project."""
