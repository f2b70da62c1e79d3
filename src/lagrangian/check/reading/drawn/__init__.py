"""Formulas and matrices drawn over several lines."""
