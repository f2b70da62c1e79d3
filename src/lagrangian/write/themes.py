"""How views follow the theme of their notebook, where that differs from the system's."""

from __future__ import annotations

from lagrangian.page.palette import DARK, LIGHT, Palette

LIGHT_NOTEBOOK = ':is([data-jp-theme-light="true"], body.vscode-light, html[theme="light"], body.light)'
"""A selector of what is around a view in light themes of JupyterLab, VS Code, Colab and marimo."""
DARK_NOTEBOOK = ':is([data-jp-theme-light="false"], body.vscode-dark, html[theme="dark"], body.dark)'
"""The same for dark themes."""


def scene_variables(palette: Palette) -> str:
    """Return the rule that gives pictures the colours of a palette."""
    roles = "".join(f"--scene-{role}:{colour};" for role, colour in palette.lines.items())
    paper = f"--paper:{palette.paper};--inside:var(--paper);--scene-inside:{palette.body}"
    return f".lagrangian-scene{{{roles}{paper}}}"


def themed_scenes() -> str:
    """Return the rules by which pictures follow the theme of their notebook."""
    return f"{LIGHT_NOTEBOOK} {scene_variables(LIGHT)}{DARK_NOTEBOOK} {scene_variables(DARK)}"
