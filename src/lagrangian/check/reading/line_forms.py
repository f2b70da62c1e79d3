"""What the values of statements are: general, accelerating, rows of a matrix equation; and several errors as one."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any

import sympy as sp
from lark import Token, Tree
from sympy.core.function import AppliedUndef
from sympy.matrices.matrixbase import MatrixBase

from lagrangian import bounded
from lagrangian.check.reading.answer import AnswerLine, Kind, Summands
from lagrangian.check.reading.meaning import Meaning
from lagrangian.check.reading.names import PI, Names, Value, spelled_rates
from lagrangian.check.reading.nodes import has_matrix, inside, names_in, only_name, start_of
from lagrangian.check.reading.placeholders import ENERGIES, displacements, is_force, is_placeholder
from lagrangian.check.reading.stated import energy_of
from lagrangian.check.reading.subject import Subject
from lagrangian.check.reading.summands import negative, summands
from lagrangian.errors import ParseError, listed
from lagrangian.model.names import time
from lagrangian.page.plain import plain
from lagrangian.quantities.source import Source
from lagrangian.read.letters import key, undotted
from lagrangian.records import dataclass

_SIDE = re.compile(r"[=,;]")
_EQUALS = re.compile(r"(?<![<>:!=])=(?![=>])")
_NUMBER = re.compile(r"\s*+[(\[]?\s*+(\d{1,2})\s*+[)\]]?\s*+[.:]?\s*+")


@dataclass(frozen=True)
class Statement:
    """The syntax trees between the equals signs of a statement, its text, and whether that is a line of words."""

    sides: tuple[Tree, ...]
    source: Source
    remark: Callable[[], bool] = bool


def together(errors: Sequence[ParseError]) -> ParseError:
    """Return one error for several places, in their order; one at the same place counts once."""
    placed = {(e.place.line or 0, e.place.column or 0) if e.place is not None else (0, 0): e for e in reversed(errors)}
    first, *others = [placed[at] for at in sorted(placed)]
    return first.with_others(others)


def listed_names(names: Sequence[str]) -> str:
    """Several names as the subject of a sentence, with its verb: a, b and c are."""
    return f"{listed(names)} {'are' if len(names) > 1 else 'is'}"


def forget_unused(lines: Sequence[AnswerLine], names: Names) -> None:
    """Drop the unknown names of sides that are not judged."""
    exprs = [x for line in lines for x in (line.lhs, line.rhs) if x is not None]
    used = {x for expr in exprs for x in bounded.letters(expr)}
    for base in [base for base, u in names.unknown.items() if u.symbol not in used]:
        del names.unknown[base]


def says_constant(statement: Statement, names: Names) -> bool:
    """Whether a statement only says that the rate of a constant of the system is 0, which is true: Ω̇ = 0."""
    named = [found for side in statement.sides if (found := only_name(side)) is not None]
    others = [side for side in statement.sides if only_name(side) is None]
    if len(named) != 1 or len(others) != 1 or [str(x) for x in others[0].scan_values(bool)] != ["0"]:
        return False
    token, primes = named[0]
    found, dots = names.scope.meanings(token)
    constant = bool(found) and found[0] in {p.name for p in names.model.parameters} and primes + dots > 0
    if constant:
        written = " ".join(statement.source.text.split())
        names.notes.setdefault(f"'{written}' was not judged: {found[0]} is constant.")
    return constant


def asides(
    statements: Sequence[Statement], turned: Sequence[tuple[Subject | None, Sequence[Tree]]], names: Names
) -> set[int]:
    """The numbers of statements that are no equations but about one position, or about numbers of lines, or that say
    which slope of an energy a name is, p = ∂T/∂x', where the answer gives no such energy but a value of the name; with
    the subjects and sides of all."""
    found = {i for i, s in enumerate(statements) if _is_place(s, names) or _equates_numbers(s, names)}
    kinds: set[str] = {x.kind for x, sides in turned if x is not None and not _is_difference(sides[-1], names)}
    given = kinds | {"L"} if {"T", "V"} <= kinds else kinds
    sloped: dict[str, list[int]] = {}
    valued = set[str]()
    for i, (subject, sides) in enumerate(turned):
        if subject is None or subject.kind != "definition" or subject.order:
            continue
        value = inside(sides[-1])
        general = isinstance(value, Tree) and value.data == "partial" and len(sides) == 2
        if general and (kind := str(value.children[0]).replace("ℒ", "L")) in ENERGIES and kind not in given:
            sloped.setdefault(key(str(subject.token)), []).append(i)
        else:
            valued.add(key(str(subject.token)))
    return found | {i for name in valued & sloped.keys() for i in sloped[name]}


def _is_difference(side: Tree, names: Names) -> bool:
    """Whether a side holds the names of energies alone: L = T - V."""
    found = [str(x) for x, _ in names_in(side)]
    return bool(found) and all(energy_of(x, names.model) is not None for x in found)


def _is_place(statement: Statement, names: Names) -> bool:
    """Whether a statement gives a coordinate of the answer's own a value, which is no definition: ψ = 0 at the top."""
    if len(statement.sides) != 2 or (found := only_name(statement.sides[0])) is None:
        return False
    token, primes = found
    own = not primes and not undotted(token)[1] and not names.scope.meanings(token)[0] and names.changes(token)
    value = inside(statement.sides[1])
    valued = isinstance(value, Tree) and all(x in PI for x, _ in names_in(value)) and not has_matrix(value)
    if own and valued:
        written = " ".join(statement.source.text.split())
        written = typed_as(statement.source, written) or written
        names.notes.setdefault(f"'{written}' was not judged: it is about one position.")
    return own and valued


