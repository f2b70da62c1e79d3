"""Draws a scene as an image with matplotlib, with its labels as outlines, so that only shapes are drawn."""

from __future__ import annotations

import importlib
import io
import threading
from collections.abc import Sequence
from typing import Any

import numpy as np

from lagrangian.errors import MissingExtra
from lagrangian.page.palette import LIGHT, Palette
from lagrangian.page.placing import Drawn, placed, places
from lagrangian.page.scene import Role, Scene, ScenePart, drawing_order
from lagrangian.records import dataclass

POINTS = 72.0
"""Points an inch: a pixel of the scene is drawn as a point."""

FONTS = ["STIXGeneral", "DejaVu Serif"]
"""Serif fonts that come with matplotlib."""

HALO = 4.0
"""The width of the line around letters in the colour of what is behind them [px]."""

_LOCK = threading.Lock()
"""Fonts of matplotlib are used by one thread at a time."""


@dataclass(frozen=True)
class Lettering:
    """A piece of a label: its size and how far it is below the line [px]."""

    text: str
    italic: bool
    size: float
    drop: float


@dataclass(frozen=True)
class LabelLetters:
    """A label: its pieces from left to right around the middle of its line [px]."""

    middle: tuple[float, float]
    role: Role
    pieces: Sequence[Lettering]
    on_body: bool = False


def scene_png(scene: Scene, labels: Sequence[LabelLetters], *, palette: Palette = LIGHT, scale: float = 2.0) -> bytes:
    """Return a scene in its pose as PNG; ``scale``: pixels of the image for each of the scene.

    Raises `MissingExtra` without matplotlib.
    """
    with _LOCK:
        return _drawn(scene, labels, palette, scale)


def _drawn(scene: Scene, labels: Sequence[LabelLetters], palette: Palette, scale: float) -> bytes:
    figure_module, agg = _matplotlib("figure"), _matplotlib("backends.backend_agg")
    width, height = scene.size
    figure = figure_module.Figure(
        figsize=(width / POINTS, height / POINTS), dpi=scale * POINTS, facecolor=palette.paper
    )
    agg.FigureCanvasAgg(figure)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0.0, width), ylim=(height, 0.0))
    axes.axis("off")
    at = places(scene)
    for n, part in enumerate(drawing_order(scene.parts)):
        drawn = placed(part, at)
        if drawn:
            axes.add_patch(_patch(part, drawn, palette, n))
    for n, label in enumerate(labels):
        _write(axes, label, palette, len(scene.parts) + n)
    stream = io.BytesIO()
    figure.savefig(stream, format="png", metadata={"Title": scene.name, "Software": "lagrangian"})
    return stream.getvalue()


def _matplotlib(module: str) -> Any:
    try:
        return importlib.import_module(f"matplotlib.{module}")
    except ImportError:
        what, fix = "an image needs the package 'matplotlib'", "pip install 'lagrangian[plot]', or write .svg"
        raise MissingExtra(what, fix=fix, code="E801") from None


def _patch(part: ScenePart, drawn: list[Drawn], palette: Palette, order: int) -> Any:
    """A part as a patch of matplotlib."""
    line = palette.line(part.role)
    face = line if part.solid else palette.inside(part.role) if part.filled else "none"
    edge = palette.inside(part.role) if part.paint == "inside" else line
    style: dict[str, Any] = {"facecolor": face, "edgecolor": edge if part.outline > 0 else "none"}
    style |= {"linewidth": part.outline, "capstyle": "round", "joinstyle": "round", "zorder": order}
    if part.dashed and part.outline > 0:
        style |= {"linestyle": (0.0, tuple(x / part.outline for x in part.dashes)), "capstyle": "butt"}
    patches = _matplotlib("patches")
    if len(drawn) == 1 and drawn[0][0] == "O":
        x, y, r = drawn[0][1].tolist()
        return patches.Circle((x, y), r, **style)
    return patches.PathPatch(_path(drawn), **style)


def _path(drawn: list[Drawn]) -> Any:
    Path = _matplotlib("path").Path
    codes = {"M": Path.MOVETO, "L": Path.LINETO, "C": Path.CURVE4}
    corners: list[Any] = []
    kinds: list[int] = []
    for letter, numbers in drawn:
        if letter == "Z":
            corners.append((0.0, 0.0))
            kinds.append(Path.CLOSEPOLY)
            continue
        points = numbers.reshape(-1, 2)
        corners += list(points)
        kinds += [codes[letter]] * len(points)
    return Path(np.array(corners), kinds)


def _write(axes: Any, label: LabelLetters, palette: Palette, order: int) -> None:
    """The letters of a label over a line around them in the colour of what is behind."""
    patches, paths = _matplotlib("patches"), _matplotlib("textpath")
    fonts, transforms = _matplotlib("font_manager"), _matplotlib("transforms")
    outlines: list[Any] = []
    x = 0.0
    for piece in label.pieces:
        font = fonts.FontProperties(family=FONTS, style="italic" if piece.italic else "normal")
        outlines.append((x, piece.drop, paths.TextPath((0.0, 0.0), piece.text, size=piece.size, prop=font)))
        fitted = font.copy()
        fitted.set_size(piece.size)
        x += paths.text_to_path.get_text_width_height_descent(piece.text, fitted, ismath=False)[0]
    left, base = label.middle[0] - x / 2, label.middle[1]
    ink, behind = palette.line(label.role), palette.body if label.on_body else palette.paper
    for colour, width in ((behind, HALO), (ink, 0.0)):
        for dx, dy, outline in outlines:
            moved = outline.transformed(transforms.Affine2D().scale(1.0, -1.0).translate(left + dx, base + dy))
            style = {"facecolor": colour, "edgecolor": colour if width else "none", "linewidth": width}
            axes.add_patch(patches.PathPatch(moved, joinstyle="round", zorder=order, **style))
