"""Tells what is wrong in the names that the answer defines: m ρ φ̇² for m (p + ½ s) φ̇² where ρ = p + ½ s."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.coordinates.renamed import each_formula
from lagrangian.check.explain.given_said import given_motions
from lagrangian.check.explain.meant import kinds_of
from lagrangian.check.explain.terms_alone import term_mistake
from lagrangian.check.reading.shortened import meant
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, TermDifference, Verdict
from lagrangian.model import time
from lagrangian.model.names import moving_symbol
from lagrangian.page.formula import Text
from lagrangian.read.letters import key, undotted
from lagrangian.records import dataclass, field

MOST_NAMES, LONGEST_VALUE, LONGEST_FORMULA = 20, 60, 400
"""The most names that are put in, the most operations of the value of one, and those of a formula that is searched."""

ALONE = " in one equation alone"
"""What is said of a mistake that one equation alone shows."""

_OF_DEFINITION = re.compile(r"Line (\d{1,6}) is not right: the ")
"""How words begin that speak of a definition."""
_WORD = re.compile(r"[^\W\d]\w{0,63}")
_STATED = re.compile(r"(?:\A|[,;:.({&$]|\w{3}[ \t])[ \t]*\\?([^\W\d]\w{0,63})(['’′]{0,2})[ \t&]*\Z")
"""A name, or its rate, that is all there is on the left, behind words."""
_MARKS = ("'", "’", "′", "\u0307", "\u0308")
"""What makes a rate of the name that stands before it."""
_APPLIED = r"(?:\(t\)|\[t\]|\{\})?"
_DIFFERENCE = re.compile(
    rf"[([{{]\s{{0,3}}\\?([^\W\d]\w{{0,63}}+){_APPLIED}\s{{0,3}}[-−–]\s{{0,3}}\\?([^\W\d]\w{{0,63}}+){_APPLIED}\s{{0,3}}[)\]}}]"
)
"""A difference of two names in brackets."""


@dataclass(frozen=True)
class OwnName:
    """A name that an answer uses, and its value in the system's letters."""

    symbol: sp.Expr
    value: sp.Expr
    given: bool = False
    """Whether the name is one of the system."""

    @property
    def key(self) -> str:
        """The key of the name, also of its rate."""
        alone = isinstance(self.symbol, (sp.Symbol, AppliedUndef))
        return _named(self.symbol if alone else self.symbol.args[0])


