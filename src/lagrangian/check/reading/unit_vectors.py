"""Tells positions, velocities and accelerations that are written with unit vectors: a = x'' e_x + y'' e_y."""

from __future__ import annotations

import re

from lagrangian.check.reading.names import Names

_VECTOR = re.compile(r"(?P<name>(?:[avrsd]|ω|omega)(?:_?\w{1,4})?)\s{0,9}=(?P<value>[^=]*+)\Z")
_UNIT_VECTOR = re.compile(
    r"(?<!\w)(?P<unit>e_?(?:[xyzrntuvφθρ123]|phi|theta|rho)|[êîĵ]_?\w{0,5}|[eijk]\u0302_?\w{0,5})(?!\w)"
)


def is_vector(row: str, names: Names) -> bool:
    """Whether a row says with unit vectors what a position, velocity or acceleration is: a = x'' e_x + y'' e_y."""
    match = _VECTOR.match(row)
    if match is None or names.known(match["name"]):
        return False
    units = _UNIT_VECTOR.finditer(match["value"])
    return any(not names.known(unit["unit"]) for unit in units)
