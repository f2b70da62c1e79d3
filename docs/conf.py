"""How the manual is built: `python -m sphinx docs docs/_build`."""

project = "lagrangian"
author = "the lagrangian authors"
copyright = "2026, the lagrangian authors"
extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath"]
source_suffix = {".md": "markdown"}
exclude_patterns = ["_build"]
html_theme = "alabaster"
