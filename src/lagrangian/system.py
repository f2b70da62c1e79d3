"""The object people hold: describe a mechanical system, then derive."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import sympy as sp
from numpy.typing import ArrayLike
from sympy.core.function import AppliedUndef

from lagrangian import read
from lagrangian.analysis import (
    ConservedQuantities,
    Equilibria,
    Hamiltonian,
    Linearization,
    LinearizationAlong,
    Routhian,
    conserved,
    equilibria,
    hamiltonian,
    linearize,
    linearize_along,
    routhian,
)
from lagrangian.analyze import check_dimensions
from lagrangian.analyze.change import carried
from lagrangian.analyze.motion import verify_motion
from lagrangian.checking import CheckedAnswer, check_answer
from lagrangian.comparison import Comparison, compare
from lagrangian.compiled import LANGUAGES, Compiled, sources
from lagrangian.derivation import Derivation, derive_and_verify
from lagrangian.derive import Check
from lagrangian.derive import derive as derive_model
from lagrangian.errors import ModelError, Place
from lagrangian.events import Event
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
    plain,
    time,
)
from lagrangian.runs import Ensemble
from lagrangian.simulation import simulate as run_model
from lagrangian.sweeping import ensemble as run_ensemble
from lagrangian.sweeping import sweep as run_sweep
from lagrangian.trajectory import Trajectory
from lagrangian.write import write_file

STANDARD_GRAVITY = 9.81
"""[m/s²] The value of the parameter g unless one is given."""


class System:
    """A mechanical system: coordinates, parameters, points and elements, in the order they are described.

    >>> from sympy import cos, sin
    >>> pendulum = System("pendulum")
    >>> theta = pendulum.coordinates("theta")
    >>> m, L = pendulum.parameters("m L")
    >>> _ = pendulum.particle(m, at=pendulum.origin + (L*sin(theta), -L*cos(theta)))
    >>> _ = pendulum.gravity(direction=(0, -1))
    >>> pendulum.derive().equations[0]
    Eq(L**2*m*Derivative(theta(t), (t, 2)) + L*g*m*sin(theta(t)), 0)
    """

    def __init__(self, name: str, *, _builder: Builder | None = None) -> None:
        self._builder = _builder if _builder is not None else Builder(name)

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
        """The symbol of time, for prescribed motions."""
        return time

    @property
    def model(self) -> Model:
        """The frozen description; raises `ModelError` where it is not complete."""
        return self._builder.model()

    @property
    def energy(self) -> sp.Expr:
        """T* + V [J] as an expression, for runs and events; `derive` reads better."""
        model = self.model
        return sp.Add(*(e.kinetic(model) + e.potential(model) for e in model.elements))

    def __getitem__(self, name: str) -> Any:
        """Return the symbol, or else the point or frame, that carries ``name``."""
        return self._builder.lookup(name)

    def coordinate(self, name: str, description: str = "", *, unit: str | None = None) -> AppliedUndef:
        """Declare one generalized coordinate; return SymPy's dynamicsymbol, whose ``.diff()`` is the rate."""
        return self._builder.coordinate(name, description=description, unit=_unit(unit)).symbol

    def coordinates(self, names: str | Iterable[str]) -> Any:
        """Declare coordinates: ``theta1, theta2 = system.coordinates("theta1 theta2")``; one name gives one symbol."""
        return _many(names, self.coordinate)

    def parameter(
        self, name: str, value: float | str | None = None, *, unit: str | None = None, description: str = ""
    ) -> sp.Symbol:
        """Declare a constant. ``value`` is a number in SI units or text with a unit, such as ``"40 N/m"``."""
        number, stored = _value(name, value, unit)
        return self._builder.parameter(name, number, unit=stored, description=description).symbol

    def parameters(self, names: str | Iterable[str], **values: float | str) -> Any:
        """Declare constants: ``m, L = system.parameters("m L", m="1 kg", L=0.5)``."""
        listed = _split(names)
        unknown = [key for key in values if key not in listed]
        if unknown:
            raise ModelError(
                f"a value was given for '{unknown[0]}', which is not among the names", fix=f"names: {' '.join(listed)}"
            )
        return _many(listed, lambda name: self.parameter(name, values.get(name)), single=isinstance(names, str))

    def input(self, name: str, description: str = "", *, unit: str | None = None) -> AppliedUndef:
        """Declare a force, torque or other signal from outside."""
        return self._builder.input(name, description=description, unit=_unit(unit)).symbol

    def inputs(self, names: str | Iterable[str]) -> Any:
        """Declare several inputs."""
        return _many(names, self.input)

    def define(self, name: str, expression: object) -> Any:
        """Give an expression a name; use the returned symbol, and the derivation shows the name."""
        return self._builder.define(name, expression).symbol

    # -- geometry -----------------------------------------------------------------------------------------------

    def point(
        self, name: str, offset: object, *, relative_to: Point | None = None, frame: Frame | None = None
    ) -> Point:
        """Return a named point, ``offset`` from ``relative_to`` (the origin unless given) in the axes of ``frame``."""
        return self._builder.point(name, offset, parent=relative_to, frame=frame)

    def frame(
        self,
        angle: object,
        *,
        axis: object = None,
        parent: Frame | None = None,
        origin: Point | None = None,
        name: str | None = None,
    ) -> Frame:
        """Return axes turned by ``angle`` from ``parent``'s: in the plane, or about ``axis`` in space."""
        return self._builder.frame(name, angle, axis=axis, parent=parent, origin=origin)

    def floating_frame(self, name: str) -> Frame:
        """Return axes that float in space: with ``base = floating_frame("base")`` its origin moves and it turns freely.

        Coordinates base_x, base_y, base_z (origin, fixed axes) and the quaternion base_qx, base_qy, base_qz, base_qw;
        velocities base_vx, base_vy, base_vz and base_wx, base_wy, base_wz (of the origin and of the turn, in the
        frame's own axes). ``base.origin`` is the point base_origin. `compile` handles it; `derive` does not.
        """
        return self._builder.floating_frame(name)

    # -- elements -----------------------------------------------------------------------------------------------

    def particle(self, mass: object, at: Point, *, name: str = "") -> Particle:
        """Add a point mass [kg]: T* = ½ m v²."""
        return self._builder.add(Particle(mass=mass, at=at, name=name))

    def rigid_body(
        self, mass: object, inertia: object, at: Point, frame: Frame | sp.Expr, *, name: str = ""
    ) -> RigidBody:
        """Add a rigid body: ``inertia`` about its centre of mass ``at``; in the plane ``frame`` may be an angle."""
        turned = frame if isinstance(frame, Frame) else self._builder.frame(None, frame)
        return self._builder.add(RigidBody(mass=mass, inertia=inertia, at=at, frame=turned, name=name))

    def gravity(
        self, direction: object = (0, -1), g: object = None, *, datum: Point | None = None, name: str = ""
    ) -> Gravity:
        """Add gravity along ``direction`` (down). ``g`` is the parameter g, 9.81 m/s², unless given."""
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
        """Add a spring: V = ½ k (δ − rest)². ``law`` may be ``lambda delta: k*delta + k3*delta**3``."""
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
        """Add a damper: D = ½ b δ̇². ``law`` may be ``lambda rate: b*rate*abs(rate)``."""
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
        """Add a torque on an angle or a frame, its opposite on ``reaction`` (the ground when left out).

        Three components stand in the axes of the frame ``axes`` (the fixed axes when left out).
        """
        return self._builder.add(Torque(value=value, on=on, reaction=reaction, axes=axes, name=name))

    def potential(self, V: object, *, name: str = "") -> Potential:
        """Add a potential energy [J] you already have."""
        return self._builder.add(Potential(value=V, name=name))

    def kinetic(self, T: object, *, name: str = "") -> Kinetic:
        """Add a kinetic co-energy [J] you already have."""
        return self._builder.add(Kinetic(value=T, name=name))

    def dissipation(self, D: object, *, name: str = "") -> Dissipation:
        """Add Rayleigh's dissipation function [W]: Ξ_i = −∂D/∂ξ̇_i."""
        return self._builder.add(Dissipation(value=D, name=name))

    def generalized_force(self, coordinate: object, value: object, *, name: str = "") -> GeneralizedForce:
        """Add a generalized force Ξ on one coordinate, or on one velocity of a floating frame."""
        return self._builder.add(GeneralizedForce(coordinate=coordinate, value=value, name=name))

    @property
    def elements(self) -> tuple[Element, ...]:
        """What was added so far, in order."""
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
    ) -> System:
        """Return the system of given energies; other symbols in them become parameters, other functions of t inputs."""
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

    # -- verbs --------------------------------------------------------------------------------------------------

    def derive(self) -> Derivation:
        """Return the derivation: the seven steps, the equations, and what was verified."""
        return derive_and_verify(self.model)

    def check(self, answer: Any, *, hint: int = 3) -> CheckedAnswer:
        """Return whether an answer (text, LaTeX, SymPy equations, energies by name) is right; see `Derivation.check`.

        Derives anew each time: for many answers derive once, and check with the derivation.
        """
        return check_answer(derive_model(self.model), answer, hint=hint)

    def verify(self, *, states: int = 50, seed: int = 1) -> tuple[Check, ...]:
        """Check the equations by independent routes at random states; every check carries its figure.

        Derived equations as `Derivation.verify` does; where a frame floats, what is compiled instead.
        """
        if self.model.floating:
            return tuple(c for part in verify_motion(self.model, states=states, seed=seed).parts for c in part.checks)
        return self.derive().verify(states=states, seed=seed)

    def compile(self, *, lanes: int | None = None, threads: int | None = None) -> Compiled:
        """Return the system as machine code: `forward`, `inverse`, `mass_matrix`, `energy`, … on arrays of states.

        ``lanes`` states are computed side by side (the machine's widest unless given), ``threads`` cores work on a
        large batch (all unless given). No compiler is needed.
        """
        check_dimensions(self.model)
        return Compiled(self.model, lanes=lanes, threads=threads)

    def conserved(self, *, params: Mapping[Any, Any] | None = None) -> ConservedQuantities:
        """Return what every motion keeps: momenta of ignorable coordinates, total momenta, energy, each verified."""
        return conserved(self.model, params=params)

    def hamiltonian(self) -> Hamiltonian:
        """Return momenta, H(q, p, t) and the canonical equations."""
        return hamiltonian(self.model)

    def routhian(self, ignorable: Sequence[Any] | None = None) -> Routhian:
        """Return the Routhian: the Lagrangian of what is left once ignorable coordinates (all, or these) are gone."""
        return routhian(self.model, ignorable)

    def equilibria(
        self,
        *,
        inputs: Mapping[Any, Any] | None = None,
        params: Mapping[Any, Any] | None = None,
        box: Mapping[Any, Any] | None = None,
        samples: int | None = None,
    ) -> Equilibria:
        """Return where the system can stay at rest: all equilibria found in a ``box`` of {name: (low, high)}."""
        return equilibria(self.model, inputs=inputs, params=params, box=box, samples=samples)

    def linearize(
        self,
        at: Any = None,
        *,
        inputs: Mapping[Any, Any] | None = None,
        params: Mapping[Any, Any] | None = None,
        outputs: Any = None,
        time: Any = 0.0,
        operating_point: bool = False,
    ) -> Linearization:
        """Return A, B, C, D about an equilibrium, with poles, modes and the verdict on stability.

        ``at``: values of coordinates and rates by name or symbol (0 where not given), or an `Equilibrium`. ``outputs``:
        expressions, listed or by name. ``operating_point`` takes a point that is no equilibrium as it is.
        """
        found: dict[str, Any] = {"inputs": inputs, "params": params, "outputs": outputs}
        return linearize(self.model, at, **found, time=time, operating_point=operating_point)

    def linearize_along(
        self,
        trajectory: Any,
        *,
        inputs: Mapping[Any, Any] | None = None,
        params: Mapping[Any, Any] | None = None,
        outputs: Any = None,
    ) -> LinearizationAlong:
        """Return A(t), B(t), C(t), D(t) along a run, or along (times, states)."""
        return linearize_along(self.model, trajectory, inputs=inputs, params=params, outputs=outputs)

    def simulate(
        self,
        duration: float | str | None = None,
        *,
        initial: Mapping[Any, Any] | Sequence[float] | None = None,
        params: Mapping[Any, Any] | None = None,
        inputs: Mapping[Any, Any] | None = None,
        times: ArrayLike | None = None,
        samples: int | None = None,
        start: float | str = 0.0,
        method: str | None = None,
        step: float | str | None = None,
        rtol: float = 1e-9,
        atol: float = 1e-12,
        events: Sequence[Event] | Event = (),
        max_step: float | str = math.inf,
        max_steps: int = 10_000_000,
        max_events: int = 1000,
        timeout: float | None = None,
        **initial_by_name: Any,
    ) -> Trajectory:
        """Run the system for ``duration`` [s] and return a `lagrangian.Trajectory`.

        >>> from lagrangian import examples
        >>> run = loads(examples.text("pendulum")).simulate(2.0, theta=0.5, params={"b": 0.0})
        >>> run.success, float(run.audit) < 1e-9
        (True, True)

        Initial values by name, ``theta1=0.2``, or in ``initial={"theta1'": 0.1, theta2: "12 deg"}``; what a model file
        says under [simulate], and else 0, where not given. ``params`` and ``inputs`` are mappings by name or symbol;
        an input is a number, text, an expression of time and state (compiled in), a table
        ``(times, values[, "hold"])`` or a Python function f(t, x), which is slow. The run is kept at ``samples``
        times (1001), or at ``times``. ``method`` is one of ours in machine code (dop853, the default; taylor; tsit5;
        rk4 and gauss4, which need ``step``) or one of SciPy's (Radau, BDF, LSODA, RK45, DOP853). ``rtol`` and ``atol`` are
        aimed at for the whole run; for SciPy's methods they are those of a step. ``events`` come from
        `lagrangian.event`. ``max_steps``, ``max_events`` and ``timeout`` [s] bound the run.

        Raises `RunError` or `ModelError` for what is wrong before the run; a run that fails on its way is returned as
        far as it went, with the reason in its ``message``.
        """
        return run_model(
            self.model,
            duration,
            initial=initial,
            params=params,
            inputs=inputs,
            times=times,
            samples=samples,
            start=start,
            method=method,
            step=step,
            rtol=rtol,
            atol=atol,
            events=events,
            max_step=max_step,
            max_steps=max_steps,
            max_events=max_events,
            timeout=timeout,
            **initial_by_name,
        )

    def ensemble(
        self,
        duration: Any = None,
        *,
        initial: Mapping[Any, Any] | None = None,
        params: Mapping[Any, Any] | None = None,
        inputs: Mapping[Any, Any] | None = None,
        dims: Sequence[str] | None = None,
        **options: Any,
    ) -> Ensemble:
        """Run the system once for every entry of arrays that broadcast together; return a `lagrangian.Ensemble`.

        >>> from lagrangian import examples
        >>> runs = loads(examples.text("pendulum")).ensemble(2.0, theta=[0.1, 0.2, 0.3], method="rk4", step=0.01)
        >>> runs["final theta"].shape
        (3,)

        ``initial``, ``params``, ``inputs``: name or symbol → number, text with a unit, or array; ``dims`` names the
        axes. ``outputs``: expressions, by name or alone, ("theta1", "max theta1"); ``reduce``: what is kept of each
        over time (`lagrangian.simulate.study.REDUCTIONS`), None for the samples at ``times`` (a number of them, or the
        times). ``method``, ``rtol``, ``atol``, ``step``, ``events`` as in `simulate`; ``memory`` [bytes] bounds what is
        held at a time, ``threads`` the cores; ``progress(done, all)`` is called on the way. ``store="name.zarr"`` keeps
        results on disk as they come, ``resume=True`` goes on after an end of any kind; ``scheduler`` is the address of
        a Dask scheduler. A run that fails is NaN, with a status, and counted. Raises `RunError` for what does not fit.
        """
        return run_ensemble(self.model, duration, initial, params, inputs, dims, options)

    def sweep(
        self,
        duration: Any = None,
        grid: Mapping[Any, Any] | Iterable[str] | str = (),
        *,
        initial: Mapping[Any, Any] | None = None,
        params: Mapping[Any, Any] | None = None,
        inputs: Mapping[Any, Any] | None = None,
        samples: int | None = None,
        seed: int = 0,
        **options: Any,
    ) -> Ensemble:
        """Run the system for every combination of values, each for every sample of what is drawn.

        >>> from lagrangian import examples
        >>> pendulum = loads(examples.text("pendulum"))
        >>> runs = pendulum.sweep(2.0, ["L=0.5:2:4", "theta~normal(0, 0.1)"], samples=5, method="rk4", step=0.01)
        >>> runs.dims, runs.shape
        (('L', 'sample'), (4, 5))

        ``grid``: texts as here, or name or symbol → values, an array or text: parameters, coordinates and rates at the
        start, inputs. The same ``seed`` draws the same samples. Everything else as in `ensemble`.
        """
        return run_sweep(self.model, duration, grid, initial, params, inputs, samples, seed, options)

    def in_coordinates(self, change: Mapping[Any, Any], *, name: str | None = None) -> System:
        """Return the same system in other coordinates: ``{x2: x1 + x2r}`` says what the old x2 is in kept and new ones.

        Keys are coordinates or their names, values SymPy expressions or text; a coordinate that is not named is kept.
        Given the other way round, ``{"x2r": "x2 - x1"}``, it is solved where it is linear.
        """
        builder = carried(self.model, change, name=name)
        return System(builder.name, _builder=builder)

    def compare(self, other: System, change: Mapping[Any, Any] | None = None) -> Comparison:
        """Return this system and another side by side: are they one motion, row by row, and where do they differ?

        ``change`` says coordinates of one in those of the other; left out, it is found where positions tell it.
        """
        return compare(self, other, change)

    def export(self, path: str | Path) -> tuple[Path, ...]:
        """Write source code of the dynamics: to ``name.c`` (and ``name.h``) or ``name.py``; return what was written."""
        target = _path(path)
        languages = {suffix: language for language, suffix in LANGUAGES.items()}
        if target.suffix not in languages:
            raise ModelError(
                f"'{target.name}' names no language by its ending", fix=f"one of {', '.join(languages)}", code="E402"
            )
        files = sources(self.model, languages[target.suffix], target.stem)
        return tuple(write_file(target.parent / name, text) for name, text in files.items())

    def to_toml(self) -> str:
        """Return the system as the text of a model file."""
        return read.dumps(self.model)

    def save(self, path: str | Path) -> None:
        """Write the system to a model file (whole or not at all)."""
        write_file(_path(path), self.to_toml())

    def __repr__(self) -> str:
        """Say what the system has so far."""
        return f"<System {self.name!r}: {self._builder.summary()}>"


