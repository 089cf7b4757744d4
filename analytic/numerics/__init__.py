"""A Runge-Kutta tableau, roots, rotations and vectors of four numbers; imports nothing of analytic."""
