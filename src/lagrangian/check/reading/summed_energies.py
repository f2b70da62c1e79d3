"""T* and V that no line states as a whole, though others use them: the sum of T_cart = … and T_rod = …."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reading.answer import AnswerLine, Kind
from lagrangian.check.reading.energy_parts import inertia_letters
from lagrangian.check.reading.line_forms import Statement
from lagrangian.check.reading.names import Names
from lagrangian.check.reading.nodes import derived, names_in, only_name
from lagrangian.check.reading.stated import energy_of
from lagrangian.check.reading.subject import Subject
from lagrangian.errors import listed
from lagrangian.model import Body, Gravity, Inductor, Model, Spring, time
from lagrangian.read.letters import key

ADDED = {kind: f"{letter} in parts" for kind, letter in (("T", "T*"), ("V", "V"))}
"""The text of a line that is the sum of parts, which nobody wrote."""
_OF = {
    "T": re.compile(r"(?:T|K|E_?\{?k(?:in)?)[_,]*\{?[^\W_]{1,40}\}*"),
    "V": re.compile(r"(?:V|U|E_?\{?p(?:ot)?)[_,]*\{?[^\W_]{1,40}\}*"),
}
"""The names of a part of each energy."""
_KIND_OF_MOTION = re.compile(r"_?(?:(?P<trans>trans)|(?P<rot>rot))", re.IGNORECASE)
_NUMBERED = re.compile(r"[A-Za-z_{]{1,7}(?P<number>\d{1,2})\}?")
_CALLED = {"T": "T*", "V": "V"}


class PartsOfEnergies:
    """The definitions of an answer that may be the parts of T*, or of V."""

    def __init__(self, model: Model, names: Names) -> None:
        self.model, self.names = model, names
        self._parts: dict[str, dict[int, str]] = {}
        """Of each energy, the names of its parts, by the number of the statement."""

    def gather(self, defining: Sequence[tuple[int, Subject]], statements: Sequence[Statement]) -> None:
        """Record the parts of each energy that no statement gives, and that others use, L = T − V, ∂V/∂φ, or of which
        the parts are numbered from 1 on.

        Nothing else uses their names, or they may be added up in another way.
        """
        sides = [side for s in statements for side in s.sides]
        letters = {str(x) for side in sides for x, _ in names_in(side)} | derived(sides)
        used = {energy_of(x, self.model) for x in letters} - self.names.stating
        used |= {"T", "V"} - self.names.stating if "L" in used else set[str]()
        for kind, form in _OF.items():
            named = [(i, s) for i, s in defining if s.token is not None and form.fullmatch(str(s.token))]
            alone = [i for i, s in named if self.names.occurs(str(s.token)) == 1 and not (s.order or s.inverse)]
            numbered = kind not in self.names.stating and are_numbered([str(s.token) for _, s in named])
            if (kind in used or numbered) and len(named) == len(alone) > 1:
                self._parts[kind] = {i: str(s.token) for i, s in named}

    def order(self, statements: Sequence[Statement]) -> list[int]:
        """The numbers of the statements as they are read: a name for energies alone, E = T + V, behind the lines that
        say what these are, which may stand below it."""
        later = {i for i, s in enumerate(statements) if self._adds(s)}
        return sorted(range(len(statements)), key=lambda i: (i in later, i))

    def _adds(self, statement: Statement) -> bool:
        """Whether a statement gives energies that others state a name of its own."""
        named = only_name(statement.sides[0]) if len(statement.sides) == 2 else None
        if named is None or named[1] or energy_of(named[0], self.model, lhs=True) or self.names.known(named[0]):
            return False
        kinds = [energy_of(x, self.model) for x, _ in names_in(statement.sides[1])]
        return len(kinds) > 1 and all(kind is not None and kind in self.names.stating for kind in kinds)

    def whole(self, i: int, made: Mapping[int, Sequence[AnswerLine]]) -> list[AnswerLine]:
        """The line that states an energy as the sum of its parts, behind the last of them."""
        return [
            self._sum(kind, [lines for k in parts for lines in made[k]])
            for kind, parts in self._parts.items()
            if i == max(parts) and parts.keys() <= made.keys() and self._is_whole(kind, parts, made)
        ]

    def _sum(self, kind: str, parts: Sequence[AnswerLine]) -> AnswerLine:
        for note in [x for x in self.names.notes if any(x.startswith(f"'{p.text}' was not judged: ") for p in parts)]:
            del self.names.notes[note]
        total = sp.Add(*[p.rhs for p in parts])
        self.names.stated[kind] = total
        self.names.stating.add(kind)
        places = list(dict.fromkeys(str(p.place.line) for p in parts))
        where = f"lines {listed(places)}" if len(places) > 1 else f"line {places[0]}"
        self.names.notes.setdefault(f"{_CALLED[kind]} is stated in parts; those in {where} were added up.")
        names = frozenset(key(p.name or "") for p in parts)
        return AnswerLine(cast("Kind", kind), None, total, None, parts[-1].place, ADDED[kind], names)

    def _is_whole(self, kind: str, parts: Mapping[int, str], made: Mapping[int, Sequence[AnswerLine]]) -> bool:
        """Whether the parts are energies of all that has such an energy, each of another thing."""
        lines = [x for k in parts for x in made[k]]
        values = [self.model.expand(x.rhs) for x in lines if x.kind == "definition" and isinstance(x.rhs, sp.Expr)]
        motions = [m and m.lastgroup for name in parts.values() for m in [_KIND_OF_MOTION.search(name)]]
        if len(values) != len(lines) or len(lines) != len(parts) or (None not in motions and len({*motions}) == 1):
            return False
        if any(self.names.is_unknown(x) for value in values for x in bounded.letters(value)):
            return False
        rates = {c.symbol.diff(time) for c in self.model.coordinates}
        if not all(bool(bounded.atoms(x, sp.Derivative) & rates) == (kind == "T") for x in values):
            return False
        held = [frozenset(key(str(x)) for x in bounded.letters(value)) for value in values]
        things = things_with(self.model, kind)
        often = Counter(x for own in things for x in own)
        moving = {c.symbol for c in self.model.coordinates} | rates
        shared = are_numbered([*parts.values()]) and _share_no_term(values, moving)
        return bool(things) and all(
            any(own & x for x in held) and (shared or all(sum(a in x for x in held) <= often[a] for a in own))
            for own in things
        )


def are_numbered(names: Sequence[str]) -> bool:
    """Whether names are a letter with the numbers from 1 on, each once: T1, T2, T3."""
    found = [_NUMBERED.fullmatch(x) for x in names]
    return [int(m["number"]) for m in found if m is not None] == [*range(1, len(names) + 1)]


def _share_no_term(values: Sequence[sp.Expr], moving: Collection[sp.Basic]) -> bool:
    """Whether no two energies have a term with the same positions and rates: parts by kind of motion, x'² and φ'²."""
    held = [
        {t.as_independent(*moving, as_Add=False)[1] for t in sp.Add.make_args(bounded.expand(value))}
        for value in values
    ]
    return sum(map(len, held)) == len(set[object]().union(*held))


def things_with(model: Model, kind: str) -> list[frozenset[str]]:
    """Of each thing with T*, or with V, the letters that are its inertia, its stiffness or its weight; none if one has
    no letter of its own."""
    moving = [x for c in model.coordinates for x in (c.symbol, c.rate)]
    found = list[frozenset[str]]()
    if kind == "T":
        found = [inertia_letters(b, lengths=False) for b in model.bodies]
    else:
        weights = [e.potential(model) for e in model.elements if isinstance(e, Gravity)]
        fallen = model.expand(sp.Add(*weights))
        for b in model.bodies:
            masses = {x for x in sp.sympify(b.mass).free_symbols if bounded.diff(fallen, x).has(*moving)}
            found += [frozenset(key(str(x)) for x in masses)] if masses else []
    for e in model.elements:
        if isinstance(e, (Gravity, Body)) or model.expand(e.kinetic(model) if kind == "T" else e.potential(model)) == 0:
            continue
        letter = e.L if isinstance(e, Inductor) else e.k if isinstance(e, Spring) else None
        letters = {letter} if isinstance(letter, sp.Symbol) else _factors(e.kinetic(model) + e.potential(model))
        found.append(frozenset(key(str(x)) for x in letters))
    return found if all(found) else []


def _factors(energy: sp.Expr) -> set[sp.Symbol]:
    """The letters to which an energy that is given as it is is proportional: J of J φ'²/2."""
    held = [{x for x in sp.Mul.make_args(t) if isinstance(x, sp.Symbol)} for t in sp.Add.make_args(energy)]
    return set[sp.Symbol].intersection(*held)
