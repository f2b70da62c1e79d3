"""What a call may change of the lists, tables and matrices of a program: r.reverse(), np.copyto(r, x), change(r)."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping

from sympy.matrices.matrixbase import MatrixBase

from lagrangian.check.reading.carried_out.routines import SAME, SHOWN, SOLVING
from lagrangian.check.reading.carried_out.values import (
    LIBRARY,
    MODULES,
    Fields,
    Outside,
    OwnFunction,
    Value,
    called_name,
)

_HARMFUL = re.compile(r"copyto|put\w*|place|fill_diagonal|shuffle|resize|\w*push\w*|insort\w*|setattr|at")
"""Functions of libraries that change what they are given."""
_HARMLESS = re.compile(
    r"\w*(?:plot|scatter|show|save|legend|label|title|lim|grid|figure|anim|Anim|quiver|text|ticks?|eig\w*|solve\w*)"
    r"|set_\w+|ode\w+|RK\d+|linspace|isinstance|type|str|repr|all|any|allclose|isclose|min|max|round|int|bool|sorted"
    r"|reversed|sum|zip|map|enumerate|range|abs|len|keys|values|items|get|index|count|append|extend|tolist|lambdify|lti"
    r"|StateSpace|ss|lsim|step|lqr|rank|cond|expm|svd|pinv|norm|trace|det|write|join|format|replace|subs|sort_index"
)
"""Functions and methods that change nothing, and those that are carried out."""
_KEPT = SAME | SHOWN | SOLVING


def altered_by(node: ast.Call, names: Mapping[str, Value], *, failed: bool, of: OwnFunction | None) -> Iterator[Value]:
    """The objects of the program that a call may change, which was not carried out or gives nothing that is known."""
    called = called_name(node.func)
    root = node.func
    while isinstance(root, (ast.Attribute, ast.Subscript)):
        root = root.value
    held = names.get(root.id) if isinstance(root, ast.Name) and root is not node.func else None
    out = [x.value for x in node.keywords if x.arg == "out"]
    library = isinstance(root, ast.Name) and root is not node.func and (held is LIBRARY or root.id in MODULES)
    if of is not None:
        given = zip(of.arguments, node.args, strict=False)
        touched = [
            x for name, x in given if not isinstance(of.body, ast.expr) and any(_alters(s, name) for s in of.body)
        ]
    elif library:
        touched = [*node.args] if _HARMFUL.fullmatch(called) else out
    elif called in ("append", "extend"):
        touched = [node.func] if failed else []
    elif called in _KEPT or _HARMLESS.fullmatch(called):
        touched = out
    else:
        touched = [node]
    for name in (x.id for part in touched for x in ast.walk(part) if isinstance(x, ast.Name)):
        yield from mutable(names.get(name))


def mutable(value: Value) -> Iterator[Value]:
    """A list, a table or a matrix, and the lists in it."""
    if isinstance(value, (list, dict, MatrixBase, Fields)):
        yield value
    if isinstance(value, list):
        for x in value:
            yield from mutable(x)


def is_doubtful(value: Value, node: ast.Call) -> bool:
    """Whether a call may have changed something: it gives nothing that is known, or fills what it is given."""
    return isinstance(value, Outside) or any(x.arg == "out" for x in node.keywords)


def _alters(statement: ast.stmt, name: str) -> bool:
    """Whether a statement of a function changes the object of an argument."""
    for node in ast.walk(statement):
        if isinstance(node, (ast.Subscript, ast.Attribute)) and isinstance(node.ctx, (ast.Store, ast.Del)):
            held: ast.AST = node.value
        elif isinstance(node, ast.AugAssign):
            held = node.target
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            fills = node.func.attr in ("append", "extend") or not _HARMLESS.fullmatch(node.func.attr)
            held = node.func.value if fills and node.func.attr not in _KEPT else node.func
        else:
            continue
        if isinstance(held, ast.Name) and held.id == name:
            return True
    return False
