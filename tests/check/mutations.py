"""Random single mistakes in printed equations: an oracle for the checker that knows nothing of it.

A mutation changes one node of the tree of an equation as it is printed, or of T* or V: it drops, doubles or negates a
term, exchanges a letter, a function, an angle or a rate, loses or adds a factor, or puts a term of one equation into
another. Only SymPy is used, and of the package only the derivation that is mutated. Whether the result is wrong is
decided by putting the true accelerations into it, as numbers.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.derivation import Derivation
from lagrangian.model import time

Path = tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Mutation:
    """One mistake: the kind of the line ("equation", "T", "V"), its row, what was done, and to which term of the line.

    ``old`` and ``new`` are the node before and after; ``lines`` is the answer as equations or energies by name;
    ``form`` says how its rows were rewritten afterwards, and ``scales`` by what each was multiplied.
    """

    kind: str
    row: int
    operation: str
    term: sp.Expr
    old: sp.Expr
    new: sp.Expr
    lines: Any
    form: str = "plain"
    scales: tuple[sp.Expr, ...] = ()

    def __str__(self) -> str:
        return f"{self.kind} {self.row}, {self.form}: {self.operation} {self.old} -> {self.new} in {self.term}"


class Mutator:
    """Makes single mistakes in the printed equations and energies of a derivation, chosen by a seed."""

    def __init__(self, derivation: Derivation, seed: int | str) -> None:
        self.derivation = derivation
        self.model = derivation.model
        self.random = random.Random(f"{self.model.name} {seed}")
        self.letters = [p.symbol for p in self.model.parameters]
        self.q: list[Any] = list(derivation.coordinates)
        self.t = time
        self.sides = [(sp.sympify(e.lhs), sp.sympify(e.rhs)) for e in derivation.equations]

    # -- mistakes -----------------------------------------------------------------------------------------------------

    def mutation(self) -> Mutation:
        """One random mistake that makes the answer wrong."""
        while True:
            found = self._energy() if self.random.random() < 0.2 else self._equation()
            if found is not None:
                return found

    def _equation(self) -> Mutation | None:
        row = self.random.randrange(len(self.sides))
        if len(self.sides) > 1 and self.random.random() < 0.06:
            return self._foreign(row)
        side = self.random.choice([0, 0, 0, 1])
        made = self._changed(self.sides[row][side])
        if made is None:
            return None
        operation, term, old, new, expr = made
        sides = list(self.sides)
        sides[row] = (expr, sides[row][1]) if side == 0 else (sides[row][0], expr)
        return self._written(row, operation, term, old, new, sides)

    def _foreign(self, row: int) -> Mutation | None:
        """A term of one equation in another one."""
        other = self.random.choice([i for i in range(len(self.sides)) if i != row])
        term = self.random.choice(sp.Add.make_args(self.sides[other][0] - self.sides[other][1]))
        sides = list(self.sides)
        sides[row] = (sides[row][0] + term, sides[row][1])
        return self._written(row, "foreign", term, sp.S.Zero, term, sides)

    def _energy(self) -> Mutation | None:
        kind = self.random.choice("TV")
        made = self._changed(sp.sympify(self.derivation.T if kind == "T" else self.derivation.V))
        if made is None:
            return None
        operation, term, old, new, expr = made
        right = self.derivation.T if kind == "T" else self.derivation.V
        rest = self.model.expand(expr - right, constants=True)
        if all(self.zero(rest.diff(x)) for c in self.model.coordinates for x in (c.symbol, c.rate)):
            return None
        return Mutation(kind, -1, operation, term, old, new, {kind: expr})

    def _written(
        self, row: int, operation: str, term: sp.Expr, old: sp.Expr, new: sp.Expr, sides: Sequence[Any]
    ) -> Mutation | None:
        """The answer with changed sides, in some form; None if it is still true."""
        if self.true(sides[row][0] - sides[row][1]):
            return None
        form = self.random.choices(["plain", "scaled", "solved"], [0.7, 0.2, 0.1])[0]
        lines: list[Any] = [sp.Eq(*s, evaluate=False) for s in sides]
        scales = [sp.S.One] * len(sides)
        if form == "scaled":
            k = self.random.randrange(len(sides))
            scales[k] = sp.sympify(self.random.choice([-1, 2, *self.letters, *(1 / p for p in self.letters)]))
            lines[k] = sp.Eq(*[sp.expand(scales[k] * x) for x in sides[k]], evaluate=False)
        if form == "solved":
            solved = self._solved(sides)
            form, lines = ("solved", solved) if solved is not None else ("plain", lines)
        return Mutation("equation", row, operation, term, old, new, lines, form, tuple(scales))

    def _solved(self, sides: Sequence[Any]) -> list[Any] | None:
        """The equations solved for their accelerations, if there are at most two."""
        a = [c.acceleration for c in self.model.coordinates]
        if len(sides) > 2:
            return None
        M, rest = sp.linear_eq_to_matrix([s[0] - s[1] for s in sides], a)
        if M.det() == 0:
            return None
        return [sp.Eq(x, y, evaluate=False) for x, y in zip(a, M.LUsolve(rest), strict=True)]

    # -- changes of a tree --------------------------------------------------------------------------------------------

    def _changed(self, expr: sp.Expr) -> tuple[str, sp.Expr, sp.Expr, sp.Expr, sp.Expr] | None:
        """What was done, the term of the sum in which it was, the node before and after, and the whole after."""
        possible: dict[str, list[tuple[Path, sp.Expr, sp.Expr]]] = {}
        for path, node in _nodes(expr):
            for operation, new in self._instead(expr, path, node):
                if new != node:
                    possible.setdefault(operation, []).append((path, node, new))
        if not possible:
            return None
        operation = self.random.choice(sorted(possible))
        path, node, new = self.random.choice(possible[operation])
        whole = _put(expr, path, new)
        term = expr.args[path[0]] if isinstance(expr, sp.Add) and path else expr
        return operation, term, node, new, whole

    def _instead(self, expr: sp.Expr, path: Path, node: Any) -> Iterator[tuple[str, Any]]:
        """What may stand in place of a node, with what was done."""
        above: Any = _at(expr, path[:-1]) if path else None
        if above is None or isinstance(above, sp.Add):
            if node == 0:
                return
            yield "drop", sp.S.Zero
            yield "sign", -node
            yield "double", 2 * node
            yield "half", node / 2
            yield "factor", node * self.random.choice(self.letters)
            yield "divided", node / self.random.choice(self.letters)
        if isinstance(node, sp.Pow) and node.exp == 2:
            yield "not squared", node.base
        if isinstance(node, (sp.sin, sp.cos)):
            yield "function", sp.cos(*node.args) if isinstance(node, sp.sin) else sp.sin(*node.args)
            others = [*self.q, *(p + q for p in self.q for q in self.q if str(p) < str(q)), 2 * node.args[0]]
            yield "angle", node.func(self.random.choice(others))
        if isinstance(above, sp.Mul) and not node.is_number:
            yield "lost", sp.S.One
        if isinstance(node, sp.Symbol) and node in self.letters:
            if not isinstance(above, sp.Pow):
                yield "squared", node**2
            if len(self.letters) > 1:
                yield "letter", self.random.choice([p for p in self.letters if p != node])
        yield from self._moving(node, above)

    def _moving(self, node: Any, above: Any) -> Iterator[tuple[str, Any]]:
        """What may stand in place of a coordinate, a rate, an acceleration or an input."""
        coordinates = self.model.coordinates
        for operation, listed in (
            ("acceleration", [c.acceleration for c in coordinates]),
            ("rate", [c.rate for c in coordinates]),
            ("input", [u.symbol for u in self.model.inputs]),
            ("coordinate", self.q if not isinstance(above, (sp.Derivative, sp.sin, sp.cos)) else []),
        ):
            others = [x for x in listed if x != node]
            if node in listed and others:
                yield operation, self.random.choice(others)

    # -- numbers ------------------------------------------------------------------------------------------------------

    def true(self, row: sp.Expr) -> bool:
        """Whether an equation holds along the true motion, at three random states."""
        rows = [self.model.expand(left - right, constants=True) for left, right in self.sides]
        row = self.model.expand(row, constants=True)
        a = {c.acceleration: sp.Dummy() for c in self.model.coordinates}
        for k in range(3):
            table = self._state([*rows, row], k) | a
            M, rest = sp.linear_eq_to_matrix([sp.sympify(r.xreplace(table)) for r in rows], list(a.values()))
            truly = dict(zip(a.values(), M.evalf(30).LUsolve(rest.evalf(30)), strict=True))
            there = row.xreplace(table).xreplace(truly)
            if abs(sp.N(there, 20)) > 1e-12:
                return False
        return True

    def zero(self, expr: sp.Expr) -> bool:
        """Whether an expression without accelerations is 0 at three random states."""
        return all(abs(sp.N(expr.xreplace(self._state([expr], k)), 20)) < 1e-12 for k in range(3))

    def _state(self, exprs: Sequence[sp.Expr], k: int) -> dict[Any, Any]:
        """Values of everything but the accelerations."""
        a = {c.acceleration for c in self.model.coordinates}
        every = {x for e in exprs for x in (*e.atoms(sp.Derivative), *e.atoms(AppliedUndef), *e.free_symbols)}
        rates = [x for x in every if isinstance(x, sp.Derivative) and x not in a]
        rest = [x for x in every if not isinstance(x, sp.Derivative)]
        return {x: sp.Float(random.Random(f"{x} {k}").uniform(0.3, 1.7), 30) for x in [*rates, *rest]}


def _nodes(expr: sp.Expr, path: Path = ()) -> Iterator[tuple[Path, sp.Expr]]:
    """All nodes of a tree with the way to them; coordinates, their derivatives and functions of them are leaves."""
    yield path, expr
    if isinstance(expr, (AppliedUndef, sp.Derivative)):
        return
    for k, part in enumerate(expr.args):
        if isinstance(part, sp.Expr):
            yield from _nodes(part, (*path, k))


def _at(expr: sp.Expr, path: Path) -> Any:
    found: Any = expr
    for k in path:
        found = found.args[k]
    return found


def _put(expr: Any, path: Path, new: sp.Expr) -> sp.Expr:
    """The tree with another node at a place."""
    if not path:
        return new
    args = list(expr.args)
    args[path[0]] = _put(args[path[0]], path[1:], new)
    return expr.func(*args)
