"""What a statement is about: the name that it gives a value to, and what that is the name of."""

from __future__ import annotations

import re

import sympy as sp
from lark import Token

from lagrangian.check.reading.answer import Kind
from lagrangian.check.reading.stated import is_no_energy
from lagrangian.records import dataclass

_CALLED = re.compile(
    r"(?:eqn?|ode|eom|res|dgl|bwg|el|ele|eq?uation|euler_?lagrange)(?:_?\d*|_[^\W_]{1,8})", re.IGNORECASE
)
"""What programs call an equation whose right side is 0: eq1 = m*x'' + k*x, eom_theta = …."""


@dataclass(frozen=True)
class Subject:
    """The subject of a statement: its kind, its name, the token, the order of a rate, the inverse of the function that
    the name stands in, and whether it is on the right."""

    kind: Kind
    name: str | None = None
    token: Token | None = None
    order: int = 0
    inverse: str = ""
    right: bool = False


def named_anew(subject: Subject, value: sp.Expr) -> Subject:
    """A subject; one with the name of an energy that is none by its value is a name of the answer's own."""
    if subject.kind not in ("T", "D") or subject.token is None or not is_no_energy(value):
        return subject
    return Subject("definition", str(subject.token), subject.token)


def is_label_of_equation(subject: Subject) -> bool:
    """Whether a name only calls what follows an equation, with 0 on its right."""
    return _CALLED.fullmatch(str(subject.token)) is not None
