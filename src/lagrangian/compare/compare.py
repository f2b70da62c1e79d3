"""The comparison of two derivations, from the change of coordinates to the verdict.

With ξ = φ(η) and J = ∂ξ/∂η: T*_η = T*_ξ(φ), V_η = V_ξ(φ) + a constant, Ξ_η = Jᵀ Ξ_ξ, and the equations of motion in η
are Jᵀ times those in ξ. So every row of one set is a sum of rows of the other, as in the lecture's comparison of its
examples 3A and 3B.
"""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from typing import Any, Protocol, TypeAlias, cast, runtime_checkable

import sympy as sp

from lagrangian import bounded
from lagrangian.advice import Advice, Argument
from lagrangian.compare.comparison import Comparison
from lagrangian.compare.differences import differing, parameter_differences, unmatched
from lagrangian.compare.given import given_change
from lagrangian.compare.match import agreement, places, solved
from lagrangian.compare.motions import compared_motions, motion_words
from lagrangian.compare.rows import ComparedSystem, EquationRow, Rewritten
from lagrangian.compare.shared import Shared, inverse
from lagrangian.compare.words import combination, equality
from lagrangian.compare.zero import Zero, ZeroVerdict
from lagrangian.coordinates import Change, check_regular, is_regular
from lagrangian.derive import Derived
from lagrangian.errors import ModelError
from lagrangian.model import Model, is_hard
from lagrangian.page.formula import Check, Name, Partial, text
from lagrangian.structured.choose import AskedForm
from lagrangian.structured.predict import is_long

_log = logging.getLogger(__name__)

MOST_TERMS = 5000
"""Terms of the equations up to which two systems are compared row by row, exactly; longer ones by their motions."""


@runtime_checkable
class Derivable(Protocol):
    """Something that can be derived, such as a `System`."""

    def derive(self, *, form: AskedForm = "auto") -> Derived:
        """Return the derivation, with its equations in a form."""
        ...


def _hard(a: Derivable | Derived, b: Derivable | Derived, change: object = None, **_: object) -> bool:
    models = (getattr(x, "model", None) for x in (a, b))
    return any(is_hard(model) for model in models if model is not None)


@bounded.answered("the comparison of the systems", _hard)
def compare(a: Derivable | Derived, b: Derivable | Derived, change: Mapping[Any, Any] | None = None) -> Comparison:
    """Return a comparison of two systems (or their derivations): are they the same motion, and where do they differ?

    ``change`` expresses the coordinates of one system in those of the other, ``{"x2": "x1 + x2r"}``. By default it is
    inferred from places that both systems have in common. Raises `ModelError` if it cannot be inferred, or is not a
    valid change.
    """
    a, b = _derived(a, "first"), _derived(b, "second")
    tag_a, tag_b = _letters(a, b)
    sides = ComparedSystem("A", a, tag_a), ComparedSystem("B", b, tag_b)
    if a.model.constraints or b.model.constraints or "structured" in (a.form, b.form):
        _log.info("comparing: motions that the constraints allow")
        return _by_motions(sides, change)
    if len(a.coordinates) != len(b.coordinates):
        return _of_other_size(sides)
    _log.info("comparing: how the coordinates follow from each other")
    found, turned, assumed = _correspondence(a.model, b.model, change)
    source, into = reversed(sides) if turned else sides
    shared = Shared(source.derivation, into.derivation, found)
    _log.info("comparing: equation by equation")
    return _compared(sides, (source, into), shared, assumed)


def _derived(thing: object, which: str) -> Derived:
    if isinstance(thing, Derived):
        return thing
    if not isinstance(thing, Derivable):
        raise ModelError(
            f"the {which} of the two is not a system (got {type(thing).__name__})",
            fix="compare(System, System), or their derivations",
            code="E406",
        )
    model = getattr(thing, "model", None)
    exact = model is not None and not model.constraints and not model.floating and not is_long(model, MOST_TERMS)
    return thing.derive(form="expanded" if exact else "auto")


def _by_motions(sides: tuple[ComparedSystem, ComparedSystem], given: Mapping[Any, Any] | None) -> Comparison:
    """The comparison of two systems of which one has constraints, or equations that are too long to be compared."""
    a, b = (side.derivation.model for side in sides)
    change, turned, assumed = _embedding(a, b, given)
    source, into = reversed(sides) if turned else sides
    found = compared_motions(source.derivation.model, into.derivation.model, change, (source.tag, into.tag))
    values = parameter_differences(a, b)
    return Comparison(
        *sides,
        source,
        into,
        same=found.same and all(p.missing for p in values),
        equations_same=found.same,
        change=change,
        J=change.jacobian,
        assumed=assumed,
        motions=found.checks,
        parameters=values,
        why=motion_words(found.same, found.first, bound=bool(a.constraints or b.constraints)),
    )


