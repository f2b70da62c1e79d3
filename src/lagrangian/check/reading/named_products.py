"""Products of a matrix and a column that an answer gives as a whole: C(q, q') q' = [a; b], and M q'' + C q' + G = Q.

Nothing says what C is, and nothing has to: the product is read as a quantity with a name of its own.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TypeAlias

from lark import Tree

from lagrangian.check.reading.line_forms import Statement
from lagrangian.check.reading.names import COLUMNS, spelled_rates
from lagrangian.check.reading.nodes import Node, inside, name, only_name, start_of
from lagrangian.check.reading.subjects import Subjects
from lagrangian.read.letters import key, undotted

_Product: TypeAlias = "tuple[str, str, int]"
"""The keys of both names, and how often the second is differentiated."""


def with_named_products(statements: Sequence[Statement], subjects: Subjects) -> Sequence[Statement]:
    """The statements, with a name for each product that one of them gives as a matrix.

    A mass of the system times q'' is no such product, but an equation, unless what it is holds accelerations and
    another statement uses it.
    """
    alone = {key(str(found[0])) for s in statements for side in s.sides if (found := only_name(side)) is not None}
    given: set[_Product] = set()
    free: set[_Product] = set()
    for side, value in ((a, b) for s in statements for a, b in zip(s.sides, s.sides[1:], strict=False)):
        product = _product(side)
        if product is None or product[0] in alone or not _is_matrix(value):
            continue
        free |= set() if subjects.names.scope.meanings(product[0])[0] else {product}
        given |= {product} if product[2] == 1 or subjects.accelerates(value) else set()
    if not given:
        return statements
    counts = Counter(x for s in statements for side in s.sides for x in _products(side))
    named = {x for x in given if x in free or counts[x] > 1}
    return [replace(s, sides=tuple(_named(side, named) for side in s.sides)) for s in statements]


def _product(tree: Node) -> _Product | None:
    """The product that a whole tree is, of a name and the rate of a column."""
    tree = inside(tree)
    if not isinstance(tree, Tree) or tree.data != "product" or len(tree.children) != 3:
        return None
    return next((found for _, found in _pairs(tree)), None)


def _pairs(tree: Tree) -> Iterator[tuple[int, _Product]]:
    """Where a name stands in front of the rate of a column in a product, and which these are."""
    for k in range(0, len(tree.children) - 2, 2):
        if "/" in tree.children[max(k - 1, 0) : k + 2 : 2]:
            continue
        first, second = only_name(tree.children[k]), only_name(tree.children[k + 2])
        if first is None or second is None or first[1] or undotted(first[0])[1]:
            continue
        stem, dots = undotted(second[0])
        order = second[1] + dots
        if not order:
            order, stem = next(((n, x) for n, x in spelled_rates(stem) if key(x) in COLUMNS), (0, stem))
        stem = key(stem).removeprefix("bold ")
        if order and stem in COLUMNS:
            yield k, (key(str(first[0])), stem, order)


def _products(tree: Tree) -> Iterator[_Product]:
    return (x for part in tree.iter_subtrees() if part.data == "product" for _, x in _pairs(part))


def _is_matrix(tree: Tree) -> bool:
    """Whether a tree is a matrix that is written out, perhaps transposed or with a factor."""
    found = inside(tree)
    return isinstance(found, Tree) and found.data != "sum" and any(x.data == "matrix" for x in found.iter_subtrees())


def _named(tree: Node, products: set[_Product]) -> Node:
    """The tree with names in the place of products."""
    if not isinstance(tree, Tree):
        return tree
    children = list(tree.children)
    for k, found in reversed(list(_pairs(tree))) if tree.data == "product" else ():
        if found in products:
            first = str(only_name(children[k])[0])  # type: ignore[index]
            children[k : k + 3] = [name(f"{first}_{found[1]}_{found[2]}", start_of(children[k]))]
    children = [_named(x, products) for x in children]
    same = len(children) == len(tree.children) and all(a is b for a, b in zip(children, tree.children, strict=True))
    return tree if same else Tree(tree.data, children, tree.meta)
