"""Converts the syntax tree of an answer to SymPy: `lagrangian.read.expression`, with derivatives and matrices."""

from __future__ import annotations

from contextlib import suppress
from typing import Any, cast

import sympy as sp
from lark import Tree
from sympy.core.function import AppliedUndef
from sympy.matrices.matrixbase import MatrixBase

from lagrangian import bounded
from lagrangian.check.reading.canonical import NAMES, ROUTHIAN, ignored, momenta_of, slope_at_momenta
from lagrangian.check.reading.columns import crossed, inverse, is_square, is_transposed, shown_shape, square
from lagrangian.check.reading.names import Names, Value
from lagrangian.check.reading.nodes import Node, leaf, names_in, only_name, start_of
from lagrangian.check.reading.placeholders import ENERGIES, is_placeholder, is_vector, slope, variation
from lagrangian.check.reading.prose.words import RECIPROCALS
from lagrangian.check.reading.reading_budget import ReadingBudget
from lagrangian.errors import ParseError
from lagrangian.model.names import time
from lagrangian.quantities.source import Source
from lagrangian.read.expression import MAX_ORDER, ExpressionReader
from lagrangian.read.letters import key, undotted

MAX_ENTRIES = 400
"""The largest number of entries of a matrix."""


class Meaning(ExpressionReader):
    """Evaluates the trees of one statement about a ``kind`` of quantity; ``budget`` is shared by the whole answer. An
    energy may hold rates that the answer gives further down. ``of_matrix``: a determinant or an inverse stood in it."""

    def __init__(self, source: Source, names: Names, budget: ReadingBudget, kind: str | None = None) -> None:
        super().__init__(source, names.scope)
        self.names, self.budget, self.energy = names, budget, kind in ENERGIES
        self.of_matrix, self._done = False, dict[int, Value]()
        self.slopes = dict[str, str]()  # names of the answer, functions of one coordinate, whose primes are slopes

    def value(self, node: Node) -> Value:
        """The expression or matrix of a node, computed once."""
        if id(node) not in self._done:
            self._done[id(node)] = super().value(node)
        return self._done[id(node)]

    def finite(self, value: Value, node: Node) -> sp.Expr:
        """Return a value if it is a finite number or expression; raise an error otherwise."""
        if value.has(sp.nan, sp.zoo, sp.oo, -sp.oo):
            self.fail("its value is not finite", node, fix="look for a division by zero", code="E705")
        return value

    def scalar(self, node: Node) -> sp.Expr:
        """The value of a node that equals a single quantity; an error if it is a matrix."""
        value = self.value(node)
        if isinstance(value, MatrixBase):
            self.fail("a single quantity cannot equal a matrix", node, fix="write one equation per line")
        return value

    # -- names -------------------------------------------------------------------------------------------------------

    def _meaning(self, token: Any) -> tuple[str, sp.Expr, int]:
        found, value, dots = self.names.meaning(token, self.source)
        if not isinstance(value, (sp.Symbol, AppliedUndef)):
            self._spend(value, token)
        return found, value, dots

    def _name(self, node: Node) -> Value:
        """The value of a name; a rate that was given its own value has that value."""
        token, primes = node.children
        base, dots = undotted(token)
        order = dots + len(primes or "")
        if order and (given := self.names.rates.get((key(base), order))) is not None:
            self._spend(given, token)
            return given
        _, value, dots = self._meaning(token)
        if order and self.energy and (given := self.names.rates.get((key(base), order))) is not None:
            self._spend(given, token)
            return given
        order = dots + len(primes or "")  # ydd is y'', which may be a column
        if not order:
            return value
        if order == 1 and key(base) in self.slopes:
            whole = self.names.model.expand(value)
            by = next(iter(whole.atoms(AppliedUndef) & self.names.moving_symbols))
            return self._differentiated(whole, by, token)
        if value.has(AppliedUndef, time) and order <= MAX_ORDER:
            return self._rated(value, order, token)
        return super()._name(node)

    def _spend(self, value: Value, node: Node) -> None:
        if not self.budget.spend(value):
            self.fail(
                "this becomes too long when it is written out",
                node,
                fix="give the answer in shorter pieces",
                code="E703",
            )

    # -- derivatives -------------------------------------------------------------------------------------------------

    def _rate(self, node: Node) -> Value:
        of, order = node.children
        value = self.value(of)
        if order > MAX_ORDER:
            self.fail(f"a derivative of order {order}", node, fix="derivatives go up to the second")
        return self._rated(value, order, node)

    def _rated(self, value: Value, order: int, node: Node) -> Value:
        """The derivative by time, taken ``order`` times; ∂L/∂ξ̇ of an L without a value changes with time, too."""
        unset = [d for d in value.atoms(sp.Derivative) if is_placeholder(d.expr) and d.variables != (time,)]
        value = value.xreplace({d: slope(str(d.expr), d.variables) for d in unset})
        for _ in range(order):
            value = self._differentiated(value, time, node)
        return value

    def _differentiated(self, value: Value, by: sp.Expr, node: Node) -> Value:
        """The derivative; its cost is checked before it is computed."""
        if (value, by) not in self.names.derivatives:
            if not self.budget.affords_derivative(value):
                self.fail(
                    "this becomes too long when it is differentiated",
                    node,
                    fix="give the answer in shorter pieces",
                    code="E703",
                )
            self.names.derivatives[value, by] = _slope(value, by)
        return self.names.derivatives[value, by]

    def _partial(self, node: Node) -> sp.Expr:
        """∂L/∂ξ or ∂L/∂ξ̇; it is left unevaluated for an energy without a value, and for a general ξ_i.

        Each derivative of something else without a value, ∂A/∂θ, has a symbol of its own, so that no two cancel.
        """
        what, by = node.children
        kind = {"ℒ": "L"}.get(what, str(what))
        energy = self.names.energy(kind)
        if energy is None and kind not in ENERGIES:
            _, energy, dots = self._meaning(what)
            if self.names.is_unknown(energy):  # ∂c_r/∂ξ̇_i: a part of something that has no value here
                return slope(key(kind), self.value(by))
            energy = self._rated(self.names.model.expand(energy), dots, what)  # also ∂h'/∂θ of a rate
            if not energy.args or isinstance(energy, AppliedUndef):
                self.fail(
                    f"'{what}' is not an energy that your answer gives",
                    what,
                    fix="write ∂L/∂x1', or state the energy on an earlier line",
                )
        variable = self.value(by)
        if energy is not None and (found := self._at_momenta(kind, energy, variable, by)) is not None:
            return found
        if (found := self._own_slope(kind, energy, variable, by)) is not None:
            return found
        if not isinstance(variable, (AppliedUndef, sp.Derivative, sp.Symbol)):
            self.fail("energies can be differentiated only by a coordinate or its rate", by, fix="write ∂L/∂x1'")
        moving = isinstance(variable, (AppliedUndef, sp.Derivative))
        if energy is None or not moving or (self.names.is_unknown(variable) and not self._is_stated_in(variable)):
            if kind not in ENERGIES:
                return slope(key(kind), variable)
            return cast("sp.Expr", sp.Derivative(ENERGIES[kind], variable))
        whole = self.names.relations.into(self.names.model.expand(energy), variable)
        return self._differentiated(whole, variable, node)

    def _derivative(self, node: Node) -> sp.Expr:
        """d/dξ(…), the derivative by a coordinate of an expression in names of the system.

        Another name in it may hold the coordinate; what it means is put in later, so that it cannot be differentiated.
        """
        inner, by = node.children
        variable = self.value(by)
        model = self.names.model
        whole = model.expand(self.scalar(inner))
        if inner.data == "partial" and any(map(is_placeholder, bounded.atoms(whole, AppliedUndef))):
            return slope(f"{key(inner.children[0])} {variable}", variable)  # ∂²V/∂θ² of a V without a value
        known = {x.symbol for x in (*model.parameters, *model.inputs, *model.coordinates)}
        own = bounded.letters(whole) - known - {time}
        if own or not isinstance(variable, AppliedUndef) or self.names.is_unknown(variable):
            self.fail("this is differentiated by a coordinate", node, fix="write the derivative out")
        return self._differentiated(self.names.relations.into(whole, variable), variable, node)

    def _at_momenta(self, kind: str, energy: sp.Expr, variable: sp.Expr, by: Node) -> sp.Expr | None:
        """The derivative of an answer's own H or R, in which its momenta are held or differentiated by; None of
        another. Where nothing says whose momenta R holds, it is not judged."""
        coordinates: list[Any] = [c.symbol for c in self.names.model.coordinates]
        if kind == ROUTHIAN:
            momenta, held = ignored(self.names.model.expand(energy), self.names.own, coordinates)
            if not momenta:
                return slope(key(kind), variable)
        else:
            momenta = momenta_of(self.names.own, [q.diff(time) for q in coordinates]) if kind in NAMES else {}
            held = coordinates
        free = [*coordinates, *(q.diff(time) for q in coordinates if q not in held)]
        named = only_name(by)
        chosen = variable if variable in free else key(undotted(named[0])[0]) if named and not named[1] else None
        if chosen is None or (chosen != variable and chosen not in momenta) or not momenta:
            return None
        whole, fixed = self.names.model.expand(energy), {x: self.names.model.expand(p) for x, p in momenta.items()}
        found = slope_at_momenta(whole, fixed, held, chosen, lambda x, y: self._differentiated(x, y, by))
        if found is not None:
            self._spend(found, by)
        return found

    def _own_slope(self, kind: str, energy: sp.Expr | None, variable: sp.Expr, by: Node) -> sp.Expr | None:
        """The derivative in an answer with coordinates of its own; where nothing says which ones these replace, or the
        energy has no value, it is a quantity that is not judged. None in the coordinates of the system."""
        if (named := only_name(by)) is None:
            return None
        base, dotted = undotted(named[0])
        name, meaning, dots = self._meaning(base)
        order = named[1] + dotted + dots
        own = not isinstance(meaning, (AppliedUndef, sp.Symbol)) and meaning.has(AppliedUndef) and order <= 1
        chart = self.names.coordinates()
        if chart is not None and energy is not None and key(name) in chart.columns:
            whole = self.names.model.expand(energy)
            order = 1 if isinstance(variable, sp.Derivative) else order
            found = chart.slope(key(name), order, lambda x: self._differentiated(whole, x, by))
            self._spend(found, by)
            return found
        return slope(key(kind), f"{base} {order}") if own else None

    def _is_stated_in(self, variable: sp.Expr) -> bool:
        """Whether all energies of the answer are in no more coordinates than the system has, with one of its own."""
        found = set().union(*(self.names.model.expand(x).atoms(AppliedUndef) for x in self.names.stated.values()))
        found |= variable.atoms(AppliedUndef)
        return len(found - {u.symbol for u in self.names.model.inputs}) <= len(self.names.model.coordinates)

    def _variation(self, node: Node) -> Value:
        """A virtual displacement; of a point that the answer gives by its components, a column."""
        found = only_name(node.children[1])
        named = str(found[0]) if found else ""
        point = self._column(named)
        if point is None:
            meant, _ = self.names.scope.meanings(named)
            return variation(meant[0] if len(meant) == 1 else named)
        moves = {c.symbol: variation(c.name) for c in self.names.model.coordinates}
        self._spend(point, node)
        return point.applyfunc(lambda x: sp.Add(*(self._differentiated(x, q, node) * v for q, v in moves.items())))

    def _column(self, named: str) -> MatrixBase | None:
        """The column that the answer, and not the system, calls so; None if it is none."""
        base = key(named)
        if base not in self.names.own and base in self.names.given_matrices:
            self.names.later(base)
        value = self.names.own.get(base, ("", None))[1]
        own = isinstance(value, MatrixBase) and value.shape[1] == 1 and not self.names.scope.meanings(named)[0]
        return value.applyfunc(self.names.model.expand) if own else None

    # -- matrices ----------------------------------------------------------------------------------------------------

    def _matrix(self, node: Node) -> Value:
        rows = [row.children for row in node.children[1:]]
        if len({len(row) for row in rows}) != 1:
            counts = " and ".join(str(n) for n in sorted({len(row) for row in rows}))
            self.fail(
                f"the rows of this matrix have {counts} entries", node, fix="give every row the same number of entries"
            )
        if sum(map(len, rows)) > MAX_ENTRIES:
            self.fail(f"a matrix with more than {MAX_ENTRIES} entries", node, code="E703")
        values = [[self._entry(x) for x in row] for row in rows]
        if any(isinstance(x, MatrixBase) for row in values for x in row):
            self.fail("a matrix contains a matrix", node, fix="write one matrix [a, b; c, d]")
        return sp.ImmutableMatrix(values)

    def _entry(self, node: Node) -> Value:
        """An entry of a matrix, in which a letter of a matrix that the system has, too, may be the system's."""
        if not self.names.matrices:
            return self.value(node)
        done = dict(self._done)
        with suppress(ParseError):
            if not isinstance(value := self.value(node), MatrixBase):
                return value
        self._done = done
        return self._of_system(node)

    def _of_system(self, node: Node) -> Value:
        """What a node is if no letter in it is that of a matrix: m + M/3 beside M q'', where M is a mass, too."""
        self.names.matrices = False
        try:
            return super().value(node)
        finally:
            self.names.matrices = True

    def _transpose(self, node: Node) -> Value:
        value = self.value(node.children[1])
        return value.T if isinstance(value, MatrixBase) else value

    def _sum(self, node: Node) -> Value:
        sign, first, *rest = node.children
        values = [(sign, first, self.value(first))]
        values += [(s, t, self.value(t)) for s, t in zip(rest[::2], rest[1::2], strict=True)]
        if not any(isinstance(v, MatrixBase) for _, _, v in values):
            return super()._sum(node)
        if (general := next((v for _, _, v in values if is_vector(v)), None)) is not None:
            return general
        total: Value = None
        for sign, term, value in values:
            value = self._signed_value(sign, value)
            if value == 0 or (total is not None and total == 0):
                total = value if total is None or total == 0 else total
                continue
            if is_transposed(value, total):
                total, value = (
                    x if x.shape[1] == 1 else x.T for x in cast("tuple[Any, Any]", (total, value))
                )  # lists of as many entries
            shapes = [getattr(x, "shape", "a number") for x in (total, value)]
            if set(shapes) == {(1, 1), "a number"} and total is not None:
                total, value = (x[0] if isinstance(x, MatrixBase) else x for x in (total, value))  # a γ of one row
            elif total is not None and shapes[0] != shapes[1]:
                if self.names.matrices and all(self.names.scope.meanings(x)[0] for x, _ in names_in(node)):
                    self._done.clear()
                    return self._of_system(node)
                a, b = (shown_shape(x) for x in shapes)
                self.fail(f"{a} and {b} cannot be added", term, fix="give both the same number of rows and columns")
            total = value if total is None else total + value
        return total

    def _product(self, node: Node) -> Value:
        first, *rest = node.children
        values = [(None, first, self.value(first))]
        values += [(o, c, self.value(c)) for o, c in zip(rest[::2], rest[1::2], strict=True)]
        if not any(isinstance(v, MatrixBase) for _, _, v in values):
            return super()._product(node)
        if (general := next((v for _, _, v in values if is_vector(v)), None)) is not None:
            return general
        total: Value = sp.S.One
        crossing = False  # from × up to the next column: r × S (b - a) / l
        for operator, child, value in values:
            if operator is not None and self.source.text.startswith(("×", "\\times"), start_of(operator)):
                crossing = isinstance(total, MatrixBase)
            if operator is not None and operator == "/":
                if isinstance(value, MatrixBase) or bounded.is_zero(value):
                    self.fail("a matrix can be divided only by a number that is not 0", child)
                value = 1 / value
            both = isinstance(total, MatrixBase) and isinstance(value, MatrixBase)
            listed = False
            if both and total.shape == value.shape and value.shape[1] == 1:
                listed = self.source.text.startswith("*", start_of(operator))
                if value.shape[0] in (2, 3) and crossing:
                    total, crossing = crossed(total, value), False
                    self._spend(total, child)
                    continue
                total = total.T  # a list in front of a column is a row
            if both and total.shape[1] != value.shape[0]:
                a, b = shown_shape(total.shape), shown_shape(value.shape)
                self.fail(
                    f"{a} times {b} is not a product", child, fix="multiply a matrix of n columns by a column of n rows"
                )
            if both and total.shape[0] * value.shape[1] * value.shape[0] > 20 * MAX_ENTRIES:
                self.fail("the matrices are too large to multiply", child, code="E703")
            summed = both and value.shape[0] > 1 and not listed
            total = total * value
            total = total[0] if summed and len(total) == 1 else total  # a dot product; M q'' of one coordinate is none
            self._spend(total, child)
        return total

    def _power(self, node: Node) -> Value:
        base, *raised = node.children
        transposed = len(raised) == 3 and raised[1] is None and only_name(raised[2]) == ("T", 0)
        if transposed and isinstance(value := self.value(base), MatrixBase):
            return value.T  # J^T of a matrix that is given by its entries
        return super()._power(node)

    def _raise(self, node: Node, base: Any, exponent: Any) -> sp.Expr:
        if isinstance(base, MatrixBase) and base.shape[1] == 1 and exponent == 2:
            return square(base)  # v^2 of a velocity that is given by its components
        if is_square(base) and exponent == -1 and (found := inverse(base)) is not None:
            self._spend(found, node)
            self.of_matrix = True
            return cast("Any", found)  # M^-1 f
        if isinstance(base, MatrixBase) or isinstance(exponent, MatrixBase):
            self.fail("a matrix is raised to a power", node, fix="write the equations out row by row")
        return super()._raise(node, base, exponent)

    def _call(self, node: Node) -> sp.Expr:
        if (below := RECIPROCALS.get(str(node.children[0]))) is not None:
            token, *arguments = node.children
            return 1 / self._call(Tree("call", [leaf("NAME", below, token.start_pos), *arguments], node.meta))
        for argument in node.children[1:]:
            if argument.data == "condition" or not isinstance(found := self.value(argument), MatrixBase):
                continue
            if str(node.children[0]) in ("abs", "norm") and found.shape[1] == 1:
                return sp.sqrt(square(found))
            if str(node.children[0]) in ("abs", "det") and is_square(found):
                self.of_matrix = True
                return self._determinant(found, argument)  # |M|
            self.fail("a function is applied to a matrix", argument, fix="write the entries out")
        return super()._call(node)

    def _determinant(self, of: MatrixBase, node: Node) -> sp.Expr:
        value = cast("sp.Expr", of.det(method="berkowitz"))
        self._spend(value, node)
        return value


def _slope(value: Value, by: sp.Expr) -> Value:
    """The derivative of a value, entry by entry of a matrix."""
    return value.applyfunc(lambda x: bounded.diff(x, by)) if isinstance(value, MatrixBase) else bounded.diff(value, by)