def _embedding(a: Model, b: Model, given: Mapping[Any, Any] | None) -> tuple[Change, bool, bool]:
    """The coordinates of one system in those of the other, of which there may be fewer; the rest as below."""
    if given is not None:
        change, turned = given_change(a, b, given)
        return change, turned, False
    pairs = places(a, b)
    proposals: list[Proposal] = []
    for turned, one, other, seen in ((False, a, b, pairs), (True, b, a, pairs.swapped())):
        names = {c.name for c in other.coordinates}
        if all(c.name in names for c in one.coordinates):
            same = Change(one.coordinates, other.coordinates, {c.symbol: c.symbol for c in one.coordinates})
            proposals.append((agreement(one, same, seen), len(one.coordinates), same, turned))
            if proposals[-1][0] == 1:
                break
        for table in solved(one, other, seen):
            made = Change(one.coordinates, other.coordinates, table)
            proposals.append((agreement(one, made, seen), len(one.coordinates), made, turned))
    return _likeliest(a, b, proposals)


Proposal: TypeAlias = "tuple[float, int, Change, bool]"
"""How well a change fits, which one is preferred of those that fit equally well, the change, and its direction."""


def _likeliest(a: Model, b: Model, proposals: Sequence[Proposal]) -> tuple[Change, bool, bool]:
    """The change that fits best, its direction, and whether it is based on equal names alone."""
    if proposals:
        score, _, change, turned = max(proposals, key=lambda p: p[:2])
        return change, turned, score < 1
    ours, theirs = (", ".join(c.name for c in m.coordinates) for m in (a, b))
    raise ModelError(
        f"how {ours} of '{a.name}' follow from {theirs} of '{b.name}' cannot be found by comparing positions",
        fix=Advice("say it: ", Argument("change", "'x1 + x2r'", "x2"), ", coordinates of one by those of the other"),
        code="E210",
    )


def _letters(a: Derived, b: Derived) -> tuple[str, str]:
    """The lecture's letters, a for absolute and r for relative, if they distinguish the two systems; otherwise a and
    b."""
    measured = [d.steps[1].expressions.get("relative", {}) for d in (a, b)]
    relative = [any(to is not None for to in found.values()) for found in measured]
    return ("r", "a") if relative == [True, False] else ("a", "r") if relative == [False, True] else ("a", "b")


def _of_other_size(sides: tuple[ComparedSystem, ComparedSystem]) -> Comparison:
    a, b = sides
    counts = [len(s.derivation.coordinates) for s in sides]
    why = text(
        f"(A) has {counts[0]} generalized coordinate{'s' if counts[0] != 1 else ''} and (B) has {counts[1]}: "
        "they cannot describe the same motion."
    )
    models = a.derivation.model, b.derivation.model
    return Comparison(
        a, b, a, b, False, False, differences=unmatched(*models), parameters=parameter_differences(*models), why=why
    )


def _correspondence(a: Model, b: Model, given: Mapping[Any, Any] | None) -> tuple[Change, bool, bool]:
    """The change, whether it expresses (B)'s coordinates in (A)'s, and whether it is based on equal names alone."""
    if given is not None:
        change, turned = given_change(a, b, given)
        check_regular(b if turned else a, change)
        return change, turned, False
    pairs = places(a, b)
    proposals: list[Proposal] = []
    names = {c.name: c for c in b.coordinates}
    if all(c.name in names for c in a.coordinates):
        same = Change(a.coordinates, b.coordinates, {c.symbol: c.symbol for c in a.coordinates})
        proposals.append((agreement(a, same, pairs), 2, same, False))
    if not proposals or proposals[0][0] < 1:
        for turned, one, other, seen in ((False, a, b, pairs), (True, b, a, pairs.swapped())):
            for table in solved(one, other, seen):
                made = Change(one.coordinates, other.coordinates, table)
                if is_regular(one, made):
                    proposals.append((agreement(one, made, seen), 1 - turned, made, turned))
                if proposals and proposals[-1][0] == 1:
                    break
            if proposals and proposals[-1][0] == 1:
                break
    return _likeliest(a, b, proposals)


