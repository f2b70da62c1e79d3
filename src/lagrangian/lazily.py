"""Names of a package: imported when they are first used, so that nobody waits for what they do not use."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from importlib import import_module
from types import ModuleType


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


class _Closed(ModuleType):
    """A package whose rooms are not names of it, though Python binds every room that is imported to its package."""

    def __setattr__(self, name: str, value: object) -> None:
        if not isinstance(value, ModuleType):
            super().__setattr__(name, value)


def closed(package: str) -> None:
    """Keep the rooms of a package out of its names: they are imported by their full names.

    Otherwise ``lg.derive`` would be a room, and calling it would fail with a message about modules.
    """
    module = sys.modules[package]
    for name in [name for name, value in vars(module).items() if isinstance(value, ModuleType) and name[0] != "_"]:
        delattr(module, name)
    module.__class__ = _Closed
