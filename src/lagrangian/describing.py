"""The part of a system that collects its description: coordinates, parameters, points and elements."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from copy import deepcopy
from typing import Any, Self

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.calls import SYSTEM, worded
from lagrangian.circuits import Circuits
from lagrangian.constraining import Constrained
from lagrangian.errors import ModelError, Notice
from lagrangian.model import (
    Builder,
    Damper,
    Dissipation,
    Element,
    Force,
    Frame,
    GeneralizedForce,
    Gravity,
    Kinetic,
    Model,
    Particle,
    Point,
    Potential,
    RigidBody,
    Spring,
    Torque,
    as_expr,
    time,
)
from lagrangian.model.decimals import describes, noting
from lagrangian.page.plain import plain
from lagrangian.placed import PointsAndFrames
from lagrangian.quantities.quantity import parse_quantity

STANDARD_GRAVITY = 9.81
"""The default value of the parameter g [m/s²]."""

MOST_NAMES = 10_000
"""The largest number of names in a range such as ``q1:7``."""


@worded
@describes
class Described(PointsAndFrames, Constrained, Circuits):
    """The methods that describe a system: symbols, geometry, elements. `lagrangian.System` adds the verbs."""

    _guide = SYSTEM

    def __init__(self, name: str, *, _builder: Builder | None = None) -> None:
        self._builder = _builder if _builder is not None else Builder(name)

    def __copy__(self) -> Self:
        """Return an independent copy: later additions to one system do not affect the other."""
        return type(self)(self.name, _builder=deepcopy(self._builder))

    # -- symbols ------------------------------------------------------------------------------------------------

    @property
    def name(self) -> str:
        """The system's name."""
        return self._builder.name

    @property
    def origin(self) -> Point:
        """The fixed origin; ``origin + (x, y)`` is a point."""
        return self._builder.origin

    @property
    def t(self) -> sp.Symbol:
        """The symbol of time t, for prescribed motions."""
        return time

    @property
    def model(self) -> Model:
        """The description as a frozen `Model`; raises `ModelError` if it is incomplete or has impossible inertias."""
        from lagrangian.dynamics import notices  # imported here because describing a system needs no mechanics

        model = self._builder.model()
        notices(model)
        return model

    @property
    def notices(self) -> tuple[Notice, ...]:
        """The notices: what you should know but is not an error, such as an inertia that no real body has."""
        from lagrangian.dynamics import notices

        return notices(self.model)

    @property
    def energy(self) -> sp.Expr:
        """T + V [J] as an expression for runs and events; T is T* but for coils that saturate."""
        return self.model.total_energy()

    def __getitem__(self, name: str) -> Any:
        """Return the symbol, point or frame with this name; a symbol comes first."""
        return self._builder.lookup(name)

    def __contains__(self, name: object) -> bool:
        """Whether ``name`` is the name of a symbol, point, frame or element of the system, or one of these itself."""
        if isinstance(name, str):
            return self._builder.find(name) is not None
        return any(name == thing for thing in self._builder.named())

    def coordinate(
        self, name: str, description: str = "", *, unit: str | None = None, positive: bool = False
    ) -> AppliedUndef:
        """Declare one generalized coordinate; return a SymPy dynamicsymbol, whose ``.diff()`` is the rate.

        ``positive`` declares that it is always greater than 0, as a distance is: then √(r²) simplifies to r.
        """
        return self._builder.coordinate(name, description=description, unit=_unit(unit), positive=positive).symbol

    def coordinates(self, names: str | Iterable[str], *, positive: bool = False) -> Any:
        """Declare coordinates: ``theta1, theta2 = system.coordinates("theta1 theta2")``; one name gives one symbol.

        ``"q1:4"`` is short for ``"q1 q2 q3"``, as in SymPy. ``positive`` declares that all of them are always greater
        than 0.
        """
        return _many(names, lambda name: self.coordinate(name, positive=positive))

    def parameter(
        self, name: str, value: float | str | None = None, *, unit: str | None = None, description: str = ""
    ) -> sp.Symbol:
        """Declare a constant. ``value`` is a number in SI units or text with a unit, such as ``"40 N/m"``."""
        number, stored = _value(name, value, unit)
        return self._builder.parameter(name, number, unit=stored, description=description).symbol

    def parameters(self, names: str | Iterable[str], **values: float | str) -> Any:
        """Declare constants: ``m, L = system.parameters("m L", m="1 kg", L=0.5)``; ``"m1:4"`` means ``"m1 m2 m3"``."""
        listed = _split(names)
        unknown = [key for key in values if key not in listed]
        if unknown:
            raise ModelError(
                f"a value was given for '{unknown[0]}', which is not among the names", fix=f"names: {' '.join(listed)}"
            )
        return _many(listed, lambda name: self.parameter(name, values.get(name)), single=_alone(names))

    def input(self, name: str, description: str = "", *, unit: str | None = None) -> AppliedUndef:
        """Declare an input: a force, torque or other signal that is known only when the system runs."""
        return self._builder.input(name, description=description, unit=_unit(unit)).symbol

    def inputs(self, names: str | Iterable[str]) -> Any:
        """Declare several inputs; ``"tau1:4"`` is short for ``"tau1 tau2 tau3"``."""
        return _many(names, self.input)

    def define(self, name: str, expression: object) -> Any:
        """Give an expression a name. Use the returned symbol in its place, and the derivation shows the name."""
        return self._builder.define(name, expression).symbol

    # -- elements -----------------------------------------------------------------------------------------------

    def particle(self, mass: object, at: Point, *, name: str = "") -> Particle:
        """Add a point mass [kg]: T* = ½ m v²."""
        return self._builder.add(Particle(mass=mass, at=at, name=name))

    def rigid_body(
        self, mass: object, inertia: object, at: Point, frame: Frame | sp.Expr, *, name: str = ""
    ) -> RigidBody:
        """Add a rigid body; ``inertia`` is about its centre of mass ``at``; in the plane ``frame`` may be an angle."""
        turned = frame if isinstance(frame, Frame) else self._builder.frame(None, frame)
        return self._builder.add(RigidBody(mass=mass, inertia=inertia, at=at, frame=turned, name=name))

    def gravity(
        self, direction: object = (0, -1), g: object = None, *, datum: Point | None = None, name: str = ""
    ) -> Gravity:
        """Add gravity along ``direction`` (down by default). By default ``g`` is a parameter g = 9.81 m/s²."""
        if isinstance(direction, (int, float)):
            raise ModelError(
                f"the direction of gravity must be a pair or a triple (got {direction!r})",
                fix=f"gravity(direction=(0, -1), g={direction!r})",
                code="E414",
            )
        strength = self._builder.standard_gravity(STANDARD_GRAVITY) if g is None else g
        return self._builder.add(Gravity(direction=direction, g=strength, datum=datum, name=name))

    def spring(
        self,
        k: object = None,
        *,
        between: Sequence[Point] | None = None,
        deflection: object = None,
        rest: object = 0,
        law: object = None,
        energy: object = None,
        name: str = "",
    ) -> Spring:
        """Add a spring: V = ½ k (δ − rest)². A ``law`` is a function: ``lambda delta: k*delta + k3*delta**3``."""
        return self._builder.add(
            Spring(k=k, between=between, deflection=deflection, rest=rest, law=law, energy=energy, name=name)
        )

    def damper(
        self,
        b: object = None,
        *,
        between: Sequence[Point] | None = None,
        deflection: object = None,
        law: object = None,
        name: str = "",
    ) -> Damper:
        """Add a damper: D = ½ b δ̇². Instead of ``b``, give a ``law`` such as ``lambda rate: b*rate*abs(rate)``."""
        return self._builder.add(Damper(b=b, between=between, deflection=deflection, law=law, name=name))

    def force(
        self,
        value: object,
        *,
        at: Point | None = None,
        reaction: Point | None = None,
        axes: Frame | None = None,
        between: Sequence[Point] | None = None,
        deflection: object = None,
        name: str = "",
    ) -> Force:
        """Add a force: a vector at a point, or a scalar along a deflection (positive pushes the ends apart)."""
        return self._builder.add(
            Force(value=value, at=at, reaction=reaction, axes=axes, between=between, deflection=deflection, name=name)
        )

    def torque(
        self, value: object, on: object = None, reaction: object = None, *, axes: Frame | None = None, name: str = ""
    ) -> Torque:
        """Add a torque on an angle or a frame; the opposite torque acts on ``reaction`` (by default the ground).

        A torque with three components has them along the axes of the frame ``axes`` (by default the fixed axes).
        """
        return self._builder.add(Torque(value=value, on=on, reaction=reaction, axes=axes, name=name))

    def potential(self, V: object, *, name: str = "") -> Potential:
        """Add a potential energy V [J] that you already know."""
        return self._builder.add(Potential(value=V, name=name))

    def kinetic(self, T: object, *, name: str = "") -> Kinetic:
        """Add a kinetic co-energy T* [J] that you already know."""
        return self._builder.add(Kinetic(value=T, name=name))

    def dissipation(self, D: object, *, name: str = "") -> Dissipation:
        """Add a Rayleigh dissipation function D [W]: Ξ_i = −∂D/∂ξ̇_i."""
        return self._builder.add(Dissipation(value=D, name=name))

    def generalized_force(self, coordinate: object, value: object, *, name: str = "") -> GeneralizedForce:
        """Add a generalized force Ξ to one coordinate, or to one velocity of a floating frame."""
        return self._builder.add(GeneralizedForce(coordinate=coordinate, value=value, name=name))

    def add(self, element: Element) -> Element:
        """Add an element that was made from its class, such as one of a kind that you wrote yourself."""
        return self._builder.add(element)

    @property
    def elements(self) -> tuple[Element, ...]:
        """The elements added so far, in order."""
        return self._builder.elements

    @classmethod
    def from_energies(
        cls,
        coordinates: Sequence[AppliedUndef] | AppliedUndef,
        *,
        T: sp.Expr,
        V: sp.Expr | int = 0,
        D: sp.Expr | int = 0,
        Xi: Mapping[AppliedUndef, sp.Expr] | Sequence[sp.Expr] | None = None,
        name: str = "system from energies",
    ) -> Self:
        """Return the system with given energies; other symbols become parameters, other functions of t inputs."""
        listed = [coordinates] if isinstance(coordinates, AppliedUndef) else _listed(coordinates, "coordinates")
        system = cls(name)
        for q in listed:
            if not isinstance(q, AppliedUndef) or q.args != (time,):
                raise ModelError(
                    f"'{q}' is not a function of time", fix='use dynamicsymbols("q") or Function("q")(t)', code="E201"
                )
            system.coordinate(q.func.__name__)
        if Xi is None:
            forces: dict[Any, Any] = {}
        elif isinstance(Xi, Mapping):
            forces = dict(Xi)
        else:
            values = _listed(Xi, "Xi")
            if len(values) != len(listed):
                raise ModelError(f"Xi has {len(values)} entries for {len(listed)} coordinates", code="E501")
            forces = dict(zip(listed, values, strict=True))
        with noting(system._builder.decimals):
            T, V, D = as_expr(T, "T"), as_expr(V, "V"), as_expr(D, "D")
            forces = {q: as_expr(value, f"Xi of {q}") for q, value in forces.items()}
        everything = sp.Tuple(T, V, D, *forces.values())
        for symbol in sorted(everything.free_symbols - {time}, key=str):
            system.parameter(str(symbol))
        for signal in sorted(everything.atoms(AppliedUndef) - set(listed), key=str):
            system.input(signal.func.__name__)
        system.kinetic(T, name="T*")
        if V != 0:
            system.potential(V, name="V")
        if D != 0:
            system.dissipation(D, name="D")
        for q, value in forces.items():
            if value != 0:
                system.generalized_force(q, value, name=f"Xi_{plain(q)}")
        return system


