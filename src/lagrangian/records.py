"""Data classes whose methods are compiled when they are first used, so that importing them takes no time.

The standard `dataclasses.dataclass` compiles up to six functions for each class while its file is imported, 0.4 ms for
one that is frozen, and a derivation imports two hundred such classes. Here only those methods are compiled that are
called. In all else the classes are standard ones: `fields`, `replace` and `asdict` work, and type checkers see no
difference.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from copy import copy
from dataclasses import field as field
from reprlib import recursive_repr
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from dataclasses import dataclass as dataclass
else:

    def dataclass(cls=None, /, *, frozen=False, eq=True, kw_only=False, slots=False):
        """Make a class a data class, like the standard decorator with these options; with slots, by that one."""
        if slots:
            return dataclasses.dataclass(cls, frozen=frozen, eq=eq, kw_only=kw_only, slots=True)

        def made(cls: type) -> type:
            return _made(cls, frozen, eq, kw_only)

        return made if cls is None else made(cls)


def _made(cls: type, frozen: bool, eq: bool, kw_only: bool) -> type:
    own = dict(cls.__dict__)
    cls.__doc__ = cls.__doc__ or cls.__name__  # else the standard decorator writes one from the signature
    dataclasses.dataclass(init=False, repr=False, eq=False, kw_only=kw_only)(cls)
    added: dict[str, Any] = {"__init__": _AtFirstUse(cls, "__init__", lambda: _constructor(cls, frozen))}
    if "__repr__" not in own:
        added["__repr__"] = _shown
    if eq and "__eq__" not in own:
        added["__eq__"] = _AtFirstUse(cls, "__eq__", lambda: _twin(cls, init=False).__eq__)
    if eq and own.get("__hash__") is None:
        hashing = _AtFirstUse(cls, "__hash__", lambda: _twin(cls, init=False, unsafe_hash=True).__hash__)
        added["__hash__"] = hashing if frozen else None
    if frozen:
        added |= _frozen(cls)
    for name, value in added.items():
        setattr(cls, name, value)
    return cls


class _AtFirstUse:
    """A method that is made when it is first looked up, and takes this object's place."""

    def __init__(self, cls: type, name: str, make: Callable[[], Callable[..., Any]]) -> None:
        self._cls, self._name, self._make = cls, name, make

    def __get__(self, instance: object, owner: type | None = None) -> Any:
        made: Any = self._make()
        made.__qualname__, made.__module__ = f"{self._cls.__qualname__}.{self._name}", self._cls.__module__
        setattr(self._cls, self._name, made)
        return made if instance is None else made.__get__(instance)


def _constructor(cls: type, frozen: bool) -> Callable[..., Any]:
    """``__init__``: it stores its arguments, or the defaults, and calls ``__post_init__``."""
    init: Any = _twin(cls, frozen=frozen, eq=False).__init__
    init.__annotations__ = {f.name: f.type for f in dataclasses.fields(cls) if f.init} | {"return": None}
    return init


def _twin(cls: type, **options: Any) -> type:
    """A standard data class with the fields of a class, for the methods that are compiled for it."""
    namespace = {"__post_init__": None} if hasattr(cls, "__post_init__") else {}
    named = [(f.name, "object", copy(f)) for f in dataclasses.fields(cls)]
    return dataclasses.make_dataclass(cls.__name__, named, namespace=namespace, repr=False, **options)


@recursive_repr()
def _shown(self: Any) -> str:
    shown = (f"{f.name}={getattr(self, f.name)!r}" for f in dataclasses.fields(self) if f.repr)
    return f"{type(self).__qualname__}({', '.join(shown)})"


def _frozen(cls: type) -> dict[str, Any]:
    """What refuses changes of the fields, and of anything else in objects of the class itself."""
    names = frozenset(f.name for f in dataclasses.fields(cls))

    def __setattr__(self: Any, name: str, value: Any) -> None:
        if type(self) is cls or name in names:
            raise dataclasses.FrozenInstanceError(f"cannot assign to field {name!r}")
        super(cls, self).__setattr__(name, value)

    def __delattr__(self: Any, name: str) -> None:
        if type(self) is cls or name in names:
            raise dataclasses.FrozenInstanceError(f"cannot delete field {name!r}")
        super(cls, self).__delattr__(name)

    return {"__setattr__": __setattr__, "__delattr__": __delattr__}
