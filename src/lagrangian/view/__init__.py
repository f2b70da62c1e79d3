"""Pictures of runs: plots with labels, units and legends. Data in, figures out; knows no mechanics."""

from lagrangian.view.plots import Marks, Panel, Picture, Series, draw, joined

__all__ = ["Marks", "Panel", "Picture", "Series", "draw", "joined"]
