"""Tells one or two terms that differ as the mistake, where no reason for them was found: ½ J₂ ω should be ½ J₂ ω²."""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.own_terms import LINES
from lagrangian.check.terms.sides import WRONG_SIGN, differs, on_side
from lagrangian.check.verdict import Finding, Mistake, TermDifference, Verdict
from lagrangian.model import time
from lagrangian.page.formula import text
from lagrangian.read.letters import key

LEFT_OVER = (" differs in other ways as well.", " differ as well.")
"""How notes end on lines that the mistakes leave open."""
MOST_TOLD = 2
"""The most terms that are told in this way; more are a list of what differs."""
WHY = text("Compare this term with its neighbours: its sign, its factors, its powers and its unit.")
WHY_CARRIED = text(
    "What carries the body is accelerated, too: m times this acceleration belongs in a sum of forces, and its moment "
    "in a sum of moments about an axis that moves along."
)


def with_terms_alone(verdict: Verdict) -> Verdict:
    """The verdict on a wrong answer, with the terms that differ as its mistakes if it has none and they are few."""
    roots = [f for f in verdict.open_findings if not f.clash]
    differing = [(f, d) for f in roots for d in f.differences]
    forces = [f.line.name for f in verdict.findings if f.line.kind == "Xi"]
    unclear = any(forces.count(f.line.name) > 1 for f in roots)  # one that is stated twice
    every = not unclear and all(f.differences for f in roots)
    if verdict.mistakes or verdict.hint == 0 or not every or not 0 < len(differing) <= MOST_TOLD:
        return verdict
    return replace(verdict, mistakes=tuple(term_mistake(f, d) for f, d in differing), sure=True)


def with_terms_of_a_balance(verdict: Verdict) -> Verdict:
    """The same for a wrong balance of a body; where it lacks an acceleration, this is what carries the body."""
    told = with_terms_alone(verdict)
    lacking = [d for f in told.open_findings for d in f.differences]
    if len(lacking) != 1 or lacking[0].written != 0 or not any(x.derivative_count > 1 for x in _rates(lacking[0])):
        return told
    return replace(told, mistakes=tuple(replace(m, why=WHY_CARRIED) for m in told.mistakes))


def _rates(difference: TermDifference) -> list[sp.Derivative]:
    return [x for x in difference.term.atoms(sp.Derivative) if isinstance(x, sp.Derivative)]


def _is_of_speeds(finding: Finding) -> bool:
    """Whether a line is no equation of a coordinate and equates rates, products of them or their squares alone."""
    line = finding.line
    if line.kind != "equation" or finding.coordinate is not None or line.sides is None:
        return False
    terms = [x for side in line.sides for x in sp.Add.make_args(side)]
    accelerated = any(d.derivative_count > 1 for d in line.expr.atoms(sp.Derivative) if isinstance(d, sp.Derivative))
    return not accelerated and all(x.has(sp.Derivative) for x in terms)


def term_mistake(finding: Finding, difference: TermDifference) -> Mistake:
    """The mistake that a term which differs is."""
    line = finding.line
    side, d = on_side(line, difference)
    origins = difference.origins
    told = origins and line.kind in ("equation", "definition")
    step = origins[0].step if told else 2 if not origins and _is_of_speeds(finding) else LINES.get(line.kind, 5)
    element = origins[0].element if len({o.element for o in origins}) == 1 else None
    where = f"In {line.title}{f', {side}' if side else ''}, "
    brief = text(f"A term in {line.title} is not right{f': one that comes from {element}' if element else ''}.")
    return Mistake("term_alone", text(where, *differs(d), "."), WHY, step, element, finding.coordinate, brief)


def with_terms_of_own_forces(verdict: Verdict) -> Verdict:
    """The verdict, in which the wrong sign of a term with a force of the answer's own, −A L sin θ, is of this term: no
    element has it, and what was put in for the force did not stand in the line."""
    roots = verdict.open_findings
    if len(roots) != 1 or len(verdict.mistakes) != 1:
        return verdict
    [finding], [mistake] = roots, verdict.mistakes
    match mistake.what.parts:
        case (str(first), sp.Expr() as term, str(last)) if first == "The term " and last.startswith(WRONG_SIGN):
            pass
        case _:
            return verdict
    own = {x for x in bounded.letters(term) - bounded.letters(finding.line.expr) if x != time}
    if not own or not {key(str(x.func if x.args else x)) for x in own} <= finding.line.names:
        return verdict
    told = replace(finding, differences=(TermDifference("sign", -term, term, finding.coordinate),))
    findings = tuple(told if f is finding else f for f in verdict.findings)
    return replace(verdict, findings=findings, mistakes=(replace(mistake, element=None, body=None, step=5),))
