"""SymPy's general routines within bounds: sizes are predicted before anything is expanded, and searches are counted.

Expanded, an expression may be exponentially longer than it was when written: (a + b + c)^50, sixty definitions that
each use another twice, a chain of frames in space. So the size of a result is predicted from the structure of an
expression. Beyond `MAX_OPERATIONS` the expression is left as it is (`expand`) or refused (`diff`, `written_out`). The
cost of a search for a closed form or a common factor cannot be predicted: `searched` counts the calls that it makes and
gives up after `CALLS`. Both count operations, so the answer does not depend on how fast or how busy a machine is.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping
from inspect import CO_GENERATOR
from math import comb
from typing import Any, TypeVar, cast

import sympy as sp
from sympy.core.cache import clear_cache
from sympy.core.function import AppliedUndef

from lagrangian.errors import ModelError

T = TypeVar("T")

MAX_OPERATIONS = 20_000
"""The largest number of operations of an expanded expression."""

SLOPES = 1_000_000
"""The largest number of operations that the product rule may make, most of which are zero."""

TERMS = 3_000
"""The largest number of terms of an expansion."""

CALLS = 300_000
"""The number of calls after which a search of SymPy is abandoned; textbook examples need less than a tenth."""

INSIDE = 50
"""If an absolute value or a sign has more operations, SymPy is not asked whether its argument is real."""

PROOFS = 10_000
"""The number of calls after which the sign of an argument is left undecided; x² + 1 takes a hundredth of it."""

HIGH = 8
"""A higher power of a sum is not multiplied out in a search for a common factor."""

BEYOND = 10**30
"""Where predictions stop counting: far above every limit."""


class TooLarge(ModelError):
    """An expression would be too long when expanded."""


class Budget:
    """A number of operations that may still be made; it is a count, so that results do not depend on the machine."""

    def __init__(self, limit: int, error: Callable[[int], BaseException]) -> None:
        self.limit = self.left = limit
        self._error = error

    def spend(self, operations: int) -> None:
        """Subtract operations; raise an error if none are left."""
        self.left -= operations
        if self.left < 0:
            raise self._error(self.limit)


# -- sizes --------------------------------------------------------------------------------------------------------


def _each(expr: sp.Basic) -> Iterator[sp.Basic]:
    """Yield every part of an expression once, its own parts before it; shared parts are visited once."""
    done: set[int] = set()
    stack: list[tuple[sp.Basic, bool]] = [(expr, False)]
    while stack:
        node, ready = stack.pop()
        if id(node) in done:
            continue
        if ready or not node.args or isinstance(node, (AppliedUndef, sp.Derivative)):
            done.add(id(node))
            yield node
        else:
            stack.append((node, True))
            stack += [(a, False) for a in node.args]


def size(expr: sp.Basic, names: Mapping[Any, int] | None = None) -> int:
    """Return how many operands and operations an expression has when written out.

    A shared part counts as often as it occurs. ``names`` maps symbols to the size of what they stand for.
    """
    found: dict[int, int] = {}
    for node in _each(expr):
        if names and node in names:
            found[id(node)] = names[node]
        elif isinstance(node, sp.Derivative):
            own = names.get(node.expr, 1) if names else 1
            found[id(node)] = own if own == 1 else min(own * (own + 1), BEYOND)  # the product rule: one term per factor
        elif not node.args or isinstance(node, AppliedUndef):
            found[id(node)] = 1
        else:
            found[id(node)] = min(1 + sum(found[id(a)] for a in node.args), BEYOND)
    return found[id(expr)]


def names(expr: sp.Basic) -> set[sp.Basic]:
    """Return the symbols, functions of time and derivatives in an expression; shared parts are visited once."""
    found = {node for node in _each(expr) if isinstance(node, (sp.Symbol, AppliedUndef, sp.Derivative))}
    return found | {node.expr for node in found if isinstance(node, sp.Derivative)}


def terms(expr: sp.Basic, *, angles: bool = False) -> int:
    """Return an upper bound on the number of terms in the longest sum that expanding an expression makes.

    With ``angles``, sines and cosines of sums and multiples are expanded, too: cos(a − 2b) has up to 2·3 terms.
    """
    found: dict[int, int] = {}
    longest = 1
    for node in _each(expr):
        inner = [found[id(a)] for a in node.args] if not isinstance(node, (AppliedUndef, sp.Derivative)) else []
        count = 1
        if isinstance(node, sp.Add):
            count = sum(inner)
        elif isinstance(node, sp.Mul):
            for n in inner:
                count = min(count * n, BEYOND)
        elif isinstance(node, sp.Pow) and isinstance(node.exp, sp.Integer):
            power = abs(int(node.exp))
            raised = inner[0] if inner[0] == 1 else min(comb(min(inner[0], 10**6) + power - 1, power), BEYOND)
            count, longest = (raised, longest) if node.exp > 0 else (1, max(longest, raised))  # so does a denominator
        elif angles and isinstance(node, (sp.sin, sp.cos)):
            for addend in sp.Add.make_args(cast("sp.Expr", node.args[0])):
                count = min(count * (1 + abs(int(addend.as_coeff_Mul()[0]))), BEYOND)
        found[id(node)] = count
        longest = max(longest, count)
    return longest


def _slopes(expr: sp.Basic) -> int:
    """Return an upper bound on the size of the derivative of an expression."""
    sizes: dict[int, int] = {}
    found: dict[int, int] = {}
    for node in _each(expr):
        if not node.args or isinstance(node, (AppliedUndef, sp.Derivative)):
            sizes[id(node)] = found[id(node)] = 1
            continue
        own = sizes[id(node)] = min(1 + sum(sizes[id(a)] for a in node.args), BEYOND)
        below = sum(found[id(a)] for a in node.args)
        found[id(node)] = min(below if isinstance(node, sp.Add) else below + own * len(node.args), BEYOND)
    return found[id(expr)]


# -- writing out --------------------------------------------------------------------------------------------------


def expand(expr: sp.Expr) -> sp.Expr:
    """Return the sum of products that an expression equals, or the expression unchanged if that would be too long.

    Maxima and cases stay as they are, as SymPy would try to prove their conditions.
    """
    return expr if terms(expr) > TERMS or size(expr) > MAX_OPERATIONS else _unbent(sp.expand, expr)


def expand_angles(expr: sp.Expr) -> sp.Expr:
    """Return the sum of products with sines and cosines of single angles, or ``expr`` unchanged if that is too long."""
    if terms(expr, angles=True) > TERMS or size(expr) > MAX_OPERATIONS:
        return expr
    return _unbent(lambda straight: sp.expand(sp.expand_trig(straight)), expr)


def _unbent(routine: Callable[[sp.Expr], Any], expr: sp.Expr) -> sp.Expr:
    """Apply a routine to an expression in which symbols replace maxima and cases."""
    letters = {node: sp.Dummy(f"bent{k}", real=True) for k, node in enumerate(_bent(expr))}
    if not letters:
        return cast("sp.Expr", routine(expr))
    made = routine(cast("sp.Expr", replaced(expr, letters)))
    return cast("sp.Expr", replaced(made, {letter: node for node, letter in letters.items()}))


def check_size(count: int, what: str) -> None:
    """Raise an error if an expression is longer than `MAX_OPERATIONS`; ``what`` is the subject of the sentence."""
    if count > MAX_OPERATIONS:
        many = f"{float(count):.0e}" if count < BEYOND else "more than 1e30"
        raise TooLarge(
            f"{what} has {many} operations once it is written out",
            fix=f"at most {MAX_OPERATIONS}: refer to each definition fewer times, or describe the system by points and "
            "frames",
            code="E601",
        )


def written_out(expr: sp.Expr, table: Mapping[Any, Any]) -> sp.Expr:
    """Return ``expr`` with symbols replaced by their expressions and derivatives by time carried out.

    Raises `TooLarge` if the result would have more than `MAX_OPERATIONS` operations.
    """
    while used := [node for node in _each(expr) if (node.expr if isinstance(node, sp.Derivative) else node) in table]:
        lengths: dict[Any, int] = {}
        for symbol, value in table.items():  # definitions come after those that they use
            lengths[symbol] = size(value, lengths)
        symbols = [node.expr if isinstance(node, sp.Derivative) else node for node in used]
        longest = str(max(symbols, key=lambda symbol: lengths[symbol])).removesuffix("(t)")
        check_size(size(expr, lengths), f"an expression that uses '{longest}'")
        values = {node: _rates(node, table) if isinstance(node, sp.Derivative) else table[node] for node in used}
        expr = cast("sp.Expr", replaced(expr, values))
    return expr


def _rates(node: sp.Derivative, table: Mapping[Any, Any]) -> sp.Expr:
    value = table[node.expr]
    for _ in range(int(node.derivative_count)):
        value = diff(value, node.variables[0])
    return value


def diff(expr: sp.Expr, *symbols: Any) -> sp.Expr:
    """Return the derivative by symbols, coordinates, rates or time in turn; raise `TooLarge` if it gets too long.

    A maximum has the derivative of its larger argument, a piecewise expression that of its case; conditions stay.
    """
    for symbol in symbols:
        if (count := _slopes(expr)) > SLOPES:
            raise TooLarge(
                f"a derivative of an expression with {size(expr)} operations has up to {float(count):.0e}",
                fix="describe the system by points and frames instead of long products",
                code="E601",
            )
        expr = _diff(expr, symbol)
    return expr


def _diff(expr: sp.Expr, symbol: Any) -> sp.Expr:
    bent = _bent(expr)
    if not bent:
        return cast("sp.Expr", sp.diff(expr, symbol))
    letters = {node: sp.Dummy(f"bent{k}", real=True) for k, node in enumerate(bent)}
    outer = cast("sp.Expr", replaced(expr, letters))
    total = sp.diff(outer, symbol)
    for node, letter in letters.items():
        inner = _case(node, symbol)
        if inner != 0:
            total += sp.diff(outer, letter) * inner
    return cast("sp.Expr", replaced(total, {letter: node for node, letter in letters.items()}))


def _bent(expr: sp.Basic) -> list[sp.Expr]:
    """The outermost maxima, minima and cases, and long absolute values and signs."""
    found: dict[sp.Expr, None] = {}
    stack, seen = [expr], {id(expr)}
    while stack:
        node = stack.pop()
        long = isinstance(node, (sp.Abs, sp.sign)) and size(node) > INSIDE
        if long or isinstance(node, (sp.Piecewise, sp.Max, sp.Min)):
            found[cast("sp.Expr", node)] = None
            continue
        fresh = [a for a in node.args if id(a) not in seen]
        seen.update(map(id, fresh))
        stack += fresh
    return list(found)


def _case(node: sp.Expr, symbol: Any) -> sp.Expr:
    """The derivative of a maximum, a minimum or cases is that of the active branch; d|u| = sign(u) du, d sign(u) =
    0."""
    if isinstance(node, (sp.Abs, sp.sign)):
        inner = _diff(cast("sp.Expr", node.args[0]), symbol) if isinstance(node, sp.Abs) else sp.S.Zero
        return inner if inner == 0 else inner * sp.sign(node.args[0], evaluate=False)
    if isinstance(node, sp.Piecewise):
        cases = [(_diff(pair.args[0], symbol), pair.args[1]) for pair in cast("tuple[Any, ...]", node.args)]
    else:
        is_it, beyond = (
            (sp.GreaterThan, sp.StrictGreaterThan) if isinstance(node, sp.Max) else (sp.LessThan, sp.StrictLessThan)
        )
        if len(node.args) == 2:  # if both arguments are equal the first counts, as in the graph
            a, b = cast("list[sp.Expr]", sorted(node.args, key=sp.default_sort_key))
            first = sp.Piecewise((1, is_it(a, b, evaluate=False)), (0, True), evaluate=False)
            second = sp.Piecewise((1, beyond(b, a, evaluate=False)), (0, True), evaluate=False)
            return _diff(a, symbol) * first + _diff(b, symbol) * second
        arguments = cast("tuple[sp.Expr, ...]", node.args)
        cases = [(_diff(a, symbol), is_it(a, node, evaluate=False)) for a in arguments]
        cases[-1] = (cases[-1][0], sp.true)
    if all(value == cases[0][0] for value, _ in cases):
        return cases[0][0]
    return sp.Piecewise(*cases, evaluate=False)


def replaced(expr: sp.Basic, table: Mapping[Any, Any]) -> sp.Basic:
    """Return an expression with parts replaced; parts without any of these stay, and no condition is proved again."""
    made: dict[int, sp.Basic] = {}
    for node in _each(expr):
        if node in table:
            made[id(node)] = table[node]
        elif not node.args or isinstance(node, (AppliedUndef, sp.Derivative)):
            made[id(node)] = node
        else:
            made[id(node)] = rebuilt(node, [made[id(a)] for a in node.args])
    return made[id(expr)]


def rebuilt(node: sp.Basic, arguments: list[Any]) -> sp.Basic:
    """Return an expression of the same kind with other arguments; cases, comparisons and long maxima stay unproved."""
    if all(a is b for a, b in zip(arguments, node.args, strict=True)):
        return node
    unproved = (sp.Piecewise, sp.core.relational.Relational)
    if isinstance(node, unproved) or (isinstance(node, (sp.Max, sp.Min)) and len(arguments) > 2):
        return node.func(*arguments, evaluate=False)
    return absolute(node.func, arguments[0]) if isinstance(node, (sp.Abs, sp.sign)) else node.func(*arguments)


# -- searches -----------------------------------------------------------------------------------------------------


class _SpentError(BaseException):
    """All calls are spent. Not an `Exception`, so that no routine on the way catches it."""


def searched(routine: Callable[..., T], *arguments: Any, calls: int = CALLS) -> T | None:
    """Return the result of one of SymPy's routines, or None if it makes more than ``calls`` calls."""
    left = calls

    def count(frame: Any, event: str, argument: Any) -> None:
        nonlocal left
        if event == "call":
            left -= 1
            # an exception raised while a generator is closed is lost, and Python would stop counting
            if left < 0 and not frame.f_code.co_flags & CO_GENERATOR:
                raise _SpentError

    before = sys.getprofile()
    sys.setprofile(count)
    try:
        return routine(*arguments)
    except _SpentError:
        clear_cache()  # unfinished results in SymPy's cache must not be used later
        return None
    except RecursionError:
        return None
    finally:
        if before is None or callable(before):
            sys.setprofile(before)
        else:  # the standard library's profiler is not a function, and starts itself again
            sys.setprofile(None)
            before.enable()