def load(path: str | Path) -> System:
    """Return the system that a model file describes."""
    builder = read.load(_path(path))
    return System(builder.name, _builder=builder)


def loads(text: str, *, name: str | None = None) -> System:
    """Return the system that the text of a model file describes; ``name`` stands for the file in messages."""
    if not isinstance(text, str):
        raise ModelError(
            f"a model file is text (got {type(text).__name__})", fix="load(path) reads a file", code="E406"
        )
    builder = read.loads(text, name)
    return System(builder.name, _builder=builder)


def _split(names: str | Iterable[str]) -> list[str]:
    return names.replace(",", " ").split() if isinstance(names, str) else _listed(names, "names")


def _listed(things: object, what: str) -> list[Any]:
    """The things of a list or tuple; anything that cannot be walked is refused."""
    if isinstance(things, Iterable) and not isinstance(things, str | bytes | Mapping):
        return list(things)
    raise ModelError(f"{what} must be a list (got {type(things).__name__})", fix="[first, second, …]", code="E406")


def _path(path: object) -> Path:
    """A path, if it is text or a path."""
    if isinstance(path, str | Path):
        return Path(path)
    raise ModelError(
        f"the name of a file must be text or a Path (got {type(path).__name__})", fix='such as "arm.toml"', code="E406"
    )


