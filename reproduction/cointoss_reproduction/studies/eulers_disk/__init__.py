"""The study, what it declares, and what it alone uses."""
