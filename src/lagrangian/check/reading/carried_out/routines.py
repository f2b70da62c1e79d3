"""The functions of SymPy, NumPy and MATLAB that are carried out on symbols."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef, UndefinedFunction
from sympy.matrices.matrixbase import MatrixBase

from lagrangian import bounded
from lagrangian.check.reading.carried_out.values import (
    HIGHEST,
    NAME,
    TIME,
    UNKNOWN,
    AbandonedError,
    Equation,
    Inverse,
    Value,
    checked,
    is_scalar,
    listed,
    matrix,
    number,
    power,
    scalar,
    slope,
    times,
)

_RANGE = re.compile(r"([^\W\d]\w*?)\(?(\d)?:(\d)\)?")

PLAIN: Mapping[str, Callable[..., Any]] = {
    **{x: getattr(sp, x) for x in ("sin", "cos", "tan", "exp", "log", "sqrt", "sinh", "cosh", "tanh", "asin", "acos")},
    **{"atan": sp.atan, "arcsin": sp.asin, "arccos": sp.acos, "arctan": sp.atan, "abs": sp.Abs, "Abs": sp.Abs},
    **{"sign": sp.sign, "cot": sp.cot, "sec": sp.sec, "csc": sp.csc},
    **dict.fromkeys(("deg2rad", "radians"), lambda x: x * sp.pi / 180),
    **dict.fromkeys(("rad2deg", "degrees"), lambda x: x * 180 / sp.pi),
}
"""Functions of one quantity."""
SAME = frozenset(
    [
        *("simplify", "expand", "trigsimp", "factor", "collect", "together", "cancel", "nsimplify", "sympify", "S"),
        *("vpa", "array", "asarray", "float", "double", "expand_trig", "radsimp", "doit", "evalf", "n", "apart"),
        *("powsimp", "combine", "list", "tuple", "as_mutable", "as_immutable", "ravel", "flatten", "copy", "squeeze"),
    ]
)
"""What changes no value."""
_ALIASES: Mapping[str, str] = {
    **dict.fromkeys(("ImmutableMatrix", "mat", "block"), "Matrix"),
    **dict.fromkeys(("numel", "length"), "len"),
    **dict.fromkeys(("Diagonal", "diagm", "diagonal"), "diag"),
    **{"arctan2": "atan2", "Subs": "subs", "block_diag": "blkdiag"},
}
"""Other names of functions."""
SHOWN = frozenset(
    ["print", "pprint", "display", "disp", "pretty", "pretty_print", "latex", "mprint", "mlatex", "fprintf", "mpprint"]
)
"""What shows values."""
SOLVING = frozenset(
    [
        "solve",
        "linsolve",
        "nonlinsolve",
        "dsolve",
        "solveset",
        "linear_eq_to_matrix",
        "odeToVectorField",
        "equationsToMatrix",
    ]
)
"""What solves equations, which are stated by that."""


def names_in(text: Value) -> list[str]:
    """The names in what symbols are made of: "m1 m2", "x, y", "q1:4"."""
    if isinstance(text, (list, tuple)):
        return [name for x in text for name in names_in(x)]
    if not isinstance(text, str) or len(text) > 400:
        raise AbandonedError
    found: list[str] = []
    for word in re.split(r"[\s,]+", text.strip()):
        bare = re.sub(r"[\\{}$]", "", word)
        if (several := _RANGE.fullmatch(bare)) is not None:
            found += [f"{several[1]}{k}" for k in range(int(several[2] or 0), int(several[3]))]
        elif NAME.fullmatch(bare):
            found.append(bare)
        elif bare:
            raise AbandonedError
    return found


def _alone(found: list[Value], text: Value) -> Value:
    return found[0] if len(found) == 1 and isinstance(text, str) and not text.rstrip().endswith(",") else found


def symbols(text: Value, options: Mapping[str, Value]) -> Value:
    """Symbols, or with cls=Function functions without an argument."""
    if "cls" in options:
        return _alone([sp.Function(x) for x in names_in(text)], text)
    return _alone([sp.Symbol(x) for x in names_in(text)], text)


def dynamic(text: Value, order: int = 0) -> Value:
    """Functions of time, or their rates."""
    if not 0 <= order <= 2:
        raise AbandonedError
    made: list[Any] = [sp.Function(x)(TIME) for x in names_in(text)]
    return _alone([x.diff(TIME, order) if order else x for x in made], text)


def differentiated(value: Value, by: Sequence[Value]) -> Value:
    """diff(f, x, y), diff(f, t, 2), diff(f, (t, 2)), diff(f, 't'); by time if nothing is named."""
    left = list(by) or [TIME]
    while left:
        one = left.pop(0)
        one = sp.Symbol(one) if isinstance(one, str) and one.isidentifier() else one
        count = 1
        if isinstance(one, (list, tuple)) and len(one) == 2:
            one, count = one[0], number(one[1])
        elif left and isinstance(left[0], (int, sp.Integer)):
            count = number(left.pop(0))
        if not 0 < count <= 2:
            raise AbandonedError
        for _ in range(count):
            value = slope(value, one)
    return value


def jacobian(of: Value, by: Value) -> Value:
    """The matrix of all slopes."""
    rows = listed(of) if isinstance(of, (list, tuple, MatrixBase)) else [of]
    columns = listed(by) if isinstance(by, (list, tuple, MatrixBase)) else [by]
    return checked(sp.Matrix([[slope(x, y) for y in columns] for x in rows]))


def gradient(of: Value, by: Value) -> MatrixBase:
    """The column of slopes by symbols, as the symbolic toolbox of MATLAB makes it."""
    if not isinstance(by, (list, tuple, MatrixBase)):
        raise AbandonedError
    return jacobian(scalar(of), by).T


def euler_lagrange(of: Value, by: Value) -> list[sp.Expr]:
    """∂L/∂q − d/dt ∂L/∂q' for each function of time."""
    functions = listed(by) if isinstance(by, (list, tuple, MatrixBase)) else [by]
    if not all(isinstance(q, AppliedUndef) for q in functions):
        raise AbandonedError
    L = scalar(of)
    return [checked(slope(L, q) - slope(slope(L, q.diff(TIME)), TIME)) for q in functions]


