"""Which lines follow from a wrong definition of a name of the system: they are right in the system that has it so.

Who says δ = φ/n + x/R where it is φ/n − x/R makes one mistake; the energy and the equations with this δ follow.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeAlias

import sympy as sp

from lagrangian.check.prescribed import integrated
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import AnsweredLine, Finding, Status
from lagrangian.coordinates import Carrier, Change
from lagrangian.derive import derive
from lagrangian.errors import ModelError
from lagrangian.model import Definition

KEPT = "definitions"
"""The first entry of the key of a reference with other definitions."""
MOST_KEPT = 4
Judge: TypeAlias = Callable[[Reference, Sequence[AnsweredLine]], Sequence[Finding]]


def follow_from_definitions(truth: Reference, findings: Sequence[Finding], judge: Judge) -> list[Finding]:
    """The findings, with the lines marked that are right with the definitions of the answer."""
    own = {d.name: d for d in truth.model.definitions if d.moving}
    wrong = [f for f in findings if f.line.kind == "identity" and f.status is Status.WRONG]
    wrong = [f for f in wrong if (f.line.name or "").rstrip("'") in own]
    table: dict[str, sp.Expr] = {}
    for f in wrong:
        name = str(f.line.name)
        way = f.line.expr if name in own else integrated(truth, f.line.expr)
        if way is not None:
            table.setdefault(name.rstrip("'"), truth.expand(own[name.rstrip("'")].symbol) - way)
    findings = _said_again(truth, findings, wrong)
    open_lines = [f for f in findings if f.is_open and f not in wrong]
    if not table or not open_lines:
        return list(findings)
    lines = [f.line for f in findings if (f.line.name or "").rstrip("'") not in table]
    right: set[int] = set()
    for sign in (1, -1):  # an angle may be counted in the other sense
        other = _redefined(truth, {name: sign * x for name, x in table.items()})
        found = {id(f.line) for f in judge(other, lines) if f.status.right} if other is not None else set[int]()
        right = max(right, found, key=len)
    return [replace(f, follows=True) if id(f.line) in right and f in open_lines else f for f in findings]


def _said_again(truth: Reference, findings: Sequence[Finding], wrong: Sequence[Finding]) -> list[Finding]:
    """The findings; what is said once more of a name follows from what was said first, γ̇ − α̇ = … from γ̇ = …."""
    later = [
        f
        for k, f in enumerate(wrong)
        if any(x.line.name == f.line.name and zero_everywhere(truth, x.line.expr - f.line.expr) for x in wrong[:k])
    ]
    return [replace(f, follows=True) if any(f is x for x in later) else f for f in findings]


def _redefined(truth: Reference, table: Mapping[str, sp.Expr]) -> Reference | None:
    """The reference of the system with other definitions; None if there is no such system. The last few are kept."""
    key = (KEPT, *table.items())
    if key not in truth.others:
        for old in [k for k in truth.others if isinstance(k, tuple) and k[0] == KEPT][: 1 - MOST_KEPT]:
            del truth.others[old]
        truth.others[key] = _made(truth, table)
    return truth.others[key]


def _made(truth: Reference, table: Mapping[str, sp.Expr]) -> Reference | None:
    model = truth.model
    same: dict[Any, sp.Expr] = {c.symbol: c.symbol for c in model.coordinates}
    try:
        carrier = _Redefined(model, Change(model.coordinates, model.coordinates, same), model.name)
        carrier.table = table
        return Reference(derive(carrier.built().model()), truth.values)
    except ModelError:
        return None


class _Redefined(Carrier):
    """Carries a model over with other definitions and without settings of runs."""

    table: Mapping[str, sp.Expr] = {}

    def definition(self, definition: Definition) -> sp.Expr:
        """The answer's own definition, if it has one."""
        return self.table.get(definition.name, definition.expression)

    def settle(self) -> None:
        """Nothing: no run starts here."""