def in_own_names(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict, in which formulas have the names that the answer, or the system, gives their parts.

    A name is put in where a wrong line has it and the answer gives it one value; never for the whole of a formula, and
    never where it would hide a letter of which the same words speak. What it stands for is what the answer says, so
    that no formula changes its value.
    """
    wrong = [f.line for f in verdict.findings if not f.status.right]
    defined = _in_definitions(lines)
    told = _Told(own_names(truth, lines, wrong), _differences(truth, lines), _unused(truth, lines), defined)
    if not told.names and not told.differences and not told.unused:
        return verdict
    named = replace(
        verdict,
        findings=tuple(map(told.finding, verdict.findings)),
        mistakes=tuple(map(told.mistake, verdict.mistakes)),
        alternatives=tuple(map(told.mistake, verdict.alternatives)),
    )
    return _by_own_term(lines, named)


def _by_own_term(lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict, in which a mistake in the energy of one equation alone, of an answer without energies, is told by
    the one term in which that differs: R S for 2 R S."""
    roots = verdict.open_findings
    far = len(verdict.mistakes) == 1 and ALONE in str(verdict.mistakes[0].what)
    if not far or any(x.kind in ("T", "V", "L") for x in lines) or len(roots) != 1 or len(roots[0].differences) != 1:
        return verdict
    mistake = term_mistake(roots[0], roots[0].differences[0])
    return replace(verdict, mistakes=(mistake,), alternatives=(), sure=True)


def own_names(truth: Reference, lines: Sequence[AnsweredLine], wrong: Sequence[AnsweredLine]) -> tuple[OwnName, ...]:
    """The names with values that the wrong lines of an answer have, but for those that they define, and names of the
    system for such values that the answer has anywhere; the longest values first."""
    used = {x for line in wrong if line.kind != "definition" for x in names_in(line) if x != _stated_in(line)}
    taken = {key(name) for name in truth.model.symbols}
    found: dict[str, set[sp.Expr]] = {}
    symbols: dict[str, sp.Expr] = {}
    for line in lines:
        name = line.name or ""
        if line.kind == "definition" and _WORD.fullmatch(name) and key(name) in used - taken:
            found.setdefault(name, set()).add(line.expr)
            own: Any = moving_symbol(name) if _moves(line.expr) else sp.Symbol(name)
            symbols[name] = own**2 if line.of_square else line.of_function(own)
    anywhere = {name for line in lines for name in names_in(line)}
    stated = {name for line in wrong if (name := _stated_in(line))}
    for d in truth.model.definitions:
        if key(d.name) in anywhere - stated:  # what is right is told of a name that a line gets wrong
            found.setdefault(d.name, set()).add(truth.expand(d.symbol))
            symbols[d.name] = d.symbol
    of_system = {d.name for d in truth.model.definitions}
    named = [OwnName(symbols[x], *values, given=x in of_system) for x, values in found.items() if len(values) == 1]
    named = [x for x in named if x.value.args and 0 < bounded.operations(x.value) <= LONGEST_VALUE]
    named = [
        x
        for x in named
        if not _has_unknown(x.value, [y.as_base_exp()[0] for y in symbols.values()]) and not _is_kinetic(x)
    ]
    rated = {name for line in lines for name in _rated_in(line)}
    plain = {name for line in wrong for name in _unrated_in(line)}  # y_B'' = … is no reason to write y_B for −l cos φ
    alone = {name for line in wrong for name in _rated_in(line)} - plain
    named_so = [x for x in named if x.given or x.key not in alone or x.value.has(sp.Derivative)]
    every = [*named_so, *(y for x in named if x.given or x.key in rated for y in _rates(x))]
    return tuple(sorted(every, key=lambda x: -bounded.operations(x.value)))[:MOST_NAMES]


def _stated_in(line: AnsweredLine) -> str:
    """The key of the name that stands alone on the left of a line, or of which the rate does if the right side is
    written without it; "" if none does."""
    left, equals, right = line.text.partition("=")
    found = _STATED.search(left) if equals else None
    if found is None or (found[2] and re.search(rf"(?<![^\W_]){re.escape(found[1])}(?![^\W_])", right)):
        return ""
    return key(found[1])


def _in_definitions(lines: Sequence[AnsweredLine]) -> dict[int, frozenset[str]]:
    """The keys of the names that the definitions and the equations in each line use, and do not define."""
    found: dict[int, frozenset[str]] = {}
    for line in lines:
        if line.kind in ("definition", "equation"):
            found[line.number] = found.get(line.number, frozenset()) | names_in(line)
    for line in lines:
        if line.kind == "definition":
            found[line.number] -= {key(line.name or "")}
    return found


def _unused(truth: Reference, lines: Sequence[AnsweredLine]) -> dict[sp.Expr, sp.Expr]:
    """The prescribed motions of the system that an answer does not call by their names, and their rates, with what
    they are."""
    anywhere = {name for line in lines for name in names_in(line)}
    given = [OwnName(x, value) for x, value in given_motions(truth.model) if _named(x) not in anywhere]
    return {y.symbol: y.value for x in given for y in (x, *_rates(x))}


def names_in(line: AnsweredLine) -> frozenset[str]:
    """The keys of the names that a line has as it is written, or by which it was read."""
    return line.names | {key(undotted(word)[0]) for word in _WORD.findall(line.text)}


def _rated_in(line: AnsweredLine) -> Iterator[str]:
    """The keys of the names whose rate is written in a line, with a dot, a prime or ``dot``."""
    return (name for name, is_rate in _words_in(line) if is_rate)


def _unrated_in(line: AnsweredLine) -> Iterator[str]:
    """The keys of the names that are written in a line themselves."""
    return (name for name, is_rate in _words_in(line) if not is_rate)


def _words_in(line: AnsweredLine) -> Iterator[tuple[str, bool]]:
    """The keys of the words in a line, each with whether it is the rate of a name."""
    for m in _WORD.finditer(line.text):
        base, dots = undotted(m[0])
        before, after = line.text[max(0, m.start() - 6) : m.start()], line.text[m.end() : m.end() + 4]
        if dots or after.removeprefix("(t)").startswith(_MARKS) or before.rstrip("{\\ ").endswith("dot"):
            yield key(base), True
        elif base.endswith("dot"):
            yield key(base.removesuffix("dot").rstrip("_")), True
        else:
            yield key(base), False


def _moves(expr: sp.Expr) -> bool:
    return bool(expr.has(time) or expr.atoms(AppliedUndef))


def _is_kinetic(name: OwnName) -> bool:
    """Whether a name stands for the kinetic energy of a part, T₁, in which no other is measured: ¼ T₁."""
    rates = name.value.atoms(sp.Derivative)
    return kinds_of(name.key) == ("kinetic",) and any(bounded.diff(name.value, x).has(*rates) for x in rates)


def _has_unknown(expr: sp.Expr, symbols: Any) -> bool:
    """Whether a value has one of the names itself, so that it is not written out."""
    return bool(bounded.letters(expr) & set(symbols))


def _rates(name: OwnName) -> Iterator[OwnName]:
    """The rate and the acceleration of a name for a given motion: β̇ = β₀ Ω cos Ω t."""
    value, symbol = name.value, name.symbol
    if not isinstance(symbol, AppliedUndef) or value.atoms(AppliedUndef):
        return
    for count in (1, 2):
        value = bounded.diff(value, time)
        if not value.has(time):
            return
        yield OwnName(cast("sp.Expr", sp.Derivative(symbol, (time, count))), value, name.given)


def _differences(truth: Reference, lines: Sequence[AnsweredLine]) -> frozenset[tuple[str, str]]:
    """The differences of two names that stand in brackets, each in one order only: φ − β in sin(φ − β)."""
    known = [c.name for c in truth.model.coordinates]
    written = {pair for line in lines for pair in _DIFFERENCE.findall(line.text)}
    found = {(_in_full(a, known), _in_full(b, known)) for a, b in written}
    return frozenset((a, b) for a, b in found if (b, a) not in found)


def _in_full(written: str, names: Sequence[str]) -> str:
    """The key of a name that is written, of a coordinate that it shortens where it can be one alone: th is theta."""
    found = meant(written, names)
    return key(found[0]) if len(found) == 1 else key(written)


@dataclass(frozen=True)
class _Told:
    """What is told, in an answer's own names and with differences of two names in its order."""

    names: tuple[OwnName, ...]
    differences: frozenset[tuple[str, str]]
    unused: Mapping[sp.Expr, sp.Expr] = field(default_factory=dict[sp.Expr, sp.Expr])
    defined: Mapping[int, frozenset[str]] = field(default_factory=dict[int, frozenset[str]])
    """The keys of the names that the definitions of each line use."""

    def finding(self, finding: Finding) -> Finding:
        """A finding, but for its line."""
        if finding.status.right:
            return finding
        own = _Told(tuple(x for x in self.names if x.given or x.key in names_in(finding.line)), self.differences)
        differences = tuple(map(own.difference, finding.differences))
        return replace(finding, differences=differences, note=own.words(finding.note))

    def mistake(self, mistake: Mistake) -> Mistake:
        """A mistake in words; one in a definition in the names that this has itself."""
        if (of := _OF_DEFINITION.match(str(mistake.what))) is not None and (used := self.defined.get(int(of[1]))):
            own = replace(self, names=tuple(x for x in self.names if x.given or x.key in used), defined={})
            return own.mistake(mistake)
        return replace(mistake, what=self.words(mistake.what), why=self.words(mistake.why))

    def difference(self, d: TermDifference) -> TermDifference:
        """A term that differs."""
        return replace(d, term=self._put(d.term, self.names), written=self._put(d.written, self.names))

    def words(self, words: Any) -> Any:
        """Words, with the names that hide nothing of which they speak, and of whose whole value they do not speak."""
        if not isinstance(words, Text):
            return words
        if self.unused:
            words = each_formula(words, lambda x: x.xreplace(dict(self.unused)) if isinstance(x, sp.Expr) else x)
        spoken = list(_spoken(words))
        kept = [x for x in self.names if not any(x.value.has(letter) for letter in spoken)]
        formulas = [x for x in words.parts if isinstance(x, sp.Expr)]
        whole = [x for x in kept if any(part in (x.value, -x.value) for part in formulas)]
        kept = [x for x in kept if x not in whole or (x.given and any(with_names(y, [x]) != y for y in formulas))]
        alone = {sign * x.value: sign * x.symbol for x in whole if x in kept for sign in (1, -1)}  # φ̇ − u̇, and u̇ in it
        return each_formula(
            words, lambda x: self._put(cast("sp.Expr", alone.get(x, x)), kept) if isinstance(x, sp.Expr) else x
        )

    def _put(self, expr: sp.Expr, names: Sequence[OwnName]) -> sp.Expr:
        return in_order(with_names(expr, names), self.differences)


def in_order(expr: sp.Expr, differences: Collection[tuple[str, str]]) -> sp.Expr:
    """A formula in which the sines and cosines of such differences are those of the differences in their order."""
    table: dict[Any, Any] = {}
    for node in bounded.each(expr) if differences else ():
        if isinstance(node, (sp.sin, sp.cos)):
            turned = -cast("sp.Expr", node.args[0])
            terms = sp.Add.make_args(turned)
            first, second = ([x for x in terms if x.could_extract_minus_sign() is sign] for sign in (False, True))
            if len(terms) == 2 and len(first) == 1 and (_named(first[0]), _named(-second[0])) in differences:
                function: Any = node.func
                in_turn = function(turned, evaluate=False)
                table[node] = -in_turn if isinstance(node, sp.sin) else in_turn
    return cast("sp.Expr", _rebuilt(expr, table)) if table else expr


def _rebuilt(expr: Any, table: Mapping[Any, Any]) -> Any:
    """A formula with parts replaced, above which no function is evaluated again."""
    if expr in table:
        return table[expr]
    if not expr.args or isinstance(expr, (AppliedUndef, sp.Derivative)):
        return expr
    own = [_rebuilt(x, table) for x in expr.args]
    return expr.func(*own) if isinstance(expr, (sp.Add, sp.Mul, sp.Pow)) else expr.func(*own, evaluate=False)


def _named(expr: sp.Basic) -> str:
    """The key of the name of a letter."""
    return key(expr.func.__name__ if isinstance(expr, AppliedUndef) else str(expr))


def _spoken(words: Text) -> Iterator[sp.Basic]:
    """The letters and functions of letters of which words speak by themselves, but for "the equation of θ"."""
    before: Any = ""
    for part in words.parts:
        of_equation = isinstance(before, str) and before.endswith(("equation of ", "equations of "))
        if isinstance(part, sp.Basic) and not of_equation and _is_short(part):
            yield part
        before = part


def _is_short(part: sp.Basic) -> bool:
    return not part.args or isinstance(part, (AppliedUndef, sp.Derivative)) or all(not x.args for x in part.args)


def with_names(expr: sp.Expr, names: Sequence[OwnName]) -> sp.Expr:
    """A formula in which names stand for what they mean, where this makes it shorter; the formula itself if it is only
    what one of them means."""
    if not expr.args or bounded.operations(expr) > LONGEST_FORMULA:
        return expr
    for name in names:
        if expr not in (name.value, -name.value):
            made = _with(expr, name)
            expr = made if _length(made) < _length(expr) else expr
    return expr


def _length(expr: sp.Expr) -> tuple[int, int]:
    """How long a formula is: by its operations, then by its sums."""
    return bounded.operations(expr), len(expr.atoms(sp.Add))


def _with(expr: sp.Expr, name: OwnName) -> sp.Expr:
    """A formula in which a name stands wherever its value does: as a part, as some terms of a sum, as some factors."""
    number, primitive = name.value.as_content_primitive() if isinstance(name.value, sp.Add) else (sp.S.One, name.value)
    forms = {name.value: name.symbol, primitive: cast("sp.Expr", name.symbol / number)}
    made: dict[int, Any] = {}
    for node in bounded.each(expr):
        inside = bool(node.args) and not isinstance(node, (AppliedUndef, sp.Derivative))
        built: Any = bounded.rebuilt(node, [made[id(a)] for a in node.args]) if inside else node
        for value, symbol in forms.items():
            if built == value:
                built = symbol
            elif isinstance(value, sp.Pow) and isinstance(built, (sp.Pow, sp.Add)):
                built = _power(built, value, symbol)
            elif isinstance(value, sp.Add) and isinstance(built, sp.Add):
                built = _some_terms(built, value, symbol)
            elif isinstance(value, sp.Mul) and isinstance(built, (sp.Mul, sp.Pow)):
                built = _some_factors(built, value, symbol)
        made[id(node)] = built
    return cast("sp.Expr", made[id(expr)])


def _power(found: sp.Expr, value: sp.Pow, symbol: sp.Expr) -> sp.Expr:
    """A power of a name for one of what its value is a power of: 1/l² for 1/(a² + d²), l = √(a² + d²)."""
    (base, own), (of, exponent) = found.as_base_exp(), value.as_base_exp()
    if isinstance(base, sp.Pow) and base.base == symbol:  # its own base is put in already
        return symbol ** (base.exp * own)
    times = own / exponent
    return symbol**times if base == of and times.is_Integer else found


def _some_terms(found: sp.Add, value: sp.Add, symbol: sp.Expr) -> sp.Expr:
    """A sum with a name for those of its terms that are its value, or this over letters: l/r for R/r + 1, l = R + r."""
    terms, first = set(found.args), value.args[0]
    for x in found.args:
        times = x / first
        own = {cast("sp.Expr", times * y) for y in value.args}
        if own <= terms and (times in (1, -1) or _is_of_letters(times)):
            return sp.Add(*(terms - own), times * symbol)
    return found


def _is_of_letters(factor: sp.Expr) -> bool:
    """Whether a factor is one over a product of letters."""
    above, below = sp.fraction(factor)
    return above in (1, -1) and all(f.as_base_exp()[0].is_Symbol for f in sp.Mul.make_args(below))


def _some_factors(found: sp.Expr, value: sp.Mul, symbol: sp.Expr) -> sp.Expr:
    """A product with a name to the highest power to which its factors stand there."""
    powers: Mapping[Any, Any] = found.as_powers_dict()
    factors: Mapping[Any, Any] = value.as_powers_dict()
    own: dict[Any, Any] = {base: e for base, e in factors.items() if not base.is_Rational}
    there: dict[Any, Any] = {base: powers.get(base, sp.S.Zero) for base in own}
    if not own or not all(e.is_Rational and there[base].is_Rational for base, e in own.items()):
        return found
    times = min(int(there[base] // e) for base, e in own.items())
    return cast("sp.Expr", found / value**times * symbol**times) if times > 0 else found
