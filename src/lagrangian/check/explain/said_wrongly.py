"""What the definitions of an answer say of the quantities of a system, rightly or wrongly."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import cached_property, lru_cache, partial
from typing import cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.apart import beside, folded, moving_part, rescales, told_apart
from lagrangian.check.explain.dampers_said import damper_share
from lagrangian.check.explain.meant import (
    PART_OF,
    TRIVIAL,
    is_about_centre,
    is_along,
    is_entry,
    is_meant,
    kinds_of,
    owner_of,
)
from lagrangian.check.explain.misconceptions import Ingredients
from lagrangian.check.explain.plain_speeds import plain_speed
from lagrangian.check.explain.quantities import LEVEL, SIGNED, Sayables, accelerations_of, quantities_of
from lagrangian.check.explain.quoted import letters_in
from lagrangian.check.explain.rates_apart import carried_apart, rates_apart
from lagrangian.check.explain.said_words import CALLED, NAMES, OF_MANY_TERMS, STEPS, WHY_RELATIVE, of_terms, why_of
from lagrangian.check.explain.sayable import Effect, Sayable
from lagrangian.check.explain.search import without_constant
from lagrangian.check.explain.sense_counted import senses, value_of
from lagrangian.check.explain.which_said import of_owner_said
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.stated import left_values
from lagrangian.check.terms.signs import turned
from lagrangian.check.verdict import AnsweredLine, Mistake
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.model import Body, time
from lagrangian.page.formula import Left, Text, text
from lagrangian.records import dataclass

LONGEST = 60
"""The largest number of operations of such a definition."""
OF_RATES = frozenset(["turning", "speed", "component", "along", "rate"])
"""Kinds of what holds rates."""
OF_MOTION = ("kinetic", "translation", "rotation", "potential")
"""Kinds of energies, which are nowhere said to be constant."""
PLACED = ("position", "height")
"""The kinds of quantities that are counted from a place of the answer's own."""
NEAR = 1e-9
"""The relative difference of values that is rounding."""


@dataclass(frozen=True, eq=False)
class InWords:
    """What a definition has wrong, as a sentence says it."""

    of: Sayable
    right: tuple[str | Left, ...]
    """What is right, in the sense in which the answer counts it."""
    written: tuple[str | Left, ...]
    letters: frozenset[sp.Basic]
    """The letters, coordinates and rates in what is right and in what is written."""
    apart: tuple[str | Left, ...] = ()
    """In which term both differ, at the end of the sentence."""
    why: Text | None = None
    """Why it is wrong, if that is not what is said of all such quantities."""


@dataclass(frozen=True, eq=False)
class SaidWrongly:
    """One quantity that a definition has wrong, and what this adds to T*, to V, to every Ξ_i and to left-hand sides."""

    line: AnsweredLine
    effect: Effect
    say: Callable[[], InWords]
    """Makes the words, which few of all are asked for."""
    elsewhere: bool = False
    """Whether what is written is right for another quantity."""
    others: tuple[str, ...] = ()
    """The other elements of which the same may be said."""
    right: sp.Expr | None = None
    """The value that the name should have, where it is known."""

    @cached_property
    def words(self) -> InWords:
        """What is wrong, as a sentence says it."""
        return self.say()

    @property
    def letters(self) -> frozenset[sp.Basic]:
        """The letters, coordinates and rates in what is right and in what is written."""
        return self.words.letters

    @property
    def number(self) -> int:
        """The line in which it is said."""
        return self.line.number

    @property
    def T(self) -> sp.Expr:
        """What it adds to T*."""
        return self.effect.T

    @property
    def V(self) -> sp.Expr:
        """What it adds to V."""
        return self.effect.V

    @property
    def mistake(self) -> Mistake:
        """The mistake in words."""
        of = self.words.of
        kind, owner = of.kind, of.owner
        of_body = isinstance(owner, Body) or (owner is not None and self.T != 0)
        own = f"{NAMES.get(kind, kind)}_{'of_body' if of_body else 'said'}"
        begins = f"Line {self.number} is not right: the "
        either = tuple(f" or {x}" for x in self.others)
        what = text(begins, *of.words, *either, " is ", *self.words.right, ", not ", *self.words.written, *self._ending)
        title = " or ".join((" and ".join((owner.title, *of.also)), *self.others)) if owner is not None else None
        words = of.words if owner is None else (f"{CALLED.get(kind, kind)} of {title}",)
        brief = text("The ", *words, " is not right.")
        return Mistake(own, what, self._why, STEPS.get(kind, 2), title, of.coordinate, brief)

    @property
    def _why(self) -> Text:
        """Why it is wrong: a term of letters that all are there is one of a sum that was not squared as a whole."""
        if self.words.why is not None:
            return self.words.why
        of, differ = self.words.of, [x for x in self.words.apart if isinstance(x, sp.Expr)]
        has_sum = any(isinstance(x, sp.Expr) and x.has(sp.Add) for x in self.words.written)
        squared = of.kind == "mass" or (str(of.words[0]).startswith("square") and has_sum)
        whole = squared and differ and all(letters_in(x) <= self.own_letters for x in differ)
        return (of_terms(differ) if whole else None) or why_of(of.kind, of.right, self.words.apart)

    @property
    def _ending(self) -> tuple[str | Left, ...]:
        return self.words.apart or (".",)

    @property
    def own_letters(self) -> set[sp.Basic]:
        """The letters, coordinates and rates in what is written."""
        return {y for x in self.words.written if isinstance(x, sp.Expr) for y in letters_in(x)}

    def adds(self, truth: Reference, kind: str, i: int | None) -> sp.Expr:
        """What it adds to an energy, to Ξ_i or to a derivative of L by ξ_i."""
        e = self.effect
        if kind in ("T", "V", "L", "D"):
            return {"T": e.T, "V": e.V, "L": e.T - e.V, "D": e.D}[kind]
        if i is None:
            return sp.S.Zero
        if kind == "Xi":
            return e.Xi[i] if e.Xi else sp.S.Zero
        c, L = truth.model.coordinates[i], e.T - e.V
        if kind == "slope":
            return bounded.diff(L, c.symbol)
        momentum = bounded.diff(L, c.rate)
        if kind == "p":
            return momentum
        rate = bounded.diff(momentum, time)
        return rate if kind == "p-rate" else rate - bounded.diff(L, c.symbol)

    def rows(self, truth: Reference) -> Array:
        """What it adds to the left-hand side of every equation, left minus right, at every state."""
        values = left_values(truth, self.T - self.V)
        for parts, sign in ((self.effect.Xi, -1), (self.effect.left, 1)):
            values = values + sign * CompiledExpressions(list(parts)).at(truth.states) if parts else values
        return values


