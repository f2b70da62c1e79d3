"""Recognizes letters of energies and generalized forces that an answer uses for something else: D = (M + m)*mu - m^2,
then x'' = …/D."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence

from lark import Token, Tree

from lagrangian.check.reading.energy_parts import inertia_letters
from lagrangian.check.reading.nodes import inside, names_in, only_name, without_minus
from lagrangian.check.reading.stated import energy_of
from lagrangian.check.reading.subjects import Subjects
from lagrangian.model import Model
from lagrangian.read.letters import key, undotted

_CALLED = re.compile(
    r"\b(?:(?:effective|total|resulting|linear|small)[ ])?(?:stiffness|spring[ ](?:rate|constant)|(?:feder)?steifigkeit"
    r"|raideur|rigidité|(?:damping|lehr)[ ]?ratio|dämpfungs(?:grad|maß)|period|time[ ]constant|tension|torque|"
    r"schwingungsdauer|length|radius|power|leistung|puissance)[ ]\$?(?P<name>(?-i:[TVULKDRP]))(?:\([^()=\n]{1,12}\))?"
    r"(?=[ $]{0,2}=)",
    re.IGNORECASE,
)
POWER = "P"
"""The letter of a power, and of potential energy."""


def called_otherwise(text: str) -> frozenset[str]:
    """The letters of energies that the word in front of them calls something else: stiffness K = k − m g/l."""
    return frozenset(key(m["name"]) for m in _CALLED.finditer(text))


def own_letters(statements: Sequence[Sequence[Tree]], subjects: Subjects) -> frozenset[str]:
    """Return the letters of energies that statements, given by their sides, give a value that is no energy.

    These are T and D without any rate, V and L of constants alone, if an equation of motion uses them, a D of positions
    if any line does, and a D of constants alone beside no T or L; and those that an equation with accelerations uses
    alone, or whose rate the answer forms: D = m r^2 theta', dD/dt = 0. P is a power if rates stand in its value, P =
    F x' - b theta'^2, or if a rate alone is equated to it, dE/dt = P, and a force if constants alone do, P = m g; K
    and R are forces if there are none, K = k (x - u), and an equation of motion uses them, or neither a square nor an
    inertia is in them.
    """
    names, model = subjects.names, subjects.model
    moving = [any(map(subjects.moves, sides)) for sides in statements]
    first = [only_name(sides[0]) if len(sides) > 1 else None for sides in statements]
    given = {key(str(x[0])) for x in first if x is not None and not x[1]}
    energies = any(x is not None and energy_of(x[0], model, lhs=True) in ("T", "L") for x in first)
    found = {*_used_as_names(statements, first, subjects), *_cut_forces(statements, first, subjects), *names.called}
    if any(map(_equates_to_power, statements)) and not names.scope.meanings(POWER)[0]:
        found.add(POWER)
    rates = {key(str(x[0])) for x, moved in zip(first, moving, strict=True) if moved and x is not None and not x[1]}
    for k, (named, sides) in enumerate(zip(first, statements, strict=True)):
        kind = None if named is None or named[1] else energy_of(named[0], model, lhs=True)
        if named is None or kind is None:
            continue
        listed = [str(x) for side in sides[1:] for x, _ in names_in(side)]
        own = str(named[0]) == POWER and not names.scope.meanings(POWER)[0]
        constants = {p.name for p in model.parameters}
        fixed = bool(listed) and all(constants.issuperset(names.scope.meanings(x)[0] or [x]) for x in listed)
        if own and (moving[k] or fixed or any(key(x) in rates for x in listed)):
            found.add(POWER)
        rated = kind == "D" and (moving[k] or any(key(x) in rates for x in listed))
        if rated and _is_no_dissipation(sides, listed, subjects, rates):
            found.add(key(str(named[0])))
        if moving[k] or key(str(named[0])) in found:
            continue
        listing = zip(statements, first, moving, strict=True)  # T = …, T = … states an energy twice
        others = [s[1:] if x == named else s for s, x, moved in listing if moved and s is not sides]
        used = {str(x) for s in others for side in s for x, changing in names_in(side) if not changing}
        known = str(named[0]) in ("K", "R") and listed and all(names.scope.meanings(x)[0] for x in listed)
        known = known and (str(named[0]) in used or not _may_be_kinetic(sides[1:], listed, subjects))
        if known and not any(_is_energy(x, s, str(named[0]), model) for x, s in zip(first, statements, strict=True)):
            found.add(str(named[0]))  # the force of a spring, K = k (x - l sin θ), of which every name has a value
        meant = [name for x in listed for name in names.scope.meanings(x)[0]]
        if kind == "D" and not energies and _is_constant(sides, listed, meant, given, model):
            found.add(key(str(named[0])))
            continue
        own = {key(x) for x in listed if not names.scope.meanings(x)[0]}
        placed = own or any(c.name in meant for c in model.coordinates)
        if kind == "D" and placed and own <= given - rates and len(set(map(key, listed)) - own) == len(set(meant)):
            held = (str(x) for s in statements if s is not sides for side in s for x, _ in names_in(side))
            found |= {key(str(named[0]))} if str(named[0]) in held else set()  # R = e + l cos(theta) is an arm
            continue
        other = only_name(sides[1]) if len(sides) == 2 else None
        renamed = other is not None and not other[1] and bool(names.scope.meanings(other[0])[0])  # U = u, a voltage
        if kind in ("V", "L") and not renamed and any(names.changes(x) or key(x) in given for x in listed):
            continue
        if str(named[0]) in used and all(
            names.scope.meanings(x)[0] or key(x) in given or names.changes(x) for x in listed
        ):
            found.add(key(str(named[0])))
    return frozenset(found)


def _is_no_dissipation(
    sides: Sequence[Tree], listed: Sequence[str], subjects: Subjects, rates: Collection[str]
) -> bool:
    """Whether a value is the force of a damper, or holds masses and no square of a rate, as an angular momentum; the
    answer may have letters of its own for ``rates``."""
    momentum = _is_heavy(listed, subjects) and not any(_squares_rates(side, rates) for side in sides[1:])
    return _is_force_of_damper(sides) or momentum


def _is_measure(sides: Sequence[Tree]) -> bool:
    """Whether a value stands between bars, as a determinant: D = |M|."""
    values = [inside(x) for x in sides[1:]]
    return any(x.data == "call" and str(x.children[0]) == "abs" for x in values)


def _is_heavy(listed: Sequence[str], subjects: Subjects) -> bool:
    """Whether a mass or a moment of inertia is among names."""
    heavy = {x for body in subjects.model.bodies for x in inertia_letters(body, lengths=False)}
    return bool(heavy & {key(name) for x in listed for name in subjects.names.scope.meanings(x)[0]})


def _is_force_of_damper(sides: Sequence[Tree]) -> bool:
    """Whether a value begins with a minus and has no power, as the force of a damper does: drag D = -b x'.

    A dissipation function is never negative.
    """
    return len(sides) == 2 and without_minus(sides[1])[1] and not _squares(sides[1])


def _equates_to_power(sides: Sequence[Tree]) -> bool:
    """Whether a side of a statement is P, and another the rate of something: dE/dt = P, no potential energy."""
    alone = [only_name(side) for side in sides]
    named = any(x is not None and not x[1] and str(x[0]) == POWER for x in alone)
    rated = (
        getattr(inside(side), "data", "") == "rate" or (x is not None and x[1] == 1)
        for side, x in zip(sides, alone, strict=True)
    )
    return named and any(rated)


def _is_constant(
    sides: Sequence[Tree], listed: Sequence[str], meant: Sequence[str], given: Collection[str], model: Model
) -> bool:
    """Whether a D is a damping matrix of one row, [b], or a ratio, b/(2 sqrt(k m)), and no function of rates: it has
    letters of parameters alone or, as the fourth matrix beside A, B and C, is 0, as is [0]."""
    if listed:
        constants = {p.name for p in model.parameters}
        return len(meant) == len(listed) and constants.issuperset(meant)
    return _is_bracketed(sides[-1]) or {"A", "B", "C"} <= set(given)


def _is_bracketed(side: Tree) -> bool:
    """Whether a value is a sum in brackets alone."""
    return sum(tree.data == "sum" for tree in side.iter_subtrees()) > 1


def _is_energy(named: tuple[Token, int] | None, sides: Sequence[Tree], letter: str, model: Model) -> bool:
    """Whether a statement of an energy, L = K - V, holds a letter."""
    stated = named is not None and energy_of(named[0], model, lhs=True) is not None
    return stated and any(str(x) == letter for side in sides[1:] for x, _ in names_in(side))


def _may_be_kinetic(sides: Sequence[Tree], listed: Sequence[str], subjects: Subjects) -> bool:
    """Whether a square or an inertia stands in a value, as in an energy without its dots: K = 1/2 (M + m) x^2."""
    return any(map(_squares, sides)) or _is_heavy(listed, subjects)


def _used_as_names(
    statements: Sequence[Sequence[Tree]], first: Sequence[tuple[Token, int] | None], subjects: Subjects
) -> Iterator[str]:
    """The letters of energies that stand alone in an equation with accelerations, D theta'' = …, or whose rate is
    formed: dD/dt = …; that of T, V or L only if no rate is squared in what it is, and of no V of positions beside a T
    or L, dV/dt = k x x'; and determinants, D = |M|."""
    kinds = [None if x is None or x[1] else energy_of(x[0], subjects.model, lhs=True) for x in first]
    energies = not {"T", "L"}.isdisjoint(kinds)
    for k, (named, sides, kind) in enumerate(zip(first, statements, kinds, strict=True)):
        if named is None or kind is None or subjects.names.scope.meanings(named[0])[0]:
            continue
        written = str(named[0])
        if _is_measure(sides):
            yield key(written)
        states = [undotted(x)[0] for side in sides[1:] for x, _ in names_in(side)]
        if any(x in ("T", "V", "U") and energy_of(x, subjects.model) for x in states):
            continue  # L = T - V
        placed = kind == "V" and energies and not any(map(subjects.moves, sides[1:]))
        for j, others in enumerate(statements):
            if j == k or not any(map(subjects.accelerates, others)):
                rated = any(x == written and changing for side in others for x, changing in names_in(side))
                if j != k and _is_used_for_rate(others, written):
                    yield key(written)
                if j != k and rated and not placed and (kind == "D" or not any(map(_squares_rates, sides[1:]))):
                    yield key(written)
                continue
            alone = only_name(others[0])
            used = any(x == written for side in others for x, _ in names_in(side))
            if placed and all(n == 1 for side in others for n in _primes_of(written, side)):
                continue  # V' is the slope of an energy
            if used and (alone is None or alone[0] != written):
                yield key(written)


