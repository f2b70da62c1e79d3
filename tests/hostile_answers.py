"""Random answers under 2 kB that are hostile to whoever compares them: a seed each, the same everywhere."""

from __future__ import annotations

from hostile_models import Source

LONGEST = 2_000
"""Bytes that an answer may have."""


def _equations(s: Source, names: tuple[str, ...], coordinates: list[str], room: int) -> str:
    """An equation for every coordinate, of which the left side is a product with an acceleration."""
    each = room // len(coordinates)
    return "\n".join(f"({s.sized(names, each // 2)})*{q}'' + {s.sized(names, each // 2)} = 0" for q in coordinates)


def _energies(s: Source, names: tuple[str, ...], coordinates: list[str], room: int) -> str:
    T = "+".join(f"({s.sized(names, room // 4)})*{q}'^2" for q in coordinates)
    return f"T = {T}\nV = {s.sized(names, room // 4)}\nL = T - V"


def _derivatives(s: Source, names: tuple[str, ...], coordinates: list[str], room: int) -> str:
    """What stands in d/dt(…) is written out by the one who reads it."""
    return "\n".join(f"d/dt(({s.sized(names, room // 3)})*{q}') = {s.expr(names, 2)}" for q in coordinates)


def _definitions(s: Source, names: tuple[str, ...], coordinates: list[str], room: int) -> str:
    """A chain of definitions, each of which uses the one before it twice or more."""
    lines = [f"u0 = {s.sized(names, room // 6)}"]
    while sum(map(len, lines)) < room // 2:
        last = f"u{len(lines) - 1}"
        lines.append(f"u{len(lines)} = {s.expr((last, last, *names), 2)} + {last}")
    return "\n".join([*lines, *(f"{q}'' = u{len(lines) - 1}" for q in coordinates)])


def _turned(s: Source, names: tuple[str, ...], coordinates: list[str], room: int) -> str:
    """Equations in coordinates that the answer makes up."""
    made = [f"{coordinates[0]} = w1 + {s.expr(names, 1)}"]
    return "\n".join([*made, _equations(s, (*names, "w1"), ["w1", *coordinates[1:]], room)])


KINDS = (_equations, _energies, _derivatives, _definitions, _turned)


def answer(seed: int, coordinates: list[str], parameters: list[str]) -> str:
    """The answer of a seed, for a system with these coordinates and parameters."""
    source = Source(1_000 + seed)
    names = (*coordinates, *coordinates, *(f"{q}'" for q in coordinates), *parameters)
    room = source.random.choice((100, 300, 800, 1600))
    while True:
        text = KINDS[seed % len(KINDS)](source, names, coordinates, room)
        if len(text.encode()) < LONGEST:
            return text
        room = room * 2 // 3
