"""Lines about positions alone: θ = 0, a position at rest such as cos θ = g/(R Ω²), and approximations, sin θ = θ."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Sequence
from functools import lru_cache
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.at_rest import DIGITS, at_rest, balances, letters_of_inputs, numbers_for, still_of
from lagrangian.check.of_one_variable import digits, number, value_and_slope
from lagrangian.check.reference import Reference
from lagrangian.model import time
from lagrangian.read.letters import key

HIGHEST = 4
"""The highest degree of an approximation: cos θ = 1 − θ²/2 + θ⁴/24."""

LONG = 300
"""The size of a line above which it is no position."""

STEPS = 40
"""The most steps of Newton's method to a position."""

FARTHEST = 50
"""Beyond this value no position is sought."""

ENDS_IN_ZERO = re.compile(r"=[ \t]*0[ \t.$;,]*\Z")
"""How a line ends whose last side is 0."""
AT_REST = "it is about the position at rest"
_ANGLE = re.compile(r"(?:sin|cos|tan|cot)[ \t]*[({\\]?[({\\]?[ ]?([^\W\d_]\w{0,15})")
"""The first name in the argument of a function."""
_TINY = 10.0 ** (10 - DIGITS)
_CLOSE = 10.0 ** (5 - DIGITS)
STARTS = (sp.Rational(3, 5), sp.Rational(-7, 4) + sp.I / 3, sp.Rational(13, 5) + sp.I / 5)


def only_places(truth: Reference, expr: sp.Expr) -> set[AppliedUndef]:
    """The coordinates of an expression that holds no rate and no other name that moves; nothing otherwise."""
    if expr.has(sp.Derivative):
        return set()
    changing = {x for x in bounded.atoms(expr, AppliedUndef) if x.args}
    return changing if changing <= {c.symbol for c in truth.model.coordinates} else set()


def place_or_approximation(
    truth: Reference, expr: sp.Expr, written: str, given: Sequence[sp.Expr] = (), *, said: bool = False
) -> str | None:
    """Why a line, as it is ``written``, with its difference ``expr``, is not about every motion; None if it is.

    A position may be any, θ = 0, if a real one exists (not cos θ = 7), or one at rest: then a row at rest vanishes
    where the line holds, with the values that are ``given`` beside it; ``said``: words say that it is about rest. An
    approximation holds to a higher order than its degree.
    """
    if "=" in written and gives_input(truth, expr):
        return "it is about one value of an input"
    if "=" in written and _is_small(truth, expr):
        return "it is about small motions"
    if "=" not in written or bounded.hard([expr], LONG):
        return None
    if (said or _gives_input(truth, written)) and balances(truth, expr):
        return AT_REST
    if (holds := rests(truth, expr, given, said=said)) is not None:
        return AT_REST if holds else None
    if said and rests_without_rates(truth, expr, given):
        return AT_REST
    changing = only_places(truth, expr)
    if not changing:
        return None
    if _approximates(expr, changing):
        return "it is about small motions"
    if said and any(_is_at_rest(truth, expr, q, changing - {q}) for q in changing):
        return AT_REST
    if len(changing) > 1:
        return None
    (place,) = changing
    chosen = _is_chosen(expr, place) and not _is_of_two_angles(written)
    return "it is about one position" if chosen or _is_at_rest(truth, expr, place) else None


def _is_of_two_angles(written: str) -> bool:
    """Whether a line equates functions of two angles, of which one is then counted from the other: cos θ = -sin γ."""
    sides = [{*map(key, _ANGLE.findall(side))} for side in written.split("=")]
    return len(sides) > 1 and all(sides) and sides[0].isdisjoint(*sides[1:])


def is_rate(truth: Reference, expr: sp.Expr) -> bool:
    """Whether a line only gives the rate of a coordinate a constant value: θ′ = 0, φ′ = Ω."""
    rates = expr.atoms(sp.Derivative)
    if len(rates) != 1 or not rates <= {c.rate for c in truth.model.coordinates}:
        return False
    (rate,) = rates
    rest = bounded.expand(expr - expr.diff(rate) * rate)
    return bool(expr.diff(rate).is_number) and (rest.is_number or (-rest).is_Symbol or rest.is_Symbol)


def stands_still(truth: Reference, expr: sp.Expr, written: str) -> bool:
    """Whether a line only says that several rates and accelerations are all 0: θ″ = θ′ = 0."""
    rates = {x for c in truth.model.coordinates for x in (c.rate, c.acceleration)}
    held = expr.atoms(sp.Derivative)
    factors = [bounded.diff(expr, x) for x in held]
    alone = all(x.is_number for x in factors) and expr.xreplace(dict.fromkeys(held, sp.S.Zero)) == 0
    return len(held) > 1 and held <= rates and alone and ENDS_IN_ZERO.search(written) is not None


