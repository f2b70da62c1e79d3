"""How the manual is built: `scripts/docs`."""

import pathlib
import runpy
from typing import Any

HERE = pathlib.Path(__file__).parent

project = "lagrangian"
author = "the lagrangian authors"
copyright = "2026, the lagrangian authors"
extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 2
source_suffix = {".md": "markdown"}
exclude_patterns = ["_build"]
html_theme = "furo"
html_title = "lagrangian"
html_show_sphinx = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#1f6aa5", "color-brand-content": "#1f6aa5"},
    "dark_css_variables": {"color-brand-primary": "#6db3e8", "color-brand-content": "#6db3e8"},
}


def write_gallery(app: object) -> None:
    """Make the pages of the gallery before Sphinx looks for pages."""
    runpy.run_path(str(HERE.parent / "tools" / "gallery.py"))["write"](HERE / "gallery")


def setup(app: Any) -> None:
    """Hook into the build."""
    app.connect("builder-inited", write_gallery)
