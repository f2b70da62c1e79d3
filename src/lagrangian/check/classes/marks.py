"""What an answer lacks, and the points for its parts; what follows from a wrong line above costs nothing again."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from lagrangian.check.classes.scheme import PARTS, PER_COORDINATE, MarkingScheme
from lagrangian.check.verdict import Finding, Status, Verdict
from lagrangian.derive import Derived
from lagrangian.records import dataclass
from lagrangian.viewed import Brief

KINDS = {"equation": "equations", "p": "step5", "p-rate": "step5", "slope": "step5", "left": "step5"}
"""The part to which a kind of line belongs, if it does not have the name of the kind."""


@dataclass(frozen=True)
class PartMark(Brief):
    """The points for one part of an answer: its name, the points, the most that it can get, and why it is fewer."""

    part: str
    points: float
    of: float
    why: str = ""

    @property
    def title(self) -> str:
        """The part in words."""
        base, _, coordinate = self.part.partition("_")
        if not coordinate:
            return PARTS[base]
        return f"Ξ of {coordinate}" if base == "Xi" else f"the equation of {coordinate}"

    def to_dict(self) -> dict[str, Any]:
        """Return plain data."""
        return {"part": self.part, "points": self.points, "of": self.of, "why": self.why}


def part_of(finding: Finding) -> str:
    """The part of an answer to which a line belongs."""
    return KINDS.get(finding.line.kind, finding.line.kind)


def lacking(verdict: Verdict, derivation: Derived, require: Sequence[str]) -> tuple[str, ...]:
    """The required parts, in words, that an answer does not have.

    A Ξ is required of every coordinate for which it is not 0. If the answer has other coordinates, their number counts.
    """
    lacks: list[str] = []
    for part in require:
        given = [f for f in verdict.findings if part_of(f) == part]
        if part == "Xi":
            lacks += _forces_lacking(given, derivation, moved=verdict.status is Status.OTHER_COORDINATES)
        elif part == "equations":
            missing = len(derivation.equations) - _independent(verdict, given)
            every = missing == len(derivation.equations)
            if missing > 0:
                lacks.append("the equations" if every else f"{missing} of the equations")
        elif not given:
            lacks.append(PARTS[part])
    return tuple(lacks)


def _forces_lacking(given: Sequence[Finding], derivation: Derived, *, moved: bool) -> list[str]:
    needed = _acted_on(derivation)
    if moved:
        missing = len(needed) - len(given)
        return [f"{missing} of the Ξ"] if missing > 0 else []
    named = {f.coordinate or f.line.name for f in given}
    return [f"Ξ of {name}" for name in needed if name not in named]


def _acted_on(derivation: Derived) -> list[str]:
    """The coordinates whose Ξ is not 0."""
    model = derivation.model
    moving = (*model.coordinates, *model.velocities)
    return [x.name for x in moving if derivation.Xi.get(x.symbol, 0) != 0]


def _independent(verdict: Verdict, equations: Sequence[Finding]) -> int:
    """The number of different equations given, the wrong ones included."""
    told = [f for f in equations if f.status is not Status.INCOMPLETE]
    named = {f.coordinate for f in told if f.coordinate is not None}
    count = len(named) + sum(f.coordinate is None for f in told)
    return count


def marks(verdict: Verdict, derivation: Derived, scheme: MarkingScheme) -> tuple[PartMark, ...]:
    """The points for every part of the scheme.

    A part is worth the share of its lines that are right or follow from a wrong line above: a mistake costs once. A T*
    or V that is not given counts as right if a right L is. Of an answer in other coordinates, if only those of the
    model are accepted, every part is worth the share ``scheme.other``.
    """
    moved = scheme.coordinates == "given" and verdict.status is Status.OTHER_COORDINATES
    found: list[PartMark] = []
    for part, worth in scheme.points.items():
        share, why = _share(verdict, derivation, part)
        if moved and share > 0 and scheme.other < 1:
            share, why = share * scheme.other, "right, but in other coordinates than those asked for"
        found.append(PartMark(part, round(worth * share, 4), worth, why))
    return tuple(found)


def _share(verdict: Verdict, derivation: Derived, part: str) -> tuple[float, str]:
    """How much of a part is right, from 0 to 1, and what is not."""
    base, _, coordinate = part.partition("_")
    lines = [f for f in verdict.findings if part_of(f) == base]
    if coordinate:
        return _line_share(
            [f for f in lines if coordinate in (f.coordinate, f.line.name)], derivation, base, coordinate
        )
    if base in PER_COORDINATE or base == "step5":
        return _lines_share(verdict, derivation, base, lines)
    if not lines and base in ("T", "V"):
        lines = [f for f in verdict.findings if f.line.kind == "L" and f.status.right]
    if not lines:
        return (1.0, "") if base == "D" and not _damped(derivation) else (0.0, "not given")
    return (1.0, "") if all(map(_earned, lines)) else (0.0, "not right")


def _damped(derivation: Derived) -> bool:
    return any(e.dissipation(derivation.model) is not None for e in derivation.model.elements)


def _line_share(lines: Sequence[Finding], derivation: Derived, base: str, coordinate: str) -> tuple[float, str]:
    if not lines:
        none = base == "Xi" and coordinate not in _acted_on(derivation)
        return (1.0, "") if none else (0.0, "not given")
    return (1.0, "") if all(map(_earned, lines)) else (0.0, "not right")


def _lines_share(verdict: Verdict, derivation: Derived, base: str, lines: Sequence[Finding]) -> tuple[float, str]:
    """The share of lines that are right, of those that are needed or given, whichever are more."""
    n = len(derivation.equations)
    lines = _once(lines) if base != "Xi" else lines
    earned = [f for f in lines if _earned(f)]
    if base == "Xi":
        acted = set(_acted_on(derivation))
        named = {f.coordinate or f.line.name for f in lines}
        moved = verdict.status is Status.OTHER_COORDINATES
        needed = max(len(acted), len(lines)) if moved else len(acted | named)
        right = needed - len({f.coordinate or f.line.name for f in lines if not _earned(f)})
        right -= max(len(acted) - len(lines), 0) if moved else len(acted - named)
    elif base == "equations":
        needed = max(n, sum(f.status is not Status.INCOMPLETE for f in lines))
        right = min(_independent(verdict, earned), n - 1 if verdict.status is Status.INCOMPLETE else n)
        needed = max(needed, right)
    else:
        needed, right = max(n, len(lines)), len(earned)
    if not needed or right == needed:
        return 1.0, ""
    if not lines:
        return 0.0, "not given"
    wrong = len(lines) - len(earned)
    missing = needed - right - wrong
    said = [f"{wrong} not right"] if wrong else []
    said += [f"{missing} not given"] if missing > 0 else []
    return right / needed, ", ".join(said)


def _once(lines: Sequence[Finding]) -> list[Finding]:
    """The lines without those that say again what another says: the right ones of a coordinate, or the wrong ones."""
    said: dict[object, Finding] = {}
    for f in lines:
        about = f.coordinate or f.line.name or f.line.expr
        key = (f.line.kind, about, f.status is Status.INCOMPLETE, f.status.right)
        if key not in said or not _earned(f):
            said[key] = f
    return list(said.values())


def _earned(finding: Finding) -> bool:
    """Whether a line gets its points: it is right, or it follows from a wrong line above."""
    return finding.status.right or finding.follows