def in_names_of(truth: Reference, line: AnsweredLine, *, accelerating: bool = False) -> sp.Expr | None:
    """What a definition says, in names of the system; None if it says nothing that could be a quantity of it, or an
    acceleration, unless these are asked for."""
    if line.kind != "definition" or bounded.operations(line.expr) > LONGEST:
        return None
    if line.name in truth.model.symbols:
        return None
    said = truth.expand(line.expr)
    foreign = said.free_symbols - truth.names
    if foreign or (not accelerating and _accelerates(truth, said)):
        return None
    return said if letters_in(said) or said == 0 else None


def _accelerates(truth: Reference, said: sp.Expr) -> bool:
    return said.has(*(c.acceleration for c in truth.model.coordinates))


def _quantities(truth: Reference, said: sp.Expr) -> Sayables:
    """The quantities that what is said may be of: accelerations if it holds any."""
    return accelerations_of(truth) if _accelerates(truth, said) else quantities_of(truth)


def _plausible(truth: Reference, line: AnsweredLine, said: sp.Expr, turned: bool, *, parts: bool = False) -> list[int]:
    """The places of the quantities that a name may stand for by its letters; only Q_… for a generalized force.

    If its axes are ``turned``, v_x is no component along the fixed one. Accelerations have names of any letters. With
    ``parts``, T_2 may be the energy of a translation alone.
    """
    every, name = _quantities(truth, said).all, line.name or ""
    owner = owner_of(name, truth.model)
    if _accelerates(truth, said):
        own = [k for k, q in enumerate(every) if owner in (None, q.owner)]
        known = set[sp.Basic]().union(*(every[k].right.free_symbols for k in own))
        return own if said.free_symbols <= known else list(range(len(every)))  # a1 may be along the first axis
    kinds = kinds_of(name)
    kinds = None if kinds is not None and set(kinds) <= OF_RATES and _is_place(truth, line) else kinds
    found = [
        k for k, q in enumerate(every) if (q.kind != "Xi" if kinds is None else PART_OF.get(q.kind, q.kind) in kinds)
    ]
    for b in truth.model.bodies if kinds is not None else ():
        if is_about_centre(name, b, truth.model):  # no other axis, nor all that moves with a coordinate
            found = [k for k in found if every[k].kind != "mass" and (every[k].kind, every[k].owner) != ("axis", b)]
    found = [k for k in found if _is_meant(every[k], name, turned, parts)]
    own = [k for k in found if owner is None or every[k].owner is owner or not isinstance(every[k].owner, Body)]
    return own or found  # J_P is the moment of inertia about P


