"""The class `System`, with which users describe a mechanical system and then derive its equations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lagrangian import read
from lagrangian.calls import worded
from lagrangian.designed import Designed
from lagrangian.errors import ModelError, Place
from lagrangian.model.without_friction import check_no_friction
from lagrangian.viewed import cut
from lagrangian.write import check_free, write_file

if TYPE_CHECKING:  # every verb imports what it needs, so that describing a system does not wait for other imports
    from lagrangian.check.verb import CheckedAnswer
    from lagrangian.compare import Comparison
    from lagrangian.compiled import Compiled
    from lagrangian.derivation import Derivation
    from lagrangian.derive import Detail
    from lagrangian.equilibria.points import Equilibria
    from lagrangian.invariants.canonical_forms import Hamiltonian, Routhian
    from lagrangian.invariants.conserved_quantities import ConservedQuantities
    from lagrangian.linear.along import MotionLinearization
    from lagrangian.linear.linearization import Linearization
    from lagrangian.page.formula import Check
    from lagrangian.picture import Picture
    from lagrangian.structured.choose import AskedForm
    from lagrangian.worksheet import Worksheet
    from lagrangian.write import Notation


@worded
class System(Designed):
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

    def derive(self, *, detail: Detail = "usual", form: AskedForm = "auto") -> Derivation:
        """Return the derivation: the seven steps, the equations, and the results of the checks.

        ``form`` is how the equations are written: "expanded" in the coordinates alone, "structured" in velocities,
        momenta and forces that are defined once, and "auto" in the second form where the first would be too long to
        read. ``detail="full"`` writes d/dt out term by term before the terms are collected. Raises `ModelError` if a
        coordinate depends on others or moves no mass, if the coordinates do not determine the position of every mass,
        or if the system cannot have the form.
        """
        from lagrangian.derivation import derive_and_verify

        return derive_and_verify(self.model, detail=detail, form=form)

    def check(self, answer: Any, *, hint: int = 3) -> CheckedAnswer:
        """Return whether an answer (text, LaTeX, SymPy equations, energies by name) is right; see `Derivation.check`.

        Every call derives the system again: to check many answers, derive once and use the derivation's `check`.
        """
        from lagrangian.check.verb import check_answer
        from lagrangian.structured.choose import derive_in_form

        return check_answer(derive_in_form(self.model), answer, hint=hint)

    def look(
        self,
        *,
        pose: Mapping[Any, Any] | None = None,
        kinds: Mapping[str, str] | None = None,
        azimuth: float | None = None,
        elevation: float | None = None,
        trail: Sequence[Any] | None = None,
        hide: Sequence[str] | None = None,
        lines: Sequence[Mapping[str, Any]] | None = None,
        shapes: Sequence[Mapping[str, Any]] | None = None,
    ) -> Picture:
        """Return the schematic of the system: rods, carts, wheels, springs, forces and coordinates, as in a textbook.

        Everything is found from the model. ``pose`` gives coordinates other values than those that were chosen,
        ``kinds`` says what bodies are drawn as (``{"cart": "box"}``: ball, cart, box, wheel, disk, link, plate, bar or
        none), ``azimuth`` and ``elevation`` [rad] from where a system in space is seen, ``trail`` the points whose
        paths are shown in motion, and ``hide`` the elements and coordinates that are left out. ``lines`` adds strings,
        wires and walls (``{"through": ["A", "B"], "kind": "string"}``), and ``shapes`` outlines in the axes of a frame
        or body (``{"frame": "pole", "box": [0.05, 0.6]}`` in metres, or ``"points": [[x, y], …]``). What is not given
        comes from ``[look]`` in the model file. `Picture.missing` says what is not drawn. Raises `ModelError` for names
        that the system does not have.
        """
        from lagrangian.picture import picture

        return picture(
            self.model,
            pose=pose,
            kinds=kinds,
            azimuth=azimuth,
            elevation=elevation,
            trail=trail,
            hide=hide,
            lines=lines,
            shapes=shapes,
        )

    def verify(self, *, states: int = 50, seed: int = 1, exports: bool = False) -> tuple[Check, ...]:
        """Check everything that is computed from the system by independent routes, at random states.

        This covers the derived equations, the compiled functions, the exported source and the linearization: see
        `Derivation.verify`. Of a floating system without derived equations (all of its energies are given
        directly) everything else is checked.
        ``exports``: exports to other programs, such as Octave, are run in them as well, where they are installed; the
        printed checklist is read back, and so are the sheets of a worksheet: of the variant with this seed.
        """
        from lagrangian.values.values import check_sampling

        check_sampling(states, seed)
        if self.model.floating:
            from lagrangian.derivation import verify_floating
            from lagrangian.structured.choose import refusal

            if refusal(self.model):
                return verify_floating(self.model, states=states, seed=seed, exports=exports)
        found = self.derive().verify(states=states, seed=seed, exports=exports)
        if exports:
            from lagrangian.worksheet.proof import variant_checks

            found += variant_checks(lambda: self.worksheet(seed=seed))
        return found

    def compile(self, *, lanes: int | None = None, threads: int | None = None) -> Compiled:
        """Return the system as machine code: `forward`, `inverse`, `mass_matrix`, `energy`, … of arrays of states.

        ``lanes`` is the number of states that are computed side by side (by default as many as the processor can),
        ``threads`` the number of cores that work on a large batch (by default all). No compiler is needed.
        """
        from lagrangian.compiled import Compiled
        from lagrangian.values.dimensions import check_dimensions

        check_no_friction(self.model, "there are no compiled functions")
        check_dimensions(self.model)
        return Compiled(self.model, lanes=lanes, threads=threads)

    def conserved_quantities(self, *, params: Mapping[Any, Any] | None = None) -> ConservedQuantities:
        """Return the quantities that are constant along every motion: momenta of ignorable coordinates, total momenta,
        energy.

        Each is proved and checked numerically. A parameter whose value in ``params`` is 0 vanishes from the formulas.
        """
        from lagrangian.invariants.conserved import conserved_quantities

        return conserved_quantities(self.model, params=params)

    def hamiltonian(self) -> Hamiltonian:
        """Return Hamilton's form: the momenta p, H(q, p, t) and the canonical equations q̇ = ∂H/∂p, ṗ = −∂H/∂q + Ξ."""
        from lagrangian.invariants.hamiltonian import hamiltonian

        return hamiltonian(self.model)

    def routhian(self, ignorable: Sequence[Any] | None = None) -> Routhian:
        """Return the Routhian, which is the Lagrangian of the other coordinates after ignorable ones have been
        eliminated.

        ``ignorable`` lists the coordinates to eliminate; by default all ignorable coordinates are.
        """
        from lagrangian.invariants.routhian import routhian

        return routhian(self.model, ignorable)

    def equilibria(
        self,
        *,
        inputs: Mapping[Any, Any] | None = None,
        params: Mapping[Any, Any] | None = None,
        box: Mapping[Any, Any] | None = None,
        starts: int | None = None,
    ) -> Equilibria:
        """Return the equilibria that a search finds, each with its stability.

        ``box`` limits the search: {name: (low, high)}. ``starts`` is the number of starting points; by default as many
        as the search needs. See `Equilibria`.
        """
        from lagrangian.equilibria.search import equilibria

        return equilibria(self.model, inputs=inputs, params=params, box=box, starts=starts)

    def linearize(
        self,
        at: Any = None,
        *,
        inputs: Mapping[Any, Any] | None = None,
        params: Mapping[Any, Any] | None = None,
        outputs: Any = None,
        time: Any = 0.0,
        operating_point: bool = False,
        fixed: Sequence[Any] | str | None = None,
    ) -> Linearization:
        """Return the linearization ẋ = A x + B u, y = C x + D u about an equilibrium, with poles, modes and stability.

        ``at``: values of coordinates and rates by name or symbol (0 unless given), or an `Equilibrium`. ``outputs``:
        expressions, as a list or by name. With ``operating_point`` the point need not be an equilibrium; otherwise such
        a point raises `RunError`.

        With constraints, the states are independent coordinates and rates, from which all others follow. The point must
        satisfy the constraints; give ``fixed``, the coordinates that stay, to move a guess onto them.
        """
        from lagrangian.linear.linearize import linearize

        found: dict[str, Any] = {"inputs": inputs, "params": params, "outputs": outputs}
        return linearize(self.model, at, **found, time=time, operating_point=operating_point, fixed=fixed)

    def linearize_along(
        self,
        trajectory: Any,
        *,
        inputs: Mapping[Any, Any] | None = None,
        params: Mapping[Any, Any] | None = None,
        outputs: Any = None,
    ) -> MotionLinearization:
        """Return A(t), B(t), C(t), D(t) along a run, or along given ``(times, states)``."""
        from lagrangian.linear.along import linearize_along

        return linearize_along(self.model, trajectory, inputs=inputs, params=params, outputs=outputs)

    def in_coordinates(self, change: Mapping[Any, Any], *, name: str | None = None) -> System:
        """Return the same system in other coordinates: ``{x2: x1 + x2r}`` expresses the old x2 in coordinates that stay
        or are new.

        Keys are coordinates or their names; values are SymPy expressions or text. Coordinates that are not mentioned
        stay. The new coordinates may also be given in the old ones, ``{"x2r": "x2 - x1"}``, if these equations are
        linear.
        """
        from lagrangian.coordinates import carried

        builder = carried(self.model, change, name=name)
        return System(builder.name, _builder=builder)

    def compare(self, other: System, change: Mapping[Any, Any] | None = None) -> Comparison:
        """Return a comparison of this system with another: whether both describe the same motion, and where they
        differ.

        ``change`` expresses the coordinates of one system in those of the other; by default it is inferred from the
        positions of the bodies.
        """
        from lagrangian.compare import compare

        return compare(self, other, change)

    def worksheet(self, *, seed: int | None = None, notation: Notation = "lecture") -> Worksheet:
        """Return an exercise: a question sheet, its solution, and the model file against which answers are checked.

        With a ``seed`` it is about a random variant of the system: other letters and values, coordinates measured in
        another way, forces and attachments elsewhere, and the same kinds and number of elements and coordinates. The
        same seed gives the same variant. Raises `ModelError` for a seed below 0, and if the system cannot be derived.

        >>> from lagrangian import example
        >>> example("lecture-3b").worksheet(seed=3).changes[-1]
        'other letters and values'
        """
        from lagrangian.worksheet import worksheet

        return worksheet(self.model, seed=seed, notation=notation)

    def export(self, path: str | Path, *, to: str | None = None, overwrite: bool = False) -> tuple[Path, ...]:
        """Write the dynamics for other programs; the ending of the path says for which, or ``to`` does.

        ``name.c`` (with ``name.h``), ``name.py`` and ``name.js`` are source code without dependencies, ``name.m``
        functions ``name_forward.m``, … for MATLAB and Octave with the script ``name_steps.m``, ``name.jl`` a module of
        Julia, ``name.mo`` a model of Modelica, ``name.fmu`` a unit of FMI 2 (``to="fmu3"``: FMI 3), and ``name.wasm``
        the integrator for browsers; with ``to``, ``name.py`` is a module of "jax" or "casadi", and ``name.c`` an
        S-function of "simulink". `docs/exports.md` lists all targets. Return the paths of the files.

        Raises `ModelError` for an ending or a target that is not supported, and `Error` if a file exists, unless
        ``overwrite``, or if it cannot be written.
        """
        from lagrangian.export import exported_files, target_of

        check_no_friction(self.model, "there is nothing to export")
        target = _path(path)
        files = exported_files(self.model, target_of(target.suffix, to, target.name), target.stem)
        found = {target.parent / name: text for name, text in files.items()}
        for file in found:
            check_free(file, overwrite=overwrite)
        return tuple(write_file(file, text) for file, text in found.items())

    def to_toml(self) -> str:
        """Return the system as the text of a model file (TOML)."""
        return read.dumps(self.model)

    def save(self, path: str | Path, *, overwrite: bool = False) -> Path:
        """Write the system to a model file, either completely or not at all; return the path.

        Raises `Error` if the file exists, unless ``overwrite``, or if it cannot be written.
        """
        target = _path(path)
        check_free(target, overwrite=overwrite)
        return write_file(target, self.to_toml())

    def __repr__(self) -> str:
        """Summarize what has been described so far."""
        return cut(f"<System {self.name!r}: {self._builder.summary()}{self._told()}>")

    def _repr_html_(self) -> str:
        from lagrangian.look.heading import head_picture
        from lagrangian.write.views import system_view, words_view

        words = f"{self._builder.summary()}{self._told()}"
        try:
            model = self.model
        except ModelError:  # not complete yet
            return words_view(self.name, [words])
        return system_view(model, words, head_picture(model))

    def _told(self) -> str:
        """The notices of a complete system, for its repr."""
        try:
            return "".join(f"; notice {n}" for n in self.notices)
        except ModelError:  # not complete yet, but its repr must work all the same
            return ""