def _equates_numbers(statement: Statement, names: Names) -> bool:
    """Whether a statement only says with their numbers which lines or steps it equates: Step 7: (5) = (6)."""
    sides = [_NUMBER.fullmatch(x) for x in statement.source.text.split("=")]
    numbers = {int(m[1]) for m in sides if m is not None}
    found = all(sides) and len(numbers) == len(sides) > 1 and 0 not in numbers
    if found:
        written = " ".join(statement.source.text.split())
        names.notes.setdefault(f"'{written}' was not judged: numbers alone name lines or steps.")
    return found


def without_expressions(
    made: Mapping[int, Sequence[AnswerLine]], statements: Sequence[Statement], names: Names
) -> tuple[AnswerLine, ...]:
    """The lines of all statements, in their order, without expressions that have no equals sign, if there is an
    equation with accelerations for every coordinate: … ⇒ m l² φ̈ + m g l sin φ, before the result. Notes tell them.

    If these equations have no equals signs, only the expressions without accelerations go, such as that of L.
    """
    moving = {k: sum(x.kind == "equation" and _moves(x) for x in lines) for k, lines in made.items()}
    stated = sum(count for k, count in moving.items() if len(statements[k].sides) > 1)
    equations = (k for k, lines in made.items() if any(x.kind == "equation" for x in lines))
    aside = {k for k in equations if len(statements[k].sides) == 1}
    if stated < len(names.model.coordinates):
        moved = sum(moving.values()) >= len(names.model.coordinates)
        aside = {k for k in aside if not moving[k]} if moved else set[int]()
    for k in sorted(aside):
        written = " ".join(statements[k].source.text.split())
        names.notes.setdefault(f"'{written}' was not judged: it is an expression without an equals sign.")
    return tuple(line for k in sorted(made) if k not in aside for line in made[k])


def _moves(line: AnswerLine) -> bool:
    return accelerates(sp.sympify(line.residual))


def rated_energy(
    token: Token, order: int, value: sp.Expr, sides: tuple[Tree, Tree], reader: Meaning
) -> AnswerLine | None:
    """The line of the rate of an energy of which the answer states the value above, and which an equation of motion
    gives if only one side of it accelerates; None for anything else."""
    kind = energy_of(undotted(token)[0], reader.names.model, lhs=True)
    stated = reader.names.energy(kind) if kind in ("T", "V") and order == 1 else None
    if not isinstance(stated, sp.Expr) or is_general(stated):
        return None
    rate = reader.scalar(sides[0]) if reader.slopes else bounded.diff(stated, time)
    judged: Kind = "identity" if accelerates(rate) == accelerates(value) else "equation"
    return made_line(judged, rate, value, None, *sides, reader)


