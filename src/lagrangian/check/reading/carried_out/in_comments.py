"""Equations of motion that only a comment of a program states, with its matrices.

% A(q)*qdd + h(q, v) = B*tau        columns of all coordinates, rates and accelerations
% xdot = A*x + B*u                  a state that a comment lists, x = [s; v]
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from itertools import islice
from typing import Any

import sympy as sp
from sympy.matrices.matrixbase import MatrixBase

from lagrangian.check.reading.carried_out.interpreter import Interpreter
from lagrangian.check.reading.carried_out.matlab import in_python
from lagrangian.check.reading.carried_out.states import StateReader
from lagrangian.check.reading.carried_out.values import TIME, Value, matrix
from lagrangian.check.reading.names import COLUMNS, spelled_rates

_COMMENT = re.compile(
    r"(?:[%#]|//)++[ \t]*+(?:[^\n:=]{0,60}:(?!=))?+(?P<left>[^\n=]{3,200}+)=(?P<right>[^=\n]{1,200}?)"
    r"(?=$|[,;.][ \t]++\w++[ \t]*+=)",
    re.MULTILINE,
)
_WORD = re.compile(r"[^\W\d]\w*+")
_TWICE = re.compile(r"(?<=[\w])(?:''|’’|″)")
_ONCE = re.compile(rf"(?<!\w)({'|'.join(COLUMNS)})['’′]")
_LISTED = re.compile(
    r"(?<=[%#,;: \t])[^\W\d]\w{0,9}['’]?[ \t]*=[ \t]*[\[(][\w'’;, \t]{1,80}[\])][ \t]*,(?=[^\n=]{3,200}=)"
)
"""A state that a comment lists in front of an equation: q = [x; y], M q'' = f."""
_SAID = re.compile(r"\A(?:[^\W\d_]{3,24}[ ]+)+(?=[A-Z])")
"""Words in front of an equation: descriptor form E z' = A z + B u."""
_LETTER = re.compile(r"(?<!\w)[A-Z](?!\w)")
_OF_TIME = re.compile(r"(?<=\w)\(t\)")
_QUOTIENT = re.compile(r"(?<![\w])d([a-z])[ ]?/[ ]?dt(?!\w)")
_PRODUCT = re.compile(r"(?<=[\w)\]])[ ](?=[\w(\[])")
MOST = 20
"""The most comments that are looked at."""


def equations_in_comments(
    run: Interpreter, names: dict[str, Value], reader: StateReader
) -> Iterator[tuple[int, list[sp.Expr]]]:
    """The entries of equations in columns that comments state, with their lines; each entry is 0."""
    bare = _LISTED.sub(lambda m: " " * len(m.group()), reader.text)
    for match in islice(_COMMENT.finditer(bare), MOST):
        sides = [_ONCE.sub(r"\g<1>d", _TWICE.sub("dd", match[k])).strip().rstrip(".;,") for k in ("left", "right")]
        sides[0] = _SAID.sub("", sides[0].rsplit(", ", 1)[-1])
        sides = [_PRODUCT.sub("*", _QUOTIENT.sub(r"\g<1>d", x)) for x in sides]
        sides = [_OF_TIME.sub("", x) for x in sides]
        own = names | _matrices(" ".join(sides), names)
        known = _columns(" ".join(sides), own, reader) or _state(" ".join(sides), own, reader)
        if known is None:
            continue
        left, right = (_value(run, side, own | known) for side in sides)
        if isinstance(left, MatrixBase) and isinstance(right, MatrixBase) and left.shape == right.shape:
            yield reader.text.count("\n", 0, match.start()) + 1, [x for x in (left - right).flat() if x != 0]


def _value(run: Interpreter, side: str, names: dict[str, Value]) -> Value:
    """The value of one side of an equation."""
    written = ast.parse((in_python(side) if run.matlab else side).strip(), mode="eval").body
    value = run.value(written, names)
    return matrix(value) if isinstance(value, (list, MatrixBase)) else value


def _matrices(said: str, names: dict[str, Value]) -> dict[str, Value]:
    """The matrices that a comment calls M, C and K, and the program Mm, Cm and Km, or Mmat: letters are taken there."""
    found: dict[str, Value] = {}
    for letter in dict.fromkeys(_LETTER.findall(said)):
        if isinstance(names.get(letter), (MatrixBase, list)):
            continue
        longer = (names.get(f"{letter}{x}") for x in ("m", "mat", "_mat", "M", letter))
        value = next((x for x in longer if isinstance(x, MatrixBase)), None)
        found |= {} if value is None else {letter: value}
    return found


def _columns(said: str, names: dict[str, Value], reader: StateReader) -> dict[str, Any] | None:
    """What the columns of coordinates, of rates and of accelerations are called; None without accelerations."""
    words = [x for x in dict.fromkeys(_WORD.findall(said)) if x not in names]
    free = [x for x in words if not reader.scope.meanings(x)[0] or x in COLUMNS]
    stems = {stem for x in free for k, stem in spelled_rates(x) if k == 2 and stem in COLUMNS}
    if len(stems) != 1:
        return None
    (stem,) = stems
    coordinates = [c.name for c in reader.model.coordinates]
    listed = reader.in_comments(stem)
    order = [listed[k + 1] for k in range(len(coordinates)) if k + 1 in listed]
    q = [sp.Function(x)(TIME) for x in (order if len(order) == len(coordinates) else coordinates)]
    orders = {x: k for x in free for k, of in [(0, x), *spelled_rates(x)] if of == stem}
    if "v" in free and 1 not in orders.values():
        orders["v"] = 1
    return {x: sp.Matrix([c.diff(TIME, k) if k else c for c in q]) for x, k in orders.items()}


def _state(said: str, names: dict[str, Value], reader: StateReader) -> dict[str, Any] | None:
    """What a state, its rate and the inputs are, the entries of which comments list; None if they list none."""
    words = [x for x in dict.fromkeys(_WORD.findall(said)) if x not in names]
    stems = {stem: x for x in words for k, stem in spelled_rates(x) if k == 1 and stem in words}
    if len(stems) != 1:
        return None
    ((stem, rate),) = stems.items()
    rates = reader.rates_of(rate, 2 * len(reader.model.coordinates))
    if not rates:
        return None
    moving = [x.args[0] if isinstance(x, sp.Derivative) and x.derivative_count == 1 else None for x in rates]
    state = [q if q is not None else x.args[0].diff(TIME) for q, x in zip(moving, rates, strict=True)]  # type: ignore[attr-defined]
    found: dict[str, Any] = {stem: sp.Matrix(state), rate: sp.Matrix(rates)}
    inputs = [u.name for u in reader.model.inputs]
    for word in (x for x in words if x not in found and not reader.scope.meanings(x)[0]):
        listed = reader.in_comments(word)
        entries = [listed.get(k + 1, name) for k, name in enumerate(inputs)]
        found |= {word: sp.Matrix([sp.Symbol(x) for x in entries])} if inputs else {}
    return found
