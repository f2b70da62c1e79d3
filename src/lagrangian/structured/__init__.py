"""Equations of motion in named quantities: turns, velocities, momenta and forces, each defined once.

Written out, the equations of a robot with six joints fill a hundred pages. In terms of the quantities a person would
name they fill two, and they are the same equations.
"""
