"""Plots with labels, units and legends, from data without mechanics."""

from lagrangian.view.plots import Marks, Panel, Plotted, Series, draw, joined

__all__ = ["Marks", "Panel", "Plotted", "Series", "draw", "joined"]