def _cut_forces(
    statements: Sequence[Sequence[Tree]], first: Sequence[tuple[Token, int] | None], subjects: Subjects
) -> Iterator[str]:
    """The names of generalized forces that a balance is solved for, Q = n τ − n² J φ'', and another balance uses."""
    moving = [any(map(subjects.accelerates, sides)) for sides in statements]
    for k, named in enumerate(first):
        if named is None or named[1] or not moving[k] or subjects.names.force(str(named[0])) is None:
            continue
        balances = [s for j, s in enumerate(statements) if j != k and moving[j] and first[j] != named]
        if any(str(x) == str(named[0]) for s in balances for side in s for x, _ in names_in(side)):
            yield key(str(named[0]))


def _primes_of(written: str, side: Tree) -> Iterator[int]:
    """The primes behind each place where a name stands in a side."""
    for tree in side.iter_subtrees():
        if tree.data == "name" and str(tree.children[0]) == written:
            yield len(str(tree.children[1] or ""))


def _is_used_for_rate(sides: Sequence[Tree], written: str) -> bool:
    """Whether a statement says with a name what the rate of another is: w1' = (tau - T)/J1."""
    alone = only_name(sides[0]) if len(sides) == 2 else None
    used = alone is not None and any(x == written and not changing for x, changing in names_in(sides[1]))
    return used and alone is not None and alone[1] == 1


def _squares(side: Tree) -> bool:
    """Whether a power stands in a tree."""
    return any(x.data == "power" and len(x.children) > 1 for x in side.iter_subtrees())


def _squares_rates(side: Tree, rates: Collection[str] = ()) -> bool:
    """Whether a power of a rate stands in a tree, or of a letter of ``rates``."""
    powers = (x for x in side.iter_subtrees() if x.data in ("power", "postfix") and len(x.children) > 1)
    bases = (x.children[0] for x in powers)
    named = (x for base in bases if isinstance(base, Tree) for x in names_in(base))
    return any(changing or key(str(name)) in rates for name, changing in named)
