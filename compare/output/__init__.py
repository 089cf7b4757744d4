"""How answers are written: files, text, plot style; imports nothing of compare."""
