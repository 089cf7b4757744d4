"""A small engine, which is built within seconds."""