def gives_one_value(truth: Reference, expr: sp.Expr, written: str) -> str | None:
    """What a line only gives a number: a "time", t = 1 s, a "value of a constant", a "motion", θ″ = 0; else None."""
    accelerations = {c.acceleration for c in truth.model.coordinates}
    moving = expr.atoms(sp.Derivative, AppliedUndef)
    found = expr.atoms(sp.Derivative) if moving else bounded.letters(expr)
    if "=" not in written or len(found) != 1:
        return None
    (given,) = found
    slope = expr.diff(given)
    if not slope.is_number or not bounded.expand(expr - slope * given).is_number:
        return None
    if moving:
        return "motion" if given in accelerations else None
    return (
        "time"
        if given == time
        else "value of a constant"
        if given in {p.symbol for p in truth.model.parameters}
        else None
    )


def relates_freedoms(truth: Reference, expr: sp.Expr) -> bool:
    """Whether a line only says that coordinates, or rates, which are independent, are proportional to each other by
    lengths and numbers: y = R φ, θ′ = −x′/R. No stiffness is in it, nor a mass: k1 x = k2 z is meant at rest."""
    model = truth.model
    if truth.derivation.multipliers or bounded.hard([expr], LONG):
        return False
    letters = {x for x in expr.free_symbols if isinstance(x, sp.Symbol)} - {time}
    if any(_is_amount(truth, x) for x in letters):
        return False
    for kind in ([c.rate for c in model.coordinates], [c.symbol for c in model.coordinates]):
        slopes = {q: bounded.diff(expr, q) for q in kind if expr.has(q)}
        if not slopes:
            continue
        rest = bounded.expand(expr - sp.Add(*(slope * q for q, slope in slopes.items())))
        moves = any(slope.atoms(AppliedUndef, sp.Derivative) for slope in slopes.values())
        return len(slopes) > 1 and rest == 0 and not moves
    return False


def _is_amount(truth: Reference, letter: sp.Symbol) -> bool:
    """Whether a letter may be no length: all equations are linear in it, as in masses and stiffnesses."""
    return not any(bounded.diff(row, letter).has(letter) for row in truth.rows)


def rests(truth: Reference, expr: sp.Expr, given: Sequence[sp.Expr] = (), *, said: bool = False) -> bool | None:
    """Whether a line about positions at rest is right, s = m g/k; None if it need not be about these, or is not clear.

    It is where it is ``said``, except for θ = 0, and where coordinates get a value that is not 0: that may be any
    position, x = L/2, unless it is a product of letters; k x = F may be meant as an equation of motion.
    """
    if expr.has(sp.Derivative) or (not expr.atoms(AppliedUndef) and len(expr.free_symbols) == 1):
        return None  # a rate, or a case of a constant: for β = 0
    coordinates = [c.symbol for c in truth.model.coordinates]
    slopes = [expr.diff(q) for q in coordinates]
    value = bounded.expand(cast("sp.Expr", expr.xreplace(dict.fromkeys(coordinates, sp.S.Zero))))
    terms = (x.free_symbols - {time} | x.atoms(AppliedUndef) for x in sp.Add.make_args(value))
    formula = any(len(x) > 1 for x in terms)
    moving = [x for x in slopes if x != 0]
    claims = said and (value != 0 or len(moving) > 1)
    valued = value != 0 and bool(moving) and (all(x.is_number for x in slopes) or not value.atoms(AppliedUndef))
    if not claims and not valued:
        return None
    holds = at_rest(truth, expr, given)
    return holds if holds or claims or formula else None


def rests_without_rates(truth: Reference, expr: sp.Expr, given: Sequence[sp.Expr]) -> bool:
    """Whether a line that is said to be about rest holds there: S = m g, where S was k δ + b δ′ above."""
    if any(x.derivative_count > 1 for x in expr.atoms(sp.Derivative)):
        return False
    still = cast("sp.Expr", expr.xreplace(still_of(truth)))
    return still not in (expr, 0) and (balances(truth, still) or rests(truth, still, given, said=True) is True)


def _gives_input(truth: Reference, written: str) -> bool:
    """Whether an input alone stands on the left: F = m g sin α."""
    left = key(re.sub(r"[\s\\${}&]", "", written.partition("=")[0]))
    return any(left == key(u.name) for u in truth.model.inputs)