def _split(names: str | Iterable[str]) -> list[str]:
    """The names in a list or a text, with ranges expanded."""
    if not isinstance(names, str):
        return _listed(names, "names")
    return [name for part in names.replace(",", " ").split() for name in _ranged(part)]


def _ranged(text: str) -> list[str]:
    """The names of a range such as ``q1:4`` or ``x_a:c``, as SymPy expands it; any other name by itself."""
    if ":" not in text:
        return [text]
    numbers = [(int(a or 0), int(b)) for a, b in re.findall(r"(\d*):(\d+)", text)]
    if any(len(part) > 9 for part in re.findall(r"\d+", text)) or math.prod(b - a for a, b in numbers) > MOST_NAMES:
        raise ModelError(f"the range '{text[:40]}' has more than {MOST_NAMES} names", code="E601")
    try:
        made = sp.symbols(text, seq=True)
    except ValueError:
        made = ()
    if not made:
        raise ModelError(
            f"'{text[:40]}' is not a range of names", fix='"q1:4" is q1 q2 q3: the end is not in it', code="E702"
        )
    return [symbol.name for symbol in made]


def _alone(names: object) -> bool:
    """Whether a text is a single name, not a range, so that one symbol is returned instead of a tuple."""
    return isinstance(names, str) and ":" not in names


