"""A search of a scenario's window for a toss that shows a sequence or an outcome; imports sweep and below."""
