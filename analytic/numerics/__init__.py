"""A Runge-Kutta tableau, roots and rotations; imports nothing of analytic."""
