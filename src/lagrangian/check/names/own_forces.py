"""Names such as Q_1 that an answer uses for what stands on the right of its equations, and not for a Ξ."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from lagrangian.check.reading import generalized_force, of_coordinate
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Status, Verdict
from lagrangian.page.formula import Text, text
from lagrangian.read.letters import key
from lagrangian.records import dataclass


@dataclass(frozen=True)
class OwnForces:
    """An answer in which such names are its own, as it was read and with names written out, and what to say of them."""

    lines: tuple[AnsweredLine, ...]
    written: tuple[AnsweredLine, ...]
    note: Text


def with_own_forces(
    lines: Sequence[AnsweredLine], written: Sequence[AnsweredLine], verdict: Verdict
) -> OwnForces | None:
    """The answer with each wrong Ξ that its equations use as a name of its own, if nothing else is wrong in it.

    Q_1 = τ − 2 m r r′ ψ′ and ψ″ = Q_1/J: as Ξ it is wrong, but the equation says what it is used for.
    """
    wrong = [f.line for f in verdict.findings if f.status is Status.WRONG]
    if verdict.status is not Status.WRONG or not wrong or any(x.kind != "Xi" or "Ξ" in x.text for x in wrong):
        return None
    names = {str(x.name) for x in wrong}
    used = [line.expr for line in lines if line.kind == "equation"]
    if not all(any(x.has(generalized_force(name)) for x in used) for name in names):
        return None

    def own(given: Sequence[AnsweredLine]) -> tuple[AnsweredLine, ...]:
        return tuple(replace(x, kind="definition") if x.kind == "Xi" and str(x.name) in names else x for x in given)

    return OwnForces(own(lines), own(written), _read_as_own(wrong))


def without_own_names(
    truth: Reference, lines: Sequence[AnsweredLine], findings: Sequence[Finding]
) -> tuple[list[Finding], tuple[Text, ...]]:
    """The findings without those of each wrong Ξ_z of a coordinate z of the answer's own that equations use, where
    their value is written out, if nothing else is wrong; with what to say of them."""
    wrong = [f.line for f in findings if f.status is Status.WRONG]
    system = {c.name for c in truth.model.coordinates}
    used = {of_coordinate(x) for line in lines if line.kind == "equation" for x in line.names}
    mine = [x for x in wrong if x.kind == "Xi" and x.name not in system and ("Xi", key(str(x.name))) in used]
    if not wrong or len(mine) < len(wrong):
        return list(findings), ()
    return [f for f in findings if f.line not in wrong], (_read_as_own(wrong),)


def _read_as_own(lines: Sequence[AnsweredLine]) -> Text:
    table = [x for line in lines for x in (f"'{line.text}'", ", ")][:-1]
    return text(*table, " was read as a name of your own; as Ξ it would be wrong.")
