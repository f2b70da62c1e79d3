"""Parses text to a syntax tree, and explains the error if the text is not in the grammar.

The grammar is ``expression.lark``, parsed by LALR(1): no recursion, linear time. The depth of the tree is limited by
that of the brackets, which is limited here.
"""

from __future__ import annotations

from functools import cache
from importlib.resources import files

from lark import Lark, Tree, UnexpectedCharacters, UnexpectedToken

from lagrangian.quantities.source import Source
from lagrangian.read.explain import explain

MAX_CHARACTERS = 50_000
"""The largest number of characters of an expression."""

MAX_DEPTH = 50
"""The deepest nesting of parentheses."""


@cache
def _parser() -> Lark:
    text = files("lagrangian.read").joinpath("expression.lark").read_text(encoding="utf-8")
    return Lark(text, parser="lalr", lexer="contextual", propagate_positions=True, maybe_placeholders=True)


def parse(source: Source) -> Tree:
    """Return the syntax tree of an expression; every node has its offset (``meta.start_pos``).

    Raises `ParseError` with line, column, what was found there and how to fix it.
    """
    source.check_text(MAX_CHARACTERS, "an expression, such as m*g*L", shorter="give parts of it names under [define]")
    _check_depth(source)
    try:
        return _parser().parse(source.text)
    except UnexpectedToken as error:
        end = error.token.type == "$END"
        offset = len(source.text) if end or error.token.start_pos is None else error.token.start_pos
        wants_operand = "NAME" in error.expected
    except UnexpectedCharacters as error:
        offset, wants_operand = error.pos_in_stream, "NAME" in error.allowed
    raise explain(source, offset, wants_operand)


def _check_depth(source: Source) -> None:
    depth = 0
    for offset, c in enumerate(source.text):
        if c == "(":
            depth += 1
            if depth > MAX_DEPTH:
                raise source.error(
                    f"parentheses are nested more than {MAX_DEPTH} deep",
                    offset,
                    fix="give the inner parts names under [define]",
                    code="E703",
                )
        elif c == ")":
            depth -= 1
