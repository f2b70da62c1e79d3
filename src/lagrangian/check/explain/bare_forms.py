"""What holds in general, d/dt ∂L/∂θ̇ − ∂L/∂θ = Ξ_θ, is not called wrong below a wrong energy."""

from __future__ import annotations

import re
from dataclasses import replace

from lagrangian.check.reference import Reference
from lagrangian.check.verdict import Finding, Status, Verdict
from lagrangian.read.letters import key

_SLOPE = re.compile(r"∂|\\(?:partial|pdv|dv)\b|\\frac\s?\{\s?d|\bd\s?/\s?d", re.ASCII)
"""What a derivative in such a line is written with."""


def without_bare_forms(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict on a wrong answer without the findings of such lines that are only not right because of others."""
    if verdict.status is not Status.WRONG:
        return verdict
    given = {key(x.name) for x in (*truth.model.parameters, *truth.model.inputs, *truth.model.definitions)}
    findings = tuple(f for f in verdict.findings if not _is_bare(f, given))
    return replace(verdict, findings=findings) if len(findings) < len(verdict.findings) else verdict


def _is_bare(finding: Finding, given: set[str]) -> bool:
    line = finding.line
    if finding.status is not Status.WRONG or not finding.follows or line.names & given:
        return False
    return line.kind == "equation" and "=" in line.text and _SLOPE.search(line.text) is not None
