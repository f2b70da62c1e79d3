"""The names of quantities that a derivation states: T*, V, L, D, a Ξ, a momentum; symbols of the model have precedence.

L is a length in many systems and the Lagrangian in every derivation. A line ``L = …`` states the Lagrangian, because a
parameter already has its value; everywhere else L means what the model says.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

import sympy as sp

from lagrangian.model import Model
from lagrangian.read.letters import SPELLED, find, key, normal, spelled

ENERGY_NAMES = {
    "T": "T",
    "T*": "T",
    "K": "T",
    "KE": "T",
    "Ek": "T",
    "Ekin": "T",
    "V": "V",
    "U": "V",
    "P": "V",
    "PE": "V",
    "Ep": "V",
    "Epot": "V",
    "L": "L",
    "ℒ": "L",
    "Lagrangian": "L",
    "D": "D",
    "ℱ": "D",
    "R": "D",
}
"""Common names of the energies, without underscores."""
ENERGY_NAMES |= {
    f"{letter}{whole}": kind
    for letter, kind in (("T", "T"), ("Ekin", "T"), ("V", "V"), ("U", "V"), ("Epot", "V"))
    for whole in ("total", "tot", "ges", "gesamt", "sys", "system", "sum")
}

_CAREFUL = frozenset(["K", "P", "R", "U"])
"""Letters that are read as an energy only if a line states them."""

_FORCE = re.compile(r"(?P<letter>Xi|Q|tau)_?\(?(?P<index>\w*)\)?\Z")
_OF_T = re.compile(r"T_?[A-Za-z]\w{0,12}")
_MOMENTUM = re.compile(r"p_?(?P<index>\w+)\Z")


def energy_of(name: str, model: Model, *, lhs: bool = False) -> str | None:
    """Return the energy that a name means, "T", "V", "L" or "D", or None. ``lhs``: the name is alone on the left of
    an =."""
    plain = str(name).replace("_", "")
    kind = ENERGY_NAMES.get(plain) or ENERGY_NAMES.get(normal(plain))
    if kind is None or (not lhs and plain in _CAREFUL):
        return None
    taken = find(name, model.symbols)
    if not taken:
        return kind
    constants = {p.name for p in model.parameters}
    return kind if lhs and taken[0] in constants else None


def is_no_energy(value: Any) -> bool:
    """Whether what has the name of an energy is none, as its value is a number: D = 0.61, T = 2.5 s."""
    return isinstance(value, sp.Expr) and value != 0 and bool(value.is_number)


def own_kinetic(own: Mapping[str, tuple[str, Any]]) -> str | None:
    """Return the one name of an answer's own, with its values by their keys, that is a T with an index and has squares
    of rates: T_rel = m x'^2/2; None if there is none, or more than one."""
    found = [base for base, (_, value) in own.items() if _OF_T.fullmatch(base) and has_squares(value)]
    return found[0] if len(found) == 1 else None


def has_squares(value: Any) -> bool:
    """Whether a value has squares of rates and nothing that is differentiated twice, as a kinetic energy has."""
    rates = value.atoms(sp.Derivative) if isinstance(value, sp.Expr) else set[Any]()
    squares = isinstance(value, sp.Expr) and any(value.has(r**2) for r in rates)
    return squares and all(r.derivative_count == 1 for r in rates)


def force_of(name: str, model: Model, *, named: bool = False) -> str | None:
    """Return the coordinate whose generalized force a name is: Xi_x1, Xi_th, Ξ₁, Q_theta, τ₁; None if it is not one.

    ``named``: the answer gives forces the ends of coordinates' names, so that Q_1 beside Q_m is that of phi_1.
    """
    written = spelled(name)
    match = _FORCE.match(written) if written.startswith(("Xi", "Q", "tau")) else None
    if match is None or find(name, model.symbols):
        return None
    if match["letter"] == "tau" and (not match["index"] or any(key(n).startswith("tau") for n in model.symbols)):
        return None  # it means a torque
    if (found := _coordinate(match["index"], model, named=named)) is not None or match["letter"] != "Xi":
        return found  # Q_th may be what one element adds
    short = key(match["index"])
    begun = [c.name for c in model.coordinates if len(short) > 1 and key(c.name).startswith(short)]
    return begun[0] if len(begun) == 1 else None


class NamedForces:
    """The generalized forces among the names of an answer.

    With several coordinates, Q_th and Q_ph are those of theta and phi if there is one such name for each coordinate;
    one alone may be what one element adds.
    """

    def __init__(self, model: Model, names: Iterable[str] = ()) -> None:
        self.model = model
        forces = [(m, x) for x in names if (m := _FORCE.match(spelled(x))) is not None and m["index"]]
        self._named = any(not m["index"].isdigit() and force_of(x, model) is not None for m, x in forces)
        begun = {key(x): self._begun(m["index"]) for m, x in forces if m["letter"] == "Q"}
        of_each = sorted(x for x in begun.values() if x is not None)
        whole = len(of_each) > 1 and of_each == sorted(c.name for c in model.coordinates)
        self._short = begun if whole and len(begun) == len(of_each) else dict[str, str | None]()

    def of(self, name: str) -> str | None:
        """The coordinate whose generalized force a name is; None if it is not one."""
        return force_of(name, self.model, named=self._named) or self._short.get(key(name))

    def _begun(self, index: str) -> str | None:
        """The coordinate that an index is, or with which only its name begins."""
        short = key(index)
        found = [c.name for c in self.model.coordinates if key(c.name) == short]
        found = found or [c.name for c in self.model.coordinates if len(short) > 1 and key(c.name).startswith(short)]
        return found[0] if len(found) == 1 else None


def momentum_of(name: str, model: Model) -> str | None:
    """Return the coordinate whose momentum a name is: p_theta, p1; pi, phi and psi are letters."""
    if find(name, model.symbols):
        return None
    match = _momentum(spelled(name))
    return None if match is None else _coordinate(match["index"], model)


def _momentum(name: str) -> re.Match[str] | None:
    """What a momentum is called, and with which index; no Greek letter."""
    return None if name in SPELLED.values() else _MOMENTUM.match(name)


def of_coordinate(name: str) -> tuple[str, str] | None:
    """Return what a name is for a coordinate that it ends with, whatever that is: Q_z ("Xi", "z"), p_z ("p", "z")."""
    for kind, form in (("Xi", _FORCE.match), ("p", _momentum)):
        match = form(spelled(name))
        if match is not None and match["index"] and not match["index"].isdigit():
            return kind, match["index"]
    return None


def _coordinate(index: str, model: Model, *, named: bool = False) -> str | None:
    """The coordinate of an index: by name, by number, or by the end of its name, which is first if it is ``named``; a
    single coordinate needs no index."""
    names = [c.name for c in model.coordinates]
    if not index:
        return names[0] if len(names) == 1 else None
    if found := find(index, names):
        return found[0] if len(found) == 1 else None
    ending = [n for n in names if key(n).endswith(key(index))]
    if index.isdigit() and 1 <= int(index[:6]) <= len(names) and not (named and len(ending) == 1):
        return names[int(index) - 1]
    return ending[0] if len(ending) == 1 else None
