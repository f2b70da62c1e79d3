"""Constraints in a derivation: rows with multipliers, Lagrange's equations with them, and the equations without."""
