"""The picture of a system as users get it."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from functools import cached_property
from math import pi
from pathlib import Path
from typing import Any

from lagrangian.errors import Error, ModelError, did_you_mean
from lagrangian.graph import Program
from lagrangian.look.cast import CHOICES
from lagrangian.look.kinematics import Kinematics
from lagrangian.look.scenes import AZIMUTH, ELEVATION, Hints, scene_of
from lagrangian.model import Model
from lagrangian.page.scene import Scene
from lagrangian.values.values import Given, key_name
from lagrangian.viewed import Brief, cut
from lagrangian.write import check_free, write_file
from lagrangian.write.scene_svg import scene_svg
from lagrangian.write.scene_tikz import scene_tikz

ENDINGS = (".svg", ".tex", ".png", ".html")
"""The formats of `Picture.save`, by the ending of the file."""


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
    def description(self) -> str:
        """What is seen, in words."""
        return self.scene.description

    def to_svg(self) -> str:
        """Return the picture as an SVG document."""
        return scene_svg(self.scene)

    def to_tikz(self) -> str:
        """Return the picture as a TikZ picture for LaTeX, which needs only the package ``tikz``."""
        return scene_tikz(self.scene)

    def to_html(self) -> str:
        """Return a page that moves: the schematic, the motion, sliders, plots and the derivation in one HTML file.

        It needs neither a network nor Python. Raises `RunError` for a system that a browser cannot integrate, such as
        one with dry friction, and if a parameter has no value.
        """
        from lagrangian.derive import derive
        from lagrangian.live import live_page

        return live_page(derive(self.model), self.scene, self.program)

    def save(self, path: str | os.PathLike[str], *, overwrite: bool = True) -> Path:
        """Write the picture to a file and return its path; the ending chooses the format.

        ``.svg`` and ``.tex`` (TikZ) are the schematic; ``.html`` is a page with the motion, sliders, plots and the
        derivation. Raises `Error` for another ending, and for ``.html`` as `to_html` does.
        """
        ending = Path(path).suffix.lower()
        check_free(path, overwrite=overwrite)
        if ending == ".svg":
            return write_file(path, self.to_svg())
        if ending == ".tex":
            return write_file(path, scene_tikz(self.scene, document=True))
        if ending == ".html":
            return write_file(path, self.to_html())
        raise Error(
            f"a picture cannot be written as '{ending or Path(path).name}'",
            fix="choose a name that ends in .svg, .tex or .html",
            code="E802",
        )

    def _repr_html_(self) -> str:
        return scene_svg(self.scene, embedded=True)

    def _repr_svg_(self) -> str:
        return self.to_svg()

    def __repr__(self) -> str:
        return cut(f"<Picture of '{self.model.name}'>")


def picture(
    model: Model,
    *,
    pose: Mapping[Any, Any] | None = None,
    kinds: Mapping[str, str] | None = None,
    azimuth: float | None = None,
    elevation: float | None = None,
    trail: Sequence[str] = (),
    hide: Sequence[str] = (),
) -> Picture:
    """The picture of a model; see `System.look`. Raises `ModelError` for names that the model does not have."""
    names = [c.name for c in model.coordinates]
    given = Given.of(model, Kinematics(model).program(()))
    values = given.states.values({key_name(k): v for k, v in (pose or {}).items()})
    if rates := [name for name in values if name not in names]:
        raise ModelError(f"'{rates[0]}' is no coordinate, and a pose has only these", code="E402")
    _known("body", kinds or {}, [b.name for b in model.bodies])
    for body, kind in (kinds or {}).items():
        if kind not in CHOICES:
            fix = did_you_mean(kind, CHOICES) or f"kinds: {', '.join(CHOICES)}"
            raise ModelError(f"body '{body}' cannot be drawn as '{str(kind)[:40]}'", fix=fix, code="E402")
    _known("point", trail, [p.name for p in model.points if p.name])
    _known("element or coordinate", hide, [*(e.name for e in model.elements), *names])
    hints = Hints(
        pose=values,
        kinds=dict(kinds or {}),
        azimuth=AZIMUTH if azimuth is None else _angle(azimuth, "azimuth"),
        elevation=ELEVATION if elevation is None else _angle(elevation, "elevation"),
        trail=tuple(trail),
        hide=tuple(hide),
    )
    return Picture(model, hints)


def _angle(value: float, what: str) -> float:
    if not isinstance(value, int | float) or not abs(value) <= 4 * pi:
        raise ModelError(f"{what} must be an angle in radians (got {value!r:.60})", code="E406")
    return float(value)


def _known(what: str, asked: Any, names: list[str]) -> None:
    for name in asked:
        if name not in names:
            fix = did_you_mean(str(name), names) or f"{what}: {', '.join(names) or 'none has a name'}"
            raise ModelError(f"there is no {what} '{str(name)[:64]}'", fix=fix, code="E412")
