"""Answers with energies as they are seen in a frame that is carried along as prescribed, a float or a turning table.

    T*     ½ m v² of the velocities relative to that frame
    V      has m a·r of the inertia forces, or −½ m (Ω × r)²
    Ξ      has −m a·∂r/∂ξ instead

The equations of motion are the same. The answer is judged with the same system at rest, under its inertia forces.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any, TypeAlias, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reading import Answer
from lagrangian.check.reference import Reference, truth_of
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status, Verdict
from lagrangian.coordinates import Carrier, Change
from lagrangian.derive import Derived, derive
from lagrangian.errors import Error, ParseError
from lagrangian.model import Body, Definition, Element, GeneralizedForce, Kinetic, Model, Potential, time
from lagrangian.page.formula import Text, text
from lagrangian.records import dataclass

_SEEN = ("T", "L", "p", "p-rate", "slope", "T-p", "T-rate", "T-slope")
"""The kinds of lines that depend on the frame in which velocities are seen."""
_HOLDING = ("V", "L", "Xi", "slope", "V-slope")
"""The kinds of lines that show inertia forces by themselves."""
_STRONG = re.compile(
    r"fictitious|pseudo.?force|apparent\s+(?:force|weight|grav)|inertia(?:l)?\s+(?:force|potential|term)|"
    r"d.?alembert|effective\s+grav|scheinkr[aä]ft|tr[äa]gheitskr[äa]ft",
    re.IGNORECASE,
)
"""Words that speak of inertia forces."""
_WEAK = re.compile(r"\brel(?:ative|\.|ativ)|\bframe\b|mitbewegt|mitgef[üu]hrt|co-?moving", re.IGNORECASE)
"""Words that may speak of a frame that is carried along."""
_GROUND, _FRAME = "seen from the ground", "seen from the frame that is carried along"


class _OfInertia:
    """What comes from the inertia forces on one element."""

    of: str

    @property
    def title(self) -> str:
        """What they act on."""
        return f"the inertia force on {self.of}"


@dataclass(frozen=True, eq=False, kw_only=True)
class InertiaPotential(_OfInertia, Potential):
    """The potential of the inertia forces on one element."""

    of: str = ""


@dataclass(frozen=True, eq=False, kw_only=True)
class InertiaForce(_OfInertia, GeneralizedForce):
    """What the inertia forces on one element do to a coordinate."""

    of: str = ""


@dataclass(frozen=True, eq=False)
class SeenSystem:
    """A system as it is seen in its frame, and the words that tell where its inertia forces are."""

    derivation: Derived
    told: Text
    bare: bool = False
    """Whether the inertia forces are left out, which makes its equations wrong."""
    apart: sp.Expr = sp.S.Zero
    """The potential of the inertia forces, where an answer has it in L but not in what it calls V."""

    def read(self, answer: Answer) -> Answer | None:
        """An answer as it is judged with this system: with the potential that stands apart in its V; None if no V of it
        is without."""
        letters = self.apart.free_symbols
        lacking = [x for x in answer.lines if x.kind == "V" and not x.rhs.free_symbols >= letters]
        if self.apart == 0:
            return answer
        whole = (replace(x, rhs=x.rhs + self.apart) if any(x is y for y in lacking) else x for x in answer.lines)
        return replace(answer, lines=tuple(whole), others=()) if lacking else None


Judging: TypeAlias = "Callable[[Derived, Answer], Verdict]"
"""Judges an answer with a system."""


def judged_as_carried(
    derivation: Derived, written: str, answer: Answer, judge: Judging, glance: Judging
) -> tuple[Verdict, Derived]:
    """The verdict on an answer, as it is seen from the ground or in a frame that is carried along if its lines are
    nearer to the energies there, and the system with which it was judged; ``glance`` judges without seeking mistakes.

    Inertia forces must be in its V or Ξ, or in its equations where it speaks of them: a prescribed motion that is
    nowhere was forgotten.
    """
    found = judge(derivation, answer)
    if found.right or not any(f.line.kind in _SEEN and _differs(f) for f in found.findings):
        return found, derivation
    amounts: list[tuple[int, SeenSystem, Answer]] = []
    for seen in _systems(derivation):
        if (read := seen.read(answer)) is not None:
            with suppress(ParseError):
                amounts.append((_wrong(glance(seen.derivation, read)), seen, read))
    full = [x for x in amounts if not x[1].bare]
    wrong = min((x[0] for x in full), default=_wrong(found) + 1)
    if wrong > _wrong(found):
        return found, derivation
    bare = min((x[0] for x in amounts if x[1].bare), default=0)
    held = _holds_inertia([x[1].derivation for x in amounts], found)
    spoken = _STRONG.search(written) and (held.anywhere or wrong < bare)
    if not (held.alone or spoken or (_WEAK.search(written) and held.anywhere and wrong)):
        return found, derivation
    best, chosen = found, derivation
    for _, seen, read in (x for x in full if x[0] == wrong):
        with suppress(ParseError):
            verdict = judge(seen.derivation, read)
            if verdict.right or _amount(verdict) < _amount(best):
                best, chosen = _as_seen(seen, verdict), seen.derivation
        if best.right:
            break
    return best, chosen


def _as_seen(seen: SeenSystem, verdict: Verdict) -> Verdict:
    """A verdict in the words of the frame that is carried along."""

    def said(mistake: Mistake) -> Mistake:
        parts = [x.replace(_GROUND, _FRAME) if isinstance(x, str) else x for x in mistake.why.parts]
        return replace(mistake, why=text(*parts))

    mistakes, others = (tuple(map(said, x)) for x in (verdict.mistakes, verdict.alternatives))
    return replace(verdict, notes=(seen.told, *verdict.notes), mistakes=mistakes, alternatives=others)


@dataclass(frozen=True)
class HeldInertia:
    """Where an answer has the letters of a prescribed motion: in an energy or force, or in any line at all."""

    alone: bool
    anywhere: bool


def _holds_inertia(systems: Sequence[Derived], verdict: Verdict) -> HeldInertia:
    """Whether what the verdict judges has the letters that stand in inertia forces alone."""
    of_each = [
        frozenset[sp.Basic]().union(*(x.free_symbols for x in (truth.T, truth.V, *truth.Xi)))
        for truth in map(truth_of, systems)
    ]
    letters = of_each[0].union(*of_each).difference(frozenset.intersection(*of_each), [time])
    found = [f.line for f in verdict.findings if letters and f.line.expr.has(*letters)]
    lines = [x for x in found if x.kind in (*_HOLDING, "equation", "left", "p-rate")]
    return HeldInertia(any(x.kind in _HOLDING and not _is_seen_from_ground(x) for x in lines), bool(lines))


def _is_seen_from_ground(line: AnsweredLine) -> bool:
    """Whether a line has products of time and rates, as energies have that are seen from the ground."""
    moving = bounded.atoms(line.expr, AppliedUndef, sp.Derivative)
    still = cast("sp.Expr", line.expr.xreplace(dict.fromkeys(moving, sp.S.One)))
    return line.kind in ("L", "slope") and time in still.free_symbols and line.expr.has(sp.Derivative)


def _differs(finding: Finding) -> bool:
    return finding.status is Status.WRONG or (finding.status.right and finding.note is not None)


def _wrong(verdict: Verdict) -> int:
    return sum(f.status is Status.WRONG for f in verdict.findings)


def _amount(verdict: Verdict) -> tuple[int, int, int, int]:
    """How many lines are wrong, in how many of them something is wrong that follows from none, how many energies are
    right in another sense, and how many terms differ."""
    others = sum(f.status.right and f.line.kind in ("T", "V", "L") and _differs(f) for f in verdict.findings)
    terms = sum(len(f.differences) for f in verdict.findings if f.status is Status.WRONG)
    return _wrong(verdict), sum(f.is_open for f in verdict.findings), others, terms


# -- the system in its frame ------------------------------------------------------------------------------------------


def _systems(derivation: Derived) -> Sequence[SeenSystem]:
    """The system as it is seen in its frame, with its inertia forces in Ξ or V, and without any; none if nothing is
    prescribed or the equations of motion would be others."""
    if derivation.multipliers or derivation.model.floating:
        return ()

    def made() -> Sequence[SeenSystem]:
        truth = truth_of(derivation)
        try:
            found = list(_seen(derivation.model))
        except Error:
            return ()
        return found if all(x.bare or _same_motion(truth, truth_of(x.derivation)) for x in found) else ()

    return derivation.model.remembered("seen in its frame", made)


def _same_motion(truth: Reference, other: Reference) -> bool:
    return all(zero_everywhere(truth, x - y) for x, y in zip(truth.rows, other.rows, strict=True))


def _seen(model: Model) -> Iterator[SeenSystem]:
    """The systems of `_systems`, whatever their equations are."""
    carried = ((e.title, Carried(model, e)) for e in model.elements if e.ledger == "T*")
    acting = {name: x for name, x in carried if x.prescribed}
    forces = {name: x.forces() for name, x in acting.items()}
    if not any(forces.values()):
        return
    begins = "T* was judged as it is seen in the frame that is carried along: the inertia forces there are in "
    in_xi = [e for name, x in forces.items() for e in _in_forces(model, name, x)]
    in_v = [e for name, x in acting.items() for e in _in_potential(model, name, x)]
    yield SeenSystem(derive(_at_rest(model, in_xi)), text(begins, "Ξ."))
    if potentials := [e.value for e in in_v if isinstance(e, InertiaPotential)]:
        both = "V and Ξ" if any(isinstance(e, InertiaForce) for e in in_v) else "V"
        found = derive(_at_rest(model, in_v))
        yield SeenSystem(found, text(begins, both, "."))
        told = text(begins, both, "; what you call V is without their potential.")
        yield SeenSystem(found, told, apart=sp.Add(*potentials))
    yield SeenSystem(derive(_at_rest(model, [])), text(begins, "Ξ."), bare=True)


class Carried:
    """What a prescribed motion adds to the energy of one element, T* = T₂ + T₁ + T₀ in the orders of rates."""

    def __init__(self, model: Model, element: Element) -> None:
        self.model, self.element = model, element
        whole = model.expand(element.kinetic(model))
        self.still: Any = {c.rate: sp.S.Zero for c in model.coordinates}
        back = cast("Any", {c.rate: -c.rate for c in model.coordinates})
        self.T_0 = bounded.expand(cast("sp.Expr", whole.xreplace(self.still)))
        self.T_1: sp.Expr = sp.S.Zero
        self.relative = whole
        if self.T_0 != 0:  # else it is at rest where all coordinates are
            turned = cast("sp.Expr", whole.xreplace(back))
            self.T_1 = bounded.expand((whole - turned) / 2)
            self.relative = (whole + turned) / 2 - self.T_0

    @property
    def prescribed(self) -> bool:
        """Whether it moves where all coordinates are at rest."""
        return self.T_1 != 0 or self.T_0.has(*(c.symbol for c in self.model.coordinates))

    def forces(self, *, in_full: bool = True) -> dict[int, sp.Expr]:
        """The generalized inertia forces, all of them or those of T₁, by the index of the coordinate."""
        T = self.T_1 + self.T_0 if in_full else self.T_1
        found: dict[int, sp.Expr] = {}
        for i, c in enumerate(self.model.coordinates):
            left = bounded.diff(bounded.diff(T, c.rate), time) - bounded.diff(T, c.symbol)
            if (force := bounded.expand(-left)) != 0:
                found[i] = force
        return found

    def potential(self) -> sp.Expr | None:
        """m a·r where the frame does not turn; None for any other."""
        if not isinstance(self.element, Body):
            return None
        moving = [c.symbol for c in self.model.coordinates]
        total: sp.Expr = sp.S.Zero
        for x in self.model.position(self.element.at):
            x = self.model.expand(x)
            speed = cast("sp.Expr", bounded.diff(x, time).xreplace(self.still))
            if speed.has(*moving):
                return None
            total += self.element.mass * bounded.diff(speed, time) * _without_time(x)
        whole = bounded.expand(total)
        return sp.Add(*[t for t in sp.Add.make_args(whole) if t.has(*moving)])


def _in_forces(model: Model, name: str, forces: dict[int, sp.Expr]) -> Iterator[Element]:
    for i, value in forces.items():
        c = model.coordinates[i]
        yield InertiaForce(coordinate=c.symbol, value=value, of=name, name=f"inertia force on {name} by {c.name}")


def _in_potential(model: Model, name: str, carried: Carried) -> Iterator[Element]:
    """Inertia forces in V as far as they have a potential that is found, else in Ξ."""
    V, forces = -carried.T_0, carried.forces(in_full=False)
    uniform = carried.potential() if forces else None
    if uniform is not None:
        V, forces = uniform, {}
    if V.has(*(c.symbol for c in model.coordinates)):
        yield InertiaPotential(value=V, of=name, name=f"inertia force on {name}")
    yield from _in_forces(model, name, forces)


@dataclass(frozen=True, eq=False, kw_only=True)
class _Standing(Change):
    """No change of coordinates, but every prescribed motion stands still where it is at t = 0."""

    model: Model

    def put_in(self, expr: sp.Expr) -> sp.Expr:
        """An expression with prescribed motions put in as they are at t = 0."""
        if expr not in self._memo:
            self._memo[expr] = _without_time(self.model.expand(expr))
        return self._memo[expr]


def _without_time(expr: sp.Expr) -> sp.Expr:
    """An expression at t = 0, where coordinates, rates and inputs keep their names."""
    names: Any = {x: sp.Dummy() for x in bounded.atoms(expr, AppliedUndef, sp.Derivative)}
    put: Any = expr.xreplace(names).xreplace({time: sp.S.Zero})
    return put.xreplace({d: x for x, d in names.items()})


class _Stopped(Carrier):
    """Builds the description of a system that is not carried; definitions keep what they say."""

    def definition(self, definition: Definition) -> sp.Expr:
        """What a definition stands for."""
        return definition.expression

    def elements(self, element: Element) -> Iterator[Element]:
        """The element at rest; an energy that is given is the one that is left."""
        for made in super().elements(element):
            yield (
                Kinetic(value=Carried(self.model, element).relative, name=element.name, place=element.place)
                if isinstance(element, Kinetic)
                else made
            )


def _at_rest(model: Model, acting: Sequence[Element]) -> Model:
    """The model of a system that is not carried, with inertia forces."""
    coordinates = model.coordinates
    change = _Standing(coordinates, coordinates, {c.symbol: c.symbol for c in coordinates}, model=model)
    builder = _Stopped(model, change, model.name).built()
    for element in acting:
        builder.add(element)
    return builder.model()
