"""What the report and the lab share: their scripts, and a toss as these play it; imports engines."""
