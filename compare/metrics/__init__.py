"""How two tosses differ: impulses, sequences, paths; imports engines and output."""
