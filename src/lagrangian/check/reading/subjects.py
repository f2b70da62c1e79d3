"""Recognizes what a statement of an answer is about: an energy, a Ξ, a momentum, a name of the answer."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import cast

import sympy as sp
from lark import Token, Tree
from sympy.core.function import AppliedUndef
from sympy.matrices.matrixbase import MatrixBase

from lagrangian.check.reading.answer import Kind
from lagrangian.check.reading.components import is_component
from lagrangian.check.reading.defined_energies import energy_of_definition
from lagrangian.check.reading.line_forms import accelerates, is_general
from lagrangian.check.reading.names import Names, spelled_rates
from lagrangian.check.reading.nodes import (
    Node,
    called_name,
    inside,
    is_matrix,
    names_in,
    only_name,
    rates_in,
    squared_name,
    without_minus,
)
from lagrangian.check.reading.placeholders import ENERGIES
from lagrangian.check.reading.stated import energy_of, has_squares, momentum_of
from lagrangian.check.reading.subject import Subject
from lagrangian.model import Model
from lagrangian.model.names import time
from lagrangian.read.letters import key, undotted

MULTIPLIERS = ("lambda", "lam", "lmbda")
"""How names of multipliers begin."""


def bare_names(trees: Iterable[Tree]) -> set[str]:
    """The keys of the names that stand in trees without a sign of a rate."""
    listed = (x for tree in trees for x in names_in(tree))
    return {key(token) for token, changing in listed if not changing and not undotted(token)[1]}


class Subjects:
    """Recognizes the subjects of statements; ``defined`` holds the names that a statement of the answer defines."""

    def __init__(self, model: Model, names: Names) -> None:
        self.model, self.names = model, names
        self.defined: set[str] = set()
        self.gives_rates: set[str] = set()
        """The keys of the names of which the rates of coordinates are functions."""
        self.accelerations: set[str] = set()
        """The keys of the names of accelerations, of which other statements are equations of motion."""
        self.bare: set[str] = set()
        """The keys of the names that stand somewhere without a sign of a rate."""
        self.leading: Counter[str] = Counter()
        """How many statements begin with a new name alone."""
        self.counted: set[str] = set()
        """The keys of the names that the answer counts from a coordinate: γ where θ = 90° − γ."""
        self.plain: frozenset[str] = frozenset()
        """The letters of energies that are names of the answer's own."""

    def turned(self, sides: list[Tree]) -> tuple[Subject | None, list[Tree]]:
        """The subject of a statement and its sides, the subject first; it may be on the left or right, a Ξ anywhere."""
        if len(sides) == 1:
            return None, sides
        found = only_name(sides[0])
        if found is not None and not found[1] and not undotted(found[0])[1] and is_matrix(sides[1]):
            return Subject("definition", str(found[0]), found[0]), sides  # M = [a, b; c, d], even if M is a mass, too
        moving, balanced = any(self.accelerates(side) for side in sides), any(map(self._is_balance, sides))
        subjects = [self.of(side, moving=moving, balanced=balanced) for side in sides]
        order = [0, len(sides) - 1, *(i for i, s in enumerate(subjects) if s is not None and s.kind == "Xi")]
        first, last = subjects[0], subjects[-1]
        if not moving and first is None and (own := energy_of_definition(sides, self.model, self.moves)) is not None:
            return Subject(cast("Kind", own[0]), None, own[1]), sides
        if first is not None and last is not None and (first.order or first.kind == "identity") and self._new(last):
            order = [len(sides) - 1]  # x1' = x2 says what x2 is
        for i in order:
            subject = subjects[i]
            if i and subject is not None and key(str(subject.token)) in self.leading:
                continue  # … = f, where another line says f = …
            if i and subject is not None and subject.token is not None and self._taken(subject.token):
                continue  # r = R, where R is a radius of the system
            if subject is not None and subject.inverse[:1] == "a" and len(sides) > 2:
                continue  # tan α = dy/dx = 2 a x
            if subject is not None:
                return replace(subject, right=i > 0), [sides[i], *sides[:i], *sides[i + 1 :]]
        return None, sides

    def accelerates(self, tree: Node) -> bool:
        """Whether an acceleration stands in a tree: of any name, in any spelling."""
        return self.moves(tree, 2)

    def _is_balance(self, side: Tree) -> bool:
        """Whether a side is a sum with accelerations and with a term without rates, which is no momentum."""
        side = inside(side)
        terms = [x for x in side.children if isinstance(x, Tree)] if side.data == "sum" else []
        return any(map(self.accelerates, terms)) and not all(map(self.moves, terms))

    def moves(self, tree: Node, least: int = 1) -> bool:
        """Whether a rate, or a derivative of at least this order, stands in a tree."""
        if not isinstance(tree, Tree):
            return False
        above, names = rates_in(tree)
        return above >= least or any(order + self._order(*name) >= least for order, name in names)

    def _order(self, token: Node, primes: Node) -> int:
        """How often a name is differentiated: by primes, dots, or in letters."""
        base, dots = undotted(token)
        order = len(primes or "") + dots
        spelled = () if self.names.scope.meanings(token)[0] else self._rates(base)
        return order + max((k for k, stem in spelled if self.names.changes(stem)), default=0)

    def _new(self, subject: Subject) -> bool:
        """Whether a statement is the first to say what a name is."""
        return subject.kind == "definition" and not subject.order and not self.names.is_own(str(subject.token))

    def in_rates(self, sides: Sequence[Tree]) -> set[str]:
        """The keys of the names in what a statement equates with the rate of a coordinate of the system: x' = p/m."""
        found = [x for side in sides if (x := only_name(side)) is not None and self._taken(x[0])]
        rates = [x for x in found if x[1] + undotted(x[0])[1] == 1]
        listed = (x for side in sides for x in names_in(side)) if rates else ()
        return {key(undotted(token)[0]) for token, changing in listed if not changing and not self._taken(token)}

    def of(self, side: Tree, *, moving: bool = False, balanced: bool = False) -> Subject | None:
        """The subject of a statement with this left-hand side; None if it is an equation.

        ``moving``: the statement contains accelerations, so it states no energy: T is then a torque. ``balanced``: it
        has them beside other terms and states no momentum either: p1 then calls a left-hand side.
        """
        if (found := only_name(side)) is not None:
            return self._named(*found, moving, balanced)
        if (token := squared_name(side)) is not None and not self._taken(token):
            base, dots = undotted(token)
            if dots and self.names.is_own(base):
                return None  # Ḃ² of a column of positions B is |Ḃ|²
            return Subject("definition", str(token), token, inverse="sqrt")
        if (called := called_name(side)) is not None and self._is_own_angle(called[1]):
            return Subject("definition", str(called[1]), called[1], inverse=f"a{called[0]}")  # tan α = 2 a x
        return self._derivative_of_energy(inside(side))

    def _is_own_angle(self, token: Token) -> bool:
        """Whether a name in a sine or a tangent is no name of the system, and nothing else says what it is."""
        if key(str(token)) in self.counted:
            return False
        return not self._taken(token) and not self.names.is_own(str(token)) and self.names.occurs(token) > 1

    def counted_from_coordinates(self, statements: Iterable[Sequence[Tree]]) -> set[str]:
        """The keys of new names that statements without functions and rates relate to one coordinate: θ = 90° − γ."""
        found: set[str] = set()
        for sides in statements:
            names = {key(str(token)): token for side in sides for token, _ in names_in(side)} if len(sides) == 2 else {}
            moving = [x for x in names.values() if self._taken(x) and self.names.changes(x)]
            new = [x for x, token in names.items() if not self._taken(token) and x != "pi"]
            calls = any(x.data in ("call", "power_of") for side in sides for x in side.iter_subtrees())
            if len(moving) == len(new) == 1 and not calls and not any(map(self.moves, sides)):
                found.add(new[0])
        return found

    def sharing(self, subject: Subject, sides: list[Tree]) -> tuple[list[Tree], list[Token]]:
        """The sides of a definition without those that are new names alone, and these: a_12 = a_21 = m l."""
        if subject.kind != "definition" or subject.order or subject.inverse or len(sides) < 3:
            return sides, []
        alone = [(side, self.of(side)) for side in sides[1:-1]]
        new = [s for _, s in alone if s is not None and s.kind == "definition" and not s.order and not s.inverse]
        same = [s.token for s in new if s.token is not None and s.token != subject.token]
        kept = [side for side, s in alone if s is None or s.token not in same]
        return [sides[0], *kept, sides[-1]], same

    def each(self, subject: Subject | None, sides: list[Tree]) -> list[tuple[Subject, list[Tree]]]:
        """The subjects of a statement, each with its sides: two of Ξ_x = Ξ_z = 0 and of p = ∂L/∂x' = m x', none of an
        equation."""
        if subject is None:
            return []
        if subject.kind == "definition" and not subject.order and len(sides) > 2:
            derived = [(side, x) for side in sides[1:] if (x := self._derivative_of_energy(inside(side))) is not None]
            rest = [side for side in sides[1:] if all(side is not x for x, _ in derived)]
            if derived and rest:
                return [(subject, [sides[0], *rest]), *((own, [side, *rest]) for side, own in derived)]
        forces = [(side, x) for side in sides if (x := self.of(side)) is not None and x.kind == "Xi"]
        rest = [side for side in sides if all(side is not x for x, _ in forces)]
        if subject.kind != "Xi" or not rest:
            return [(subject, sides)]
        return [(own, [side, *rest]) for side, own in forces]

    def names_sides(self, subject: Subject, sides: list[Tree]) -> bool:
        """Whether a name in front of an equation of motion only says what its sides are: F_x = m x'' = F - b x'."""
        token = subject.token
        if subject.kind != "definition" or subject.order or subject.inverse or token is None or len(sides) < 3:
            return False
        alone = self.names.occurs(token) == self.leading[key(undotted(token)[0])]
        return alone and any(map(self.accelerates, sides[1:]))

    def equates(self, subject: Subject, value: sp.Expr, equal: int) -> bool:
        """Whether a new name alone on a side is no definition but an input of the answer's own, or a coordinate.

        It is a definition if it stands on the left and there are as many equations without it as coordinates:
        N = m g - m y''. ``equal`` statements may be equations. The acceleration of an unknown name equals
        accelerations only if it is defined.
        """
        assert subject.token is not None
        if not subject.order and key(str(subject.token)) in self.accelerations:
            return not isinstance(value, sp.Derivative)  # a = y'' is no equation, a = F/m is one
        used = self.names.occurs(subject.token) > 1
        if subject.order:
            if is_component(subject.token, self.names.given_matrices) or (used and not value.atoms(AppliedUndef)):
                return False  # the rate of a point's component, or a motion that is prescribed: y_p'' = -a w^2 cos(w t)
            if subject.order == 1 and key(str(subject.token)) in self.gives_rates - self.defined:
                return True  # p' = F, where x' = p/m says what p is
            if subject.order == 1 and used and key(subject.token) not in self.bare:
                return False  # xS' = x' + l phi' cos phi, of which only the rate is used
            new = any(self.names.is_unknown(x) for x in value.atoms(AppliedUndef, sp.Derivative))
            return new or not used or (subject.order > 1 and not accelerates(value))
        if subject.inverse or not accelerates(value):
            return False
        return subject.right or not used or equal < len(self.model.coordinates)

    def is_letter(self, subject: Subject) -> bool:
        """Whether a subject is an energy by a letter that is one only because a line says so: K, P, U."""
        return subject.kind in ENERGIES and subject.token is not None and energy_of(subject.token, self.model) is None

    def is_force_found(self, subject: Subject, above: Sequence[Sequence[Tree]]) -> bool:
        """Whether a name is a multiplier whose value is a result: λ = m g cos θ, which no other line uses, or below an
        equation of motion with λ; ``above`` are the sides of the statements above."""
        token = subject.token
        if token is None or subject.order or not self.model.constraints or not key(token).startswith(MULTIPLIERS):
            return False
        moving = (sides for sides in above if any(map(self.accelerates, sides)))
        used = (str(name) for sides in moving for side in sides for name, _ in names_in(side))
        return self.names.occurs(token) == 1 or any(key(name) == key(token) for name in used)

    def left_side(self, side: Tree) -> Subject | None:
        """Recognize d/dt ∂L/∂ξ̇ − ∂L/∂ξ, written with L alone."""
        side = inside(side)
        terms = [inside(x) for x in side.children if isinstance(x, Tree)] if side.data == "sum" else []
        if len(terms) != 2 or [str(x) for x in side.children if isinstance(x, Token)] != ["-"]:
            return None
        first, second = (self._derivative_of_energy(x) for x in terms)
        if first is None or second is None or (first.kind, second.kind) != ("p-rate", "slope"):
            return None
        return Subject("left", first.name) if first.name == second.name else None

    def parameter(self, side: Tree, value: sp.Expr) -> str | None:
        """The parameter that a side consists of, if the other side is its value: J = m*R^2/2."""
        if (found := only_name(side)) is None or found[1] or value.has(AppliedUndef, time):
            return None
        names, dots = self.names.scope.meanings(found[0])
        return names[0] if not dots and names and names[0] in {p.name for p in self.model.parameters} else None

    def changes_coordinate(self, token: Token, value: sp.Expr) -> bool:
        """Whether a line expresses a coordinate of the model in new ones: x2 = x1 + s, where the model has no s."""
        names, dots = self.names.scope.meanings(token)
        if dots or len(names) != 1 or names[0] not in {c.name for c in self.model.coordinates}:
            return False
        new = {u.symbol for u in self.names.unknown.values() if isinstance(u.symbol, AppliedUndef)}
        return bool(value.atoms(AppliedUndef) & new) and not value.has(sp.Derivative)

    def only_calls(self, token: Token) -> bool:
        """Whether a name of the answer's own only calls coordinates or rates: ξ₁ = θ, q = [θ, φ], or has one."""
        _, value = self.names.own.get(key(str(token)), ("", None))
        symbols = {c.symbol for c in self.model.coordinates}
        listed = [] if value is None else value.flat() if isinstance(value, MatrixBase) else [value]
        bare = {x.expr if isinstance(x, sp.Derivative) else x for x in listed}
        return self.names.changes(token) or (bool(listed) and bare <= symbols)

    def _taken(self, token: Token) -> bool:
        """Whether a name belongs to the model, or spells out the rate of one of its names: theta1_ddot."""
        scope = self.names.scope
        return bool(scope.meanings(token)[0]) or any(scope.meanings(stem)[0] for _, stem in self._rates(token))

    def _rates(self, written: str) -> Iterator[tuple[int, str]]:
        """The orders and names that a name can mean as a rate in letters: Fd and kd are names, as x and not F and k
        has a rate, but Fdot is one."""
        for order, stem in spelled_rates(written):
            found = self.names.scope.meanings(stem)[0]
            if "dot" in written or not found or self.names.scope[found[0]] in self.names.moving_symbols:
                yield order, stem

    def _named(self, token: Token, primes: int, moving: bool, balanced: bool) -> Subject | None:
        base, dots = undotted(token)
        order = primes + dots
        if not order and not self._taken(token):
            order, base = next(((k, x) for k, x in self._rates(base) if self.names.changes(x)), (0, base))
        if order:
            if self._taken(token):
                return None
            own = self.names.is_own(base) or key(base) in self.defined or key(base) in self.names.implied
            return Subject("identity" if own else "definition", base, Token("NAME", base), order)
        plain = key(str(token)) in self.plain
        if not moving and not plain and (kind := energy_of(token, self.model, lhs=True)) is not None:
            return Subject(cast("Kind", kind), None, token)
        if not plain and (coordinate := self.names.force(token)) is not None:
            return Subject("Xi", coordinate)
        momentum = momentum_of(token, self.model) if self.names.occurs(token) == 1 and not balanced else None
        if momentum is not None:
            return Subject("p", momentum)
        return None if self._taken(token) or token in ("t", "pi") else Subject("definition", str(token), token)

    def derived(self, *sides: tuple[Tree, sp.Expr]) -> tuple[Kind, sp.Expr | None, sp.Expr, str | None] | None:
        """What a statement says of ∂V/∂ξ, ∂D/∂ξ̇, ∂T*/∂ξ, ∂T*/∂ξ̇ or d/dt ∂T*/∂ξ̇ of its own energies, alone on one of its
        ``sides``, perhaps with a minus, or of ℒ where the system defines an L: as a line less its place."""
        lengths = [d.symbol for d in self.model.definitions if d.name == "L"]
        if sides[0][1] in lengths and has_squares(sides[1][1]):
            self.names.stated["L"] = sides[1][1]
            return "L", None, sides[1][1], None
        for (whole, own), (_, value) in (sides, sides[::-1]):
            side, minus = without_minus(whole)
            own, value = (-own, -value) if minus else (own, value)
            found = self._added_by(side)
            if minus and found is not None and self._balances(found[0], value):
                continue
            if found is not None and not is_general(own - value):
                kind, name = found
                left, right = (own, value) if kind in ("T-p", "T-slope") else (value, own)
                return kind, left, right, name
        return None

    def _balances(self, kind: str, value: sp.Expr) -> bool:
        """Whether what is equated to a derivative is no form of it, so that both are a balance: m x'' = −∂V/∂x."""
        inputs = [u.symbol for u in self.model.inputs]
        rated = kind == "V-slope" and value.has(sp.Derivative)
        return value == 0 or accelerates(value) or rated or value.has(*inputs)

    def is_chain_rule(self, *sides: tuple[Tree, sp.Expr]) -> bool:
        """Whether a statement differentiates an expression of positions: d/dt(a + l sin θ) = l cos θ θ'."""
        for (side, own), (_, value) in (sides, sides[::-1]):
            tree = inside(side)
            rated = tree.data == "rate" and tree.children[1] == 1 and only_name(inside(tree.children[0])) is None
            if rated and not self.model.constraints and value.has(sp.Derivative):
                return not accelerates(own) and not accelerates(value)
        return False

    def _added_by(self, side: Node) -> tuple[Kind, str] | None:
        """Which derivative a side is, and of which coordinate; ∂T*/∂ξ̇ itself adds to no equation."""
        side, rate = inside(side), False
        if isinstance(side, Tree) and side.data == "rate" and side.children[1] == 1:
            side, rate = inside(side.children[0]), True
        if not isinstance(side, Tree) or side.data != "partial" or (by := self._by(side.children[1])) is None:
            return None
        of = (str(side.children[0]), by[1])
        if rate:
            return ("T-rate", by[0]) if of == ("T", 1) else None
        kinds: dict[tuple[str, int], Kind] = {
            ("T", 1): "T-p",
            ("T", 0): "T-slope",
            ("V", 0): "V-slope",
            ("D", 1): "D-slope",
        }
        return (kinds[of], by[0]) if of in kinds else None

    def _derivative_of_energy(self, side: Node) -> Subject | None:
        """Recognize ∂L/∂ξ, ∂L/∂ξ̇ and d/dt ∂L/∂ξ̇ alone on one side."""
        if not isinstance(side, Tree):
            return None
        if side.data == "rate" and side.children[1] == 1:
            inner = self._derivative_of_energy(inside(side.children[0]))
            return Subject("p-rate", inner.name) if inner is not None and inner.kind == "p" else None
        if side.data != "partial" or side.children[0] not in ("L", "ℒ", "T"):
            return None
        of_kinetic = side.children[0] == "T"
        if of_kinetic and ("T" in self.names.stating or self.names.energy("T") is not None):
            return None
        if self.names.coordinates() is not None and self.names.energy("L") is not None:
            return None  # of the answer's own L, which the reader differentiates
        by = self._by(side.children[1])
        if by is None or (of_kinetic and not by[1]):
            return None
        return Subject("p" if by[1] else "slope", by[0])  # ∂T*/∂ξ̇ = ∂L/∂ξ̇: V has no rates

    def _by(self, side: Node) -> tuple[str, int] | None:
        """The coordinate of the model or the answer by which, or by whose rate (1), something is differentiated."""
        if (found := only_name(side)) is None:
            return None
        token, primes = found
        coordinates, chart = {c.name for c in self.model.coordinates}, self.names.coordinates()
        coordinates |= {d.name for d in self.model.definitions if chart is not None and key(d.name) in chart.columns}
        spellings = [*spelled_rates(token), (0, str(token))]
        for order, stem in spellings[-1:] if self.names.scope.meanings(token)[0] else spellings:  # xd is no new name
            base, dotted = undotted(stem)
            names, dots = self.names.scope.meanings(stem)
            own = not names and self.names.changes(base)  # a position of the answer's own
            name, dots = (base, dotted) if own else (names[0] if len(names) == 1 else "", dots)
            order += primes + dots
            if (own or name in coordinates) and order <= 1 and (chart is None or key(name) in chart.columns):
                return name, order
        return None
