"""Writes a system as one interactive HTML page: its schematic, its motion, plots and sliders beside its derivation."""

from lagrangian.write.interactive.page import Adjustable, PageContents, PageSolver, page_html

__all__ = ["Adjustable", "PageContents", "PageSolver", "page_html"]