def _many(names: str | Iterable[str], make: Any, *, single: bool | None = None) -> Any:
    """Make one symbol a name; text with exactly one name gives the symbol itself, as SymPy's ``symbols`` does."""
    listed = _split(names)
    if not listed:
        raise ModelError("no name was given", fix='such as "theta1 theta2"', code="E401")
    made = tuple(make(name) for name in listed)
    alone = isinstance(names, str) if single is None else single
    return made[0] if len(made) == 1 and alone else made


def _unit(unit: str | None) -> str | None:
    if unit is not None:
        if not isinstance(unit, str):
            raise ModelError(f"a unit must be text (got {type(unit).__name__})", fix='such as "kg"', code="E408")
        read.parse_quantity(f"1 {unit}")
    return unit


def _value(name: str, value: float | str | None, unit: str | None) -> tuple[Any, str | None]:
    """Return a value in SI units and the unit it was given in."""
    if isinstance(value, str):
        quantity = read.parse_quantity(value, what=f"parameter '{name}'")
        return quantity.value, quantity.unit
    if unit is not None and isinstance(value, (int, float)) and not isinstance(value, bool):
        quantity = read.parse_quantity(f"{value!r} {unit}", what=f"parameter '{name}'")
        return quantity.value, quantity.unit
    return value, unit


__all__ = ["Place", "System", "load", "loads"]