def gives_input(truth: Reference, expr: sp.Expr) -> bool:
    """Whether a line only gives an input a value: F = 0."""
    changing = {x for x in bounded.atoms(expr, AppliedUndef) if x.args}
    if len(changing) != 1 or not changing <= {u.symbol for u in truth.model.inputs} or expr.has(sp.Derivative):
        return False
    (given,) = changing
    return bool(expr.diff(given).is_number)


def _is_chosen(expr: sp.Expr, place: AppliedUndef) -> bool:
    """Whether a coordinate has a value, or its sine or cosine one that exists; no letter multiplies it: not k x = 0."""
    slope = expr.diff(place)
    if not slope.free_symbols <= place.free_symbols:
        return False
    if not slope.has(place):
        return slope != 0
    functions = [f for f in _functions(expr, [place]) if isinstance(f, (sp.sin, sp.cos))]
    if len(functions) != 1:
        return False
    (f,) = functions
    size = cast("sp.Expr", sp.cancel(slope / f.diff(place)))
    rest = bounded.expand(expr - size * f)
    return bool(size.is_number and size != 0 and rest.is_number and abs(sp.N(rest / size)) <= 1)


def _approximates(expr: sp.Expr, changing: Iterable[AppliedUndef]) -> bool:
    """Whether a line with functions holds for small values to a higher order than the degree of its powers."""
    symbols = list(changing)
    terms = [cast("sp.Expr", x) for x in sp.Add.make_args(bounded.expand(expr))]
    powers = [x for x in terms if not _functions(x, symbols)]
    if not _functions(expr, symbols):
        return len(powers) == 1 and powers[0].is_number is False and 1 < _degree(powers, symbols) <= HIGHEST
    degree = max(1, _degree(powers, symbols))
    if degree > HIGHEST:
        return False
    size = sp.Dummy()
    about = _middle(expr, symbols)
    changed = cast("sp.Expr", expr.xreplace({q: about.get(q, sp.S.Zero) + size * q for q in symbols}))
    for _ in range(degree + 1):
        if bounded.expand(cast("sp.Expr", changed.xreplace({size: sp.S.Zero}))) != 0:
            return False
        changed = changed.diff(size)
    return True


@lru_cache(maxsize=32)
def prescribed_angles(truth: Reference) -> frozenset[Any]:
    """The sines and cosines of prescribed angles that swing: sin(A sin Ωt)."""
    found = {cast("Any", f) for row in truth.rows for f in row.atoms(sp.sin, sp.cos)}
    return frozenset(f for f in found if not f.atoms(AppliedUndef) and f.has(time) and f.args[0].atoms(sp.sin, sp.cos))


@lru_cache(maxsize=32)
def amplitudes(truth: Reference) -> frozenset[sp.Symbol]:
    """The parameters to which prescribed angles are proportional, outside the functions in these: A of A sin Ωt."""
    sizes: set[sp.Symbol] = set()
    for angle in {cast("sp.Expr", f.args[0]) for f in prescribed_angles(truth)}:
        bare = angle.xreplace({f: sp.Dummy() for f in angle.atoms(sp.sin, sp.cos)})
        found = {p.symbol for p in truth.model.parameters} & bare.free_symbols
        whole = sp.Add(*[x * angle.diff(x) for x in found])
        sizes |= found if bounded.expand(angle - whole) == 0 else set()
    return frozenset(sizes)


def _is_small(truth: Reference, expr: sp.Expr) -> bool:
    """Whether what a line says of a prescribed angle holds to first order in its amplitude: sin α = α, α′² = 0."""
    if not (sizes := amplitudes(truth)) or not expr.has(*sizes) or not expr.has(time) or expr.has(sp.Derivative):
        return False
    bare = expr.xreplace({f: sp.Dummy() for f in expr.atoms(sp.sin, sp.cos) if not f.has(*sizes)})
    if bounded.hard([bare], LONG):
        return False
    size = sp.Dummy()
    scaled = cast("sp.Expr", bare.xreplace({x: size * x for x in sizes}))
    orders = (cast("sp.Expr", x.xreplace({size: sp.S.Zero})) for x in (scaled, bounded.diff(scaled, size)))
    return all(bounded.expand(x) == 0 for x in orders)


def _functions(expr: sp.Expr, symbols: Iterable[AppliedUndef]) -> list[Any]:
    """The sines, cosines and other functions of coordinates in an expression."""
    return [f for f in expr.atoms(sp.Function) if not isinstance(f, AppliedUndef) and f.has(*symbols)]


