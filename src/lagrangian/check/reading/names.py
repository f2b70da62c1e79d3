"""The meaning of the names in one answer: symbols of the model, the answer's own names, energies and Ξ, or unknown."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from difflib import get_close_matches
from functools import lru_cache
from typing import Any, TypeVar

import sympy as sp
from lark import Token, Tree
from sympy.core.function import AppliedUndef
from sympy.matrices.matrixbase import MatrixBase

from lagrangian.check.reading.answer import Unknown
from lagrangian.check.reading.components import component_of, has_entries
from lagrangian.check.reading.implied_rates import implied_rates
from lagrangian.check.reading.name_hints import factors_of, hint_for
from lagrangian.check.reading.nodes import names_in, start_of
from lagrangian.check.reading.own_inputs import OwnInputs
from lagrangian.check.reading.own_slopes import OwnCoordinates, own_coordinates
from lagrangian.check.reading.own_values import OwnValues
from lagrangian.check.reading.placeholders import ENERGIES, generalized_force, vector
from lagrangian.check.reading.related import StatedRelations
from lagrangian.check.reading.shortened import AnswerScope
from lagrangian.check.reading.stated import NamedForces, energy_of, force_of, of_coordinate, own_kinetic
from lagrangian.errors import ParseError
from lagrangian.model import Model
from lagrangian.model.names import moving_symbol, time
from lagrangian.quantities.source import Source
from lagrangian.read.letters import key, spelled, undotted
from lagrangian.read.scope import Scope, rate_stems

T = TypeVar("T")
MAX_NAME = 64
MAX_UNKNOWN = 100
"""The largest number of unknown names in an answer."""
MAX_HINTS = 20
"""The largest number of unknown names for which a suggestion is sought."""
SHORTEST_NEAR, NEAR = 4, 0.8
"""In LaTeX, where adjacent letters are a product: the fewest letters of a misspelled name, and its similarity."""

PI = ("pi", "π", "Pi", "PI")
"""Names of π, also of programs."""
BOLD = "bold "
"""What stands in front of a bold letter."""
COLUMNS = frozenset(["q", "x", "X", "y", "z", "xi", "eta"])
"""Letters that often are the column of all coordinates."""

Value = Any
"""An expression, or a matrix of expressions."""


class Names:
    """The names and their meanings, which are added as the answer is read, line by line."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self.scope = AnswerScope(Scope(model.symbols))
        self.redefined = OwnValues()
        self.statement = 0
        """The number of the statement that is read."""
        self.own, self.stated = dict[str, tuple[str, Value]](), dict[str, Value]()
        self.unknown: dict[str, Unknown] = {}
        self.renamed: dict[str, Unknown] = {}
        """The names that were read as others of the system, with the symbols of these."""
        self.notes: dict[str, None] = {}
        """How names were read that the answer does not spell as the system does."""
        self.rates: dict[tuple[str, int], Value] = {}
        self.later: Callable[[str], None] = lambda base: None
        self.derivatives: dict[tuple[Value, sp.Expr], Value] = {}
        self.stating: set[str] = set()
        """The energies that lines of the answer state."""
        self.relations, self.inputs = StatedRelations(model), OwnInputs(model)
        self.moving = self.matrices = False
        """Whether the statement that is being read has accelerations (an energy must be stated then), and matrices."""
        self.columns = False
        """Whether a coordinate q of the system is the column of all of them in that statement: M*qdd + K*q = f."""
        self.column = [c.symbol for c in model.coordinates]
        """The coordinates in the order in which such a column holds them."""
        self.given_matrices, self.defined = set[str](), set[str]()
        """The names that a statement of the answer gives a matrix, and those that one defines."""
        self.chained, self.sloped = dict[int, tuple[Token, int]](), dict[int, dict[str, str]]()
        """By statement, the name that a chain of energies gives, with its side, and those whose primes are slopes."""
        self.residuals: frozenset[str] = frozenset()
        """The names that the answer gives to expressions that are zero."""
        self.differentiated: tuple[str, ...] = ()
        """The names by which the answer differentiates energies."""
        self.moving_symbols: set[sp.Expr] = {c.symbol for c in model.coordinates}
        """The coordinates of the system."""
        self.dependents: frozenset[str] = frozenset()
        """The quantities that the answer states with what they depend on: I(r)."""
        self.implied: dict[str, sp.Expr] = {}
        """The rates that letters of the answer are unless it says what they are: i of a charge q."""
        self.called = frozenset[str]()  # letters of energies that words call something else: damping ratio D
        self.headed: dict[int, str] = {}
        """The headings that say of which quantity the items of a list are, by the numbers of their lines."""
        self._forces = NamedForces(model)
        self._moving, self._seen = set[str](), Counter[str]()

    # -- before the meaning ----------------------------------------------------------------------------------------

    @property
    def unexplained(self) -> frozenset[str]:
        """The names that no statement explains, as they are written."""
        return frozenset(u.name for u in self.unknown.values())

    @property
    def asked(self) -> list[str]:
        """The names that nothing explains, and those that were read as others."""
        return [u.name for u in (*self.unknown.values(), *self.renamed.values())]

    def gather(self, trees: Iterable[Tree]) -> None:
        """Record which names occur in the trees, and which of them are differentiated anywhere."""
        for tree in trees:
            for token, changing in names_in(tree):
                base, dots = undotted(token)
                self._seen[key(base)] += 1
                if changing or dots:
                    self._moving.add(key(base))
        self._forces = NamedForces(self.model, self._seen)
        for base in list(self._seen):
            self._moving.update(key(stem) for _, stem in spelled_rates(base) if key(stem) in self._seen)
        self.implied = implied_rates(self.model, self._seen, self._moving)

    def known(self, written: str) -> bool:
        """Whether a name already has a meaning."""
        base, _ = undotted(written)
        return bool(
            self.scope.meanings(written)[0]
            or key(base) in self.own
            or written in ("t", *PI)
            or energy_of(written, self.model)
            or force_of(written, self.model)
        )

    def misspelled(self, run: str) -> bool:
        """Whether a run of letters is similar to a name of the model and is not a product of known names."""
        near = len(run) >= SHORTEST_NEAR and not self.known(run) and not factors_of(run, self.scope)
        return near and bool(get_close_matches(run, self.scope, n=1, cutoff=NEAR))

    def occurs(self, written: str) -> int:
        """How often a name occurs in the answer."""
        return self._seen[key(undotted(written)[0])]

    def force(self, written: str) -> str | None:
        """The coordinate whose generalized force a name is in this answer; None if it is not one."""
        of = of_coordinate(written)
        if of is not None and key(of[1]) in self.defined and not self.scope.meanings(of[1])[0]:
            return None  # Q_s of an s that the answer defines, beside x_s
        own = of is not None and of[1] in ("x", "y", "z") and self._seen[key(written)] > 1 and written[0] == "Q"
        for axis in "xyz" if own else "":
            other = key(written)[:-1] + axis
            if self._seen[other] > 1 and not self.scope.meanings(axis)[0] and axis not in self.defined:
                return None  # Q_y beside Q_x, both used, where x is no coordinate: a force's components
        return self._forces.of(written)

    def changes(self, written: str) -> bool:
        """Whether a name, of the system or of the answer, changes with time, so that it can have a rate."""
        names, _ = self.scope.meanings(written)
        if names:
            return self.scope[names[0]].has(AppliedUndef)
        return key(written) in self._moving or key(written) in self.implied.keys() - self.defined

    def is_own(self, written: str) -> bool:
        """Whether the answer has said what a name is."""
        return key(undotted(written)[0]) in self.own

    # -- meaning -----------------------------------------------------------------------------------------------------

    def define(self, written: str, value: Value) -> None:
        """Give a name of the answer its meaning; a number beside a value that moves is only one position."""
        base = key(undotted(written)[0])
        value, above = self.inputs.meant(written, value, self.occurs, self.notes), self.own.get(base)
        if above is not None and above[1].atoms(AppliedUndef) and isinstance(value, sp.Expr) and value.is_number:
            self.notes.setdefault(f"'{written} = {value}' was not judged: {written} moves, this is one position.")
            return
        self.own[base] = (str(written), value)
        self.redefined.define(base, value, self.statement)

    def mine(self, base: str) -> tuple[str, Value] | None:
        """A name of the answer and the value that it has now, which counts as used."""
        if base not in self.own and base not in self.defined and (rate := self.implied.get(base)) is not None:
            self.notes.setdefault(f"'{base}' was read as {rate.args[0].func}'.")
            self.own[base] = (base, rate)
        if base in self.own:
            self.redefined.use(base)
        return self.own.get(base)

    def meaning(self, token: Token, source: Source) -> tuple[str, Value, int]:
        """Return the name, its value and its number of dots. An unknown name is recorded; it is not an error.

        ``later`` looks up a name that the answer defines further down ("where h = …").
        """
        names, dots = self.scope.meanings(token)
        if self.matrices and (matrix := self._matrix(undotted(token)[0])) is not None:
            return str(token), matrix, undotted(token)[1]
        for order, stem in spelled_rates(token) if self.columns else ():
            if (matrix := self._matrix(stem)) is not None:
                return str(token), matrix, order
        if len(names) > 1:
            listed = " or ".join(f"'{n}'" for n in names)
            what = f"'{token[:40]}' can mean {listed}"
            raise source.error(what, start_of(token), fix="write the one you mean", code="E402")
        if names:
            if key(undotted(token)[0]) != key(names[0]):
                base = undotted(token)[0]
                self.notes.setdefault(f"'{base}' was read as {names[0]}.")
                symbol: Any = self.scope[names[0]]
                if len(base) == 1 and base.isascii():  # no th of θ
                    self.renamed.setdefault(base, Unknown(base, symbol, source.at(start_of(token))))
            return names[0], self.scope[names[0]], dots
        base, dots = undotted(token)
        if key(base) not in self.own:
            self.later(key(base))
        if (mine := self.mine(key(base))) is not None:
            return *mine, dots
        if base in ("bold Xi", "bold Q"):
            column = [generalized_force(c.name) for c in self.model.coordinates]
            return base, sp.ImmutableMatrix(column), dots
        if (kind := energy_of(base, self.model)) is not None and (kind in self.stating or not self.moving):
            given = self.energy(kind)
            return kind, ENERGIES[kind] if given is None else given, dots
        if (coordinate := self.force(base)) is not None:
            return base, generalized_force(coordinate), dots
        if base in PI or base == "t":
            return ("pi", sp.pi, dots) if base in PI else ("t", time, dots)
        if base.startswith(BOLD):  # a bold letter that is not a matrix of this answer
            plain = self.scope.meanings(base[5:])[0] and not has_entries(key(base), self.defined)
            if not plain and key(base[5:]) not in self.given_matrices:
                return base, vector(base[5:]), dots
            return self.meaning(Token("NAME", base[5:], start_pos=start_of(token)), source)
        for order, stem in spelled_rates(base):
            if self._is_near_rate(stem):  # phdd is φ'' as phd is φ', not the rate of a name phd
                continue
            if (found := self._rate_of(stem, token, source)) is not None:
                if found[0] in self.scope and key(stem) != key(found[0]):
                    self.notes.setdefault(f"'{base}' was read as {found[0]}{chr(39) * order}.")
                return *found, order + dots
        if (near := self._near_rate(base, token, source)) is not None:
            return near[0], self.scope[near[0]], near[1] + dots
        if (entry := component_of(base, self._matrix)) is not None:
            return base, entry, dots
        return self._noted(base, token, source), self.unknown[key(base)].symbol, dots

    def _matrix(self, base: str) -> Value | None:
        """The matrix that the answer gives this name; q or x is the column of coordinates if it is nothing else.

        Beside a matrix M_, M stays the mass that the system calls so.
        """
        own = self.scope.meanings(base)[0]
        if key(base) not in self.own and key(base) in self.given_matrices:
            self.later(key(base))
        if (mine := self.mine(key(base))) is not None and not (own and undotted(mine[0])[0] != base):
            return mine[1] if isinstance(mine[1], MatrixBase) else None
        if not self._is_column(base) or (own and not self.columns):
            return None
        return sp.ImmutableMatrix(self.column)

    def has_column(self, sides: Iterable[Tree]) -> bool:
        """Whether the column of all coordinates stands in trees by a letter that is nothing else."""
        stems = {undotted(token)[0] for side in sides for token, _ in names_in(side)}
        return any(self._is_column(x) and (x.startswith(BOLD) or not self.scope.meanings(x)[0]) for x in stems)

    def _is_column(self, base: str) -> bool:
        """Whether a letter that the answer does not define may be the column of coordinates."""
        return key(base.removeprefix(BOLD)) in COLUMNS and not {key(base), key(base.removeprefix(BOLD))} & self.defined

    def in_order(self, listed: Sequence[str]) -> None:
        """Take the order of the coordinates from an answer that lists all of them."""
        found = [self.scope[x[0]] for written in listed if len(x := self.scope.meanings(written)[0]) == 1]
        if len(found) == len(self.column) and set(found) == set(self.column):
            self.column = found

    def fitting(self, sides: Sequence[Tree], read: Callable[[], T]) -> T:
        """What a statement says; one of matrices that does not fit is read once more with a coordinate q as the column
        of all."""
        try:
            return read()
        except ParseError:
            listed = [token for side in sides for token, _ in names_in(side)] if self.matrices else []
            stems = {key(stem) for x in listed for stem in (undotted(x)[0], *(stem for _, stem in spelled_rates(x)))}
            if not any(key(c.name) in stems & COLUMNS for c in self.model.coordinates):
                raise
        self.columns = True
        try:
            return read()
        finally:
            self.columns = False

    def energy(self, kind: str) -> sp.Expr | None:
        """An energy as stated so far; the Lagrangian also from T* and V."""
        if kind == "L" and "L" not in self.stated and {"T", "V"} <= self.stated.keys():
            return self.stated["T"] - self.stated["V"]
        if kind == "T" and "T" not in self.stating and (base := own_kinetic(self.own)) is not None:
            name, value = self.mine(base) or (base, None)
            for note in [x for x in self.notes if x.endswith(f"nothing else uses {name}.")]:
                del self.notes[note]
            self.notes.setdefault(f"T was read as {name}: no line states T.")
            return value
        return self.stated.get(kind)

    def coordinates(self) -> OwnCoordinates | None:
        """The coordinates of the answer's own by which it differentiates; None if those of the system do."""
        meanings, kept = dict[str, sp.Expr](), set[sp.Expr]()
        for written in self.differentiated:
            stems = (written, *(stem for _, stem in spelled_rates(written)))
            known = next((names[0] for x in stems if (names := self.scope.meanings(x)[0])), None)
            base = key(known or undotted(written)[0])
            if known is None and base not in self.own:
                self.later(base)
            of: Any = self.scope[known] if known is not None else self.own.get(base, ("", sp.S.Zero))[1]
            if known is not None and self.model.expand(of) == of:
                kept.add(of)
                continue
            value = of if known is None else self.model.expand(of)
            if not isinstance(value, sp.Expr) or not value.has(AppliedUndef):
                return None
            meanings[base] = value
        own = tuple(c.symbol for c in self.model.coordinates)
        return own_coordinates(tuple(meanings.items()), frozenset(kept & self.moving_symbols), own)

    def is_unknown(self, symbol: sp.Basic) -> bool:
        """Whether a symbol, or the symbol of which it is the rate, is unknown to the model."""
        of = symbol.args[0] if isinstance(symbol, sp.Derivative) else symbol
        return any(u.symbol == of for u in self.unknown.values())

    def _rate_of(self, stem: str, token: Token, source: Source) -> tuple[str, Value] | None:
        """The symbol or function that depends on time and is called ``stem``."""
        names, _ = self.scope.meanings(stem)
        if len(names) == 1 and self.scope[names[0]].has(AppliedUndef):
            return names[0], self.scope[names[0]]
        if self.matrices and (column := self._matrix(stem)) is not None and column.has(AppliedUndef):
            return stem, column  # qdd = [y''; phi''], qd
        if key(stem) not in self.own and key(stem) in self._moving:
            self.later(key(stem))  # bdd = beta'', bd = beta'
        if (mine := self.mine(key(stem))) is not None:
            return mine
        if not names and key(stem) in self._seen and key(stem) in self._moving:
            return self._noted(stem, token, source), self.unknown[key(stem)].symbol
        return None

    def _is_near_rate(self, stem: str) -> bool:
        """Whether a name is the rate of a coordinate in shortened letters, and nothing says that it is another."""
        inner = stem.removesuffix("d")
        if inner == stem or len(inner) < 2 or self.known(stem) or key(stem) in self.defined:
            return False
        return sum(key(c.name).startswith(key(inner)) for c in self.model.coordinates) == 1

    def _near_rate(self, base: str, token: Token, source: Source) -> tuple[str, int] | None:
        """The coordinate and the order that a shortened name with dd, ddot, … means: thdd is theta''.

        None if the name is no rate in letters; an error if it is one, of no coordinate or of several.
        """
        spelled_out = [(k, key(stem)) for k, stem in spelled_rates(base)]
        found: dict[str, int] = {}
        for order, stem in spelled_out:
            near = [c.name for c in self.model.coordinates if key(c.name).startswith(stem)]
            if len(stem) > 1 or key(base).endswith(("dd", "dot")):
                for name in near:
                    found.setdefault(name, order)
        if len(found) == 1:
            ((name, order),) = found.items()
            self.notes.setdefault(f"'{base}' was read as {name}{chr(39) * order}.")
            return name, order
        if not key(base).endswith(("dd", "dot")) or not spelled_out:
            return None
        order = spelled_out[0][0]
        possible = found or dict.fromkeys((c.name for c in self.model.coordinates[:3]), order)
        meant = [f"{name}{chr(39) * order}" for name, order in possible.items()]
        fix = f"Did you mean {' or '.join(meant)}?"
        raise source.error(f"'{base[:40]}' cannot be read", start_of(token), fix=fix, code="E402")

    def _noted(self, base: str, token: Token, source: Source) -> str:
        if len(base) > MAX_NAME:
            what = f"a name with {len(base)} characters"
            raise source.error(what, start_of(token), fix=f"names have at most {MAX_NAME}", code="E703")
        if key(base) not in self.unknown:
            if len(self.unknown) >= MAX_UNKNOWN:
                what = f"more than {MAX_UNKNOWN} names that the system does not have"
                raise source.error(what, start_of(token), fix="use the names of the system", code="E703")
            spelling = spelled(base)
            symbol: sp.Expr = moving_symbol(spelling) if key(base) in self._moving else sp.Symbol(spelling)
            hint = hint_for(base, self.scope) if len(self.unknown) < MAX_HINTS else None
            self.unknown[key(base)] = Unknown(str(base), symbol, source.at(start_of(token)), hint)
        return base


def spelled_rates(base: str) -> tuple[tuple[int, str], ...]:
    """The orders and names that a spelled-out derivative can mean: xdd is the second derivative of x or the first of
    xd."""
    return _spelled_rates(str(base))


@lru_cache(maxsize=4_096)
def _spelled_rates(base: str) -> tuple[tuple[int, str], ...]:
    ends = ((suffix, order) for suffix, order in (("dd", 2), ("d", 1)) if base.endswith(suffix) and base != suffix)
    return (*rate_stems(base), *((order, base.removesuffix(suffix)) for suffix, order in ends))