def _is_meant(q: Sayable, name: str, turned: bool, parts: bool) -> bool:
    meant = q.kind == "along" if turned else (parts and q.kind in PART_OF) or is_meant(q.kind, name)
    return meant and is_along(q.axis, name) and is_entry(q.entry, name)


def _is_place(truth: Reference, line: AnsweredLine) -> bool:
    """Whether what is said moves and has no rates: w = 2 y − u is no angular velocity."""
    s, said = quantities_of(truth).of, truth.expand(line.expr)
    return not said.has(*s.v) and said.has(*s.q)


def right_quantities(truth: Reference, line: AnsweredLine, *, but: bool = False, turned: bool = False) -> list[Sayable]:
    """The quantities whose value a definition has, as it counts them, along ``turned`` axes if those are meant; with
    ``but``, a constant more does not matter."""
    return list(_right_quantities(truth, line, but, turned))


@lru_cache(maxsize=500)
def _right_quantities(truth: Reference, line: AnsweredLine, but: bool, turned: bool) -> tuple[Sayable, ...]:
    """The same, kept: many ask it of the same lines."""
    said = in_names_of(truth, line, accelerating=True)
    trivial = said is None or _is_trivial(said)
    if said is None or (trivial and kinds_of(line.name or "") is None):
        return ()
    every = _quantities(truth, said)
    values = CompiledExpressions([said]).at(truth.states)[0]
    found: list[Sayable] = []
    for k in _plausible(truth, line, said, turned) if np.isfinite(values).all() else ():
        q, right = every.all[k], every.values[k]
        if (trivial and q.kind not in TRIVIAL) or (q.kind == "restoring" and not every.of.moves(said)):
            continue  # M g may be a weight, or what a rope is said to pull
        for x, expr in _readings(q, values, said):
            rest = x - right
            rest = without_constant(rest) if but and q.kind in LEVEL else rest
            near = np.abs(rest).max() <= NEAR * (1 + np.abs(right).max())
            if near and (but or zero_everywhere(truth, expr - every.rights[k])):
                found.append(
                    q if expr is said or q.kind != "speed" else replace(q, words=(f"speed of {q.owner.title}",))
                )
                break
    return tuple([q for q in found if q.kind != "along"] or found)


def _readings(q: Sayable, values: Array, said: sp.Expr) -> Iterator[tuple[Array, sp.Expr]]:
    """What is written, as the quantity is counted: in either sense, or its square."""
    yield values, said
    if q.kind in SIGNED:
        yield -values, -said
    if q.kind == "speed":
        yield values**2, said**2


def _is_trivial(said: sp.Expr) -> bool:
    """Whether a value is nothing but a letter, a coordinate or a rate."""
    bare = -said if said.could_extract_minus_sign() else said
    return bool(bare.is_Symbol or bare.is_Function or isinstance(bare, sp.Derivative) or bare.is_number)


def said_of(truth: Reference, line: AnsweredLine, *, turned: bool = False) -> Iterator[SaidWrongly]:
    """What a definition may say wrongly of the quantities that its name may stand for."""
    said = in_names_of(truth, line, accelerating=True)
    if said is None or (_is_trivial(said) and kinds_of(line.name or "") is None):
        return
    every, right = _quantities(truth, said), right_quantities(truth, line, but=True, turned=turned)
    right, own = of_owner_said(truth, line, right), {id(q) for q in of_owner_said(truth, line, every.all)}
    placed = all(q.kind in PLACED for q in right)  # R + s sin θ is the height s sin θ from another place, if it is that
    exact = of_owner_said(truth, line, right_quantities(truth, line, turned=turned)) if placed else right
    s, elsewhere = every.of, bool(exact)
    for k in _plausible(truth, line, said, turned, parts=True):
        q = every.all[k]
        if id(q) not in own or not _alike(s, q, said) or any(q is x for x in right):
            continue
        for written, sign in senses(truth, q, said):
            effect = put(truth, q.adds(sign * written))
            if effect.T != 0 or effect.V != 0 or any(effect.Xi) or any(effect.left):
                words, value = partial(in_words, s, q, written, sign), value_of(q, said, written, sign)
                yield SaidWrongly(line, effect, words, elsewhere, right=None if value is None else truth.put(value))


