"""The values of a program that is carried out on symbols, and the arithmetic with them, within bounds."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Mapping, Sequence
from itertools import islice
from typing import Any, TypeAlias, cast

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.matrices.matrixbase import MatrixBase

from lagrangian import bounded
from lagrangian.errors import Error
from lagrangian.records import dataclass, field

Value: TypeAlias = Any
"""A SymPy expression or matrix, a list, a dictionary, a string, or one of the classes below."""

TIME = sp.Symbol("t")
NAME = re.compile(r"[^\W\d]\w{0,30}")
MOST_STEPS = 6_000
"""The most parts of a program that are carried out."""
LARGEST = 4_000
"""The most operations of one value."""
LARGEST_NUMBER = 10**60
"""The largest number, and the largest denominator of one."""
MOST_ENTRIES = 64
"""The most entries of a matrix or a list."""
MOST_COLUMNS = 4
"""The most columns for which linear equations are solved at once."""
HIGHEST = 12
"""The highest power."""


class AbandonedError(Exception):
    """A program does something that has no meaning on symbols, or too much."""


TROUBLES = (AbandonedError, Error, ValueError, TypeError, IndexError, KeyError, ZeroDivisionError, AttributeError)
"""What may come of a program that is carried out and does not make sense."""


class Outside:
    """What no symbol stands for: a module, a figure, the solution of a solver. Nothing is done with it."""


class SolverOptions(Outside):
    """The options of a solver, of which only the ``mass`` matrix is kept."""

    def __init__(self, mass: Value) -> None:
        self.mass = mass


UNKNOWN, LIBRARY, LOST = Outside(), Outside(), Outside()
"""What is not known, a module, and what is made of parameters in a way that is not known."""
MODULES = frozenset(
    ["np", "numpy", "sp", "sympy", "math", "me", "mechanics", "scipy", "plt", "jnp", "cmath", "la", "linalg", "physics"]
)
"""What modules are called."""


def has_unknown(value: Value) -> bool:
    """Whether a value, or an entry of a list, is one of which nothing is known."""
    return isinstance(value, Outside) or (isinstance(value, (list, tuple)) and any(map(has_unknown, value)))


@dataclass(frozen=True, eq=False)
class Routine:
    """A function of a library by its name."""

    name: str


@dataclass(frozen=True, eq=False)
class OwnFunction:
    """A function of the program: the names of its arguments, and its body or its one expression."""

    name: str
    arguments: tuple[str, ...]
    body: Sequence[ast.stmt] | ast.expr
    out: str | None = None
    """The names that hold the results, in MATLAB."""
    defaults: Sequence[ast.expr] = ()
    """What the last arguments are if they are not given."""


@dataclass(frozen=True, eq=False)
class BoundMethod:
    """A method of a value."""

    of: Value
    name: str


class Mechanical:
    """A frame, a vector, a point, a body or a method of SymPy's mechanics."""

    def attribute(self, name: str) -> Value:
        """Return the value of an attribute."""
        raise NotImplementedError

    def call(self, name: str, given: Sequence[Value], options: Mapping[str, Value]) -> Value:
        """Return the value of a method."""
        raise NotImplementedError


@dataclass(frozen=True)
class Equation:
    """Two sides that a program sets equal."""

    left: sp.Expr
    right: sp.Expr


@dataclass(frozen=True, eq=False)
class Inverse:
    """The inverse of a matrix, of which only products with columns are taken."""

    matrix: MatrixBase


@dataclass(frozen=True, eq=False)
class Fields:
    """A structure of parameters, p.m or p["m"], or an object, self.m: each field that has no value is the symbol with
    its name."""

    values: dict[str, Value] = field(default_factory=dict)

    def value(self, name: str) -> Value:
        """Return what a field is."""
        return self.values.get(name, sp.Symbol(name))


@dataclass(frozen=True, eq=False)
class State:
    """The state of a system of first order: a vector of symbols of unknown length."""

    name: str
    entries: dict[int, sp.Symbol] = field(default_factory=dict)

    def entry(self, index: int) -> sp.Symbol:
        """The entry at a place that is counted from 1."""
        if not 1 <= index <= MOST_ENTRIES:
            raise AbandonedError
        return self.entries.setdefault(index, sp.Symbol(f"{self.name}[{index}]"))


@dataclass(eq=False)
class Shown:
    """What a program states: a value under a name, or shown without one, by the line of the program."""

    line: int
    name: str | None
    value: Value
    shown: bool = False
    of: str = ""
    """The name that is shown."""


class ReturnedError(Exception):
    """A function of the program returns a value."""

    def __init__(self, value: Value) -> None:
        self.value = value


def is_sided(value: Value) -> bool:
    """Whether a value may be a side of an equation."""
    return (is_scalar(value) or isinstance(value, MatrixBase)) and not isinstance(value, Outside)


