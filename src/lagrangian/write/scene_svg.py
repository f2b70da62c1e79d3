"""Writes a scene as SVG that needs nothing else: no script, no font, no style of the page around it.

Colours are given twice: as attributes for light surroundings, which every program understands, and as CSS variables,
with which browsers follow ``prefers-color-scheme``. There are no ids, so that any number of pictures fit on a page.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from itertools import groupby

from lagrangian.page.palette import DARK, LIGHT
from lagrangian.page.placing import Array, Drawn, on_bodies, placed, places
from lagrangian.page.scene import Label, Scene, ScenePart, drawing_order
from lagrangian.write.expression_tree import Letter
from lagrangian.write.html_page import data_element, escape
from lagrangian.write.scene_letters import SMALLER, LetterPiece, pieces, scene_letters
from lagrangian.write.themes import scene_variables, themed_scenes

FONTS = "'Latin Modern Roman','CMU Serif','STIX Two Text',Cambria,'Times New Roman','Liberation Serif',serif"

LOWER = (0.0, 0.24, 0.36)
"""How far letters, subscripts and subscripts of these lie below the line, in sizes of the letters."""
MIDDLE = 0.32
"""The line of a label lies this far below its centre, in sizes of the letters."""
HALO = 4.0
"""The width of the line around letters in the colour of the paper [px]."""


def scene_svg(scene: Scene, *, embedded: bool = False, notebook: bool = False) -> str:
    """Return a scene in its pose at rest as SVG; ``embedded`` for use within HTML, otherwise a document of its own.

    ``notebook``: its colours follow the theme of the notebook around it.

    Every part is in a group ``<g class="glyph kind-… role-…" data-element="…">``; `data_element` says how the names of
    elements are written there.
    """
    style = themed_scenes() if notebook else ""
    return document(scene, scene_body(scene), size=scene.size, embedded=embedded, style=style)


def scene_body(scene: Scene) -> list[str]:
    """Return the groups of a scene's parts and labels, for a document of any size."""
    at = places(scene)
    return [*_groups(scene.parts, at), *labels(scene, at)]


def document(
    scene: Scene,
    body: Iterable[str],
    *,
    size: tuple[float, float],
    embedded: bool,
    style: str = "",
    width: float | None = None,
) -> str:
    """Return SVG of a size in pixels with a title, a description, the style and the lines of a body.

    ``width`` is the width in which it is shown.
    """
    w, h = map(number, size)
    shown = size[0] if width is None else width
    shown_h = shown * size[1] / size[0] if size[0] > 0 else size[1]
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" class="lagrangian-scene" viewBox="0 0 {w} {h}" '
        f'width="{number(shown)}" height="{number(shown_h)}" role="img" font-family="{FONTS}" '
        'stroke-width="1.5" stroke-linecap="round" stroke-linejoin="round">'
    )
    lines = [head, f"<title>{escape(scene.name)}</title>"]
    if scene.description:
        lines.append(f"<desc>{escape(scene.description)}</desc>")
    lines.append(f"<style>{_style(embedded)}{style}</style>")
    if not embedded:
        lines.append(f'<rect class="paper" width="{w}" height="{h}" fill="{LIGHT.paper}"/>')
    text = "\n".join([*lines, *body, "</svg>"]) + "\n"
    return text if embedded else f'<?xml version="1.0" encoding="UTF-8"?>\n{text}'


def _style(embedded: bool) -> str:
    """The rules of colours, all restricted to pictures of this kind."""
    rules = [
        scene_variables(LIGHT),
        f"@media (prefers-color-scheme:dark){{{scene_variables(DARK)}}}",
        ".lagrangian-scene .line{stroke:var(--line)}",
        ".lagrangian-scene .inside{fill:var(--inside)}",
        ".lagrangian-scene .inner{stroke:var(--inside)}",
        ".lagrangian-scene .solid{fill:var(--line)}",
        ".lagrangian-scene .halo{fill:var(--paper);stroke:var(--paper)}",
        ".lagrangian-scene .on-body{fill:var(--scene-inside);stroke:var(--scene-inside)}",
        ".lagrangian-scene .paper{fill:var(--paper)}",
        *(f".lagrangian-scene .role-{role}{{--line:var(--scene-{role})}}" for role in LIGHT.lines),
        ".lagrangian-scene .role-body{--inside:var(--scene-inside)}",
    ]
    if embedded:
        rules.append(".lagrangian-scene{max-width:100%;height:auto;background:var(--paper)}")
    return "".join(rules)


