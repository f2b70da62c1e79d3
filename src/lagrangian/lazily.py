"""Lazy imports: the names of a package are imported when they are first used, so that nobody waits for unused ones."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from importlib import import_module
from types import ModuleType


def lazily(room: str, places: Mapping[str, str]) -> Callable[[str], object]:
    """Return ``__getattr__`` for the package ``room``; ``places`` maps each file in it to the names that it defines,
    separated by spaces.

    The package lists the same names for type checkers under ``if TYPE_CHECKING``. No name may be that of a file in the
    room, because importing the file would replace the name.
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
    """A package that hides its subpackages, which Python would otherwise make attributes of it on import."""

    def __setattr__(self, name: str, value: object) -> None:
        if not isinstance(value, ModuleType):
            super().__setattr__(name, value)


def closed(package: str) -> None:
    """Hide the subpackages of a package from its names: they are imported by their full names.

    Otherwise ``lg.derive`` would be a module, and calling it would fail with a confusing message.
    """
    module = sys.modules[package]
    for name in [name for name, value in vars(module).items() if isinstance(value, ModuleType) and name[0] != "_"]:
        delattr(module, name)
    module.__class__ = _Closed
