"""Converts an answer that was read to the lines that are checked, with its own definitions substituted."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.prescribed import as_prescribed, with_own_definitions
from lagrangian.check.reading import Answer, generalized_force
from lagrangian.check.reading.placeholders import ENERGIES
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.errors import ModelError, Place
from lagrangian.model import time
from lagrangian.page.formula import Text, text

LONGEST = 160
"""The most characters in front of a statement that are read as words about it."""
_ABOUT = re.compile(r"[ \t,]*+[(%#]?[ \t]*+(?P<about>(?:about|around|um|bezüglich)[ ][^=:,;.()\n]{1,60})")
_SENTENCE = re.compile(r"[.;|][ \t]")
_RATES = {k: sp.Derivative(ENERGIES[k], time) for k in ("T", "V")}


def lines_of(answer: Answer) -> tuple[AnsweredLine, ...]:
    """The lines of an answer that was read, numbered as in its text."""
    found: list[AnsweredLine] = []
    spelled = {u.name: u.symbol for u in answer.unknown}
    senses = [(spelled[name], (str(spelled[name]), way, on)) for name, way, on in answer.senses if name in spelled]
    for k, stated in enumerate(answer.lines, 1):
        number = stated.place.line if stated.place is not None and stated.place.line is not None else k
        beside = answer.beside.get(number, frozenset())
        expr, names = sp.sympify(stated.residual), stated.names
        pushing = frozenset(sense for x, sense in senses if expr.has(x))
        told = (stated.kind, expr, number, stated.name, stated.text, beside, names, pushing)
        sides = None if stated.lhs is None else (sp.sympify(stated.lhs), sp.sympify(stated.rhs))
        words, near = _words_around(stated.place, stated.text), answer.near.get(number, frozenset())
        found.append(AnsweredLine(*told, sides, stated.summands, words, near))
    return tuple(found)


def _words_around(place: Place | None, written: str) -> str:
    """The words of the same sentence in front of a statement, before any formula, and "about the hinge" behind it."""
    if place is None or place.text is None or place.column is None:
        return ""
    start = place.column - 1
    before = _SENTENCE.split(place.text[max(0, start - LONGEST) : start])[-1].partition("=")[0]
    own = place.text.startswith(written, start)
    behind = _ABOUT.match(place.text, start + len(written)) if own and written else None
    return " ".join((before if behind is None else f"{before} {behind['about']}").split())


def lines_from(things: object) -> tuple[AnsweredLine, ...]:
    """The lines of SymPy equations, expressions (= 0), or a mapping such as ``{"T": …, "V": …}``, in order.

    Raises `ModelError` for anything else.
    """
    if isinstance(things, Mapping):
        return tuple(_named(key, value, k) for k, (key, value) in enumerate(things.items(), 1))
    if isinstance(things, (sp.Basic, sp.MatrixBase)):
        things = things.flat() if isinstance(things, sp.MatrixBase) else [things]
    if isinstance(things, Iterable) and not isinstance(things, (str, bytes)):
        return tuple(_equation(x, k) for k, x in enumerate(things, 1))
    raise ModelError(
        f"an answer is text, a list of SymPy equations, or energies by name (got {type(things).__name__})",
        fix='check("m*x\'\' + k*x = F"), check([Eq(…), Eq(…)]) or check({"T": …})',
        code="E406",
    )


def _named(key: object, value: object, number: int) -> AnsweredLine:
    if isinstance(key, str) and key in ("T", "V", "L", "D"):
        return AnsweredLine(key, _expression(value), number)
    if isinstance(key, sp.Basic):
        return AnsweredLine("Xi", _expression(value), number, getattr(key.func, "__name__", str(key)))
    raise ModelError(
        f"'{key}' is neither T, V, L, D nor a coordinate",
        fix='{"T": …, "V": …, theta: …}, a coordinate for its Ξ',
        code="E402",
    )


def _equation(thing: object, number: int) -> AnsweredLine:
    if isinstance(thing, sp.Equality):
        lhs, rhs = (_expression(side) for side in (thing.lhs, thing.rhs))
        return AnsweredLine("equation", lhs - rhs, number, None, str(thing), sides=(lhs, rhs))
    return AnsweredLine("equation", _expression(thing), number, None, str(thing))


def _expression(thing: object) -> sp.Expr:
    if isinstance(thing, (int, float, sp.Expr)) and not isinstance(thing, bool):
        return cast("sp.Expr", sp.sympify(thing))
    raise ModelError(
        f"an answer is made of SymPy expressions and equations (got {type(thing).__name__})",
        fix="Eq(left, right), or an expression that is 0; text goes through check(text)",
        code="E406",
    )


def filled(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[AnsweredLine, ...]:
    """The lines with definitions written out, and with the value of every Ξ that is only named: the answer's value, or
    ours."""
    given = {line.name: line.expr for line in lines if line.kind == "Xi"}
    forces: dict[Any, sp.Expr] = {}
    for c, own in zip(truth.model.coordinates, truth.Xi, strict=True):
        forces[generalized_force(c.name)] = given.get(c.name, own)
    energies = {ENERGIES["T"]: truth.T, ENERGIES["V"]: truth.V}
    out: list[AnsweredLine] = []
    for written in with_own_definitions(truth, lines):
        line = with_rates_of_energies(truth, as_prescribed(truth, written))
        plain = forces.keys().isdisjoint(bounded.letters(line.expr))
        kind, expr = line.kind, truth.expand(line.expr if plain else cast("sp.Expr", line.expr.xreplace(forces)))
        if _is_other_lagrangian(line):
            kind, expr = "L", cast("sp.Expr", expr.xreplace(energies))
        out.append(replace(line, kind=kind, expr=expr))
    return tuple(out)


def with_rates_of_energies(truth: Reference, line: AnsweredLine) -> AnsweredLine:
    """A line with the rates of energies that the answer does not state, dV/dt = …, as those of the system's."""
    if not any(line.expr.has(x) for x in _RATES.values()):
        return line
    rates = {_RATES[k]: bounded.diff(x, time) for k, x in (("T", truth.T), ("V", truth.V))}
    held = [x for x in rates if line.expr.has(x)]
    accelerations = [c.acceleration for c in truth.model.coordinates]
    alone = [x for x in held if line.sides is not None and x in line.sides]
    own = len(alone) == len(held) == 1 and line.sides is not None
    others = [x for x in line.sides or () if x not in alone]
    same = own and rates[alone[0]].has(*accelerations) == any(x.has(*accelerations) for x in others)
    sides = None if line.sides is None else (line.sides[0].xreplace(rates), line.sides[1].xreplace(rates))
    kind = "identity" if line.kind == "equation" and same else line.kind
    return replace(line, kind=kind, expr=cast("sp.Expr", line.expr.xreplace(rates)), sides=cast("Any", sides))


