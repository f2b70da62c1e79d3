"""Compares independent routes: the derived equations, and what is compiled, exported and linearized from them."""
