"""Options of the form ``name=value``, given once for each name: ``--at x2=0 --at "theta=12 deg"``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from lagrangian.errors import Error


def assignments(given: Sequence[str] | None, option: str) -> dict[str, str]:
    """Return name → value as text. Raises `Error` if an item is not ``name=value`` or a name occurs twice."""
    found: dict[str, str] = {}
    for item in given or ():
        name, equals, value = (part.strip() for part in item.partition("="))
        if not (name and equals and value):
            raise Error(
                f"{option} takes name=value (got '{item[:80]}')",
                fix=f'{option} x=0.1 or {option} "x=10 mm"',
                code="E406",
            )
        if name in found:
            raise Error(f"'{name[:64]}' is given twice with {option}", fix="give only one of the two", code="E404")
        found[name] = value
    return found


def ranges(given: Sequence[str] | None, option: str) -> dict[str, tuple[str, str]]:
    """Return name → (low, high) of options of the form ``name=low:high``."""
    return {name: _ends(name, side, option) for name, side in assignments(given, option).items()}


def _ends(name: str, side: str, option: str) -> tuple[str, str]:
    low, colon, high = (part.strip() for part in side.partition(":"))
    if not (low and colon and high):
        what = "box" if option == "--box" else "range"
        raise Error(f"the {what} of '{name}' is not low:high", fix=f"{option} {name}=-1:1", code="E406")
    return low, high


def guesses(given: Sequence[str]) -> dict[str, str | None]:
    """Return name → first guess, or None, of words of the form ``name`` or ``name=value``; raises `Error` for none."""
    if not given:
        raise Error("no unknown was named", fix="name parameters or states behind the file: L, or L=0.8", code="E401")
    found: dict[str, str | None] = {}
    for item in given:
        name, equals, value = (part.strip() for part in item.partition("="))
        if not name or (equals and not value):
            raise Error(f"unknowns are names, or name=guess (got '{item[:80]}')", fix="L, or L=0.8", code="E406")
        if name in found:
            raise Error(f"'{name[:64]}' is given twice", fix="name each unknown once", code="E404")
        found[name] = value or None
    return found


def point(
    at: Sequence[str] | None, values: Sequence[str] | None, inputs: Sequence[str] | None, fixed: Sequence[str] | None
) -> dict[str, Any]:
    """Return the arguments of `System.linearize` that say where: ``--at``, ``--set``, ``--input`` and ``--fixed``."""
    return {
        "at": assignments(at, "--at"),
        "params": assignments(values, "--set"),
        "inputs": assignments(inputs, "--input"),
        "fixed": names(fixed) if fixed else None,
    }


def names(given: Sequence[str] | None) -> list[str]:
    """Return names that are separated by commas, or given by several options."""
    return [name.strip() for item in given or () for name in item.split(",") if name.strip()]
