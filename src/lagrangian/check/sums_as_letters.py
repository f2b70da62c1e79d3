"""Wrong answers to systems with sums of parameters, R − r: what is wrong is sought with one letter for such a sum.

Written out, J (R − r)² φ̇²/(2 r²) is three terms, none of which anybody wrote. With a letter D for R − r it is one, and
what is wrong in it is a factor, a power or a divisor. What is found is told with the sum in place of the letter.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any, TypeVar, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.coordinates.renamed import each_formula
from lagrangian.check.explain.wrong_terms import VAGUE
from lagrangian.check.reference import truth_of
from lagrangian.check.verdict import AnsweredLine, Mistake, Status, Verdict, keys_of
from lagrangian.coordinates.carry import Carrier
from lagrangian.coordinates.change import Change
from lagrangian.derive import Derived, derive
from lagrangian.errors import Error
from lagrangian.model import Coordinate, Model, Parameter
from lagrangian.page.plain import plain
from lagrangian.records import dataclass, field

T = TypeVar("T")
Judge = Callable[[Derived, Sequence[AnsweredLine]], Verdict]

MOST_LETTERS = 2
"""The most sums of a system for which letters are put."""
LONGEST = 1_500
"""The most operations of the energies, forces and equations of such a system."""
OF_TERMS = frozenset(["term_alone", "term_replaced", "term_too_much", "term_missing", "sign_in_a_sum", *VAGUE])
"""Names of mistakes that say which term differs, and not why."""
OF_FACTORS = frozenset(["arm", "force_arm", "damper_arm", "factor_of_a_term"])
"""Names of those that say a factor, which may be that of a part of a sum alone."""


@dataclass(frozen=True, eq=False)
class Lettered:
    """A system with letters for sums of parameters: what is ``put`` for parameters, and the sums by their letters."""

    derivation: Derived
    put: dict[sp.Basic, sp.Expr]
    sums: dict[sp.Basic, sp.Expr]

    @property
    def used(self) -> tuple[sp.Basic, ...]:
        """What a line has that such a sum is in: its parameters, or its name."""
        return (*self.put, *self.sums.values())

    def line(self, line: AnsweredLine) -> AnsweredLine:
        """A line of an answer in these letters."""
        return each_formula(line, lambda x: cast("sp.Basic", x.xreplace(self.put)))

    def told(self, value: T) -> T:
        """What is told of such lines, with the sums written out."""
        names = {str(letter): f"({plain(of)})" for letter, of in self.sums.items()}

        def words(said: str) -> str:
            for name, of in names.items():
                said = said.replace(name, of)
            return said

        return each_formula(value, lambda x: cast("sp.Basic", x.xreplace(self.sums)), words)


def with_sums_as_letters(derivation: Derived, lines: Sequence[AnsweredLine], verdict: Verdict, judge: Judge) -> Verdict:
    """The verdict on a wrong answer with what is found with letters for sums of parameters, where this says more than
    what is found without them, or the same in fewer mistakes."""
    if verdict.status is not Status.WRONG or not verdict.hint or verdict.change:
        return verdict
    if derivation.form == "structured" or derivation.multipliers or derivation.model.floating:
        return verdict
    lettered = derivation.model.remembered("sums as letters", lambda: _lettered(derivation))
    if lettered is None or not any(line.expr.has(*lettered.used) for line in lines) or _says_values(lettered, lines):
        return verdict
    try:
        found = judge(lettered.derivation, [lettered.line(x) for x in lines])
    except Error:
        return verdict
    others = dict(zip(_keys(found), found.findings, strict=True))
    keys = _keys(verdict)
    if others.keys() != set(keys) or any(
        (f.status, f.follows) != (others[key].status, others[key].follows)
        for key, f in zip(keys, verdict.findings, strict=True)
    ):
        return verdict
    mistakes, alternatives = lettered.told((found.mistakes, found.alternatives))
    if not _says_more(found, mistakes, verdict):
        return verdict
    findings = tuple(
        replace(lettered.told(others[key]), line=f.line) if f.status is Status.WRONG else f
        for key, f in zip(keys, verdict.findings, strict=True)
    )
    return replace(verdict, findings=findings, mistakes=mistakes, alternatives=alternatives, sure=found.sure)


def _keys(verdict: Verdict) -> list[tuple[int, str, int]]:
    return keys_of([f.line for f in verdict.findings])


def _worth(verdict: Verdict) -> int:
    """How much the first mistake says: 0 nothing, 1 a piece of a term that was multiplied out, 2 a term or a factor,
    3 what was done."""
    for mistake in verdict.mistakes[:1]:
        if mistake.name == "sign_in_a_sum" and str(mistake.what).startswith("In line "):
            return 1
        return 2 if mistake.name in OF_TERMS | OF_FACTORS else 3
    return 0


def _says_more(found: Verdict, told: Sequence[Mistake], verdict: Verdict) -> bool:
    """Whether what is found with letters says more than what was found without: why and not only which term, what one
    mistake explains and not several, or the same in fewer words."""
    if not told or len(told) > max(1, len(verdict.mistakes)) or _worth(found) < _worth(verdict):
        return False
    if len(told) < len(verdict.mistakes) or _worth(found) > _worth(verdict):
        return True
    first, other = told[0], verdict.mistakes[0]
    return other.name in OF_FACTORS and first.name in OF_FACTORS and len(str(first.what)) < len(str(other.what))


def _says_values(lettered: Lettered, lines: Sequence[AnsweredLine]) -> bool:
    """Whether an answer says what one of the parameters is."""
    names = {str(p) for p in lettered.put}
    return any(x.kind in ("given", "definition") and x.name in names for x in lines)


# -- the system in these letters --------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, kw_only=True)
class _Lettering(Change):
    """No change of coordinates, but letters put for sums of parameters; ``seen`` are all formulas of the system."""

    letters: dict[sp.Basic, sp.Expr]
    seen: list[sp.Expr] = field(default_factory=list)

    def put_in(self, expr: sp.Expr) -> sp.Expr:
        """An expression in these letters."""
        if expr not in self._memo:
            self.seen.append(expr)
            self._memo[expr] = cast("sp.Expr", expr.xreplace(self.letters))
        return self._memo[expr]


def _lettering(model: Model, letters: dict[sp.Basic, sp.Expr]) -> _Lettering:
    own: tuple[Coordinate, ...] = model.coordinates
    return _Lettering(own, own, {c.symbol: c.symbol for c in own}, letters=letters)


class _Letterer(Carrier):
    """Builds the description of the system in these letters."""

    def __init__(self, model: Model, change: Change, instead: Sequence[Parameter]) -> None:
        super().__init__(model, change, model.name)
        self.instead = instead

    def parameters(self) -> Sequence[Parameter]:
        """The parameters, some of which letters stand for."""
        return self.instead

    def settle(self) -> None:
        """No settings: nothing is run."""


def _lettered(derivation: Derived) -> Lettered | None:
    """The system with letters for the sums of parameters that make its terms fewer; None if there are none."""
    model = derivation.model
    truth = truth_of(derivation)
    forms = [truth.T, truth.V, *truth.Xi, *truth.rows]
    if sum(map(bounded.operations, forms)) > LONGEST:
        return None
    named = {truth.expand(d.symbol): d.symbol for d in model.definitions if not d.moving}
    put, sums, parameters = dict[sp.Basic, sp.Expr](), dict[sp.Basic, sp.Expr](), list(model.parameters)
    for number, whole in enumerate(_sums(model, truth.angles), 1):
        if len(sums) == MOST_LETTERS or put.keys() & whole.free_symbols:
            continue
        own: list[Any] = sorted(whole.free_symbols, key=str)
        letter = sp.Symbol(f"sum{number}of{'and'.join(map(str, own))}")
        ways: list[tuple[sp.Symbol, sp.Expr]] = [(x, whole.coeff(x) * (letter - whole) + x) for x in own]
        tried = [([cast("sp.Expr", x.xreplace({p: of})) for x in forms], p, of) for p, of in ways]
        fewest, p, of = min(tried, key=lambda way: _count(way[0]))
        if _count(fewest) >= _count(forms):
            continue
        forms = fewest
        put[p], sums[letter] = of, named.get(whole, whole)
        at = next(k for k, x in enumerate(parameters) if x.symbol == p)
        parameters[at] = replace(parameters[at], name=str(letter), symbol=letter, value=_value(model, whole))
    if not put:
        return None
    change = _lettering(model, put)
    try:
        return Lettered(derive(_Letterer(model, change, parameters).built().model()), put, sums)
    except Error:
        return None


def _sums(model: Model, angles: frozenset[sp.Basic]) -> Iterator[sp.Expr]:
    """The sums of parameters in the description of a system, ± signs aside; none of angles alone."""
    change = _lettering(model, {})
    try:
        _Letterer(model, change, model.parameters).built()
    except Error:
        return
    symbols = {p.symbol for p in model.parameters} - angles
    found: dict[sp.Expr, None] = {}
    for expr in change.seen:
        for x in bounded.each(expr):
            if isinstance(x, sp.Add) and x.free_symbols <= symbols and len(x.args) <= 3:
                pairs = [cast("sp.Expr", a).as_coeff_Mul() for a in x.args]
                if all(c in (1, -1) and of.is_Symbol for c, of in pairs) and -x not in found:
                    found[cast("sp.Expr", x)] = None
    yield from (-x if x.could_extract_minus_sign() else x for x in found)


def _count(exprs: Sequence[sp.Expr]) -> int:
    """The number of terms when everything is multiplied out."""
    return sum(len(sp.Add.make_args(bounded.expand(x))) for x in exprs)


def _value(model: Model, whole: sp.Expr) -> float | None:
    """The value of a sum; None if one of its parameters has none."""
    values: Any = {p: v for p, v in model.values.items() if p in whole.free_symbols}
    return float(cast("Any", whole.xreplace(values))) if len(values) == len(whole.free_symbols) else None
