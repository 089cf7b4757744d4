"""Answers written: files, text, tables, bars, palette; imports nothing of compare."""