def load(path: str | Path) -> System:
    """Return the system that the file at ``path`` describes: a model file (TOML), or a robot's in URDF or MJCF."""
    builder = read.load(_path(path))
    return System(builder.name, _builder=builder)


def loads(text: str, *, name: str | None = None) -> System:
    """Return the system described by ``text``, the content of a model file; messages use ``name`` as the name of the
    file."""
    if not isinstance(text, str):
        raise ModelError(
            f"a model file is text (got {type(text).__name__})", fix="load(path) reads a file", code="E406"
        )
    if text.strip().endswith(".toml") and "\n" not in text.strip():
        raise ModelError(
            f"loads reads the text of a model, and {text.strip()[:60]!r} names a file",
            fix=f"load({text.strip()[:60]!r})",
            code="E406",
        )
    builder = read.loads(text, name)
    return System(builder.name, _builder=builder)


def example(name: str) -> System:
    """Return a built-in example such as ``example("cart-pole")``; `lagrangian.examples.names` lists them all.

    Raises `ModelError` if there is no such example; the message suggests the nearest name.
    """
    from lagrangian import examples

    return loads(examples.text(name), name=f"<example {name}>")


def _path(path: object) -> Path:
    """Return text or a path as a `Path`; anything else is an error."""
    if isinstance(path, str | Path):
        return Path(path)
    raise ModelError(
        f"the name of a file must be text or a Path (got {type(path).__name__})", fix='such as "arm.toml"', code="E406"
    )


__all__ = ["Place", "System", "example", "load", "loads"]
