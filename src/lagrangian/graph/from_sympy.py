"""Converts SymPy expressions to graph nodes, without recursion and without executing text.

Every subexpression is converted once. The keys of ``symbols`` (symbols, functions of time, their derivatives) are
looked up as a whole. A sum is added term by term; a product becomes one quotient, with the factors of negative exponent
in the denominator.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false

from __future__ import annotations

from collections.abc import Callable, Mapping, MutableMapping
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.functions.elementary.piecewise import ExprCondPair
from sympy.logic.boolalg import ITE, BooleanFalse, BooleanTrue

from lagrangian.errors import ModelError, did_you_mean
from lagrangian.graph.graph import Graph

Make = Callable[..., int]

UNARY: dict[type, str] = {
    sp.sin: "sin",
    sp.cos: "cos",
    sp.tan: "tan",
    sp.asin: "asin",
    sp.acos: "acos",
    sp.atan: "atan",
    sp.sinh: "sinh",
    sp.cosh: "cosh",
    sp.tanh: "tanh",
    sp.asinh: "asinh",
    sp.acosh: "acosh",
    sp.atanh: "atanh",
    sp.exp: "exp",
    sp.Abs: "abs",
    sp.sign: "sign",
}
RECIPROCAL: dict[type, str] = {
    sp.sec: "cos",
    sp.csc: "sin",
    sp.cot: "tan",
    sp.sech: "cosh",
    sp.csch: "sinh",
    sp.coth: "tanh",
}

OTHERS: tuple[type, ...] = (
    sp.Add,
    sp.Mul,
    sp.Pow,
    sp.log,
    sp.atan2,
    sp.Min,
    sp.Max,
    sp.Heaviside,
    sp.Piecewise,
    ExprCondPair,
    sp.core.relational.Relational,
    sp.And,
    sp.Or,
    sp.Not,
    ITE,
)
LEAVES: tuple[type, ...] = (
    sp.Symbol,
    sp.Rational,
    sp.Float,
    sp.NumberSymbol,
    BooleanTrue,
    BooleanFalse,
    AppliedUndef,
    sp.Derivative,
)


def unknown_part(expr: sp.Basic) -> sp.Basic | None:
    """The first subexpression that a graph cannot represent (a sum over an index, an integral, a matrix, …), or
    None."""
    stack, seen = [expr], {expr}
    while stack:
        e = stack.pop()
        if isinstance(e, LEAVES):
            continue
        if not (isinstance(e, OTHERS) or type(e) in UNARY or type(e) in RECIPROCAL):
            return e
        fresh = [a for a in e.args if a not in seen]
        seen.update(fresh)
        stack += fresh
    return None


def from_sympy(
    graph: Graph,
    expr: sp.Basic,
    symbols: Mapping[Any, int],
    memo: MutableMapping[Any, int] | None = None,
) -> int:
    """The node that computes ``expr``; ``symbols`` gives the node of every symbol.

    ``memo`` stores what was converted, for further calls with the same graph and symbols. Raises `ModelError` that
    names an unknown symbol or function.
    """
    done: MutableMapping[Any, int] = {} if memo is None else memo
    stack: list[tuple[sp.Basic, bool]] = [(sp.sympify(expr, strict=True), False)]
    while stack:
        e, ready = stack.pop()
        if e in done:
            continue
        if ready:
            done[e] = _operation(graph, e, done)
        elif e in symbols:
            done[e] = symbols[e]
        elif not e.args or isinstance(e, (AppliedUndef, sp.Derivative)):
            done[e] = _leaf(graph, e, symbols)
        elif waiting := [(p, False) for p in _parts(e) if p not in done]:
            stack.append((e, True))
            stack.extend(waiting)
        else:
            done[e] = _operation(graph, e, done)
    return done[expr]


def _parts(e: sp.Basic) -> list[sp.Basic]:
    """The subexpressions from whose nodes the node of ``e`` is made."""
    if isinstance(e, sp.Pow):
        return [e.base] if e.exp.is_Rational else [e.base, e.exp]
    if isinstance(e, sp.Mul):
        return [_base(f) if _whole_below(f) else f for f in e.args]
    if isinstance(e, sp.Piecewise):
        return [p for pair in e.args for p in pair.args]
    return list(e.args)


def _base(f: Any) -> sp.Basic:
    return f.base


def _whole_below(f: Any) -> bool:
    """Whether a factor belongs in the denominator: a negative rational power."""
    return isinstance(f, sp.Pow) and bool(f.exp.is_Rational) and bool(f.exp.is_negative)


def _leaf(graph: Graph, e: sp.Basic, symbols: Mapping[Any, int]) -> int:
    if isinstance(e, sp.Rational):
        try:
            return graph.const(int(e.p) / int(e.q))
        except OverflowError:
            raise ModelError(
                "a number in an expression is larger than the largest floating-point number, 1.8e308", code="E101"
            ) from None
    if isinstance(e, (sp.Float, sp.NumberSymbol)):
        return graph.const(float(e))
    if isinstance(e, (BooleanTrue, BooleanFalse)):
        return graph.one if isinstance(e, BooleanTrue) else graph.zero
    if e in (sp.oo, -sp.oo, sp.nan, sp.zoo, sp.I):
        raise ModelError(f"an expression contains {e}", fix="expressions must be real and finite", code="E101")
    name = str(e)
    kind = "derivative" if isinstance(e, sp.Derivative) else "symbol"
    raise ModelError(
        f"{kind} '{name}' has no value here", fix=did_you_mean(name, [str(s) for s in symbols]), code="E402"
    )


def _operation(graph: Graph, e: Any, done: Mapping[Any, int]) -> int:
    """The node of ``e``, after its parts were converted."""
    if isinstance(e, sp.Add):
        return _sum(graph, [done[a] for a in e.args])
    if isinstance(e, sp.Mul):
        return _product(graph, e, done)
    if isinstance(e, sp.Pow):
        if e.exp.is_Rational:
            return _power(graph, done[e.base], e.exp)
        return graph.pow(done[e.base], done[e.exp])
    a = [done[x] for x in e.args if not isinstance(x, ExprCondPair)]
    if type(e) in UNARY:
        return getattr(graph, UNARY[type(e)])(a[0])
    if type(e) in RECIPROCAL:
        return graph.div(graph.one, getattr(graph, RECIPROCAL[type(e)])(a[0]))
    if isinstance(e, sp.log):
        return graph.log(a[0]) if len(a) == 1 else graph.div(graph.log(a[0]), graph.log(a[1]))
    if isinstance(e, sp.atan2):
        return graph.atan2(a[0], a[1])
    if isinstance(e, (sp.Min, sp.Max)):
        ordered = [done[x] for x in sorted(e.args, key=sp.default_sort_key)]  # SymPy's order may change from run to run
        return _chain(graph.min if isinstance(e, sp.Min) else graph.max, ordered)
    if isinstance(e, sp.Heaviside):  # 0 below, 1 above, and at 0 the value of its second argument
        return graph.select(
            graph.lt(a[0], graph.zero), graph.zero, graph.select(graph.lt(graph.zero, a[0]), graph.one, a[1])
        )
    if isinstance(e, sp.Piecewise):
        return _piecewise(graph, e, done)
    return _condition(graph, e, a)


def _sum(graph: Graph, terms: list[int]) -> int:
    """The terms added one after another, oldest first, those with a minus sign last, so that they are subtracted.

    In this order θ₁, θ₁ + θ₂, θ₁ + θ₂ + θ₃, … share their beginnings, so a chain of relative angles has linear size.
    """
    plus = sorted(t for t in terms if graph.nodes[t][0] != "neg")
    minus = sorted(t for t in terms if graph.nodes[t][0] == "neg")
    return _chain(graph.add, [*plus, *minus])


def _chain(make: Make, items: list[int]) -> int:
    total = items[0]
    for item in items[1:]:
        total = make(total, item)
    return total


def _product(graph: Graph, e: sp.Mul, done: Mapping[Any, int]) -> int:
    """c · Π numerator / Π denominator, with the number c = p/q last: p/(q …) only if q alone is a multiplication."""
    above = graph.one
    below = graph.one
    coefficient = graph.one
    for f in e.args:
        if f.is_Number:
            coefficient = done[f]
        elif _whole_below(f):
            below = graph.mul(below, _power(graph, done[f.base], -f.exp))  # type: ignore[attr-defined]
        else:
            above = graph.mul(above, done[f])
    return graph.div(graph.mul(coefficient, above), below)


def _power(graph: Graph, base: int, exponent: Any) -> int:
    """base^(p/q): whole powers as products, half powers with a square root."""
    p, q = int(exponent.p), int(exponent.q)
    if q == 1:
        return graph.powi(base, p)
    if q == 2:
        root = graph.sqrt(base)
        if abs(p) == 1:
            return graph.powi(root, p)
        whole = graph.mul(graph.powi(base, abs(p) // 2), root)  # x^(n + ½) = xⁿ √x
        return whole if p > 0 else graph.div(graph.one, whole)
    return graph.pow(base, graph.const(p / q))


def _piecewise(graph: Graph, e: sp.Piecewise, done: Mapping[Any, int]) -> int:
    pairs: list[tuple[int, int]] = [(done[p.args[0]], done[p.args[1]]) for p in e.args]
    if pairs[-1][1] != graph.one:
        raise ModelError(
            f"the piecewise expression {e} has no value where none of its conditions holds",
            fix="end it with a case (…, True)",
            code="E416",
        )
    value = pairs[-1][0]
    for branch, condition in reversed(pairs[:-1]):
        value = graph.select(condition, branch, value)
    return value


def _condition(graph: Graph, e: Any, a: list[int]) -> int:
    """Comparisons and their logical combinations."""
    if isinstance(e, sp.StrictLessThan):
        return graph.lt(a[0], a[1])
    if isinstance(e, sp.LessThan):
        return graph.le(a[0], a[1])
    if isinstance(e, sp.StrictGreaterThan):
        return graph.lt(a[1], a[0])
    if isinstance(e, sp.GreaterThan):
        return graph.le(a[1], a[0])
    if isinstance(e, sp.Equality):
        return graph.eq(a[0], a[1])
    if isinstance(e, sp.Unequality):
        return graph.not_(graph.eq(a[0], a[1]))
    if isinstance(e, sp.And):
        return _chain(graph.and_, a)
    if isinstance(e, sp.Or):
        return _chain(graph.or_, a)
    if isinstance(e, sp.Not):
        return graph.not_(a[0])
    if isinstance(e, ITE):
        return graph.or_(graph.and_(a[0], a[1]), graph.and_(graph.not_(a[0]), a[2]))
    known = [c.__name__ for c in (*UNARY, *RECIPROCAL)]
    name = e.func.__name__
    if name == "DiracDelta":
        raise ModelError(
            f"an energy or a position contains sign({str(e.args[0])[:60]}), which jumps: its derivative is an impulse",
            fix="write abs(x) for x*sign(x); what is differentiated must be continuous",
            code="E525",
        )
    raise ModelError(
        f"function '{name}' is not supported",
        fix=did_you_mean(name, known) or "write it with sin, cos, exp, log, sqrt, Abs, Piecewise and the like",
        code="E402",
    )
