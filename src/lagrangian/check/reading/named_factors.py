"""Products that say what one new name in them is: 2 D w0 = d/m is D = d/(2 m w0) where w0^2 = k/m says what w0 is."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from lark import Tree

from lagrangian.check.reading.line_forms import Statement
from lagrangian.check.reading.named_products import with_named_products
from lagrangian.check.reading.names import Names, names_in
from lagrangian.check.reading.nodes import Node, inside, leaf, node, only_name, squared_name, start_of
from lagrangian.check.reading.subjects import Subjects
from lagrangian.read.letters import key, undotted


def with_solved_factors(statements: Sequence[Statement], subjects: Subjects) -> Sequence[Statement]:
    """The statements, with names for products of matrices, and those between constants solved for the one name in a
    product that nothing else explains."""
    names, out = subjects.names, list(with_named_products(statements, subjects))
    own = {key(str(x)) for s in out if len(s.sides) > 1 and (x := _new_name(s.sides[0])) is not None}
    waiting = [i for i, s in enumerate(out) if len(s.sides) == 2 and inside(s.sides[0]).data == "product"]
    while True:
        solved = next(((i, x) for i in waiting if (x := _solved(out, i, names, own)) is not None), None)
        if solved is None:
            return out
        i, (new, made) = solved
        out[i] = made
        waiting.remove(i)
        own.add(new)


def _new_name(side: Node) -> str | None:
    """The name that a side is, perhaps squared."""
    found = only_name(side)
    if found is not None:
        return None if found[1] else str(found[0])
    squared = squared_name(side)
    return None if squared is None else str(squared)


def _solved(statements: Sequence[Statement], i: int, names: Names, own: set[str]) -> tuple[str, Statement] | None:
    """The key of the new name and the statement that says what it is; None if it does not."""
    statement = statements[i]
    left, right = statement.sides
    product = inside(left)
    factors = list(product.children[::2])
    new = [x for x in factors if (name := _new_name(x)) is not None and _is_new(name, names, own)]
    if len(new) != 1 or "/" in product.children[1::2]:
        return None
    name = key(str(_new_name(new[0])))
    rest = [x for x in factors if x is not new[0]]
    others = (s for k, s in enumerate(statements) if k != i)
    used = any(key(str(token)) == name for s in others for side in s.sides for token, _ in names_in(side))
    if not used or not all(_is_constant(x, names, own) for x in _names([*rest, right])):
        return None
    start = start_of(right)
    divided = [x for factor in rest for x in (leaf("SLASH", "/", start), factor)]
    return name, replace(statement, sides=(node("sum", start, None, new[0]), node("product", start, right, *divided)))


def _names(trees: Sequence[Node]) -> Iterator[str]:
    """The names in trees; an empty one for what is differentiated."""
    for tree in trees:
        if isinstance(tree, Tree):
            yield from ("" if changing else str(token) for token, changing in names_in(tree))


def _is_new(name: str, names: Names, own: set[str]) -> bool:
    """Whether a name is none of the system, and no statement says what it is."""
    return not undotted(name)[1] and not names.scope.meanings(name)[0] and key(name) not in own


def _is_constant(name: str, names: Names, own: set[str]) -> bool:
    """Whether a name is a parameter of the system, or explained by the answer."""
    given = {p.name for p in names.model.parameters}
    return key(name) in own or any(x in given for x in names.scope.meanings(name)[0])
