"""Draws the frames of a motion as images, with Pillow: at twice the size, then reduced, so that lines are smooth."""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import MissingExtra
from lagrangian.page.motion import THIN, SceneMotion
from lagrangian.page.palette import LIGHT, Palette
from lagrangian.page.placing import Drawn, placed
from lagrangian.page.scene import Role, ScenePart

if TYPE_CHECKING:
    from PIL.Image import Image

Array = NDArray[np.float64]

FINER = 2
"""How many times larger an image is drawn."""

CURVE = 10
"""The number of straight lines in place of a Bézier curve."""

LETTERS = 13
"""The size of the words about an early end [px]."""


def pillow(module: str) -> Any:
    """Return a module of Pillow, or raise `MissingExtra` with the command that installs it."""
    try:
        return importlib.import_module(f"PIL.{module}")
    except ImportError:
        what, fix = "drawing frames needs the package 'pillow'", "pip install 'lagrangian[animate]', or write .svg"
        raise MissingExtra(what, fix=fix, code="E801") from None


class FramePainter:
    """Draws the frames of a motion in an image of ``width`` × ``height`` pixels; both are even, as videos need."""

    def __init__(self, motion: SceneMotion, width: float, palette: Palette = LIGHT) -> None:
        self._image, self._draw, self._font = pillow("Image"), pillow("ImageDraw"), pillow("ImageFont")
        self._motion, self._palette = motion, palette
        left, top, w, h = motion.frame
        self.width = max(2, 2 * round(width / 2))
        self.height = max(2, 2 * round(self.width * h / w / 2))
        self._scale = FINER * self.width / w
        self._corner = np.array([left, top])
        self._thick = self._scale * max(1.0, THIN * w / self.width)
        self._parts = [(part, self._scaled(placed(part, motion.at))) for part in motion.parts]
        self._paths = [self._scale * (path - self._corner) for path in motion.paths]

    def _scaled(self, drawn: list[Drawn]) -> list[Drawn]:
        """The commands of a part in pixels of the large image."""
        found: list[Drawn] = []
        for letter, numbers in drawn:
            corner = np.append(self._corner, 0.0) if letter == "O" else np.tile(self._corner, numbers.shape[-1] // 2)
            found.append((letter, self._scale * (numbers - corner)))
        return found

    def frames(self) -> Iterator[Image]:
        """Return one image after another, in RGB."""
        return (self.frame(k) for k in range(self._motion.count))

    def frame(self, k: int) -> Image:
        """Return one frame, in RGB."""
        size = (FINER * self.width, FINER * self.height)
        image = self._image.new("RGB", size, self._palette.paper)
        draw = self._draw.Draw(image)
        blend = _mixed(self._palette.line("coordinate"), self._palette.paper, 0.25)
        strong = _mixed(self._palette.line("coordinate"), self._palette.paper, 0.65)
        for path in self._paths:
            self._line(draw, path, blend, 1.4 * self._thick)
            gone = k * (len(path) - 1) // max(self._motion.count - 1, 1)
            self._line(draw, path[: gone + 1], strong, 1.4 * self._thick)
        for part, drawn in self._parts:
            self._part(draw, part, [(letter, numbers[k]) for letter, numbers in drawn])
        if self._motion.ending:
            self._words(draw, self._motion.ending, "input")
        if self._motion.pace:
            self._words(draw, self._motion.pace, "thin", right=True)
        return image.resize((self.width, self.height), self._image.Resampling.BOX)

    def _part(self, draw: Any, part: ScenePart, drawn: list[Drawn]) -> None:
        ink, inside = self._palette.line(part.role), self._palette.inside(part.role)
        fill = ink if part.solid else inside if part.filled else None
        line = inside if part.paint == "inside" else ink
        width = part.outline * self._thick
        if len(drawn) == 1 and drawn[0][0] == "O" and not part.dashed:
            x, y, r = drawn[0][1].tolist()
            outer = r + width / 2
            draw.ellipse((x - outer, y - outer, x + outer, y + outer), fill=line if width else fill)
            inner = r - width / 2
            if width and inner > 0:
                behind = fill if fill is not None else self._palette.paper
                if fill is None:
                    draw.ellipse((x - outer, y - outer, x + outer, y + outer), outline=line, width=max(1, round(width)))
                else:
                    draw.ellipse((x - inner, y - inner, x + inner, y + inner), fill=behind)
            return
        pieces = _flattened(drawn)
        if fill is not None:
            for piece in pieces:
                if len(piece) > 2:
                    draw.polygon([tuple(p) for p in piece.tolist()], fill=fill)
        if width:
            for piece in pieces:
                for run in _dashed(piece, *(self._thick * x for x in part.dashes)) if part.dashed else (piece,):
                    self._line(draw, run, line, width, round_ends=not part.dashed)

    def _line(self, draw: Any, points: Array, colour: str, width: float, *, round_ends: bool = True) -> None:
        """A line through points with round corners and ends."""
        whole, listed = max(1, round(width)), [tuple(p) for p in points.tolist()]
        if len(listed) > 1:
            draw.line(listed, fill=colour, width=whole, joint="curve")
        r = whole / 2 - 0.5
        if round_ends and r > 0.5:
            for x, y in (listed[0], listed[-1]):
                draw.ellipse((x - r, y - r, x + r, y + r), fill=colour)

    def _words(self, draw: Any, words: str, role: Role, *, right: bool = False) -> None:
        size = FINER * LETTERS
        font = self._font.load_default(size)
        shown = words.replace("×", "x").encode("ascii", "replace").decode()  # letters that every font of Pillow has
        x = FINER * self.width - FINER * 8 - draw.textlength(shown, font=font) if right else FINER * 8
        draw.text((x, FINER * self.height - 1.6 * size), shown, fill=self._palette.line(role), font=font)


def _mixed(ink: str, paper: str, share: float) -> str:
    """The colour of ink that covers a share of the paper."""
    pairs = [(int(ink[i : i + 2], 16), int(paper[i : i + 2], 16)) for i in (1, 3, 5)]
    return "#" + "".join(f"{round(share * a + (1 - share) * b):02x}" for a, b in pairs)


def _flattened(drawn: list[Drawn]) -> list[Array]:
    """The lines of a shape, (points, 2) each, with curves and circles as many short lines."""
    pieces: list[list[Array]] = []
    for letter, n in drawn:
        match letter:
            case "O":
                turn = np.linspace(0.0, 2 * np.pi, 61)
                circle = n[:2] + n[2] * np.stack([np.cos(turn), np.sin(turn)], axis=-1)
                pieces.append(list(circle))
            case "M":
                pieces.append([n])
            case "L":
                pieces[-1].append(n)
            case "C":
                pieces[-1] += _curve(pieces[-1][-1], n)
            case _:
                pieces[-1].append(pieces[-1][0])
    return [np.array(piece) for piece in pieces if len(piece) > 1]


def _curve(start: Array, n: Array) -> list[Array]:
    s = np.linspace(0.0, 1.0, CURVE + 1)[1:, None]
    found = (1 - s) ** 3 * start + 3 * s * (1 - s) ** 2 * n[:2] + 3 * s**2 * (1 - s) * n[2:4] + s**3 * n[4:]
    return list(found)


def _dashed(points: Array, on: float, off: float) -> Iterator[Array]:
    """The dashes of a line, ``on`` long and ``off`` apart."""
    steps = np.hypot(*np.diff(points, axis=0).T)
    at = np.concatenate([[0.0], np.cumsum(steps)])
    for begin in np.arange(0.0, at[-1], on + off):
        end = min(begin + on, at[-1])
        inner = at[(at > begin) & (at < end)]
        where = np.concatenate([[begin], inner, [end]])
        yield np.stack([np.interp(where, at, points[:, i]) for i in (0, 1)], axis=-1)
