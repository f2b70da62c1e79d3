"""Floating frames of a model file, which are declared together with the coordinates because they have their own."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lagrangian.errors import ParseError, did_you_mean
from lagrangian.quantities.source import shown
from lagrangian.read.letters import normal

if TYPE_CHECKING:
    from lagrangian.read.file_geometry import Geometry
    from lagrangian.read.file_reading import Reading


class FloatingFrames:
    """The floating frames of one file, each of which waits for the coordinate or frame that it comes ``after``."""

    def __init__(self, loader: Reading, geometry: Geometry) -> None:
        self.loader, self.geometry = loader, geometry
        tables = enumerate(loader.file.frame)
        self.waiting = {n: None if t.after is None else normal(t.after) for n, t in tables if t.floating}
        self._refuse_after_without_floating()

    def _refuse_after_without_floating(self) -> None:
        for number, table in enumerate(self.loader.file.frame):
            for key in ("angle", "axis", "parent", "origin") if table.floating else ("after",):
                if getattr(table, key) is not None:
                    what = "it floats, so it has no" if table.floating else "it does not float, so it needs no"
                    raise ParseError(
                        f"{what} '{key}'",
                        element=f"frame {shown(table.name)}",
                        place=self.loader.index.of_key(("frame", number, key)),
                        fix=f"leave '{key}' out" + (", or 'floating'" if table.floating else ""),
                        code="E412",
                    )

    def declare(self, after: str | None) -> None:
        """Declare the frames that come after a coordinate or a frame (None: those that come first), in order."""
        loader = self.loader
        for number in [n for n, name in self.waiting.items() if name == after]:
            del self.waiting[number]
            name, place = loader.file.frame[number].name, loader.index.of_key(("frame", number))
            frame = loader.placed(lambda n=name, p=place: loader.builder.floating_frame(n, place=p), place)
            for x in (*frame.floating.coordinates, *frame.floating.velocities):
                loader.scope.add(x.name, x.symbol)
            self.geometry.frames[frame.name] = frame
            self.geometry.points[frame.origin.name] = frame.origin
            self.declare(frame.name)

    def finish(self) -> None:
        """Raise an error for frames that come after something that does not exist."""
        for number, after in self.waiting.items():
            tables = self.loader.file.frame
            known = [*self.loader.file.coordinates, *(t.name for t in tables if t.floating)]
            raise ParseError(
                f"there is no coordinate or floating frame {shown(str(after))} that its coordinates could follow",
                element=f"frame {shown(tables[number].name)}",
                place=self.loader.index.of_value(("frame", number, "after")),
                fix=did_you_mean(str(after)[:64], known) or "leave 'after' out: then its coordinates come first",
                code="E402",
            )
