"""A verdict in the names that an answer gives to the coordinates of a system: th for theta.

Where only names differ, mistakes are sought in the system's own and told in those of the answer.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass, replace
from typing import Any, TypeVar, cast

import sympy as sp

from lagrangian.check.verdict import Finding, Mistake, TermDifference
from lagrangian.page.plain import plain

T = TypeVar("T")


def names_only(table: Mapping[sp.Expr, sp.Expr], own: list[sp.Expr]) -> bool:
    """Whether a change of coordinates gives each one another name, and nothing else."""
    values = list(table.values())
    return all(psi in own for psi in values) and len(set(values)) == len(values) and not set(table) & set(own)


class OwnNames:
    """The answer's names for the coordinates of a system; ``table`` are those of the system by those of the answer."""

    def __init__(self, table: Mapping[sp.Expr, sp.Expr]) -> None:
        self.back: dict[Any, sp.Expr] = {psi: eta for eta, psi in table.items()}
        self.words = {plain(psi): plain(eta) for eta, psi in table.items()}

    def finding(self, finding: Finding) -> Finding:
        """A finding, but for its line."""
        differences = tuple(self._difference(d) for d in finding.differences)
        note = self._put(finding.note)
        return replace(finding, differences=differences, note=note, coordinate=self._name(finding.coordinate))

    def mistake(self, mistake: Mistake) -> Mistake:
        """A mistake in words."""
        what, why, brief = self._put(mistake.what), self._put(mistake.why), self._put(mistake.brief)
        return replace(mistake, what=what, why=why, brief=brief, coordinate=self._name(mistake.coordinate))

    def _difference(self, d: TermDifference) -> TermDifference:
        return replace(d, term=self._put(d.term), written=self._put(d.written), coordinate=self._name(d.coordinate))

    def _name(self, name: str | None) -> str | None:
        return self.words.get(name, name) if name is not None else None

    def _put(self, value: T) -> T:
        return each_formula(value, lambda x: cast("sp.Basic", x.xreplace(self.back)))


def each_formula(value: T, put: Callable[[sp.Basic], sp.Basic], words: Callable[[str], str] | None = None) -> T:
    """Words and formulas, however they are nested, with something put in place of every formula, and of all ``words``
    if it is given."""
    found: Any = value
    if isinstance(value, sp.Basic):
        found = put(value)
    elif words is not None and type(value) is str:  # and no status, which is one of several words
        found = words(value)
    elif isinstance(value, tuple):
        found = tuple(each_formula(x, put, words) for x in value)
    elif is_dataclass(value) and not isinstance(value, type):
        own = {f.name: getattr(value, f.name) for f in fields(value) if f.init}
        found = replace(value, **{name: each_formula(x, put, words) for name, x in own.items()})
    return cast("T", found)
