"""What a class is asked for: the parts that an answer must have, whose coordinates count, and the points of each."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal, TypeAlias, get_args

from lagrangian.errors import Error, ModelError, did_you_mean
from lagrangian.read import MAX_BYTES, decode
from lagrangian.records import dataclass, field
from lagrangian.viewed import Brief

AllowedCoordinates: TypeAlias = Literal["any", "given"]
"""Whether an answer may use any coordinates, or only those of the model."""

PARTS = {"T": "T*", "V": "V", "L": "L", "D": "D", "step5": "step 5", "Xi": "Ξ", "equations": "the equations"}
"""The parts of an answer and how they are called; ``step5`` stands for ∂L/∂ξ̇, its d/dt and ∂L/∂ξ."""

ALIASES = {"T*": "T", "step2": "T", "step3": "V", "step4": "L", "step6": "Xi", "Ξ": "Xi", "equation": "equations"}
"""Other names of parts: the step of the lecture in which each is found."""

PER_COORDINATE = ("Xi", "equations")
"""The parts with a line for every coordinate; ``Xi_theta`` is one of these lines."""

OTHER = "other_coordinates"
"""The name of the share of the points for an answer in other coordinates than those asked for."""

MAX_POINTS = 10_000
"""The most points that a part may have."""


@dataclass(frozen=True, kw_only=True)
class MarkingScheme(Brief):
    """What is asked for, and what it is worth; see `lagrangian.Derivation.check_class`.

    ``points`` has the points by part: "T", "V", "L", "D", "step5", "Xi", "equations" (or "step2" to "step6"), or by
    line: "Xi_theta", "equations_theta". ``require`` lists the parts without which a right answer is incomplete. With
    ``coordinates="given"`` an answer in other coordinates than the model's is not accepted, and gets the share
    ``other`` of its points. Raises `ModelError` for a name or a number that does not fit.
    """

    points: Mapping[str, float] = field(default_factory=dict[str, float])
    require: Sequence[str] = ()
    coordinates: AllowedCoordinates = "any"
    other: float = 0.5

    def __post_init__(self) -> None:
        if self.coordinates not in get_args(AllowedCoordinates):
            fix = 'coordinates="any", or coordinates="given"'
            raise ModelError(f"coordinates is “any” or “given” (got {self.coordinates!r})", fix=fix, code="E406")
        points: dict[str, float] = {}
        for name, worth in self.points.items():
            part = _part(name)
            if part in points:
                raise ModelError(f"the points of {PARTS.get(part, part)} are given twice", fix="give them once")
            points[part] = _worth(name, worth, MAX_POINTS)
        whole = {name.partition("_")[0] for name in points if "_" in name} & points.keys()
        if whole:
            name = sorted(whole)[0]
            what = f"points are given for {PARTS[name]} as a whole and line by line"
            raise ModelError(what, fix="give one of the two", code="E404")
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "require", tuple(dict.fromkeys(_part(name, lines=False) for name in self.require)))
        object.__setattr__(self, "other", _worth(OTHER, self.other, 1))

    @property
    def total(self) -> float:
        """The most points that an answer can get."""
        return sum(self.points.values())

    def to_dict(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "points": dict(self.points),
            "require": list(self.require),
            "coordinates": self.coordinates,
            "other": self.other,
        }


def _part(name: object, *, lines: bool = True) -> str:
    """The name of a part, or of one of its lines."""
    if not isinstance(name, str):
        raise ModelError(f"a part of an answer has a name (got {name!r})", fix='"T"', code="E406")
    base, line, coordinate = name.strip().partition("_")
    base = ALIASES.get(base, base)
    if base in PARTS and not line:
        return base
    if base in PER_COORDINATE and coordinate and lines:
        return f"{base}_{coordinate}"
    known = [*PARTS, "step2", "step3", "step4", "step6"]
    fix = did_you_mean(name, known) or f"use {', '.join(PARTS)}, or step2 to step6"
    raise ModelError(f"'{name}' is not a part of an answer", fix=fix, code="E402")


def _worth(name: str, value: object, most: float) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0 <= value <= most:
        raise ModelError(f"'{name}' is a number from 0 to {most} (got {value!r})", fix=f"{name} = 1", code="E406")
    return float(value)


def scheme_of(
    points: str | None = None, require: str | None = None, coordinates: AllowedCoordinates = "any"
) -> MarkingScheme:
    """Return the scheme that the options of the command describe.

    ``points`` is ``T=2,V=2,equations=4`` or the path of a TOML file with such lines, alone or under ``[points]``;
    ``other_coordinates = 0.5`` there is the share for an answer in other coordinates. Raises `Error` if it cannot be
    read.
    """
    found = {} if points is None else _read(points) if "=" not in points else _listed(points)
    other = found.pop(OTHER, 0.5)
    wanted = [] if require is None else [name for name in require.split(",") if name.strip()]
    return MarkingScheme(points=found, require=wanted, coordinates=coordinates, other=other)


def _listed(text: str) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for item in text.split(","):
        name, _, value = item.partition("=")
        try:
            number = float(value)
        except ValueError:
            what = f"'{item.strip()}' is not a part and its points"
            raise Error(what, fix="--points T=2,V=2,Xi=2,equations=4", code="E402") from None
        if name.strip() in found:
            raise Error(f"the points of '{name.strip()}' are given twice", fix="give them once", code="E402")
        found[name.strip()] = number
    return found


def _read(path: str) -> dict[str, Any]:
    try:
        with Path(path).open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except OSError as error:
        fix = "name a TOML file, or give the points themselves: --points T=2,V=2,equations=4"
        raise Error(f"cannot read '{path}': {(error.strerror or str(error)).lower()}", fix=fix, code="E702") from error
    try:
        found = tomllib.loads(decode(data, path))
    except tomllib.TOMLDecodeError as error:
        raise Error(f"'{path}' is not TOML: {error}", fix="T = 2", code="E701") from error
    table = found.pop("points", found)
    if not isinstance(table, dict) or (table is not found and found.keys() - {OTHER}):
        raise Error(f"'{path}' holds more than points", fix="put them under [points], a line each: T = 2", code="E402")
    return {**found, **table}