def replaced(value: Value, pairs: Mapping[Any, Any]) -> Value:
    """A value with others in place of some of its parts."""
    if isinstance(value, (list, tuple)):
        return [replaced(x, pairs) for x in value]
    if isinstance(value, Equation):
        return Equation(replaced(value.left, pairs), replaced(value.right, pairs))
    if isinstance(value, MatrixBase):
        return checked(value.applyfunc(lambda x: x.xreplace(dict(pairs))))
    return checked(scalar(value).xreplace(dict(pairs)))


def pairs_of(given: Sequence[Value]) -> dict[Any, Any]:
    """What .subs(…) is given: x, y; {x: y}; [(x, y), …]; [x, …], [y, …]."""
    if len(given) == 2:
        old, new = given
        if isinstance(old, (list, tuple, MatrixBase)):
            return dict(zip(listed(old), map(scalar, listed(new)), strict=False))
        return {old: scalar(new)}
    if len(given) == 1 and isinstance(given[0], dict):
        return {a: scalar(b) for a, b in given[0].items()}
    if len(given) == 1 and isinstance(given[0], (list, tuple)):
        return {a: scalar(b) for a, b in (listed(x) for x in given[0])}
    raise AbandonedError


def _alone_or_column(found: list[sp.Expr]) -> Value:
    return found[0] if len(found) == 1 else sp.Matrix(found)


def dot(a: Value, b: Value) -> sp.Expr:
    """The scalar product."""
    x, y = listed(matrix(a)), listed(matrix(b))
    if len(x) != len(y):
        raise AbandonedError
    return checked(sp.Add(*[p * q for p, q in zip(x, y, strict=True)]))


def cross(a: Value, b: Value) -> MatrixBase:
    """The vector product in space."""
    x, y = matrix(a), matrix(b)
    if len(x) != 3 or len(y) != 3:
        raise AbandonedError
    return checked(sp.Matrix(listed(x)).cross(sp.Matrix(listed(y))))


def filled(name: str, given: Sequence[Value], *, matlab: bool) -> MatrixBase:
    """Zeros, ones and the unit matrix."""
    sizes = [
        number(x) for x in (listed(given[0]) if len(given) == 1 and isinstance(given[0], (list, tuple)) else given)
    ]
    rows, columns = (sizes[0], sizes[1]) if len(sizes) > 1 else (sizes[0], sizes[0] if matlab or name == "eye" else 1)
    if not (0 < rows <= 8 and 0 < columns <= 8):
        raise AbandonedError
    made = sp.eye(rows, columns) if name in ("eye", "identity") else sp.zeros(rows, columns)
    return made.applyfunc(lambda _: sp.S.One) if name == "ones" else made


def applied(of: Value, given: Sequence[Value]) -> Value:
    """A function of time: f(t)."""
    if isinstance(of, UndefinedFunction) and list(given) in ([], [TIME]):
        return of(TIME)
    if isinstance(of, AppliedUndef) and list(given) in ([], [TIME]):
        return of
    if isinstance(of, (sp.Derivative, sp.Symbol)) and list(given) == [TIME]:
        return of
    raise AbandonedError


def stacked(given: Sequence[Value]) -> MatrixBase:
    """Columns below each other: vstack, hstack of flat arrays, concatenate."""
    parts = listed(given[0]) if len(given) == 1 else list(given)
    rows = [x for part in parts for x in (listed(part) if isinstance(part, (list, tuple, MatrixBase)) else [part])]
    return matrix(rows)


def _matrix_or_equations(value: Value) -> Value:
    """A matrix, or the equations that stand in its place: [eq1, eq2]."""
    parts = [y for x in listed(value) for y in (listed(x) if isinstance(x, (list, tuple)) else [x])]
    return parts if parts and all(isinstance(x, Equation) for x in parts) else matrix(value)


