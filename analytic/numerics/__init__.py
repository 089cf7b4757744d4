"""Runge-Kutta steps and rotations; imports nothing of analytic."""
