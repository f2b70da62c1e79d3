"""The steps of the derivation as lines for a comment, where a system has a derivation."""

from __future__ import annotations

from itertools import pairwise

from lagrangian import bounded
from lagrangian.derive import pages
from lagrangian.errors import Error
from lagrangian.model import Model
from lagrangian.model.model import is_hard
from lagrangian.structured.choose import derive_in_form

Sections = list[tuple[str, list[str]]]
"""The heading of a step, and its lines."""


@bounded.answered("writing the equations out", is_hard)
def _derived(model: Model) -> str:
    return pages.to_text(derive_in_form(model), brief=True)


def step_sections(model: Model) -> Sections:
    """Return the steps of the derivation in brief: a heading and its lines each.

    Without a derivation, as with a floating frame or where the equations cannot be written, one section says why.
    """
    try:
        lines = _derived(model).splitlines()[3:]
    except Error as error:
        return [("Derivation", [f"The steps are not shown: {error.what}."])]
    found: Sections = [("Derivation", [])]
    for before, line in pairwise(["", *lines]):
        if not before and line[:1].isalnum():
            found.append((line.strip(), []))
        else:
            found[-1][1].append(line.rstrip())
    return [(heading, _trimmed(body)) for heading, body in found if heading != "Derivation" or any(body)]


def _trimmed(lines: list[str]) -> list[str]:
    """Without empty lines at both ends."""
    while lines and not lines[0]:
        lines = lines[1:]
    while lines and not lines[-1]:
        lines = lines[:-1]
    return lines
