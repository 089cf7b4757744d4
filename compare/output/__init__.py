"""Answers written: files, text, plot style; imports nothing of compare."""