def _degree(terms: Iterable[sp.Expr], symbols: list[AppliedUndef]) -> int:
    """The highest degree of the terms in the coordinates; beyond all approximations for what is no polynomial."""
    try:
        return max((sp.Poly(x, *symbols).total_degree() for x in terms), default=0)
    except sp.PolynomialError:
        return HIGHEST + 1


def _middle(expr: sp.Expr, symbols: list[AppliedUndef]) -> dict[sp.Basic, sp.Expr]:
    """About which value a single coordinate is small: sin(θ − β) = θ − β."""
    if len(symbols) != 1:
        return {}
    (q,) = symbols
    inside = cast("sp.Expr", _functions(expr, symbols)[0].args[0])
    slope = inside.diff(q)
    if slope.has(q) or slope == 0:
        return {}
    rest = cast("sp.Expr", inside.xreplace({q: sp.S.Zero}))
    return {q: cast("sp.Expr", sp.cancel(-rest / slope))}


def _is_at_rest(
    truth: Reference, expr: sp.Expr, place: AppliedUndef, others: Collection[AppliedUndef] | None = None
) -> bool:
    """Whether a row of the system at rest, with constant inputs, vanishes wherever the line holds.

    Where words say that it is at rest, it holds at any values of the ``others``, and inputs that it lacks are 0.
    """
    if others is None and not expr.diff(place).has(place):
        return False  # k x = 0 may be meant as an equation of motion
    if not all(isinstance(f, (sp.sin, sp.cos, sp.tan)) for f in _functions(expr, [place])):
        return False
    still = still_of(truth) | letters_of_inputs(truth) | {q: sp.Dummy(str(q.func)) for q in others or ()}
    if others is not None:
        still |= {u.symbol: sp.S.Zero for u in truth.model.inputs if not expr.has(u.symbol)}
    rows = [cast("sp.Expr", row.xreplace(still)) for row in truth.rows]
    rows = [row for row in rows if row.atoms(AppliedUndef) == {place}]
    own = cast("sp.Expr", expr.xreplace(still))
    rows = [row for row in rows if not _moves_by_itself(row, place)]
    if _moves_by_itself(own, place):
        return False
    names = sorted(own.free_symbols.union(*(row.free_symbols for row in rows)) - place.free_symbols, key=str)
    table = numbers_for(names)
    f, *balance = (cast("sp.Expr", x.xreplace(table)) for x in (own, *rows))
    with digits(DIGITS):
        if any(_proportional(f, row, place) for row in balance):
            return True
        found = [root for start in STARTS if (root := _root(f, place, start)) is not None]
        elsewhere = any(abs(root) > _TINY for root in found)
        return elsewhere and any(all(_vanishes(row, place, root) for root in found) for row in balance)


def _moves_by_itself(expr: sp.Expr, place: AppliedUndef) -> bool:
    """Whether an expression holds time beside a coordinate: a prescribed motion is never at rest."""
    return expr.xreplace({place: sp.Dummy()}).has(time)


def _proportional(f: sp.Expr, row: sp.Expr, place: AppliedUndef) -> bool:
    """Whether two expressions of numbers have the same ratio at several places."""
    found = [[value_and_slope(x, place, number(at)) for x in (f, row)] for at in STARTS]
    ratios = [(a[0], b[0]) for a, b in found if a is not None and b is not None]
    if len(ratios) < len(STARTS):
        return False
    (a, b), *others = ratios
    return all(abs(a * d - b * c) <= _TINY * (abs(a * d) + abs(b * c)) for c, d in others)


def _root(f: sp.Expr, place: AppliedUndef, start: sp.Expr) -> Any | None:
    """A place where an expression of numbers is 0, perhaps a complex one, by Newton's method; None if none is found."""
    at = number(start)
    for _ in range(STEPS):
        found = value_and_slope(f, place, at)
        if found is None or found[1] == 0:
            return None
        step = found[0] / found[1]
        at = at - step
        if abs(at) > FARTHEST:
            return None
        if abs(step) < _CLOSE:
            return at
    return None


def _vanishes(row: sp.Expr, place: AppliedUndef, root: Any) -> bool:
    """Whether a row is 0 at a place, compared with the largest of its terms."""
    found = [value_and_slope(x, place, root) for x in sp.Add.make_args(row)]
    terms = [x[0] for x in found if x is not None]
    return len(terms) == len(found) and bool(abs(sum(terms)) <= _TINY * max(abs(x) for x in terms))