def labels(scene: Scene, at: Array) -> Iterator[str]:
    """Return the groups of the labels; the halo of a label on a body has the colour of the body."""
    table = scene_letters(scene)
    for label, on_body in on_bodies(scene, at):
        yield _label(label, table, " on-body" if on_body else "")


def _groups(parts: Iterable[ScenePart], at: Array) -> Iterator[str]:
    for opening, members in groupby(drawing_order(parts), key=group_opening):
        yield opening + "".join(shape(part, outline(placed(part, at))) for part in members) + "</g>"


def group_opening(part: ScenePart | Label) -> str:
    """Return the beginning of the group of a part or a label."""
    kind = getattr(part, "kind", "label")
    kinds = f" kind-{re.sub(r'[^A-Za-z0-9]+', '-', kind)}" if kind else ""
    elements = f' data-element="{escape(data_element(part.elements))}"' if part.elements else ""
    return f'<g class="glyph{kinds} role-{part.role}"{elements}>'


def shape(part: ScenePart, geometry: str, within: str = "") -> str:
    """Return the element of a part: its ``geometry`` (the name of the element and its attributes), and its style."""
    tag = geometry.partition(" ")[0]
    return f"<{geometry}{_painted(part)}" + (f">{within}</{tag}>" if within else "/>")


def _painted(part: ScenePart) -> str:
    """The attributes of the lines and of the inside of a part."""
    line = LIGHT.line(part.role)
    classes: list[str] = []
    if part.solid:
        fill, name = line, "solid"
    elif part.filled:
        fill, name = LIGHT.inside(part.role), "inside"
    else:
        fill, name = "none", ""
    classes += [name] if name else []
    attributes = f' fill="{fill}"'
    if part.outline > 0:
        inner = part.paint == "inside"
        classes.append("inner" if inner else "line")
        attributes += f' stroke="{LIGHT.inside(part.role) if inner else line}"'
        if part.outline != 1.5:
            attributes += f' stroke-width="{number(part.outline)}"'
        if part.dashed:
            attributes += f' stroke-dasharray="{" ".join(map(number, part.dashes))}" stroke-linecap="butt"'
    return (f' class="{" ".join(classes)}"' if classes else "") + attributes


def outline(drawn: list[Drawn]) -> str:
    """Return the geometry of one pose: a circle or a path."""
    if len(drawn) == 1 and drawn[0][0] == "O":
        x, y, r = map(number, drawn[0][1].tolist())
        return f'circle cx="{x}" cy="{y}" r="{r}"'
    return f'path d="{"".join(letter + pair_text(numbers.tolist()) for letter, numbers in drawn)}"'


def pair_text(numbers: Iterable[float], digits: int = 2) -> str:
    """Return numbers separated as briefly as SVG allows."""
    text = ""
    for x in numbers:
        written = number(x, digits)
        text += written if not text or written.startswith("-") else f" {written}"
    return text


def number(x: float, digits: int = 2) -> str:
    """Return a number with at most ``digits`` decimals, without needless zeros."""
    text = f"{x:.{digits}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return "0" if text in ("-0", "") else text


def _label(label: Label, table: Mapping[str, Letter], behind: str) -> str:
    """A label over a halo, which is a text of its own: that of a subscript must not cover the letter before it."""
    x, y = label.centre
    listed = pieces(label, table)
    runs = "".join(
        _run(piece, before, label) for piece, before in zip(listed, [LetterPiece(""), *listed], strict=False)
    )
    place = (
        f'x="{number(x)}" y="{number(y + MIDDLE * label.size)}" font-size="{number(label.size)}" text-anchor="middle"'
    )
    ink, paper = LIGHT.line(label.role), LIGHT.body if behind else LIGHT.paper
    halo = f'class="halo{behind}" fill="{paper}" stroke="{paper}" stroke-width="{number(HALO)}" aria-hidden="true"'
    return (
        f"{group_opening(label)}<text {place} {halo}>{runs}</text>"
        f'<text {place} class="solid" fill="{ink}">{runs}</text></g>'
    )


def _run(piece: LetterPiece, before: LetterPiece, label: Label) -> str:
    """A piece of a label, moved down from the line of the piece before it."""
    attributes = ' font-style="italic"' if piece.italic else ""
    if piece.lowered:
        attributes += f' font-size="{number(SMALLER[piece.lowered] * label.size)}"'
    if shift := LOWER[piece.lowered] - LOWER[before.lowered]:
        attributes += f' dy="{number(shift * label.size)}"'
    return f"<tspan{attributes}>{escape(piece.text)}</tspan>"
