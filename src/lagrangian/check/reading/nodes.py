"""The syntax tree of an answer: lark's nodes, named as in ``expression.lark``, and a few more.

rate        (x1 + x2)', d/dt(…), diff(…, t):   what is differentiated, and how often
partial     ∂L/∂ξ̇, diff(L, x1'):               what is differentiated, and by which name
matrix      rows of entries;  transpose  of one
power_of    sin²(x): the call, and the exponent
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypeAlias, TypeVar, cast

from lark import Token, Tree
from lark.tree import Meta

T = TypeVar("T")
Node: TypeAlias = Any
"""A tree or one of its tokens; lark's own types are no more specific about the children of a node."""

_MAX_DIAGONAL = 30

MAX_DEPTH = 50
"""The deepest nesting of brackets, fractions, roots and dots over brackets."""


def leaf(kind: str, text: str, start: int) -> Token:
    """Return a token with its place."""
    return Token(kind, text, start_pos=start)


def node(kind: str, start: int, *children: Node) -> Tree:
    """Return a node with the place where it begins."""
    meta = Meta()
    meta.start_pos, meta.empty = start, False
    return Tree(kind, list(children), meta)


def kept(tree: Tree, what: str, find: Callable[[Tree], T]) -> T:
    """What is found in a tree, which never changes: it is kept with it, as many statements are compared."""
    known = vars(tree)
    if what not in known:
        known[what] = find(tree)
    return known[what]


def start_of(item: Node) -> int:
    """Where a node or token begins."""
    return (item.start_pos or 0) if isinstance(item, Token) else item.meta.start_pos


def number(text: str, start: int) -> Tree:
    """Return the node of a number."""
    return node("number", start, leaf("NUMBER", text, start))


def name(text: str, start: int, primes: int = 0) -> Tree:
    """Return the node of a name with its primes or dots."""
    return node("name", start, leaf("NAME", text, start), leaf("PRIMES", "'" * primes, start) if primes else None)


def wrapped(kind: str, start: int, child: Tree) -> Tree:
    """Return a node around another; its own token distinguishes it from a node that only wraps another."""
    return node(kind, start, leaf("MARK", kind, start), child)


def matrix(start: int, rows: Sequence[Sequence[Tree]]) -> Tree:
    """Return the node of a matrix."""
    return node("matrix", start, leaf("MARK", "matrix", start), *(node("row", start, *row) for row in rows))


def column(start: int, entries: Sequence[Tree]) -> Tree:
    """Return the node of a list, which is a column, transposed or not."""
    return node("matrix", start, leaf("MARK", "list", start), *(node("row", start, entry) for entry in entries))


def is_column(tree: Node) -> bool:
    """Whether a tree is a list, (x, y) or [x, y]."""
    return is_matrix(tree) and inside(tree).children[0] == "list"


def diagonal(start: int, entries: Sequence[Tree]) -> Tree:
    """Return the node of a matrix with these entries on its diagonal; of a matrix that is too large, enough that it is
    refused."""
    n = min(len(entries), _MAX_DIAGONAL)
    return matrix(start, [[entries[i] if i == j else number("0", start) for j in range(n)] for i in range(n)])


def matrix_entries(tree: Tree) -> list[Tree] | None:
    """Return the entries of a list inside a list; None if it is no list."""
    if tree.data != "matrix":
        return None
    rows: list[Node] = list(tree.children[1:])
    return [row.children[0] for row in rows] if all(len(r.children) == 1 for r in rows) else None


def inside(tree: Node) -> Node:
    """Return the innermost tree when nodes that only wrap another are removed."""
    while isinstance(tree, Tree) and tree.data in ("sum", "product", "signed", "power", "postfix"):
        inner = [c for c in tree.children if c is not None]
        if len(inner) != 1:
            return tree
        tree = inner[0]
    return tree


def without_minus(side: Node) -> tuple[Node, bool]:
    """A side without the minus in front of its only term, and whether there is one."""
    tree = inside(side)
    children = tree.children if isinstance(tree, Tree) and tree.data in ("sum", "signed") else []
    minus = len(children) == 2 and str(children[0]) == "-"
    return (children[1], True) if minus else (side, False)