def tell_expression(side: Tree, reader: Meaning, what: str) -> None:
    """Tell that a row without an equals sign is not judged, if it is more than a name or a list of names, (θ, x)."""
    if not _names_alone(side):
        written = " ".join(reader.source.text.split())
        reader.names.notes.setdefault(f"'{written}' was not judged: it is {what} without an equals sign.")


def _names_alone(side: Tree) -> bool:
    """Whether a side is a name, or a list or matrix of names."""
    side = inside(side)
    if isinstance(side, Tree) and side.data == "matrix":
        return all(_names_alone(x) for row in side.children[1:] for x in row.children)  # type: ignore[union-attr]
    return only_name(side) is not None


def is_of_entries(token: Token, side: Tree) -> bool:
    """Whether a matrix only puts entries together that have the name of the matrix and a number: Q = [Q1; Q2]."""
    names = [str(x) for x, _ in names_in(side)]
    return _names_alone(side) and all(x.startswith(str(token)) and len(x) > len(token) for x in names)


def is_general(value: sp.Expr) -> bool:
    """Whether an expression contains energies or variations that have no value."""
    return any(is_placeholder(x) and not is_force(x) for x in bounded.atoms(value, AppliedUndef))


def accelerates(value: sp.Expr) -> bool:
    """Whether an expression contains an acceleration."""
    return any(d.derivative_count > 1 for d in bounded.atoms(value, sp.Derivative))


def is_rate_of(token: Token, side: Tree) -> bool:
    """Whether one side of a statement is the rate of a name alone: z' or dz/dt of z."""
    name, primes = only_name(side) or (token, 0)
    base, dots = undotted(name)
    return key(base) == key(str(token)) and bool(primes or dots)


def define_rate(token: Token, order: int, value: Any, names: Names, bare: Collection[str]) -> None:
    """Record what a statement says of the rate of a name: dw/dt = φ'' also says that w is φ', if nothing else says what
    w is, and other statements, of which the names without signs of rates are ``bare``, use it."""
    base = key(undotted(token)[0])
    names.rates[base, order] = value
    names.redefined.rates.append((undotted(token)[0], order, value, names.statement))
    if order != 1 or base not in bare or base in names.defined or base in names.own or not isinstance(value, sp.Expr):
        return
    terms = [x.as_independent(sp.Derivative) for x in sp.Add.make_args(bounded.expand(value))]
    accelerations = {c.symbol.diff(time, 2): c.symbol.diff(time) for c in names.model.coordinates}
    if all(x in accelerations and not k.has(AppliedUndef, time) for k, x in terms):
        rate = sp.Add(*(k * accelerations[x] for k, x in terms))
        names.define(token, rate)
        names.notes.setdefault(f"'{undotted(token)[0]}' was read as {plain(rate)}, as you write what its rate is.")


def solves(rate: sp.Expr, value: sp.Expr) -> bool:
    """Whether the rate of a name of the answer equals something else than its derivative: omega' = -g/L*sin(theta).

    The name is a rate up to a constant, or the value contains no acceleration.
    """
    if not accelerates(rate) or bounded.expand(rate - value) == 0:
        return False
    alone = rate / next(d for d in rate.atoms(sp.Derivative) if d.derivative_count > 1)
    return not accelerates(value) or not alone.atoms(AppliedUndef)


def matrix_rows(left: Value, right: Value, node: Tree, reader: Meaning) -> list[tuple[sp.Expr, sp.Expr]]:
    """The equations of a matrix equation, row by row; a plain 0 is a column of zeros."""
    shape = left.shape if isinstance(left, MatrixBase) else right.shape
    both = []
    for value in (left, right):
        if not isinstance(value, MatrixBase):
            if value != 0:
                reader.fail("a matrix equals a number", node, fix="write a column [a; b] on both sides")
            value = sp.zeros(*shape)
        both.append(value)
    if both[0].shape != both[1].shape:
        a, b = (f"{s[0]} × {s[1]}" for s in (both[0].shape, both[1].shape))
        reader.fail(f"the left side is {a}, the right side {b}", node, fix="give both sides the same number of rows")
    if any(displacements(x) and bounded.expand(x) != 0 for x in both[0] - both[1]):
        written = " ".join(reader.source.text.split())
        reader.names.notes.setdefault(f"'{written}' was not judged: it is about virtual displacements.")
    return list(zip(both[0], both[1], strict=True))


