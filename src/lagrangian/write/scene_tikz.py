"""Writes a scene as a TikZ picture with the same geometry as its SVG; a pixel is 1/96 inch.

Only the packages ``tikz`` and ``amsmath`` are needed, and no library of TikZ.
"""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.page.palette import LIGHT
from lagrangian.page.placing import Drawn, on_bodies, placed, places
from lagrangian.page.scene import Scene, ScenePart, drawing_order
from lagrangian.write.scene_letters import scene_letters
from lagrangian.write.scene_svg import number
from lagrangian.write.tex import PAGE
from lagrangian.write.text import clean

PIXEL = 0.75
"""A pixel in big points, 1/72 inch."""

USUAL_SIZE = 15.0
"""The size of a label [px] that is written in the size of the text around the picture."""

LONGEST_NAME = 60
"""A comment shows at most this many characters of the names of elements."""

_DOCUMENT = r"""\documentclass[border=2mm]{standalone}
\usepackage[utf8]{inputenc}
\usepackage[T1]{fontenc}
\usepackage{amsmath,amssymb,tikz}
\ifdefined\Umathchar\newcommand{\glyph}[1]{\symbol{"#1}}\else\newcommand{\glyph}[1]{\texttt{[U+#1]}}\fi
\begin{document}
%s\end{document}
"""


def scene_tikz(scene: Scene, *, document: bool = False) -> str:
    """Return a scene in its pose at rest as a ``tikzpicture``; with ``document``, as a LaTeX file of its own."""
    at, table = places(scene), scene_letters(scene)
    w, h = map(number, scene.size)
    lines = [
        f"% {clean(scene.name)[:LONGEST_NAME]}; needs \\usepackage{{amsmath,tikz}}",
        rf"\begin{{tikzpicture}}[x={PIXEL}bp,y=-{PIXEL}bp,line cap=round,line join=round]",
        *_colours(),
        rf"\path[use as bounding box] (0,0) rectangle ({w},{h});",
    ]
    comment = ""
    for part in drawing_order(scene.parts):
        said = clean(" ".join((part.kind or part.role, *part.elements)))[:LONGEST_NAME].rstrip()
        if said != comment:
            lines.append(f"% {said}")
            comment = said
        lines.append(rf"\path[{','.join(_style(part))}] {_outline(placed(part, at))};")
    for label, on_body in on_bodies(scene, at):
        ground = f"fill={_inside('body')}" if on_body else "fill=white"
        letters = ", ".join(PAGE.latex(table[name]) for name in label.names)
        options = f"text=scene-{label.role},{ground},fill opacity=0.85,text opacity=1,inner sep=0.6bp"
        if label.size != USUAL_SIZE:
            options += f",scale={number(label.size / USUAL_SIZE)}"
        x, y = map(number, label.centre)
        lines.append(rf"\node[{options}] at ({x},{y}) {{${letters}$}};")
    text = "\n".join([*lines, r"\end{tikzpicture}"]) + "\n"
    return _DOCUMENT % text if document else text


def _colours() -> Iterator[str]:
    yield rf"\definecolor{{scene-inside}}{{HTML}}{{{LIGHT.body[1:].upper()}}}"
    for role, colour in LIGHT.lines.items():
        yield rf"\definecolor{{scene-{role}}}{{HTML}}{{{colour[1:].upper()}}}"


def _inside(role: str) -> str:
    return "scene-inside" if role == "body" else "white"


def _style(part: ScenePart) -> Iterator[str]:
    """The options of the path of a part."""
    line = f"scene-{part.role}"
    if part.solid or part.filled:
        yield f"fill={line if part.solid else _inside(part.role)}"
    if part.outline > 0:
        yield f"draw={_inside(part.role) if part.paint == 'inside' else line}"
        yield f"line width={number(PIXEL * part.outline)}bp"
        if part.dashed:
            on, off = (number(PIXEL * x) for x in part.dashes)
            yield f"dash pattern=on {on}bp off {off}bp,line cap=butt"


def _outline(drawn: list[Drawn]) -> str:
    out: list[str] = []
    for letter, numbers in drawn:
        text = [number(x) for x in numbers.tolist()]
        if letter == "O":
            out.append(f"({text[0]},{text[1]}) circle[radius={text[2]}]")
            continue
        pairs = [f"({x},{y})" for x, y in zip(text[::2], text[1::2], strict=True)]
        match letter:
            case "M":
                out.append(pairs[0])
            case "L":
                out.append(f"-- {pairs[0]}")
            case "C":
                out.append(f".. controls {pairs[0]} and {pairs[1]} .. {pairs[2]}")
            case _:
                out.append("-- cycle")
    return " ".join(out)
