"""Files that lie beside a robot's file: nothing outside its folder is read."""

from __future__ import annotations

from pathlib import Path

from lagrangian.quantities.source import shown
from lagrangian.read.robots.markup import Tag


def beside(tag: Tag, folder: Path, local: str, what: str) -> Path:
    """The file ``local`` in a folder or below it; ``what`` says what it is.

    Raises `ParseError` for a place outside the folder, `OSError` if there is no such file.
    """
    path = (folder / local).resolve()
    if not path.is_relative_to(folder.resolve()):
        said = f"the {what} {shown(local)} is outside the folder of the robot's file"
        raise tag.error(said, "nothing outside that folder is read: put it there", "E702", "file")
    if not path.is_file():
        raise FileNotFoundError(path)
    return path