def equated(a: Value, b: Value) -> Value:
    """Two sides set equal, entry by entry if they are columns."""
    if is_scalar(a) and is_scalar(b):
        return Equation(scalar(a), scalar(b))
    left, right = ([x] * len(listed(y)) if is_scalar(x) else listed(x) for x, y in ((a, b), (b, a)))
    return [Equation(scalar(x), scalar(y)) for x, y in zip(left, right, strict=True)]


def checked(value: Value) -> Value:
    """Return a value that is no longer than what is carried out."""
    if isinstance(value, MatrixBase):
        if len(value) > MOST_ENTRIES or any(bounded.size(x) > LARGEST for x in value):
            raise AbandonedError
    elif isinstance(value, sp.Expr):
        factor: Any = value.as_coeff_Mul()[0]
        if bounded.size(value) > LARGEST or (factor.is_Rational and max(abs(factor.p), factor.q) > LARGEST_NUMBER):
            raise AbandonedError
    elif isinstance(value, (list, tuple, str)) and len(value) > (LARGEST if isinstance(value, str) else MOST_ENTRIES):
        raise AbandonedError
    return value


def number(value: Value) -> int:
    """Return an integer as such."""
    if isinstance(value, bool) or not isinstance(value, (int, sp.Integer)):
        raise AbandonedError
    return int(value)


def listed(value: Value) -> list[Value]:
    """Return the entries of a list or a matrix, and the names of a table."""
    if isinstance(value, MatrixBase):
        return value.flat()
    if isinstance(value, (list, tuple, dict)):
        return list(value)
    raise AbandonedError


def matrix(value: Value) -> MatrixBase:
    """Return a matrix of a list of rows, or a column of a list."""
    if isinstance(value, MatrixBase):
        return value
    rows = listed(value)
    if not rows or len(rows) > MOST_ENTRIES:
        raise AbandonedError
    if all(isinstance(x, (list, tuple)) for x in rows):
        if len({len(x) for x in rows}) != 1 or not rows[0]:
            raise AbandonedError
        if any(isinstance(y, MatrixBase) for x in rows for y in x):
            return checked(
                sp.Matrix.vstack(
                    *[sp.Matrix.hstack(*[matrix(y) if not is_scalar(y) else matrix([y]) for y in x]) for x in rows]
                )
            )
        return sp.Matrix([[scalar(y) for y in x] for x in rows])
    if any(isinstance(x, MatrixBase) for x in rows):
        return checked(sp.Matrix.vstack(*[matrix([x]) if is_scalar(x) else matrix(x) for x in rows]))
    return sp.Matrix([scalar(x) for x in rows])


def scalar(value: Value) -> sp.Expr:
    """Return a single quantity."""
    if isinstance(value, MatrixBase) and value.shape == (1, 1):
        return value[0]
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return sp.Rational(str(value))
    if not isinstance(value, sp.Expr):
        raise AbandonedError
    return value


def is_number(value: Value) -> bool:
    """Whether a value is a number, or a list or a matrix of numbers; what is unknown counts as one."""
    if isinstance(value, (list, tuple, MatrixBase)):
        return all(map(is_number, listed(value)))
    return isinstance(value, Outside) or (isinstance(value, sp.Expr) and not value.free_symbols)


def is_list(value: Value) -> bool:
    """Whether a value is a list of Python, which a sum makes longer, and no matrix by its rows."""
    return isinstance(value, list) and not any(isinstance(x, (list, MatrixBase)) for x in value)


def joined(parts: Sequence[Value]) -> str:
    """Return a string of its parts; an empty one if these are no names and numbers."""
    return checked("".join(map(str, parts))) if all(isinstance(x, (str, sp.Integer)) for x in parts) else ""


def is_scalar(value: Value) -> bool:
    """Whether a value is a single quantity."""
    return isinstance(value, sp.Expr) or (isinstance(value, (int, float)) and not isinstance(value, bool))


def added(a: Value, b: Value, sign: int = 1) -> Value:
    """a + b or a − b; lists are joined, and a number is added to every entry of a column."""
    if isinstance(a, (list, tuple)) and isinstance(b, (list, tuple)) and sign > 0:
        return checked([*a, *b])
    if is_scalar(a) and is_scalar(b):
        return checked(scalar(a) + sign * scalar(b))
    a, b = (x if is_scalar(x) else matrix(x) for x in (a, b))
    if is_scalar(a) or is_scalar(b) or a.shape != b.shape:
        raise AbandonedError
    return checked(a + sign * b)


