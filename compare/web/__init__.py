"""What the report and the explorer share: their scripts, and a toss as these play it; imports engines."""
