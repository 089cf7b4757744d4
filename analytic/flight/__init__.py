"""Free flight and the search for its first touch; imports air and numerics."""
