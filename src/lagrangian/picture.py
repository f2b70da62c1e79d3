"""The picture of a system as users get it."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

from lagrangian.errors import Error
from lagrangian.graph import Program
from lagrangian.look.hints import Hints, hints_of
from lagrangian.look.scenes import scene_of
from lagrangian.model import Model
from lagrangian.page.palette import DARK, LIGHT
from lagrangian.page.placing import on_bodies, places
from lagrangian.page.scene import Scene
from lagrangian.simulate.events import Event
from lagrangian.view.still import LabelLetters, Lettering, scene_png
from lagrangian.viewed import Brief, cut
from lagrangian.write import check_free, write_file
from lagrangian.write.scene_letters import SMALLER, pieces, scene_letters
from lagrangian.write.scene_svg import LOWER, MIDDLE, scene_svg
from lagrangian.write.scene_tikz import scene_tikz


class Picture(Brief):
    """The schematic of a system, in the style of a textbook.

    ``missing`` says what is not drawn, and what helps. ``description`` says in words what is seen. In a notebook the
    picture shows itself.
    """

    def __init__(self, model: Model, hints: Hints) -> None:
        self.model, self.hints = model, hints

    @cached_property
    def _made(self) -> tuple[Scene, Program]:
        return scene_of(self.model, self.hints)

    @property
    def scene(self) -> Scene:
        """The picture as data."""
        return self._made[0]

    @property
    def program(self) -> Program:
        """x = [q; v], u, p, t → the positions r [m] of the scene's anchors, shape (anchors, d)."""
        return self._made[1]

    @property
    def missing(self) -> tuple[str, ...]:
        """What is not drawn, each with what helps."""
        return self.scene.missing

    @property
    def pose(self) -> Mapping[str, float]:
        """The coordinates that are drawn, in SI units, by name."""
        return self.scene.pose

    @property
    def description(self) -> str:
        """What is seen, in words."""
        return self.scene.description

    def to_svg(self) -> str:
        """Return the picture as an SVG document."""
        return scene_svg(self.scene)

    def to_tikz(self) -> str:
        """Return the picture as a TikZ picture for LaTeX, which needs only the package ``tikz``."""
        return scene_tikz(self.scene)

    def to_png(self, *, dark: bool = False, scale: float = 2.0) -> bytes:
        """Return the picture as a PNG image; ``scale``: its pixels for each pixel of the picture.

        Raises `MissingExtra`, which says what to install, without matplotlib.
        """
        scene = self.scene
        return scene_png(scene, _lettering(scene), palette=DARK if dark else LIGHT, scale=scale)

    def to_html(self, *, events: Sequence[Event] | Event = ()) -> str:
        """Return a page that moves: the schematic, the motion, sliders, plots and the derivation in one HTML file.

        ``events``, made by `lagrangian.event`, are found in its motion, with their resets, as in `simulate`. It needs
        neither a network nor Python. Raises `RunError` for a system that a browser cannot integrate, such as one with
        dry friction, and if a parameter has no value.
        """
        from lagrangian.live import live_page

        return live_page(self.model, self.scene, self.program, events)

    def save(
        self, path: str | os.PathLike[str], *, overwrite: bool = True, events: Sequence[Event] | Event = ()
    ) -> Path:
        """Write the picture to a file and return its path; the ending chooses the format.

        ``.svg``, ``.tex`` (TikZ) and ``.png`` (which needs matplotlib) are the schematic; ``.html`` is a page with the
        motion, sliders, plots and the derivation, and with the ``events`` of `to_html`. Raises `Error` for another
        ending, and otherwise as `to_html` and `to_png` do.
        """
        ending = Path(path).suffix.lower()
        check_free(path, overwrite=overwrite)
        if ending == ".svg":
            return write_file(path, self.to_svg())
        if ending == ".tex":
            return write_file(path, scene_tikz(self.scene, document=True))
        if ending == ".png":
            return write_file(path, self.to_png())
        if ending == ".html":
            return write_file(path, self.to_html(events=events))
        raise Error(
            f"a picture cannot be written as '{ending or Path(path).name}'",
            fix="choose a name that ends in .svg, .tex, .png or .html",
            code="E802",
        )

    def _repr_html_(self) -> str:
        return scene_svg(self.scene, embedded=True, notebook=True)

    def _repr_svg_(self) -> str:
        return self.to_svg()

    def __repr__(self) -> str:
        return cut(f"<Picture of '{self.model.name}'>")


def _lettering(scene: Scene) -> list[LabelLetters]:
    """The labels of a scene as pieces of text with their sizes and places."""
    table, found = scene_letters(scene), list[LabelLetters]()
    for label, on_body in on_bodies(scene, places(scene)):
        size, (x, y) = label.size, label.centre
        listed = [
            Lettering(piece.text, piece.italic, SMALLER[piece.lowered] * size, LOWER[piece.lowered] * size)
            for piece in pieces(label, table)
        ]
        found.append(LabelLetters((x, y + MIDDLE * size), label.role, listed, on_body))
    return found


def picture(model: Model, **hints: Any) -> Picture:
    """The picture of a model; ``hints`` are those of `hints_of`. Raises `ModelError` as that does."""
    return Picture(model, hints_of(model, **hints))
