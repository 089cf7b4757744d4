"""Compiled functions, their vectors, and the loader of their library; imports nothing of the project."""
