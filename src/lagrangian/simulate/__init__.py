"""Kernel → trajectories: integrators in machine code, events, ensembles. Knows no mechanics."""
