"""Reads the pages of a derivation back as if they were answers: what is printed must be what was derived.

The reader shares nothing with the printers but the names of the symbols, so that a fraction turned over or a lost sign
makes a wrong answer.
"""

from __future__ import annotations

from collections.abc import Mapping

from lagrangian.check.check import check
from lagrangian.check.lines import lines_of
from lagrangian.check.reading import parse_answer
from lagrangian.check.verdict import Status
from lagrangian.derive import Derived
from lagrangian.errors import Error
from lagrangian.page.formula import Check, text


def printed_checks(derivation: Derived, pages: Mapping[str, str]) -> tuple[Check, ...]:
    """Return a check for each page, by the name of its format; ``holds`` is None for one that cannot be read back."""
    return tuple(_checked(derivation, name, page) for name, page in pages.items())


def _checked(derivation: Derived, name: str, page: str) -> Check:
    what = text(f"the equations and energies as {name} prints them, read back, are these")
    try:
        verdict = check(derivation, lines_of(parse_answer(page, derivation.model)), explain=False)
    except Error as error:
        return Check(what, None, f"not checked: the page is not read back ({error.what[:120]})")
    wrong = [finding for finding in verdict.findings if not finding.status.right]
    complete = verdict.right or (verdict.status is Status.INCOMPLETE and not wrong)
    count = f"{len(verdict.findings)} lines"
    return Check(what, complete, count if complete else f"{len(wrong)} of {count} differ")
