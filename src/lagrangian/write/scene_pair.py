"""Writes two scenes side by side as one SVG picture, each under its caption."""

from __future__ import annotations

from dataclasses import replace

from lagrangian.page.palette import LIGHT
from lagrangian.page.scene import Scene
from lagrangian.write.html_page import escape
from lagrangian.write.scene_svg import document, number, scene_body
from lagrangian.write.themes import themed_scenes

GAP, CAPTION, LETTER = 24.0, 34.0, 15.0
"""Between the pictures; the height of the captions; the size of their letters [px]."""

CHARACTER = 7.4
"""The width of a usual letter of a caption [px]."""


def pair_svg(left: Scene, right: Scene, captions: tuple[str, str], *, embedded: bool = False) -> str:
    """Return two scenes side by side as SVG; ``embedded`` for use within HTML, otherwise a document of its own."""
    height = max(left.size[1], right.size[1])
    body: list[str] = []
    x = 0.0
    for scene, caption in zip((left, right), captions, strict=True):
        width = max(scene.size[0], CHARACTER * len(caption) + 2 * GAP)
        place = f"{number(x + (width - scene.size[0]) / 2)} {number(CAPTION + height - scene.size[1])}"
        body.append(f'<g transform="translate({place})">')
        body += scene_body(scene)
        body.append("</g>")
        ink = LIGHT.line("body")
        body.append(
            f'<g class="glyph role-body"><text x="{number(x + width / 2)}" y="{number(CAPTION - 12)}" class="solid" '
            f'fill="{ink}" font-size="{number(LETTER)}" text-anchor="middle">{escape(caption)}</text></g>'
        )
        x += width + GAP
    said = f"{captions[0]}: {left.description} {captions[1]}: {right.description}"
    style = themed_scenes() if embedded else ""
    both = replace(left, name=" and ".join(captions), description=said)
    return document(both, body, size=(x - GAP, CAPTION + height), embedded=embedded, style=style)
