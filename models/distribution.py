"""The name under which pip installs cointoss."""

DISTRIBUTION = "cointoss"
"""As in pyproject.toml."""
