"""The frame that runs, checks and shows every study."""
