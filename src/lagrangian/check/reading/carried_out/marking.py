"""Carries out a program with marks in the values that it assigns; see `marked_values`."""

from __future__ import annotations

import ast
from collections.abc import Sequence

import sympy as sp
from sympy.matrices.matrixbase import MatrixBase

from lagrangian.check.reading.carried_out.interpreter import Interpreter
from lagrangian.check.reading.carried_out.values import Value, called_name
from lagrangian.check.reading.marked_values import ValueMarks, is_formula
from lagrangian.records import dataclass, field

DIFFERENTIATING = frozenset(
    ["diff", "Derivative", "Diff", "jacobian", "hessian", "dt", "LagrangesMethod", "KanesMethod", "time_derivative"]
)
"""What differentiates its arguments, or what it is a method of."""


@dataclass(eq=False)
class MarkingInterpreter(Interpreter):
    """Carries out a program; formulas that it assigns to names, and the entries of its matrices, are marked."""

    marks: ValueMarks = field(default_factory=lambda: ValueMarks(""))
    nodes: dict[int, ast.expr] = field(default_factory=dict)
    """What is assigned to a target, by the identity of this."""

    def _statement(self, s: ast.stmt, names: dict[str, Value]) -> None:
        if isinstance(s, ast.Assign):
            self.nodes |= {id(target): s.value for target in s.targets}
        super()._statement(s, names)

    def _assign(self, target: ast.expr, value: Value, names: dict[str, Value], line: int) -> None:
        node = self.nodes.get(id(target))
        held = (
            target.value
            if isinstance(target, ast.Subscript)
            else target.func
            if isinstance(target, ast.Call)
            else target
        )
        called = called_name(held)
        if node is not None and called and not self.known(called):
            value = self._marked(value, node, called, line)
        super()._assign(target, value, names, line)

    def call(self, node: ast.Call, names: dict[str, Value]) -> Value:
        """The value of a call; what is differentiated keeps no marks."""
        if called_name(node.func) in DIFFERENTIATING:
            used = [x.id for x in ast.walk(node) if isinstance(x, ast.Name)]
            self.marks.lose(names.get(x) for x in used)
        return super().call(node, names)

    def _marked(self, value: Value, node: ast.expr, name: str, line: int) -> Value:
        """A value with marks, if its name is given a formula or a matrix with formulas."""
        if is_formula(value) and _computes(node):
            return self.marks.marked(value, name, line)
        while isinstance(node, ast.Call) and node.args:  # Matrix([…])
            node = node.args[0]
        if not isinstance(node, (ast.List, ast.Tuple)) or not any(map(_computes, ast.walk(node))):
            return value
        if isinstance(value, MatrixBase):
            return self._matrix(value, node, name, line)
        if isinstance(value, list) and len(value) == len(node.elts) and all(isinstance(x, sp.Expr) for x in value):
            pairs = enumerate(zip(value, node.elts, strict=True))
            return [x if _is_name(of) else self.marks.marked(x, name, line, (k, 0), len(value)) for k, (x, of) in pairs]
        return value

    def _matrix(self, value: MatrixBase, node: ast.List | ast.Tuple, name: str, line: int) -> Value:
        """A matrix with marks in its entries; one of blocks has none."""
        rows: Sequence[ast.expr] = node.elts
        listed = [x.elts if isinstance(x, (ast.List, ast.Tuple)) else [x] for x in rows]
        if len(listed) != value.shape[0] or any(len(x) != value.shape[1] for x in listed):
            return value
        made = self.marks.matrix(value, name, line)
        plain = {k for k, row in enumerate(listed) if len(row) == 1 and _is_name(row[0])}
        return made if not plain else sp.Matrix([value[k] if k in plain else made[k] for k in range(len(made))])


def _is_name(node: ast.AST) -> bool:
    """Whether an entry of a column is a name alone: w of dz = [w; tau/I], by which the rates of states are known."""
    return isinstance(node, (ast.Name, ast.Subscript))


def _computes(node: ast.AST) -> bool:
    """Whether something is computed there, and not only named."""
    negative = isinstance(node, ast.UnaryOp) and isinstance(node.operand, ast.Constant)
    return isinstance(node, (ast.BinOp, ast.UnaryOp)) and not negative