def integrated(value: sp.Expr, over_: Sequence[Value]) -> Value:
    """The integral of a polynomial along a body: integrate(f, (u, 0, l)) in SymPy, int(f, u, 0, l) in MATLAB."""
    x, low, high = listed(over_[0]) if isinstance(over_[0], (list, tuple)) and len(over_) == 1 else over_
    if not isinstance(x, sp.Symbol):
        raise AbandonedError
    rest, factors = bounded.expand(value), list[sp.Expr]()
    for k in range(HIGHEST):
        factors.append(rest.xreplace({x: sp.S.Zero}) / sp.factorial(k))
        rest = slope(rest, x)
        if not rest.has(x):
            break
    else:
        raise AbandonedError  # no polynomial of low degree
    factors.append(rest / sp.factorial(len(factors)))
    ends = (scalar(high), scalar(low))
    parts = [c * (ends[0] ** (k + 1) - ends[1] ** (k + 1)) / (k + 1) for k, c in enumerate(factors)]
    return checked(sp.Add(*parts))


def routine(name: str, given: Sequence[Value], options: Mapping[str, Value], *, matlab: bool = False) -> Value:
    """The value of a function of a library; `AbandonedError` if it is none of these."""
    if name in PLAIN:
        value = given[0]
        make = PLAIN[name]
        return checked(value.applyfunc(make) if isinstance(value, MatrixBase) else make(scalar(value)))
    if name in ("array", "asarray") and isinstance(given[0], list) and given[0] and all(map(is_scalar, given[0])):
        return matrix(given[0])  # whose sums are no longer lists
    if name in ("list", "tuple") and given and isinstance(given[0], (list, tuple, MatrixBase)):
        return listed(given[0])
    if name in ("copy", "deepcopy") and given and isinstance(given[0], (list, dict, MatrixBase)):
        return given[0].copy()
    if name in SAME:
        return given[0] if given else UNKNOWN
    if name in ("symbols", "Symbol", "sym", "var"):
        return symbols(given[0], options)
    if name == "Function":
        return sp.Function(names_in(given[0])[0])
    if name == "dynamicsymbols":
        return dynamic(given[0], number(given[1]) if len(given) > 1 else number(options.get("level", 0)))
    if name in ("diff", "Derivative", "Diff"):
        return differentiated(given[0], given[1:])
    if name in ("integrate", "int") and len(given) > 1:
        return integrated(scalar(given[0]), given[1:])
    table: dict[str, Callable[[], Value]] = {
        "Rational": lambda: scalar(given[0]) / (scalar(given[1]) if len(given) > 1 else 1),
        "Matrix": lambda: _matrix_or_equations(given[0] if len(given) == 1 else list(given)),
        "Eq": lambda: Equation(scalar(given[0]), scalar(given[1])),
        "jacobian": lambda: jacobian(given[0], given[1]),
        "hessian": lambda: jacobian(jacobian(given[0], given[1]), given[1]),
        "gradient": lambda: gradient(given[0], given[1]),
        "functionalDerivative": lambda: _alone_or_column(euler_lagrange(given[0], given[1])),
        "euler_equations": lambda: [Equation(x, sp.S.Zero) for x in euler_lagrange(given[0], given[1])],
        "derive_by_array": lambda: listed(jacobian(scalar(given[0]), given[1])),
        "subs": lambda: replaced(given[0], pairs_of(given[1:])),
        "dot": lambda: dot(given[0], given[1]) if 1 in matrix(given[0]).shape else times(given[0], given[1]),
        "hypot": lambda: sp.sqrt(scalar(given[0]) ** 2 + scalar(given[1]) ** 2),
        "blkdiag": lambda: checked(sp.diag(*(scalar(x) if is_scalar(x) else matrix(x) for x in given))),
        "struct": lambda: dict(zip(given[::2], given[1::2], strict=False)),
        "cross": lambda: cross(given[0], given[1]),
        "diag": lambda: sp.diag(*map(scalar, listed(given[0]) if len(given) == 1 else given)),
        "transpose": lambda: matrix(given[0]).T,
        "inv": lambda: Inverse(matrix(given[0])),
        "norm": lambda: sp.sqrt(dot(given[0], given[0])),
        "sum": lambda: checked(sp.Add(*map(scalar, listed(given[0])))),
        "power": lambda: power(given[0], given[1]),
        "atan2": lambda: sp.atan2(scalar(given[0]), scalar(given[1])),
        "deal": lambda: list(given),
        "len": lambda: sp.Integer(len(listed(given[0]))),
    }
    table |= {alias: table[same] for alias, same in _ALIASES.items()}
    if name in ("concatenate", "hstack", "vstack"):
        return stacked(given)
    if name in ("zeros", "ones", "eye", "identity", "zeros_like", "empty"):
        return filled(name, given, matlab=matlab)
    if name not in table:
        return UNKNOWN
    return table[name]()
