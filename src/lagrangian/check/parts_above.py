"""Parts of a wrong line that stand alone above it, where the mistake was made: "brake: −B δφ", "bearing: −c φ̇".

What has no equals sign, or a name that nothing else uses, is not judged by itself. But a line below puts it in, so that
a term which is wrong there is wrong here first, if what stands here is meant as a part of that line: it is work for
δξ, or power; or a sum of several of its terms; or one in a list of its terms.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reading import parse_answer
from lagrangian.check.reading.placeholders import displacements
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Status, TermDifference, Verdict, inserted
from lagrangian.errors import ParseError
from lagrangian.model import Coordinate
from lagrangian.read.letters import key
from lagrangian.records import dataclass

MOST_PIECES, MOST_LINES, LONGEST = 16, 200, 300
"""The most pieces that are read again, the most lines of an answer, and the longest line that is looked at."""
KINDS = ("equation", "Xi", "T", "V", "L", "slope")
_NAME = "zz_"
_SPLIT = re.compile(r"(?::|=|,[ \t]|;|[→⇒⟹]|\*\*)[ \t]*")
_WORD = re.compile(r"[^\W\d_]{4,}")
_FUNCTION = re.compile(r"(?:arc|a)?(?:sin|cos|tan|sqrt|exp)|d?[a-z]{0,2}(?:theta|phi|psi)|ddot|sqrt|alpha|beta|gamma")
_FORMULA = re.compile(r"[+−–-]?[ \t]*[\w(\[½¼⅓⅙⅛¾⅔√{][^\n]*[\w)\]}'’′″²³\u0307\u0308]")
_LABEL = re.compile(r"(?:[^\W\d_]{4,20}[ \t]+){1,4}(?=[\w(\[½¼⅓√+−-])")
"""Words before a formula: tangential s φ̇."""
_BULLET = re.compile(r"[ \t]*(?:[-*•][ \t]+)?")
_SIGNED = re.compile(r"[+−–-]")


@dataclass(frozen=True, eq=False)
class FormulaAbove:
    """A formula in a line without a verdict: the number of the line, its text, and what it is."""

    number: int
    text: str
    expr: sp.Expr

    @property
    def signed(self) -> bool:
        """Whether it begins with a sign."""
        return _SIGNED.match(self.text) is not None


def with_parts_above(truth: Reference, written: str, verdict: Verdict) -> Verdict:
    """The verdict, with the lines above wrong ones that hold their wrong terms already as wrong, and these as what
    follows from them."""
    rows = written.split("\n")
    open_ones = [f for f in verdict.findings if f.line.kind in KINDS and f.differences and _is_open(f)]
    if not open_ones or len(rows) > MOST_LINES:
        return verdict
    judged = {f.line.number for f in verdict.findings}
    above = [k for k in range(1, min(open_ones[-1].line.number, len(rows) + 1)) if k not in judged]
    pieces = _read(truth, written, [(k, x) for k in above for x in _formulas(truth, rows[k - 1])])
    findings, made = list(verdict.findings), list[FormulaAbove]()
    for first in open_ones:
        before = [p for p in pieces if p.number < first.line.number and p not in made]
        found = [(p, own) for p in before if (own := _made_in(truth, p, before, first))]
        known = {id(d) for _, own in found for d, _ in own}
        left = tuple(d for d in first.differences if id(d) not in known)
        rest = replace(first, differences=left) if left else replace(first, follows=True)
        findings = [rest if f is first else f for f in findings]
        for piece, own in found:
            line = AnsweredLine("definition", piece.expr, piece.number, None, piece.text)
            said = tuple(x for _, x in own)
            findings = inserted(findings, Finding(line, Status.WRONG, None, first.coordinate, said))
            made.append(piece)
    if not made:
        return verdict
    told = {"".join(p.text.split()) for p in made}
    numbers = {p.number for p in made}
    notes = tuple(x for x in verdict.notes if not _is_about(str(x), told, numbers))
    return replace(verdict, findings=tuple(findings), notes=notes)


def _is_open(finding: Finding) -> bool:
    return finding.is_open and not finding.clash


def _is_about(note: str, told: set[str], numbers: set[int]) -> bool:
    """Whether a note says that a piece, or the line in which it stands, was not judged."""
    quoted = note[1:].partition("' was not judged")
    same = "".join(quoted[0].replace("δ", "d").split())
    held = bool(quoted[1]) and any(x.replace("δ", "d") in same or same in x.replace("δ", "d") for x in told)
    return held or any(note.startswith(f"Line {k} has a part that was not read") for k in numbers)


# -- reading ----------------------------------------------------------------------------------------------------------


def _formulas(truth: Reference, row: str) -> Iterator[str]:
    """The pieces of a line, between colons, commas and equals signs, that have no words."""
    if len(row) > LONGEST:
        return
    known = {key(x) for x in truth.model.symbols}
    for piece in _SPLIT.split(_BULLET.sub("", row, count=1)):
        short = _LABEL.sub("", piece.strip().strip("."), count=1)
        words = [x for x in _WORD.findall(short) if key(x) not in known and _FUNCTION.fullmatch(x) is None]
        if not words and _FORMULA.fullmatch(short) is not None:
            yield short


def _read(truth: Reference, written: str, found: Sequence[tuple[int, str]]) -> list[FormulaAbove]:
    """The pieces with what they are, with the names of the answer; none of them where the text cannot be read so."""
    if not found or len(found) > MOST_PIECES or _NAME in written:
        return []
    added = "\n\n".join(f"{_NAME}{k} = {x}" for k, (_, x) in enumerate(found))
    try:
        answer = parse_answer(f"{written}\n\n{added}\n", truth.model)
    except ParseError:
        return []
    own = {u.symbol for u in answer.unknown if u.name.startswith(_NAME)}
    values: dict[int, sp.Expr] = {}
    for line in answer.lines:
        name, _, rest = line.text.partition("=")
        at = name.strip().removeprefix(_NAME)
        if not rest or at == name.strip() or not at.isdecimal():
            continue
        expr = line.residual
        value = own & bounded.letters(expr)
        turned = -cast("sp.Expr", expr.xreplace(dict.fromkeys(value, sp.S.Zero)))
        values[int(at)] = turned if value else expr
    listed: dict[tuple[int, sp.Expr], FormulaAbove] = {}
    for k, x in values.items():
        if k < len(found) and isinstance(x, sp.Expr):
            piece = FormulaAbove(*found[k], truth.expand(x))
            listed[piece.number, piece.expr] = piece  # a name, and then its value
    return [*listed.values()]


# -- judging ----------------------------------------------------------------------------------------------------------


def _made_in(
    truth: Reference, piece: FormulaAbove, pieces: Sequence[FormulaAbove], first: Finding
) -> list[tuple[TermDifference, TermDifference]]:
    """The differences of a wrong line that stand in a piece already, and the same as they are in it."""
    coordinate = next((c for c in truth.model.coordinates if c.name == first.coordinate), None)
    sides = _sides(truth, first.line)
    if first.line.kind == "T" and (slow := [d for d in first.differences if _is_speed(truth, d, piece.expr)]):
        return [(d, _of_speed(truth, d, piece.expr)) for d in slow]
    found: list[tuple[TermDifference, TermDifference]] = []
    for value, factor, sure in _as_parts(piece, coordinate):
        own = _terms(value)
        for sign, side in sides:
            if not own or not own <= side:
                continue
            listed = not sure and len(own) == 1
            beside = _beside(truth, piece, pieces, side) if listed else []
            if listed and len(beside) < 2:
                continue
            explicit = not listed or piece.signed or any(x.signed for x in beside)
            for d in first.differences:
                if not _is_in(truth, d, sign, own, side, sure=sure, listed=listed, explicit=explicit):
                    continue
                found.append((d, replace(d, term=sign * factor * d.term, written=sign * factor * d.written)))
        if found:
            return found
    return found


def _as_parts(piece: FormulaAbove, coordinate: Coordinate | None) -> Iterator[tuple[sp.Expr, sp.Expr, bool]]:
    """What a piece adds to a line of a coordinate, and times what this stands there: as work for its δξ, as power,
    which are surely meant so, or as it stands."""
    varied = displacements(piece.expr)
    if varied:
        if coordinate is not None:
            yield from (
                (bounded.diff(piece.expr, x), sp.S.One, True) for x, name in varied.items() if name == coordinate.name
            )
        return
    if coordinate is not None and piece.expr.has(coordinate.rate):
        whole = bounded.expand(piece.expr)
        divided = bounded.expand(whole / coordinate.rate)
        if not any(sp.fraction(t)[1].has(coordinate.rate) for t in sp.Add.make_args(divided)):
            yield divided, coordinate.rate, True
    yield piece.expr, sp.S.One, False


def _is_in(
    truth: Reference,
    d: TermDifference,
    sign: int,
    own: set[sp.Expr],
    side: set[sp.Expr],
    *,
    sure: bool,
    listed: bool,
    explicit: bool,
) -> bool:
    """Whether what differs in a side of a line is wrong in a part of it, the terms ``own``, already."""
    term, written = (_terms(truth.expand(sign * x)) for x in (d.term, d.written))
    if not written:
        return sure and _is_whole(truth, d, own, side)
    if not written <= own or written <= term or term <= own:
        return False
    quotient = bounded.cancel(truth.expand(d.written / d.term)) if d.term != 0 else sp.S.Zero
    if quotient == -1 or d.kind == "sign":
        return explicit
    if quotient.is_number:
        return not listed and (not sure or _is_of_one(truth, own))
    return True


def _is_speed(truth: Reference, d: TermDifference, speed: sp.Expr) -> bool:
    """Whether a wrong term of T* is a constant times the square of a speed, and should be that of a multiple of it."""
    rates = [c.rate for c in truth.model.coordinates]
    if 0 in (d.written, d.term) or not speed.has(*rates) or len(_terms(speed)) > 1:
        return False
    moving = (*rates, *(c.symbol for c in truth.model.coordinates))
    factor, ratio = (bounded.cancel(truth.expand(x)) for x in (d.written / speed**2, d.term / d.written))
    return not factor.has(*moving) and _root(ratio) is not None


def _root(square: sp.Expr) -> sp.Expr | None:
    """The root of a product of squares of letters; None for anything else."""
    powers = [x.as_base_exp() for x in sp.Mul.make_args(square)]
    if not all(x.is_Symbol and n.is_Integer and n % 2 == 0 for x, n in powers):
        return None
    return sp.Mul(*(x ** (n / 2) for x, n in powers))


def _of_speed(truth: Reference, d: TermDifference, speed: sp.Expr) -> TermDifference:
    """How a speed differs of whose square a wrong term of T* is a multiple."""
    root = _root(bounded.cancel(truth.expand(d.term / d.written)))
    assert root is not None
    return replace(d, term=root * speed, written=speed)


def _is_whole(truth: Reference, d: TermDifference, own: set[sp.Expr], side: set[sp.Expr]) -> bool:
    """Whether a part is all that a line has with the letter of one force, of which a term is missing there."""
    for letter in bounded.letters(truth.expand(d.term)):
        whole = all(x.has(letter) for x in own) and {x for x in side if x.has(letter)} == own
        if whole and _acts_once(truth, letter):
            return True
    return False


def _is_of_one(truth: Reference, own: set[sp.Expr]) -> bool:
    """Whether all terms have the letter of one force."""
    shared = set.intersection(*(set(bounded.letters(x)) for x in own))
    return any(_acts_once(truth, x) for x in shared)


def _acts_once(truth: Reference, letter: object) -> bool:
    """Whether a letter stands in what one element adds to Ξ, and in nothing else."""
    if any(x.has(letter) for x in (truth.T, truth.V)):
        return False
    given = {
        e for terms in truth.derivation.terms for t in terms if truth.expand(t.expr).has(letter) for e in t.elements
    }
    return len(given) == 1


def _beside(
    truth: Reference, piece: FormulaAbove, pieces: Sequence[FormulaAbove], side: set[sp.Expr]
) -> list[FormulaAbove]:
    """The pieces of the lines around one, each of which is a term of the same side, without a gap between them."""
    held = [p for p in pieces if (own := _terms(p.expr)) and len(own) == 1 and own <= side]
    numbers = {p.number for p in held}
    near = {piece.number}
    for step in (-1, 1):
        at = piece.number + step
        while at in numbers:
            near.add(at)
            at += step
    return [p for p in held if p.number in near]


def _sides(truth: Reference, line: AnsweredLine) -> list[tuple[int, set[sp.Expr]]]:
    """The terms of each side of a line, and the sign that it has with everything on the left."""
    if line.kind != "equation" or line.sides is None:
        return [(1, _terms(truth.expand(line.expr)))]
    return [(sign, _terms(truth.expand(x))) for sign, x in zip((1, -1), line.sides, strict=True)]


def _terms(expr: sp.Expr) -> set[sp.Expr]:
    """The terms of a sum, multiplied out."""
    return {cast("sp.Expr", x) for x in sp.Add.make_args(bounded.expand(expr)) if x != 0}
