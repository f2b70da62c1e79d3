"""The two systems of a comparison as pictures side by side, in the same pose."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

import sympy as sp

from lagrangian.compare.rows import ComparedSystem
from lagrangian.coordinates import Change
from lagrangian.errors import Error
from lagrangian.look import hints_of, scene_of
from lagrangian.model import Model, time
from lagrangian.page.scene import Scene
from lagrangian.viewed import Brief, cut
from lagrangian.write import check_free, write_file
from lagrangian.write.scene_pair import pair_svg

LONGEST = 60
"""A caption shows at most this many characters of a system's name."""


class PicturePair(Brief):
    """Two schematics side by side: (A) ``left`` and (B) ``right``. In a notebook they show themselves."""

    def __init__(self, left: Scene, right: Scene) -> None:
        self.left, self.right = left, right

    @property
    def captions(self) -> tuple[str, str]:
        """What is written above the pictures."""
        return cut(f"(A) {self.left.name}", LONGEST), cut(f"(B) {self.right.name}", LONGEST)

    @property
    def missing(self) -> tuple[str, ...]:
        """What is not drawn, each with what helps."""
        return tuple(f"({tag}) {x}" for tag, scene in (("A", self.left), ("B", self.right)) for x in scene.missing)

    def to_svg(self) -> str:
        """Return both pictures as one SVG document."""
        return pair_svg(self.left, self.right, self.captions)

    def save(self, path: str | os.PathLike[str], *, overwrite: bool = True) -> Path:
        """Write both pictures to an SVG file and return its path. Raises `Error` for another ending than ``.svg``."""
        if Path(path).suffix.lower() != ".svg":
            fix = "choose a name that ends in .svg"
            raise Error(f"two pictures cannot be written as '{Path(path).suffix}'", fix=fix, code="E802")
        check_free(path, overwrite=overwrite)
        return write_file(path, self.to_svg())

    def _repr_html_(self) -> str:
        return pair_svg(self.left, self.right, self.captions, embedded=True)

    def __repr__(self) -> str:
        return cut(f"<Pictures of '{self.left.name}' and '{self.right.name}'>")


def pictures(source: ComparedSystem, into: ComparedSystem, change: Change | None) -> PicturePair:
    """The pictures of two systems; where the coordinates correspond, ξ = φ(η), both are in the same pose."""
    second = _scene(into.derivation.model, None)
    pose = None if change is None else _posed(source.derivation.model, change, second.pose)
    first = _scene(source.derivation.model, pose)
    left, right = (first, second) if source.tag == "A" else (second, first)
    return PicturePair(left, right)


def _scene(model: Model, pose: Mapping[str, float] | None) -> Scene:
    return scene_of(model, hints_of(model, pose=pose))[0]


def _posed(model: Model, change: Change, pose: Mapping[str, float]) -> dict[str, float] | None:
    """The coordinates ξ = φ(η) of a pose η; parameters without a value are 1, as in pictures. None if not finite."""
    table: dict[sp.Basic, float] = {c.symbol: pose[c.name] for c in change.new}
    table |= {p.symbol: 1.0 if p.value is None else p.value for p in model.parameters}
    found = {
        c.name: model.expand(change.table[c.symbol], constants=True).subs({**table, time: 0.0}) for c in change.old
    }
    if not all(x.is_number and x.is_real and x.is_finite for x in found.values()):
        return None
    return {name: float(x) for name, x in found.items()}
