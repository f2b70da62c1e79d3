"""Whether an expression that cannot be carried out has anything of the system in it: q in g = q if on else q."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Mapping

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.matrices.matrixbase import MatrixBase

from lagrangian.check.reading.carried_out.changed_by import changed_by
from lagrangian.check.reading.carried_out.values import LOST, Equation, Fields, Outside, OwnFunction, State, Value
from lagrangian.records import dataclass

DEEPEST = 6
"""How deep functions and structures are looked into; what is deeper counts as something of the system."""


@dataclass(frozen=True)
class MadeOf:
    """Looks into expressions; ``known`` says whether a name is a parameter or an input of the system."""

    names: Mapping[str, Value]
    functions: Mapping[str, OwnFunction]
    known: Callable[[str], bool]
    states: bool = True
    """Whether entries of a state count."""

    def expression(self, node: ast.AST, target: str = "", hidden: frozenset[str] = frozenset(), depth: int = 0) -> bool:
        """Whether anything of the system is in an expression; p.m is none where m itself is the ``target``."""
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id not in hidden:
            of = self.names.get(node.value.id)
            if isinstance(of, Fields) and node.attr in of.values:
                return self.value(of.values[node.attr], target, depth)
            if of is LOST or not isinstance(of, (Fields, Outside, sp.Symbol, type(None))):
                return self.value(of, "", depth)
            return self.known(node.attr) and node.attr != target
        if isinstance(node, ast.Name):
            if node.id in hidden:
                return False
            own = self.names.get(node.id, self.functions.get(node.id))
            return self.known(node.id) if own is None else self.value(own, "", depth)
        return any(self.expression(x, target, hidden, depth) for x in _parts(node))

    def value(self, value: Value, target: str = "", depth: int = 0) -> bool:
        """Whether anything of the system is in a value; the symbol of the ``target`` itself is none."""
        if depth > DEEPEST:
            return True
        if isinstance(value, sp.Expr):
            letters = {str(x) for x in value.free_symbols} - ({target} if value == sp.Symbol(target) else set())
            moving = any("[" in x for x in letters) or bool(value.atoms(AppliedUndef))
            return any(map(self.known, letters)) or (self.states and moving)
        if isinstance(value, (list, tuple, MatrixBase)):
            return any(self.value(x, "", depth + 1) for x in value)
        if isinstance(value, (dict, Fields)):
            held = value if isinstance(value, dict) else value.values
            return any(self.value(x, "", depth + 1) for x in held.values() if not isinstance(x, OwnFunction))
        if isinstance(value, OwnFunction):
            body = [value.body] if isinstance(value.body, ast.expr) else value.body
            return any(self.expression(x, "", frozenset(value.arguments), depth + 1) for x in body)
        return value is LOST or isinstance(value, Equation) or (self.states and isinstance(value, State))


def _parts(node: ast.AST) -> Iterator[ast.AST]:
    """The parts of an expression that are in its value, not what it depends on."""
    if isinstance(node, ast.IfExp):
        yield from (node.body, node.orelse)
    else:
        yield from ast.iter_child_nodes(node)


def given_in(statement: ast.stmt, name: str, made: MadeOf) -> bool:
    """Whether all values that a statement gives to a name are numbers, or unknown ones without anything of the system,
    and of what else changes in it."""
    changed = set(changed_by(statement))
    for node in ast.walk(statement):
        if isinstance(node, ast.AugAssign):
            targets, value = [node.target], None
        elif isinstance(node, (ast.Assign, ast.AnnAssign)):
            targets, value = node.targets if isinstance(node, ast.Assign) else [node.target], node.value
        elif isinstance(node, ast.For):
            targets, value = [node.target], node.iter
        else:
            continue
        held = {x.id for t in targets for x in ast.walk(t) if isinstance(x, ast.Name)}
        if name not in held:
            continue
        used = {x.id for x in ast.walk(value) if isinstance(x, ast.Name)} if value is not None else changed
        if used & changed or value is None or made.expression(value, name):
            return False
    return True
