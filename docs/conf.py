"""How the manual is built: `scripts/docs`."""

import logging
import pathlib
import re
import runpy
import sys
from typing import Any

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE))
logging.getLogger("lagrangian").setLevel(logging.WARNING)

project = "lagrangian"
author = "the lagrangian authors"
copyright = "2026, the lagrangian authors"
extensions = ["myst_parser", "sphinx.ext.autodoc", "mathml"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
source_suffix = {".md": "markdown"}
exclude_patterns = ["_build"]
html_theme = "furo"
html_math_renderer = "mathml"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_title = "lagrangian"
html_show_sphinx = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#1f6aa5", "color-brand-content": "#1f6aa5"},
    "dark_css_variables": {"color-brand-primary": "#6db3e8", "color-brand-content": "#6db3e8"},
    "top_of_page_buttons": [],
}

NAMED = {
    '<aside class="sidebar-drawer">': '<aside class="sidebar-drawer" aria-label="Pages">',
    '<aside class="toc-drawer': '<aside aria-label="On this page" class="toc-drawer',
    'class="caption" role="heading"': 'class="caption" role="heading" aria-level="2"',
    "<pre>": '<pre tabindex="0">',
}
"""What the theme leaves out: names of regions, levels of headings, and code that the keyboard can scroll."""


autodoc_default_options = {"members": True, "inherited-members": "tuple", "member-order": "groupwise"}
autodoc_typehints = "signature"
autodoc_preserve_defaults = True

CODE = re.compile(r"(``?)(.+?)\1", re.S)


def as_rst(app: object, what: str, name: str, thing: object, options: object, lines: list[str]) -> None:
    """Read docstrings as they are meant: names between backticks are code, stars and bars are themselves."""
    lines[:] = "\n\n".join(map(paragraph, "\n".join(lines).split("\n\n"))).split("\n")


def paragraph(text: str) -> str:
    """A paragraph of a docstring; a session of Python stays as it is."""
    if text.lstrip().startswith(">>>"):
        return text
    parts = CODE.split(text)  # words, backticks, code, words, …
    words = [re.sub(r"[*|]|_(?=\W|$)", r"\\\g<0>", part) for part in parts[::3]]
    code = [f"``{part}``" for part in parts[2::3]]
    return "".join(part for pair in zip(words, [*code, ""], strict=True) for part in pair)


def write_gallery(app: object) -> None:
    """Make the pages of the gallery before Sphinx looks for pages."""
    runpy.run_path(str(HERE.parent / "tools" / "gallery.py"))["write"](HERE / "gallery")


def name_regions(app: Any, failed: object) -> None:
    """Give the pages that were built what the theme leaves out."""
    for path in [] if failed else pathlib.Path(app.outdir).rglob("*.html"):
        text = path.read_text(encoding="utf-8")
        for before, after in NAMED.items():
            text = text.replace(before, after) if after not in text else text
        path.write_text(text, encoding="utf-8")


def setup(app: Any) -> None:
    """Hook into the build."""
    app.connect("build-finished", name_regions)
    app.connect("builder-inited", write_gallery)
    app.connect("autodoc-process-docstring", as_rst)
