"""Bounces of MuJoCo's own contacts, measured with `mj_step`; imports the model's settings and models."""
