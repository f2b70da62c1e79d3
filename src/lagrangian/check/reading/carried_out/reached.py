"""Functions of a program that one uses which cannot be carried out: what this one makes of them is not known."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Mapping

from lagrangian.check.reading.carried_out.values import OwnFunction

_STEPS = re.compile(
    r"step|rk\d|runge|euler|heun|verlet|leap|simul|integr|solve|run|main|plot|anim|draw|show|test|check|err|loss|resid"
    r"|energ|event|jac|linear|update|frame|control",
    re.IGNORECASE,
)
"""Names of functions that take steps, draw or check, and are no equations of motion."""


def reached(failed: Iterable[OwnFunction], own: Mapping[str, OwnFunction]) -> set[OwnFunction]:
    """Return the functions that others call which return something that cannot be read, and those that these call."""
    left = [f for f in failed if _returns(f) and _STEPS.search(f.name) is None]
    found: set[OwnFunction] = set()
    while left:
        called = {own[x] for x in _called(left.pop()) if x in own} - found
        found |= called
        left += called
    return found


def _nodes(f: OwnFunction) -> Iterable[ast.AST]:
    body = [f.body] if isinstance(f.body, ast.expr) else f.body
    return (x for part in body for x in ast.walk(part))


def _called(f: OwnFunction) -> set[str]:
    return {x.func.id for x in _nodes(f) if isinstance(x, ast.Call) and isinstance(x.func, ast.Name)} | {
        x.func.attr for x in _nodes(f) if isinstance(x, ast.Call) and isinstance(x.func, ast.Attribute)
    }


def _returns(f: OwnFunction) -> bool:
    """Whether a function returns a value, and takes no steps in a loop."""
    if any(isinstance(x, (ast.While, ast.For)) for x in _nodes(f)):
        return False
    valued = any(isinstance(x, ast.Return) and x.value is not None for x in _nodes(f))
    return isinstance(f.body, ast.expr) or bool(f.out) or valued
