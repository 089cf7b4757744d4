"""A toss that shows a sequence or an outcome, searched in a window of a scenario; imports sweep and below."""