def entries_of(token: Token, value: Value, side: Tree, reader: Meaning) -> list[AnswerLine]:
    """The entries of a column of two or three that move, as definitions with a number: r_S = (l sin φ, −l cos φ)."""
    if not isinstance(value, MatrixBase) or 1 not in value.shape or len(value) not in (2, 3):
        return []
    if not any(x.has(AppliedUndef) and isinstance(x, (sp.Add, sp.Mul)) for x in value):
        return []
    return [made_line("definition", None, x, f"{token}_{k}", side, side, reader) for k, x in enumerate(value.flat(), 1)]


def made_line(
    kind: Kind, lhs: sp.Expr | None, rhs: sp.Expr, name: str | None, a: Tree, b: Tree, reader: Meaning
) -> AnswerLine:
    """Make the line; its place is that of its first side, or of its last one if that goes on in another line of text
    what was equal before, v² = … ⏎ = …; and i = q′ names q. Raises `ParseError` if only one side is a matrix.
    """
    if lhs is not None and isinstance(lhs, MatrixBase) != isinstance(rhs, MatrixBase):
        reader.fail("a single quantity cannot equal a matrix", a, fix="write one equation per line")
    source = reader.source
    start = min(start_of(a), start_of(b))
    start = start_of(b) if _goes_on(source, start, start_of(b)) else start
    tokens = (str(token) for side in (a, b) for token, _ in names_in(side))
    names = {key(x) for token in tokens for x in (undotted(token)[0], *(x for _, x in spelled_rates(token)))}
    values = [reader.names.own[x][1] for x in names if x in reader.names.own]
    rates = {
        key(x.expr.func.__name__) for x in values if isinstance(x, sp.Derivative) and isinstance(x.expr, AppliedUndef)
    }
    text, parts = " ".join(source.text.split()), _summands(kind, lhs, a, b, reader)
    typed = typed_as(source, text)
    return AnswerLine(kind, lhs, rhs, name, source.at(start), text, frozenset(names | rates), parts, typed)


def _goes_on(source: Source, start: int, last: int) -> bool:
    """Whether the side that begins at ``last`` is a third or later one of a statement, in a line of its own."""
    before = source.text[:last]
    return len(_EQUALS.findall(before)) > 1 and source.at(start).line != source.at(last).line


def typed_as(source: Source, text: str) -> str:
    """What was typed where a statement has another ``text``: dB/dφ for ∂B/∂φ; empty if it is the same, or unknown."""
    first, last = source.at(0), source.at(max(len(source.text.rstrip()) - 1, 0))
    if first.line is None or first.line != last.line or first.text is None or not first.column or not last.column:
        return ""
    before, found = first.text[: first.column - 1], first.text[first.column - 1 : last.column]
    found = _SIDE.split(before)[-1] + found if found.startswith("=") else found
    found = " ".join(found.split())
    balanced = all(found.count(a) == found.count(b) for a, b in ("()", "[]", "{}"))
    return found if found != text and balanced and found.count("=") == text.count("=") else ""


def _summands(kind: Kind, lhs: sp.Expr | None, a: Tree, b: Tree, reader: Meaning) -> Summands:
    """The terms of an energy, a force or a definition, or of an equation, as they are written; none if one has no
    value of its own."""
    try:
        with reader.names.redefined.unrecorded():
            return _parts(kind, lhs, a, b, reader)
    except ParseError:
        return ()


def _parts(kind: Kind, lhs: sp.Expr | None, a: Tree, b: Tree, reader: Meaning) -> Summands:
    if kind == "equation" and lhs is not None and a is not b:
        sides = summands(a, reader), summands(b, reader)
        return (*sides[0], *negative(sides[1])) if all(sides) else ()
    return summands(b, reader) if kind in ("T", "V", "L", "D", "Xi", "definition") else ()