def _listed(things: object, what: str) -> list[Any]:
    """The items of a list or tuple; anything else is an error."""
    if isinstance(things, Iterable) and not isinstance(things, str | bytes | Mapping):
        return list(things)
    raise ModelError(f"{what} must be a list (got {type(things).__name__})", fix="[first, second, …]", code="E406")


def _many(names: str | Iterable[str], make: Any, *, single: bool | None = None) -> Any:
    """Make one symbol for each name; a text with exactly one name gives the symbol itself, as in SymPy."""
    listed = _split(names)
    if not listed:
        raise ModelError("no name is given", fix='give names, such as "theta1 theta2"', code="E401")
    made = tuple(make(name) for name in listed)
    alone = _alone(names) if single is None else single
    return made[0] if len(made) == 1 and alone else made


def _unit(unit: str | None) -> str | None:
    if unit is not None:
        if not isinstance(unit, str):
            raise ModelError(f"a unit must be text (got {type(unit).__name__})", fix='such as "kg"', code="E408")
        parse_quantity(f"1 {unit}")
    return unit


def _value(name: str, value: float | str | None, unit: str | None) -> tuple[Any, str | None]:
    """Return a value in SI units, and the unit in which it was given."""
    if isinstance(value, str):
        quantity = parse_quantity(value, what=f"parameter '{name}'")
        return quantity.value, quantity.unit
    if unit is not None and isinstance(value, (int, float)) and not isinstance(value, bool):
        quantity = parse_quantity(f"{value!r} {unit}", what=f"parameter '{name}'")
        return quantity.value, quantity.unit
    return value, unit