def in_words(s: Ingredients, q: Sayable, written: sp.Expr, sign: int) -> InWords:
    """What is wrong in a quantity, as the answer counts it."""
    if (share := damper_share(s, q, written)) is not None:
        return replace(
            told(share.of, [share.right], [share.written], (share.right,), (share.written,)), apart=share.ending
        )
    square, (q, written) = q, plain_speed(q, written) if q.kind == "speed" else (q, written)
    of, right, own = _narrowed(q, q.right if sign > 0 else turned(q.right), written, sign)
    right = moving_part(s, right, own) if q is square and q.kind in ("speed", "kinetic", "translation") else right
    right = _from_its_place(s, right, own) if q.kind in ("position", "height") else right
    right = folded(s, right)
    apart = rates_apart(right, own) if q.kind in OF_RATES else ()
    carried = carried_apart(right, own) if q.kind in ("component", "along") and not apart else ()
    if not apart and not carried and (q.kind in OF_MANY_TERMS or own.is_Add or right.is_Add):
        apart = told_apart(s, right, own)
    right = beside(s, right, own) if q.kind in ("speed", "kinetic") and not rescales(apart) else right
    why = WHY_RELATIVE if carried else None
    return replace(told(of, [right], [own], (right,), (own,)), apart=apart or carried, why=why)


def _from_its_place(s: Ingredients, right: sp.Expr, own: sp.Expr) -> sp.Expr:
    """A coordinate of a body, counted from the place from which the answer counts it: no constant in it is wrong."""
    level, counted = ([x for x in sp.Add.make_args(e) if not s.moves(x) and not x.has(time)] for e in (right, own))
    return right if level == counted else sp.Add(right, *(-x for x in level), *counted)


def told(
    of: Sayable,
    right: Iterable[sp.Expr],
    written: Iterable[sp.Expr],
    in_sentence: tuple[str | Left, ...],
    as_written: tuple[str | Left, ...],
) -> InWords:
    """The words about expressions that a sentence shows in some form."""
    return InWords(of, in_sentence, as_written, frozenset(y for x in (*right, *written) for y in letters_in(x)))


def said_of_rate(truth: Reference, line: AnsweredLine) -> Iterator[SaidWrongly]:
    """What a wrong rate of a place of the answer's own, ẏ = …, may say wrongly of the velocity of each body."""
    every, rest = quantities_of(truth), truth.expand(line.expr)
    if bounded.operations(rest) > LONGEST or rest.free_symbols - truth.names:
        return
    for q in (q for q in every.all if q.kind == "component"):
        for sign in (1, -1):
            written = bounded.expand(sign * q.right - rest)
            effect = put(truth, q.adds(sign * written))
            yield SaidWrongly(line, effect, partial(_of_rate, every.of, q, bounded.expand(sign * q.right), written))


def _of_rate(s: Ingredients, q: Sayable, right: sp.Expr, written: sp.Expr) -> InWords:
    """What is wrong in the rate of a place."""
    return replace(told(q, [right], [written], (right,), (written,)), apart=told_apart(s, right, written))


def _narrowed(q: Sayable, right: sp.Expr, written: sp.Expr, sign: int) -> tuple[Sayable, sp.Expr, sp.Expr]:
    """Of a sum of forces, the only one that is wrong, with what is right and what is written of it."""
    for k, (element, part) in enumerate(q.parts):
        others = sp.Add(*[sign * x for j, (_, x) in enumerate(q.parts) if j != k])
        factor = sp.Mul(*[x for x in sp.Mul.make_args(part) if x.is_Symbol])
        way = bounded.expand(bounded.expand(written - others) / factor)
        if way.free_symbols <= (part / factor).free_symbols:
            own = replace(q, owner=element, words=(f"force of {element.title}",))
            return own, sign * part, cast("sp.Expr", factor * way)
    return q, right, written


def put(truth: Reference, effect: Effect) -> Effect:
    """An effect with the values that are put in."""
    T, V, D = (truth.put(sp.sympify(x)) for x in (effect.T, effect.V, effect.D))
    Xi, left = (tuple(truth.put(sp.sympify(x)) for x in parts) for parts in (effect.Xi, effect.left))
    return Effect(T, V, Xi, left, D)


def _alike(s: Ingredients, q: Sayable, said: sp.Expr) -> bool:
    """Whether what is written may be a value of a quantity: constant, or of positions or rates alone, as this is, and
    with a letter of its own."""
    moves, rates = s.moves(said), said.has(*s.v)
    if _is_trivial(said) and q.kind not in TRIVIAL:
        return False
    if q.kind in ("inertia", "axis"):
        return not moves and not rates
    if q.kind in ("position", "height", "apart", "deflection"):
        return not rates and (moves or (q.kind == "position" and s.rate(said) != 0))
    if q.kind in ("turning", "speed", "component", "along"):
        return bool(rates) or (said == 0 and q.kind in ("component", "along"))
    if q.kind == "rate":
        return bool(moves or rates)
    if q.kind == "acceleration":
        return True
    if q.kind in OF_MOTION and not moves and not rates:
        return False  # P = m g is a force
    common = letters_in(said) & letters_in(q.right)
    return q.kind == "Xi" or any(x.is_Symbol for x in common)
