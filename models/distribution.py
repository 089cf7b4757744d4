"""The name under which pip installs cointoss."""

DISTRIBUTION = "cointoss-dynamics"
"""As in pyproject.toml; the index has another project under `cointoss`."""
