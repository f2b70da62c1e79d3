"""What a statement of a program changes: the names to which it, or what is in it, gives values."""

from __future__ import annotations

import ast
from collections.abc import Iterator

_FILLING = ("append", "extend", "insert", "update", "pop")
"""Methods that change a list."""


def changed_by(statement: ast.stmt) -> dict[str, bool]:
    """Return the names that a statement may change, and whether one of their new values is made of the old one."""
    found: dict[str, bool] = {}
    for node in ast.walk(statement):
        if isinstance(node, ast.AugAssign):
            found |= dict.fromkeys(_targets(node.target), True)
        elif isinstance(node, (ast.Assign, ast.AnnAssign)):
            used = {x.id for x in ast.walk(node.value) if isinstance(x, ast.Name)} if node.value is not None else set()
            for target in node.targets if isinstance(node, ast.Assign) else [node.target]:
                for name in _targets(target):
                    found[name] = found.get(name, False) or name in used
        elif isinstance(node, ast.For):
            found |= dict.fromkeys(_targets(node.target), False)
        elif isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found[node.name] = True
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in _FILLING:
            found |= dict.fromkeys(_targets(node.func.value), True)
    return found


def returns(statement: ast.AST) -> bool:
    """Whether a function may end within a statement; functions in it end for themselves."""
    if isinstance(statement, (ast.FunctionDef, ast.ClassDef)):
        return False
    inner = (x for x in ast.iter_child_nodes(statement) if not isinstance(x, ast.expr))
    return isinstance(statement, ast.Return) or any(map(returns, inner))


def _targets(node: ast.expr) -> Iterator[str]:
    """The names that a target of an assignment holds: x, y[0], (a, b); a field changes its object."""
    if isinstance(node, ast.Name):
        yield node.id
    elif isinstance(node, (ast.Tuple, ast.List)):
        for x in node.elts:
            yield from _targets(x)
    elif isinstance(node, (ast.Subscript, ast.Attribute, ast.Starred)):
        yield from _targets(node.value)
    elif isinstance(node, ast.Call):
        yield from _targets(node.func)