def absolute(function: Callable[..., Any], argument: sp.Expr) -> sp.Expr:
    """Return abs or sign of a real number, unevaluated if SymPy would split it into real and imaginary parts."""
    value = searched(function, argument, calls=PROOFS)
    split = value is None or value.has(sp.re, sp.im, sp.arg, sp.conjugate)
    return cast("sp.Expr", function(argument, evaluate=False) if split else value)


def cancel(expr: sp.Expr) -> sp.Expr:
    """Return a quotient without common factors, or the expression unchanged if the search takes too long."""
    return _found(sp.cancel, expr)


def together(expr: sp.Expr) -> sp.Expr:
    """Return an expression over one denominator, or unchanged if that takes too long."""
    return _found(sp.together, expr)


def simplify(expr: sp.Expr) -> sp.Expr:
    """Return the expression as SymPy simplifies it, or unchanged if that takes too long."""
    return _found(sp.simplify, expr)


def trigsimp(expr: sp.Expr) -> sp.Expr:
    """Return an expression with fewer sines and cosines, or unchanged if SymPy searches too long."""
    return _found(sp.trigsimp, expr)


def _found(routine: Callable[[Any], Any], expr: sp.Expr) -> sp.Expr:
    if not expr.args:
        return expr
    if terms(expr) > TERMS or size(expr) > MAX_OPERATIONS:
        return expr
    answer = searched(routine, expr)
    return expr if answer is None else cast("sp.Expr", answer)


def is_one(expr: sp.Expr) -> bool:
    """Whether an expression equals 1 by arithmetic and sin² + cos² = 1, as the square of a unit vector does."""
    whole = expr = expand(expr)
    for angle in sorted({c.args[0] for c in expr.atoms(sp.cos)}, key=sp.default_sort_key):
        if expr == 1:
            return True
        cosine, square = sp.cos(angle), 1 - sp.sin(angle) ** 2

        def even(power: Any, base: Any = cosine, square: Any = square) -> sp.Expr:
            return square ** (power.exp // 2) * base ** (power.exp % 2)

        powers = [p for p in expr.atoms(sp.Pow) if p.base == cosine and isinstance(p.exp, sp.Integer) and p.exp > 1]
        expr = expand(cast("sp.Expr", expr.xreplace({p: even(p) for p in powers})))
    if expr == 1:
        return True
    high = [p.base for p in whole.atoms(sp.Pow) if isinstance(p.exp, sp.Integer) and p.exp > HIGH and p.base.is_Add]
    letters = {base: sp.Dummy(f"sum{k}") for k, base in enumerate(dict.fromkeys(high))}  # 1 for any sum is 1 for this
    return cancel(together(cast("sp.Expr", replaced(whole, letters)))) == 1
