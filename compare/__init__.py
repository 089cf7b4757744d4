"""Both engines asked the same question, and the answers side by side."""
