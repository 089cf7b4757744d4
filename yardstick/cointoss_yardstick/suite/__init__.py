"""A suite of cases with known answers, for any engine; imports simulators."""
