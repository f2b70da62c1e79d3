"""Finds the equilibria of a system: all that a search in a box finds."""