def _compared(
    sides: tuple[ComparedSystem, ComparedSystem],
    roles: tuple[ComparedSystem, ComparedSystem],
    shared: Shared,
    assumed: bool,
) -> Comparison:
    source, into = roles
    zero = Zero(shared.b, [*shared.energies("T*"), *shared.energies("V")])
    rewritten = _rewritten(source, into, shared, zero)
    J = shared.J
    theirs, ours = shared.rows_b, shared.rows_a
    names = tuple(r.label for r in rewritten)
    rows = tuple(_row(zero, into.label(j), tuple(J.col(j)), names, theirs[j], ours) for j in range(J.cols))
    back: tuple[EquationRow, ...] = ()
    if (upside := inverse(J)) is not None:
        labels = tuple(into.label(j) for j in range(J.cols))
        back = tuple(_row(zero, names[i], tuple(upside.col(i)), labels, ours[i], theirs) for i in range(J.rows))
    equations_same = all(r.holds for r in rows)
    a, b = sides
    values = parameter_differences(a.derivation.model, b.derivation.model)
    forces = _forces(zero, shared)
    energies = _energies(zero, shared)
    booked = equations_same and all(c.holds for c in (*forces, *energies))
    return Comparison(
        a,
        b,
        source,
        into,
        same=equations_same and all(p.missing for p in values),
        equations_same=equations_same,
        change=shared.change,
        J=J,
        assumed=assumed,
        rewritten=rewritten,
        rows=rows,
        back=back,
        energies=energies,
        forces=forces,
        differences=() if booked else differing(zero, shared, turned=source is b),
        parameters=values,
    )


def _rewritten(source: ComparedSystem, into: ComparedSystem, shared: Shared, zero: Zero) -> tuple[Rewritten, ...]:
    """The rows of one set in the coordinates of the other: B-1, B-2."""
    found = []
    for i, equation in enumerate(source.derivation.equations):
        left, right = (_readable(zero, shared.seen(cast("sp.Expr", x))) for x in (equation.lhs, equation.rhs))
        found.append(Rewritten(f"{into.tag}-{i + 1}", source.label(i), left, right))
    return tuple(found)


def _readable(zero: Zero, expr: sp.Expr) -> tuple[sp.Expr, ...]:
    form = zero.form(expr)
    return tuple(t.expr for t in form.terms()) if form is not None else sp.Add.make_args(expr)


def _row(
    zero: Zero,
    label: str,
    factors: tuple[sp.Expr, ...],
    of: tuple[str, ...],
    row: sp.Expr,
    others: tuple[sp.Expr, ...],
) -> EquationRow:
    terms = [(sp.S.NegativeOne, row)]
    terms += [(f, e) for f, e in zip(factors, others, strict=True) if f != 0]
    verdict = zero.vanishes(terms)
    words = combination(label, factors, of, holds=verdict.holds)
    rest = sp.S.Zero if verdict.holds else zero.readable(-sp.Add(*(f * e for f, e in terms)))
    return EquationRow(
        label, factors, of, words, Check(equality(label, factors, of), verdict.holds, verdict.figure), rest
    )


def _energies(zero: Zero, shared: Shared) -> tuple[Check, ...]:
    """Compare T* and V, the latter up to terms that vanish in derivatives."""
    T, V = (shared.energies(column) for column in ("T*", "V"))
    found = [
        Check(text(Name("T*"), " is the same"), *_pair(zero.vanishes([(sp.S.One, T[0]), (sp.S.NegativeOne, T[1])])))
    ]
    verdict = zero.vanishes([(sp.S.One, V[0]), (sp.S.NegativeOne, V[1])])
    words = text(Name("V"), " is the same")
    if not verdict.holds:
        slopes = [zero.vanishes([(sp.S.One, sp.diff(V[0] - V[1], c.symbol))]) for c in shared.b.coordinates]
        if all(s.holds for s in slopes):
            verdict, words = slopes[0], text(Name("V"), " is the same up to what does not depend on the coordinates")
    return (*found, Check(words, *_pair(verdict)))


def _forces(zero: Zero, shared: Shared) -> tuple[Check, ...]:
    """Check Ξ_j = Σ_i J_ij Ξ_i for every new coordinate j."""
    found = []
    for j, c in enumerate(shared.b.coordinates):
        terms = [(sp.S.NegativeOne, shared.Xi_b[j])]
        terms += [(shared.J[i, j], x) for i, x in enumerate(shared.Xi_a) if shared.J[i, j] != 0]
        verdict = zero.vanishes(cast("list[tuple[sp.Expr, sp.Expr]]", terms))
        whose = text(Name("Xi", str(j + 1)), " is the sum of ", Partial(Name("xi", "i"), c.symbol), " Ξᵢ")
        found.append(Check(whose, *_pair(verdict)))
    return tuple(found)


def _pair(verdict: ZeroVerdict) -> tuple[bool, str]:
    return verdict.holds, verdict.figure
