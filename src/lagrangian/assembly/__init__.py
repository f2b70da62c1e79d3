"""Positions that close the loops: from a rough guess to coordinates and rates that satisfy every constraint."""
