"""A model file while it is read: its text, the description so far, and the names declared so far."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NoReturn

import sympy as sp

from lagrangian.errors import ModelError, ParseError, Place
from lagrangian.model import Builder
from lagrangian.model.geometry import as_expr
from lagrangian.read.expression import read_source
from lagrangian.read.scope import Scope
from lagrangian.read.toml_index import Path
from lagrangian.read.validate import read_toml


class Reading:
    """The state of reading one file; ``scope`` contains the names declared so far, ``builder`` the description so
    far."""

    def __init__(self, text: str, name: str) -> None:
        self.file, self.data, self.index = read_toml(text, name)
        self.builder = Builder(self.file.name if self.file.name.strip() else self._unnamed())
        self.scope = Scope()

    @property
    def generalized_names(self) -> list[str]:
        """What a generalized force may act on: the coordinates, and the velocities of floating frames."""
        return list(dict.fromkeys(x.name for x in (*self.builder.coordinates, *self.builder.floating)))

    def _unnamed(self) -> NoReturn:
        place = self.index.of_value(("name",))
        raise ParseError("the name of the system is empty", place=place, fix='name = "two-link arm"', code="E401")

    def placed(self, make: Callable[[], Any], place: Place, element: str | None = None) -> Any:
        """Call ``make``; an error without a place gets this one."""
        try:
            return make()
        except ModelError as error:
            error.at(place)
            if error.element is None and element is not None:
                error.element = element
            raise

    def expression(self, value: Any, path: Path, what: str, local: tuple[sp.Symbol, ...] = ()) -> sp.Expr:
        """Return the SymPy expression of a text or number at a path; only this expression may use the names in
        ``local``."""
        if not isinstance(value, str):
            return self.placed(lambda: as_expr(_whole(value), what), self.index.of_value(path))
        scope = self.scope.extended({s.name: s for s in local}) if local else self.scope
        return read_source(self.index.source(path, value, what), scope)

    def vector(self, values: list[Any], path: Path, what: str) -> tuple[sp.Expr, ...]:
        """Return the expressions of a list."""
        return tuple(self.expression(v, (*path, i), f"component {i + 1} of {what}") for i, v in enumerate(values))


def _whole(value: float) -> int | float:
    """Return a whole number as an integer, so that it is displayed without a decimal point."""
    return int(value) if float(value).is_integer() else value
