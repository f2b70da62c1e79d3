"""Writes a system as one interactive HTML page: its schematic, its motion, plots and sliders beside its derivation."""

from lagrangian.write.interactive.page import Adjustable, Engine, PageContents, page_html

__all__ = ["Adjustable", "Engine", "PageContents", "page_html"]
