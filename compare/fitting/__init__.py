"""A scenario fitted to a coin that was seen; may import sweep, metrics, output, the engines and models."""
