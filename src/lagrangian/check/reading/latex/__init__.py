"""Answers in LaTeX."""
