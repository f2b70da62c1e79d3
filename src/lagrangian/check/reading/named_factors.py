"""Products that say what one new name in them is: 2 D w0 = d/m is D = d/(2 m w0) where w0^2 = k/m says what w0 is."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

from lark import Tree

from lagrangian.check.reading.line_forms import Statement
from lagrangian.check.reading.named_products import with_named_products
from lagrangian.check.reading.names import Names
from lagrangian.check.reading.nodes import Node, inside, leaf, names_in, node, only_name, squared_name, start_of
from lagrangian.check.reading.subjects import Subjects
from lagrangian.read.letters import key, undotted


def with_solved_factors(statements: Sequence[Statement], subjects: Subjects) -> Sequence[Statement]:
    """The statements, with names for products of matrices, and those between constants solved for the one name in a
    product that nothing else explains."""
    names, out = subjects.names, list(with_named_products(statements, subjects))
    own = {key(str(x)) for s in out if len(s.sides) > 1 and (x := _new_name(s.sides[0])) is not None}
    turned = {i: replace(s, sides=s.sides[::-1]) for i, s in enumerate(out) if len(s.sides) == 2 and not _is_product(s)}
    turned = {i: s for i, s in turned.items() if _is_product(s) and _is_parameter(s.sides[1], names)}  # J = M i^2
    waiting = {i: _names(s.sides) for i, s in enumerate(out) if _is_product(s) or i in turned}
    counts = Counter(key(x) for s in out for x in _names(s.sides)) if waiting else Counter[str]()
    found = True
    while found:
        found = False
        for i, listed in list(waiting.items()):
            new = {key(x) for x in listed if _is_new(x, names, own)}
            if len(new) != 1 or not all(key(x) in new or _is_constant(x, names, own) for x in listed):
                continue
            made = _solved(turned.get(i, out[i]), *new)
            if made is None or counts[min(new)] < 2:  # nothing else uses it
                continue
            out[i], found = made, True
            own |= new
            del waiting[i]
    return out


def _is_product(statement: Statement) -> bool:
    """Whether a statement equates a product without quotients."""
    if len(statement.sides) != 2:
        return False
    left = inside(statement.sides[0])
    return isinstance(left, Tree) and left.data == "product" and "/" not in left.children[1::2]


def _is_parameter(side: Node, names: Names) -> bool:
    """Whether a side is a parameter of the system alone."""
    found = only_name(side)
    meant = [] if found is None or found[1] else names.scope.meanings(found[0])[0]
    return any(p.name in meant for p in names.model.parameters)


def _new_name(side: Node) -> str | None:
    """The name that a side is, perhaps squared."""
    found = only_name(side)
    if found is not None:
        return None if found[1] else str(found[0])
    squared = squared_name(side)
    return None if squared is None else str(squared)


def _solved(statement: Statement, new: str) -> Statement | None:
    """The statement that says what a factor of its left side is; None if it is not a single one."""
    left, right = statement.sides
    factors = list(inside(left).children[::2])
    single = [x for x in factors if (name := _new_name(x)) is not None and key(name) == new]
    rest = [x for x in factors if x is not single[0]] if single else []
    if any(key(x) == new for x in _names([*rest, right])) or not single:
        return None
    start = start_of(right)
    divided = [x for factor in rest for x in (leaf("SLASH", "/", start), factor)]
    return replace(statement, sides=(node("sum", start, None, single[0]), node("product", start, right, *divided)))


def _names(trees: Sequence[Node]) -> list[str]:
    """The names in trees; an empty one for what is differentiated."""
    found = (x for tree in trees if isinstance(tree, Tree) for x in names_in(tree))
    return ["" if changing else str(token) for token, changing in found]


def _is_new(name: str, names: Names, own: set[str]) -> bool:
    """Whether a name is none of the system, and no statement says what it is."""
    return bool(name) and not undotted(name)[1] and not names.scope.meanings(name)[0] and key(name) not in own


def _is_constant(name: str, names: Names, own: set[str]) -> bool:
    """Whether a name is a parameter of the system, or explained by the answer."""
    given = {p.name for p in names.model.parameters}
    return key(name) in own or any(x in given for x in names.scope.meanings(name)[0])