def _is_other_lagrangian(line: AnsweredLine) -> bool:
    """Whether a line says what L is in terms of T and V alone, and not T − V."""
    T, V = ENERGIES["T"], ENERGIES["V"]
    used = bounded.symbols(line.expr) - {time} | bounded.atoms(line.expr, AppliedUndef)
    return (line.kind, line.name) == ("statement", "L") and set() < used <= {T, V} and line.expr != T - V


def without_periods(
    truth: Reference, lines: Sequence[AnsweredLine]
) -> tuple[tuple[AnsweredLine, ...], tuple[Text, ...]]:
    """The lines without a T = 2 π √(L/g) that is no kinetic energy: it has π and no rate. With notes that say so."""
    moving = [x for c in truth.model.coordinates for x in (c.symbol, c.rate)]
    periods = [x for x in lines if x.kind == "T" and x.expr.has(sp.pi) and not x.expr.has(*moving, sp.Derivative)]
    told = tuple(text(f"'{x.text}' was not judged: T is a period there, and not the kinetic energy.") for x in periods)
    return tuple(x for x in lines if not any(x is y for y in periods)), told


def without_forms(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[tuple[AnsweredLine, ...], tuple[Text, ...]]:
    """The lines without headings such as M q̈ + K q = f, of whose names the system and all other lines have none.

    Nothing is left out unless there is an equation for every coordinate beside them. With notes on what is not judged.
    """
    model = truth.model
    known = {x.symbol for x in (*model.parameters, *model.coordinates, *model.inputs, *model.definitions)}
    known |= {m.symbol for m in truth.derivation.multipliers.values()}
    names = [{x for x in bounded.letters(a.expr) if x != time} for a in lines]
    forms: set[int] = set()
    for k, line in enumerate(lines):
        elsewhere = known.union(*(own for j, own in enumerate(names) if j != k))
        if line.kind == "equation" and names[k] and not names[k] & elsewhere:
            forms.add(k)
    if sum(line.kind == "equation" for line in lines) - len(forms) < truth.n:
        return tuple(lines), ()
    told = tuple(text(f"'{lines[k].text}' was not judged: it names nothing of the system.") for k in sorted(forms))
    return tuple(line for k, line in enumerate(lines) if k not in forms), told
