"""MJCF written out: files that are included, groups of bodies in <frame>, and copies by <replicate>.

Afterwards a body contains only what belongs to it. Every tag knows the frames that it stood in, from the outermost:
its pose is T_1 T_2 … T, and that of copy i of <replicate> begins with the i-th power of its step.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from lagrangian.errors import ParseError
from lagrangian.quantities.source import shown
from lagrangian.read.robots.beside import beside
from lagrangian.read.robots.markup import MAX_TAGS, MarkupFile, Tag
from lagrangian.read.validate import MAX_BYTES, decode
from lagrangian.records import dataclass, field

MAX_INCLUDED = 100
"""The largest number of files that one file includes."""

MAX_COPIES = 1000
"""The largest number of copies that one <replicate> makes."""


def expand(root: Tag, folder: Path | None) -> None:
    """Put included files, and what is in frames and copies, where it belongs; raises `ParseError` with its place.

    Files are read from ``folder`` and below alone; without a folder <include> is refused.
    """
    _Included(folder).into(root)
    worlds = [tag for tag in root.children if tag.name == "worldbody"]
    for other in worlds[1:]:
        worlds[0].children.extend(other.children)
        root.children.remove(other)
    copies = _Copies()
    for world in worlds[:1]:
        copies.write_out(world)


@dataclass
class _Included:
    """The files read so far."""

    folder: Path | None
    known: set[Path] = field(default_factory=set[Path])

    def into(self, tag: Tag) -> None:
        """Replace every <include> within a tag by what its file has."""
        waiting = [tag]
        for outer in waiting:
            while any(child.name == "include" for child in outer.children):
                outer.children = [x for child in outer.children for x in self._read(child)]
            waiting.extend(outer.children)

    def _read(self, tag: Tag) -> list[Tag]:
        if tag.name != "include":
            return [tag]
        name = tag.word("file", "arm.xml")
        if self.folder is None:
            fix = "load the robot from its file, lagrangian.load(path), or put the text of that file in its place"
            raise tag.error("<include> needs a file, and there are none beside a text", fix, "E702")
        try:
            path = beside(tag, self.folder, name, "file")
            with path.open("rb") as file:
                data = file.read(MAX_BYTES + 1)
        except ParseError:
            raise
        except (OSError, ValueError, RuntimeError) as error:
            said = f"the file {shown(name)} cannot be read ({type(error).__name__})"
            raise tag.error(said, "its name counts from the folder of the robot's file", "E702", "file") from None
        if path in self.known:
            raise tag.error(f"the file {shown(name)} is included twice", "a file is included once", "E404", "file")
        self.known.add(path)
        if len(self.known) > MAX_INCLUDED:
            raise tag.error(f"more than {MAX_INCLUDED} files are included", "is this a robot?", "E703")
        return MarkupFile(decode(data, name), name).parse().children


@dataclass
class _Copies:
    """Writes frames and copies out; ``made`` counts the tags of copies."""

    made: int = 0

    def write_out(self, tag: Tag) -> None:
        """Replace the frames and copies within a body by what they contain."""
        tag.children = list(self._flat(tag, (), None))
        for child in tag.children:
            if child.name == "body":
                self.write_out(child)

    def _flat(self, tag: Tag, frames: tuple[Tag, ...], own: str | None) -> Iterator[Tag]:
        """The children of a body, or of a frame in it with the class ``own``, each with its frames."""
        for child in tag.children:
            child.read = child.read or child.name in ("frame", "replicate")
            if child.name == "frame":
                yield from self._flat(child, (*frames, child), child.get("childclass") or own)
            elif child.name == "replicate":
                count, sep = self._count(child), child.get("sep") or ""
                for i in range(count):
                    copied = self._copy(child, f"{sep}{i:0{len(str(count))}d}")
                    yield from self._flat(copied, (*frames, *(child for _ in range(i))), own)
            else:
                child.frames = frames
                if own is not None:
                    child.attributes.setdefault("childclass" if child.name == "body" else "class", own)
                yield child

    def _count(self, tag: Tag) -> int:
        count = tag.number("count")
        if count != int(count) or not 1 <= count <= MAX_COPIES:
            raise tag.error(f"'count' is {count:g}", f"a whole number from 1 to {MAX_COPIES}", "E406", "count")
        return int(count)

    def _copy(self, tag: Tag, end: str) -> Tag:
        """A copy of a tag and all that it contains, whose names have the same end."""
        self.made += 1
        if self.made > MAX_TAGS:
            raise tag.error(f"copies have more than {MAX_TAGS} elements", "is this a robot?", "E703")
        attributes = dict(tag.attributes)
        if "name" in attributes:
            attributes["name"] += end
        return replace(tag, attributes=attributes, children=[self._copy(child, end) for child in tag.children])
