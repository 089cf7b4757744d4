"""What is tossed: the scenario, the records of a toss, and what both engines must mean alike."""
