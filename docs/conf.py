"""How the manual is built: `scripts/docs`."""

project = "lagrangian"
author = "the lagrangian authors"
copyright = "2026, the lagrangian authors"
extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 2
source_suffix = {".md": "markdown"}
exclude_patterns = ["_build"]
html_theme = "alabaster"
