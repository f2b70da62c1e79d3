"""Reads an answer's multipliers as those of the system, so that mistakes in equations with constraints can be named.

The equations m_i(ξ̈, ξ̇, ξ) = Ξ_i + Σ_k A_ki λ_k are compared with λ as with an input of the system. An answer's own
multiplier is s = c λ, and c may depend on the position: λ x/√(x² + y²) is the same force as 2 s x.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import islice, permutations, product
from typing import Any, cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.align import agreeing
from lagrangian.check.constraints.multiplier_words import Pushing, of_multiplier, unfitting
from lagrangian.check.constraints.stated_senses import stated_signs
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.terms.sides import on_side
from lagrangian.check.verdict import AnsweredLine, Mistake, TermDifference
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.page.formula import Text, text
from lagrangian.page.plain import plain
from lagrangian.records import dataclass, field

MOST = 3
"""The largest number of multipliers for which all orders and scales are tried."""
MOST_SCALES = 8
"""The largest number of scales that are tried for one multiplier."""
MOST_READINGS = 300
_ZERO = re.compile(r"=[ ]?0[\s$.,;&}\\]{0,9}$")
LONGEST = 60
"""The largest number of operations of the scale of a multiplier."""


@dataclass(frozen=True, eq=False)
class ReadMultipliers:
    """An answer whose multipliers are read: its lines, with right multipliers in all equations, and how they were read.

    ``sources[j]`` is which of the given lines became line j. ``mistakes`` say where the multipliers had stood wrong,
    ``slips`` in which of the given lines and which multiplier of the answer. ``own`` are the names of these, ``pushes``
    their factors in the given lines, ``scales`` what each is of a multiplier of the system. ``clashing``: two lines,
    one of which is wrong, though nothing says which.
    """

    lines: tuple[AnsweredLine, ...]
    notes: tuple[Text, ...]
    mistakes: tuple[Mistake, ...]
    slips: tuple[tuple[int, Any], ...]
    sources: tuple[int, ...]
    own: tuple[Any, ...]
    pushes: Mapping[tuple[int, Any], Pushing] = field(default_factory=dict[tuple[int, Any], Pushing])
    clashing: tuple[int, ...] = ()
    scales: Mapping[Any, sp.Expr] = field(default_factory=dict[Any, sp.Expr])

    @property
    def wrong(self) -> frozenset[int]:
        """The given lines in which a multiplier stands wrong, or may."""
        return frozenset([*(j for j, _ in self.slips), *self.clashing])


def with_own_multipliers(
    truth: Reference, lines: Sequence[AnsweredLine], *, clashes: bool = True
) -> ReadMultipliers | None:
    """The lines that can be compared one by one with the system's, and how the answer's multipliers were read.

    The constraints themselves, which hold no acceleration and no multiplier, are left out. None if there is no reading.
    With ``clashes``, two lines may not fit each other, and neither is right then.
    """
    model = truth.model
    own: list[Any] = [m.symbol for m in truth.derivation.multipliers.values()]
    accelerations = [c.acceleration for c in model.coordinates]
    rows = [line for line in lines if line.kind == "equation"]
    rows = [line for line in rows if line.expr.has(*accelerations) or line.expr.has(*own)]
    used: set[Any] = {x for line in rows for x in bounded.letters(line.expr)}
    names = sorted(used - truth.names, key=str)
    if not own or len(names) > len(own) or len(names) > MOST or not rows:
        return None
    if any(d.has(*names) for line in rows for d in line.expr.atoms(sp.Derivative)) if names else False:
        return None  # a name that moves is a coordinate of the answer's own
    exprs = [line.expr for line in rows]
    signs = {s: stated_signs(truth, lines, s) for s in names}
    possible = list(islice(_readings(truth, rows, names, own), MOST_READINGS))
    possible = _most_agreed(truth, exprs, [x for x in possible if _fits(truth, x, signs)] or possible)
    stated = list(_of_stated(truth, lines, names, own))
    stated = [x for x in stated if _fits(truth, x, signs)] or stated
    against = [_against(truth, exprs, _matched(truth, exprs, x, own)) for x in stated]
    fixed = [(_read(truth, lines, rows, x), k) for x, k in zip(stated, against, strict=True)]
    right, _ = min(fixed, key=lambda x: (len(x[0].mistakes) + x[1], x[1]), default=(None, 0))
    if right is not None and len(right.mistakes) < sum(line.expr.has(*names) for line in rows):
        doubtful = clashes and not any(_is_zero_of_positions(truth, line) for line in lines)
        return _beside_rivals(truth, right, lines, [x for x, _ in fixed if doubtful])
    found = _likeliest(truth, lines, rows, possible)
    if found.notes and found.mistakes and not clashes:  # a wrong constraint tells nothing of its sense
        others = (_read(truth, lines, rows, x) for x in possible[:2] if all(c == 1 for _, c in x.values()))
        found = next((x for x in others if _are(x.mistakes) == _are(found.mistakes)), found)
    rivals = (_read(truth, lines, rows, x) for x in possible) if clashes and len(found.mistakes) == 1 else ()
    return _beside_rivals(truth, found, lines, rivals)


def _likeliest(
    truth: Reference, lines: Sequence[AnsweredLine], rows: Sequence[AnsweredLine], possible: Sequence[_Reading]
) -> ReadMultipliers:
    """The lines in the reading on which most of them agree; in a plainer one if that leaves no more mistakes."""
    own: list[Any] = [m.symbol for m in truth.derivation.multipliers.values()]
    exprs = [line.expr for line in rows]
    matches = [_matched(truth, exprs, x, own) for x in possible]
    scores = [_score(found) for found in matches]
    best = [k for k, x in enumerate(scores) if x == max(scores)]
    if len(best) > 1:  # the signs that most equations agree on
        best.sort(key=lambda k: -_signs(truth, exprs, possible[k], matches[k]))
    found = _read(truth, lines, rows, possible[best[0]])
    if not found.mistakes:
        return found
    plain_ones = [k for k, x in enumerate(possible) if all(c in (1, -1) for _, c in x.values())]
    plain_ones.sort(key=lambda k: (_against(truth, exprs, matches[k]), -scores[k]))
    others = [_read(truth, lines, rows, possible[k]) for k in plain_ones]
    if not any(map(_is_odd, found.mistakes)):
        return next((x for x in others if _is_plainer(truth, x, found)), found)
    kept = (x for x in others if len(x.mistakes) <= len(found.mistakes))  # never two for one
    return next((x for x in kept if not any(map(_is_odd, x.mistakes))), found)


def _fits(truth: Reference, reading: _Reading, signs: Mapping[Any, Mapping[int, int]]) -> bool:
    """Whether multipliers push in every equation as words say that they do."""
    for s, (x, c) in reading.items():
        for i, sign in signs[s].items():
            pushes = cast("sp.Expr", -sign * c * truth.rows[i].diff(x))
            if pushes != 0 and not (CompiledExpressions([pushes]).at(truth.states) > 0).all():
                return False
    return True


def _most_agreed(truth: Reference, exprs: Sequence[sp.Expr], possible: Sequence[_Reading]) -> Sequence[_Reading]:
    """The readings in which most rows with a multiplier are right, where there are more than right ones: λ = …"""
    own = {x for reading in possible for x, _ in reading.values()}
    held = [row for row in truth.rows if row.has(*own)] if own else []
    forced = [e for e in exprs if possible and e.has(*possible[0])]
    if len(forced) <= len(held):
        return possible

    def agreed(reading: _Reading) -> int:
        table = {s: c * x for s, (x, c) in reading.items()}
        read = [cast("sp.Expr", e.xreplace(table)) for e in forced]
        return sum(
            any(zero_everywhere(truth, e - f * row) for row in held for f in _row_factors(truth, e, row)) for e in read
        )

    counts = [agreed(x) for x in possible]
    return [x for x, count in zip(possible, counts, strict=True) if count == max(counts)]


def _beside_rivals(
    truth: Reference, found: ReadMultipliers, lines: Sequence[AnsweredLine], rivals: Iterable[ReadMultipliers]
) -> ReadMultipliers:
    """The reading or, if another one leaves one mistake as well, and that in another line, both lines as one mistake:
    nothing says which of them is right."""
    if len(found.mistakes) != 1 or found.mistakes[0].name not in ("multiplier_sign", "multiplier_factor"):
        return found
    kind, ((line, s),) = found.mistakes[0].name, found.slips
    alike = (x for x in rivals if [m.name for m in x.mistakes] == [kind] and x.slips[0][1] == s)
    if (other := next((x for x in alike if x.slips[0][0] != line), None)) is None:
        return found
    first, second = sorted((line, other.slips[0][0]))
    read = found if line == second else other
    titles, pushes = [lines[j].title for j in (first, second)], [read.pushes[j, s] for j in (first, second)]
    told = unfitting(truth, titles, pushes, s, read.mistakes[0])
    return replace(found, mistakes=(told,), clashing=(first, second), notes=())


def _is_plainer(truth: Reference, reading: ReadMultipliers, than: ReadMultipliers) -> bool:
    """Whether λ read as ±λ leaves no more mistakes than λ times a function of the place, and no number for it."""
    turned = any(
        x.has(*truth.derivation.coordinates) for note in than.notes for x in note.parts if isinstance(x, sp.Expr)
    )
    return turned and len(reading.mistakes) <= len(than.mistakes) and not any(map(_is_odd, reading.mistakes))


def _of_stated(
    truth: Reference, lines: Sequence[AnsweredLine], names: Sequence[Any], own: Sequence[Any]
) -> Iterator[_Reading]:
    """How λ is read where the answer states a constraint with the slopes of c f for our f: λ/c in all equations, or all
    with −. What is the same wherever the system is, x/R = φ for x = R φ, is no scale that λ need have."""
    if len(names) != 1 or len(own) != 1:
        return
    for line in lines:
        c = _slope_ratio(truth, line.expr, own[0]) if line.kind in ("equation", "definition") else None
        if c is not None and bounded.size(c) <= LONGEST and (c.is_number or c.has(*truth.derivation.coordinates)):
            yield from ({names[0]: (own[0], cast("sp.Expr", sign / c))} for sign in (1, -1))
            return


def _is_zero_of_positions(truth: Reference, line: AnsweredLine) -> bool:
    """Whether a line states a constraint as f = 0, of which λ ∂f/∂ξ has a sign, or what its f is."""
    if line.kind == "definition":
        own = [m.symbol for m in truth.derivation.multipliers.values()]
        return any(_slope_ratio(truth, line.expr, x) is not None for x in own)
    return line.kind == "equation" and not line.expr.has(sp.Derivative) and _ZERO.search(line.text) is not None


def _slope_ratio(truth: Reference, g: sp.Expr, x: Any) -> sp.Expr | None:
    """The c with ∂g/∂ξ_i = c times the factor of the multiplier ``x`` on every right-hand side; None without one.

    It is √(x² + y²) for g = (x² + y² − l²)/2 and a constraint √(x² + y²) = l. The slopes of one on rates are by rates.
    """
    coordinates = truth.model.coordinates
    if g.has(*(c.acceleration for c in coordinates)):
        return None
    by = [c.rate if g.has(*(c.rate for c in coordinates)) else c.symbol for c in coordinates]
    pairs = [(bounded.diff(g, q), -row.diff(x)) for q, row in zip(by, truth.rows, strict=True)]
    c = next((bounded.cancel(a / b) for a, b in pairs if a != 0 and b != 0), None)
    if c is None or c == 0:  # slopes that cancel, as of two forms of one side
        return None
    values = CompiledExpressions([y for a, b in pairs for y in (a, cast("sp.Expr", c * b))]).at(truth.states)
    return c if np.allclose(values[::2], values[1::2], rtol=1e-9, atol=1e-12) else None


def _against(truth: Reference, exprs: Sequence[sp.Expr], found: Sequence[_Match]) -> int:
    """How many rows would hold an inertia with the wrong sign: mistakes that nobody makes."""
    count = 0
    for expr, match in zip(exprs, found, strict=True):
        for c in truth.model.coordinates if match.factor is not None else ():
            right = match.factor * truth.rows[match.row].diff(c.acceleration)
            ratio = bounded.cancel(expr.diff(c.acceleration) / right) if right != 0 else sp.S.Zero
            count += bool(ratio.is_number and ratio < 0)
    return count


def _signs(truth: Reference, exprs: Sequence[sp.Expr], reading: _Reading, found: Sequence[_Match]) -> int:
    """How often a multiplier stands in a row with the right sign, whatever its factor."""
    pairs = [
        (cast("sp.Expr", expr.diff(s)) * c, _right(truth, match, x))
        for expr, match in zip(exprs, found, strict=True)
        for s, (x, c) in reading.items()
    ]
    compared = [(a, b) for a, b in pairs if a != 0 and b is not None and b != 0]
    values = CompiledExpressions([y for pair in compared for y in pair]).at(truth.states) if compared else []
    return sum(bool((a * b > 0).all()) for a, b in zip(values[::2], values[1::2], strict=True))


def _are(mistakes: Iterable[Mistake]) -> list[str]:
    """The names of mistakes."""
    return [m.name for m in mistakes]


def _is_odd(mistake: Mistake) -> bool:
    """Whether a multiplier would have a wrong number, as with −2 λ for λ: rather two other mistakes were made."""
    if mistake.name != "multiplier_factor":
        return False
    _, written, _, right = [x for x in mistake.what.parts if isinstance(x, sp.Expr)]
    return bool((right / written).is_number)


def _read(
    truth: Reference, lines: Sequence[AnsweredLine], rows: Sequence[AnsweredLine], best: _Reading
) -> ReadMultipliers:
    """The lines with multipliers read in one way, and what is wrong with these."""
    own: list[Any] = [m.symbol for m in truth.derivation.multipliers.values()]
    exprs = [line.expr for line in rows]
    table = {s: cast("sp.Expr", c * x) for s, (x, c) in best.items()}
    told = [text(f"'{plain(s)}' was read as ", x, ".") for s, x in table.items() if s != x]
    read = {id(line): replace(line, expr=cast("sp.Expr", line.expr.xreplace(table))) for line in rows}
    places = {id(line): j for j, line in enumerate(lines)}
    mistakes: list[Mistake] = []
    slips: list[tuple[int, Any]] = []
    pushes: dict[tuple[int, Any], Pushing] = {}
    for line, found in zip(rows, _matched(truth, exprs, best, own), strict=True):
        for s, (x, c) in best.items():
            right = _right(truth, found, x)
            written = cast("sp.Expr", line.expr.diff(s))
            if right is None or found.factor is None or right == 0:
                continue
            pushes[places[id(line)], s] = _pushing(found.row, found.factor, written, cast("sp.Expr", right / c))
            if zero_everywhere(truth, rest := written * c - right):
                continue
            read[id(line)] = replace(read[id(line)], expr=read[id(line)].expr - rest * x)
            slips.append((places[id(line)], s))
            belongs = cast("sp.Expr", bounded.cancel(right / c))
            _, said = on_side(line, TermDifference("", belongs * s, written * s, None))
            sign = -1 if said.written == -written * s else 1  # as it stands in the line
            told_so = cast("tuple[sp.Expr, sp.Expr]", (sign * written, sign * belongs))
            mistakes.append(of_multiplier(truth, found.row, s, x, *told_so))
    sources = [j for j, line in enumerate(lines) if line.kind != "equation" or id(line) in read]
    kept = tuple(read.get(id(lines[j]), lines[j]) for j in sources)
    found = kept, tuple(told), tuple(mistakes), tuple(slips), tuple(sources), tuple(best), pushes
    return ReadMultipliers(*found, scales={s: c for s, (_, c) in best.items()})


def _pushing(row: int, factor: sp.Expr, written: sp.Expr, right: sp.Expr) -> Pushing:
    """The factors on the right-hand side of an equation whose inertia is on the left, in its own scale."""
    sign = 1 if factor.could_extract_minus_sign() else -1
    return Pushing(row, *(cast("sp.Expr", bounded.cancel(sign * x)) for x in (written, right)))


_Reading = Mapping[Any, "tuple[Any, sp.Expr]"]
"""For every multiplier of the answer the one of the system that it stands for, and its scale."""


@dataclass(frozen=True, eq=False)
class _Match:
    """The right row that a row of the answer resembles most, the factor, and in how many slopes they agree."""

    row: int
    factor: sp.Expr | None
    count: float


def _score(found: Sequence[_Match]) -> float:
    return sum(m.count for m in found)


def _readings(
    truth: Reference, rows: Sequence[AnsweredLine], names: Sequence[Any], own: Sequence[Any]
) -> Iterator[_Reading]:
    """Every assignment of multipliers with every scale, the plain ones first."""
    for chosen in permutations(own, len(names)):
        scales = [_scales(truth, rows, s, x) for s, x in zip(names, chosen, strict=True)]
        for cs in product(*scales):
            yield {s: (x, c) for s, x, c in zip(names, chosen, cs, strict=True)}


def _scales(truth: Reference, rows: Sequence[AnsweredLine], s: Any, x: Any) -> list[sp.Expr]:
    """The scales c with which c·x in place of s has the right factor in some equation; ±1 first."""
    found: dict[sp.Expr, None] = {sp.S.One: None, sp.S.NegativeOne: None}
    for line in rows:
        mine = cast("sp.Expr", line.expr.diff(s))
        if mine == 0 or mine.has(s, *[c.acceleration for c in truth.model.coordinates]):
            continue
        for row in truth.rows:
            if (right := row.diff(x)) == 0:
                continue
            for f in _row_factors(truth, line.expr, row):
                c = bounded.cancel(f * right / mine)
                if bounded.size(c) <= LONGEST and len(found) < MOST_SCALES:
                    found[c] = None
    return list(found)


def _row_factors(truth: Reference, expr: sp.Expr, row: sp.Expr) -> list[sp.Expr]:
    """±1, and what an acceleration has in an equation and in a right one."""
    found: list[sp.Expr] = [sp.S.One, sp.S.NegativeOne]
    for c in truth.model.coordinates:
        mine, right = expr.diff(c.acceleration), row.diff(c.acceleration)
        if mine != 0 and right != 0:
            found.append(cast("sp.Expr", bounded.cancel(mine / right)))
    return list(dict.fromkeys(found))


def _matched(truth: Reference, exprs: Sequence[sp.Expr], reading: _Reading, own: Sequence[Any]) -> list[_Match]:
    """For every row the right row with which the most slopes agree, but for a factor; each right row once."""
    table = {s: c * x for s, (x, c) in reading.items()}
    read = [cast("sp.Expr", e.xreplace(table)) for e in exprs]
    by = _by(truth, own)
    mine, right = _slopes(truth, read, by), _right_slopes(truth, tuple(by))
    cells = sorted(
        ((count, -j, -i, k) for j, m in enumerate(mine) for i, r in enumerate(right) for count, k in [agreeing(m, r)]),
        reverse=True,
    )
    found: dict[int, _Match] = {}
    for count, j, i, k in cells:
        if -j not in found and all(m.row != -i for m in found.values()):
            factor = None if k is None else _quotient(read[-j], truth.rows[-i], by[k])
            if factor is not None and factor.has(*truth.derivation.coordinates):  # rather that of an inertia
                k = agreeing(mine[-j], right[-i], truth.n)[1]
                factor = factor if k is None else _quotient(read[-j], truth.rows[-i], by[k])
            found[-j] = _Match(-i, factor, count)
    return [found.get(j, _Match(0, None, 0.0)) for j in range(len(exprs))]


@lru_cache(maxsize=1024)
def _quotient(expr: sp.Expr, row: sp.Expr, by: Any) -> sp.Expr:
    """What a slope of an equation is of that of a right one."""
    return cast("sp.Expr", bounded.cancel(expr.diff(by) / row.diff(by)))


def _by(truth: Reference, own: Sequence[Any]) -> list[Any]:
    model = truth.model
    by = [c.acceleration for c in model.coordinates] + [c.rate for c in model.coordinates]
    return [*by, *(x.symbol for x in (*model.inputs, *model.parameters)), *own]


@lru_cache(maxsize=64)
def _right_slopes(truth: Reference, by: tuple[Any, ...]) -> Array:
    return _slopes(truth, truth.rows, by)


def _slopes(truth: Reference, exprs: Sequence[sp.Expr], by: Sequence[Any]) -> Array:
    """The slopes of every row by accelerations, rates, inputs, parameters and multipliers, (k, m, S)."""
    return CompiledExpressions(exprs).slopes(by).at(truth.states).reshape(len(exprs), len(by), truth.states.size)


def _right(truth: Reference, found: _Match, x: Any) -> sp.Expr | None:
    """What a multiplier of the system has for a factor in a row of the answer."""
    return None if found.factor is None else cast("sp.Expr", found.factor * truth.rows[found.row].diff(x))
