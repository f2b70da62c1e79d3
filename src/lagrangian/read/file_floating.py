"""Frames with a quaternion in a model file: they are declared with the coordinates, because they have their own."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lagrangian.errors import ParseError, Place, did_you_mean
from lagrangian.model import Floating
from lagrangian.quantities.source import shown
from lagrangian.read.letters import normal

if TYPE_CHECKING:
    from lagrangian.read.file_geometry import Geometry
    from lagrangian.read.file_reading import Reading
    from lagrangian.read.file_schema import FrameTable

REFUSED = {"floating": ("angle", "axis", "parent", "origin", "ball"), "ball": ("angle", "axis"), "": ("after",)}
"""The fields that a frame that floats, one in a ball joint, and one with an angle have no use for."""

WHY = {"floating": "it floats, so it has no", "ball": "it turns in a ball joint, so it has no"}


class FloatingFrames:
    """The frames of one file that float or turn in ball joints; each waits for what it comes ``after``."""

    def __init__(self, loader: Reading, geometry: Geometry) -> None:
        self.loader, self.geometry = loader, geometry
        tables = enumerate(loader.file.frame)
        self.waiting = {n: None if t.after is None else normal(t.after) for n, t in tables if t.has_quaternion}
        for number, table in enumerate(loader.file.frame):
            self._refuse_useless(number, table)

    def _refuse_useless(self, number: int, table: FrameTable) -> None:
        kind = "floating" if table.floating else "ball" if table.ball else ""
        for key in REFUSED[kind]:
            if (given := getattr(table, key)) is not None and given is not False:
                why = WHY.get(kind, "it has no coordinates of its own, so it needs no")
                raise ParseError(
                    f"{why} '{key}'",
                    element=f"frame {shown(table.name)}",
                    place=self.loader.index.of_key(("frame", number, key)),
                    fix=f"leave '{key}' out" + (f", or '{kind}'" if kind else ""),
                    code="E412",
                )

    def declare(self, after: str | None) -> None:
        """Declare the frames that come after a coordinate or a frame (None: those that come first), in order."""
        loader = self.loader
        for number in [n for n, name in self.waiting.items() if name == after]:
            del self.waiting[number]
            table, place = loader.file.frame[number], loader.index.of_key(("frame", number))
            made = loader.placed(lambda t=table, p=place: self._made(t, p), place)
            for x in (*made.coordinates, *made.velocities):
                loader.scope.add(x.name, x.symbol)
            self.declare(normal(table.name))

    def _made(self, table: FrameTable, place: Place) -> Floating:
        """The variables of a frame; one that floats exists at once, a ball joint waits for what carries it."""
        builder, geometry = self.loader.builder, self.geometry
        if table.ball:
            made = geometry.held[table.name] = builder.quaternion(table.name, held=True, place=place)
            return made
        frame = builder.floating_frame(table.name, place=place)
        assert frame.name is not None and frame.floating is not None and frame.origin.name is not None
        geometry.frames[frame.name] = frame
        geometry.points[frame.origin.name] = frame.origin
        return frame.floating

    def finish(self) -> None:
        """Raise an error for frames that come after something that does not exist."""
        for number, after in self.waiting.items():
            tables = self.loader.file.frame
            known = [*self.loader.file.coordinates, *(t.name for t in tables if t.has_quaternion)]
            raise ParseError(
                f"there is no coordinate or frame with a quaternion {shown(str(after))} that its coordinates could "
                "follow",
                element=f"frame {shown(tables[number].name)}",
                place=self.loader.index.of_value(("frame", number, "after")),
                fix=did_you_mean(str(after)[:64], known) or "leave 'after' out: then its coordinates come first",
                code="E402",
            )
