"""Names of a room that are imported when they are first used, so that nobody waits for what they do not use."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from importlib import import_module


def lazily(room: str, places: Mapping[str, str]) -> Callable[[str], object]:
    """Return ``__getattr__`` for the package ``room``; ``places`` is file within it → names that come from there,
    with spaces between.

    The package tells the type checker of the same names under ``if TYPE_CHECKING``. No name may be that of a file of
    the room: importing the file would put the file in the name's place.
    """
    where = {name: f"{room}.{place}" for place, names in places.items() for name in names.split()}

    def __getattr__(name: str) -> object:
        if name not in where:
            raise AttributeError(f"module '{room}' has no attribute '{name}'")
        found = getattr(import_module(where[name]), name)
        setattr(sys.modules[room], name, found)
        return found

    return __getattr__