def is_matrix(tree: Node) -> bool:
    """Whether a tree is a matrix that is written out."""
    tree = inside(tree)
    return isinstance(tree, Tree) and tree.data == "matrix"


def squared_name(tree: Node) -> Token | None:
    """Return the name if a tree is the square of a name: v^2, v²."""
    tree = inside(tree)
    if not isinstance(tree, Tree) or tree.data not in ("power", "postfix"):
        return None
    base, *rest = [c for c in tree.children if c is not None]
    found = only_name(base)
    last = inside(rest[-1])
    exponent = last.children[0] if isinstance(last, Tree) and last.data == "number" else last
    return found[0] if found is not None and not found[1] and exponent in ("2", "²") and len(rest) <= 2 else None


def called_name(tree: Node) -> tuple[str, Token] | None:
    """Return the function and the name if a tree is the sine or the tangent of a name: tan α."""
    tree = inside(tree)
    if not isinstance(tree, Tree) or tree.data != "call" or len(tree.children) != 2:
        return None
    found, function = only_name(tree.children[1]), str(tree.children[0])
    return (function, found[0]) if function in ("sin", "tan") and found is not None and not found[1] else None


def only_name(tree: Node) -> tuple[Token, int] | None:
    """Return the name and its primes if a tree is only a name, however it is wrapped."""
    tree = inside(tree)
    if not isinstance(tree, Tree) or tree.data != "name":
        return None
    token, primes = tree.children
    return token, len(primes or "")  # type: ignore[return-value]


def derived(trees: Sequence[Tree]) -> set[str]:
    """The letters of which partial derivatives stand in the trees: H of ∂H/∂x."""
    return {str(part.children[0]) for tree in trees for part in _partials(tree)}


def _partials(tree: Tree) -> tuple[Tree, ...]:
    """The partial derivatives in a tree."""
    return kept(tree, "partials", lambda of: tuple(x for x in of.iter_subtrees() if x.data == "partial"))


def has_matrix(tree: Tree) -> bool:
    """Whether a matrix that is written out stands in a tree."""
    return kept(tree, "matrix", lambda of: any(x.data == "matrix" for x in of.iter_subtrees()))


def names_in(tree: Node) -> tuple[tuple[Token, bool], ...]:
    """The names in a tree, and whether each is differentiated by time there."""
    return kept(tree, "names", lambda of: tuple(_names_in(of))) if isinstance(tree, Tree) else ()


def _names_in(tree: Tree) -> Iterator[tuple[Token, bool]]:
    stack: list[tuple[Node, bool]] = [(tree, False)]
    while stack:
        item, changing = stack.pop()
        if not isinstance(item, Tree):
            continue
        if item.data == "name":
            yield item.children[0], changing or item.children[1] is not None  # type: ignore[misc]
        elif item.data == "partial":
            stack.append((item.children[1], False))
        else:
            stack.extend((child, changing or item.data == "rate") for child in item.children)


def rates_in(tree: Tree) -> tuple[int, list[tuple[int, Sequence[Node]]]]:
    """The highest order of a rate over something in a tree, and its names, each with the order of the rates over it."""
    return kept(tree, "rates", _rates_in)


def _rates_in(tree: Tree) -> tuple[int, list[tuple[int, Sequence[Node]]]]:
    highest, names = 0, list[tuple[int, Sequence[Node]]]()
    stack: list[tuple[Node, int]] = [(tree, 0)]
    while stack:
        item, order = stack.pop()
        if not isinstance(item, Tree):
            continue
        if item.data == "name":
            names.append((order, item.children))
        elif item.data == "rate":
            order += cast("int", item.children[1])
            highest = max(highest, order)
            stack.append((item.children[0], order))
        else:
            stack.extend((child, order) for child in item.children)
    return highest, names


def differentiated_by(trees: Sequence[Tree]) -> tuple[str, ...]:
    """The names by which energies are differentiated somewhere, each once."""
    found = (only_name(part.children[1]) for tree in trees for part in _partials(tree))
    return tuple(dict.fromkeys(str(x[0]) for x in found if x is not None))
