"""The lab: a page that tosses coins by itself, and opens maps; imports sweep and below."""
