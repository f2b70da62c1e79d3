"""Plots with labels, units and legends, from data without mechanics."""

from lagrangian.view.plots import Marks, Panel, Picture, Series, draw, joined

__all__ = ["Marks", "Panel", "Picture", "Series", "draw", "joined"]
