"""Runs of a system: one run, an ensemble, a sweep. Connects mechanics with integrators and names the results."""
