"""How two tosses differ: impulses, sequences, paths, Lyapunov exponents; imports engines and output."""