def times(a: Value, b: Value) -> Value:
    """The product of numbers, and of matrices that fit; of two columns, entry by entry."""
    if is_scalar(a) and is_scalar(b):
        return checked(scalar(a) * scalar(b))
    if is_scalar(a) or is_scalar(b):
        factor, whole = (scalar(a), matrix(b)) if is_scalar(a) else (scalar(b), matrix(a))
        return checked(whole * factor)
    a, b = matrix(a), matrix(b)
    if a.shape[1] == b.shape[0]:
        made = checked(a * b)
        return made[0] if made.shape == (1, 1) else made
    if a.shape == b.shape:
        return checked(a.multiply_elementwise(b))
    raise AbandonedError


def over(a: Value, b: Value) -> Value:
    """A quotient by a single quantity."""
    if scalar(b) == 0:
        raise AbandonedError
    return times(a, 1 / scalar(b))


def power(a: Value, b: Value) -> Value:
    """A power with a small exponent; of a matrix to −1, its inverse."""
    exponent = scalar(b)
    if isinstance(a, MatrixBase) and exponent == -1:
        return Inverse(a)
    if isinstance(a, MatrixBase) and len(a) > 1 and 1 in a.shape and exponent == 2:
        return checked(a.applyfunc(lambda x: x**2))
    base = scalar(a)
    if exponent.is_number and (not exponent.is_Rational or abs(exponent) > HIGHEST):
        raise AbandonedError
    if base == 0 and exponent.is_negative:
        raise AbandonedError
    return checked(base**exponent)


def transposed(of: Value, known: Callable[[str], bool]) -> Value:
    """The transpose; x' of a coordinate that is no ``known`` parameter may be meant as its rate."""
    if isinstance(of, AppliedUndef) or (isinstance(of, sp.Symbol) and not known(of.name)):
        raise AbandonedError
    if isinstance(of, sp.Expr):
        return of
    flat = isinstance(of, list) and not any(isinstance(x, list) for x in of)
    return matrix(of) if flat else matrix(of).T


def slope(value: Value, by: Value) -> Value:
    """The derivative by a symbol, a function of time or its rate; of one quantity also by a column of these."""
    if isinstance(by, MatrixBase) and is_scalar(value):
        return by.applyfunc(lambda x: slope(value, x))
    if isinstance(value, MatrixBase):
        return value.applyfunc(lambda x: slope(x, by))
    if not isinstance(by, sp.Expr) or not (by.is_Symbol or by.is_Function or isinstance(by, sp.Derivative)):
        raise AbandonedError
    return checked(bounded.diff(scalar(value), by))


def entry_of(of: MatrixBase, row: int, column: int) -> sp.Expr:
    """Return an entry of a matrix."""
    if not (-of.shape[0] <= row < of.shape[0] and -of.shape[1] <= column < of.shape[1]):
        raise AbandonedError
    return of[row, column]


def is_square(value: Value) -> bool:
    """Whether a value is a square matrix, or rows of one."""
    if isinstance(value, MatrixBase):
        return value.shape[0] == value.shape[1]
    return isinstance(value, list) and all(isinstance(x, list) and len(x) == len(value) for x in value)


def constant(value: Any) -> Value:
    """Return the value of a number or a string that is written out."""
    if isinstance(value, bool) or value is None or isinstance(value, complex):
        return UNKNOWN
    if isinstance(value, (int, float)):
        if isinstance(value, int) and abs(value) > 10**30:
            raise AbandonedError
        return sp.Rational(str(value))
    return value if isinstance(value, str) else UNKNOWN


def cramer(x: sp.Symbol, A: MatrixBase, b: MatrixBase, unknowns: Sequence[sp.Symbol]) -> sp.Expr:
    """Return the value of one of the unknowns of A x = b, of which there are three at most."""
    if len(unknowns) > 3:
        raise AbandonedError
    swapped = sp.Matrix(A)
    swapped[:, unknowns.index(x)] = b
    above, below = (cast("sp.Expr", x.det(method="berkowitz")) for x in (swapped, sp.Matrix(A)))
    return checked(above / below)


def called_name(node: ast.expr) -> str:
    """The last name of what is called: print, sp.simplify."""
    return node.id if isinstance(node, ast.Name) else node.attr if isinstance(node, ast.Attribute) else ""


def bind(target: ast.expr, value: Value, names: dict[str, Value]) -> None:
    """Give the names of a comprehension their values."""
    if isinstance(target, ast.Name):
        names[target.id] = value
    elif isinstance(target, ast.Tuple):
        for one, part in zip(target.elts, listed(value), strict=False):
            bind(one, part, names)
    else:
        raise AbandonedError


def counted(called: str, given: Sequence[Value]) -> list[Value]:
    """Return what a loop over range(…), zip(…) or enumerate(…) goes through."""
    if called == "range":
        return [sp.Integer(k) for k in islice(range(*map(number, given)), MOST_ENTRIES + 1)]
    if called == "zip":
        return [list(x) for x in zip(*map(listed, given), strict=False)]
    return [[sp.Integer(k), x] for k, x in enumerate(listed(given[0]))]
