"""The object people hold: describe a mechanical system, then derive."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lagrangian import read
from lagrangian.calls import worded
from lagrangian.errors import ModelError, Place
from lagrangian.simulated import Simulated
from lagrangian.viewed import cut
from lagrangian.write import check_free, write_file

if TYPE_CHECKING:  # every verb imports what it needs: describing a system waits for none of them
    from lagrangian.check.verb import CheckedAnswer
    from lagrangian.compare import Comparison
    from lagrangian.compiled import Compiled
    from lagrangian.derivation import Derivation
    from lagrangian.derive import Detail
    from lagrangian.equilibria.points import Equilibria
    from lagrangian.invariants.canonical_forms import Hamiltonian, Routhian
    from lagrangian.invariants.conserved_quantities import ConservedQuantities
    from lagrangian.linear.along import LinearizationAlong
    from lagrangian.linear.linearization import Linearization
    from lagrangian.page.formula import Check


@worded
class System(Simulated):
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

    def derive(self, *, detail: Detail = "usual") -> Derivation:
        """Return the derivation: the seven steps, the equations, and what was verified.

        ``detail="full"`` writes d/dt of every term out before it is gathered. Raises `ModelError` for a model whose
        coordinates are dependent, incomplete or move nothing.
        """
        from lagrangian.derivation import derive_and_verify

        return derive_and_verify(self.model, detail=detail)

    def check(self, answer: Any, *, hint: int = 3) -> CheckedAnswer:
        """Return whether an answer (text, LaTeX, SymPy equations, energies by name) is right; see `Derivation.check`.

        Derives anew each time: for many answers derive once, and check with the derivation.
        """
        from lagrangian.check.verb import check_answer
        from lagrangian.derive import derive

        return check_answer(derive(self.model), answer, hint=hint)

    def verify(self, *, states: int = 50, seed: int = 1) -> tuple[Check, ...]:
        """Check everything that can be taken from the system by independent routes at random states.

        The derived equations, the compiled functions, the exported sources, the linearization: see `Derivation.verify`.
        Where a frame floats there are no derived equations; all else is checked.
        """
        from lagrangian.values.values import check_sampling

        check_sampling(states, seed)
        if self.model.floating:
            from lagrangian.derivation import verify_floating

            return verify_floating(self.model, states=states, seed=seed)
        return self.derive().verify(states=states, seed=seed)

    def compile(self, *, lanes: int | None = None, threads: int | None = None) -> Compiled:
        """Return the system as machine code: `forward`, `inverse`, `mass_matrix`, `energy`, … on arrays of states.

        ``lanes`` states are computed side by side (the machine's widest unless given), ``threads`` cores work on a
        large batch (all unless given). No compiler is needed.
        """
        from lagrangian.compiled import Compiled
        from lagrangian.values.dimensions import check_dimensions

        check_dimensions(self.model)
        return Compiled(self.model, lanes=lanes, threads=threads)

    def conserved_quantities(self, *, params: Mapping[Any, Any] | None = None) -> ConservedQuantities:
        """Return what every motion keeps: momenta of ignorable coordinates, total momenta, energy, each verified.

        A parameter given as 0 vanishes.
        """
        from lagrangian.invariants.conserved import conserved_quantities

        return conserved_quantities(self.model, params=params)

    def hamiltonian(self) -> Hamiltonian:
        """Return momenta, H(q, p, t) and the canonical equations."""
        from lagrangian.invariants.hamiltonian import hamiltonian

        return hamiltonian(self.model)

    def routhian(self, ignorable: Sequence[Any] | None = None) -> Routhian:
        """Return the Routhian: the Lagrangian of what is left once ignorable coordinates (all, or these) are gone."""
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
        """Return where the system can stay at rest: all found in a ``box`` of {name: (low, high)} from ``starts``."""
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
    ) -> Linearization:
        """Return A, B, C, D about an equilibrium, with poles, modes and the verdict on stability.

        ``at``: values of coordinates and rates by name or symbol (0 where not given), or an `Equilibrium`. ``outputs``:
        expressions, listed or by name. ``operating_point`` takes a point that is no equilibrium as it is.
        """
        from lagrangian.linear.linearize import linearize

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
        from lagrangian.linear.along import linearize_along

        return linearize_along(self.model, trajectory, inputs=inputs, params=params, outputs=outputs)

    def in_coordinates(self, change: Mapping[Any, Any], *, name: str | None = None) -> System:
        """Return the same system in other coordinates: ``{x2: x1 + x2r}`` says what the old x2 is in kept and new ones.

        Keys are coordinates or their names, values SymPy expressions or text; a coordinate that is not named is kept.
        Given the other way round, ``{"x2r": "x2 - x1"}``, it is solved where it is linear.
        """
        from lagrangian.coordinates import carried

        builder = carried(self.model, change, name=name)
        return System(builder.name, _builder=builder)

    def compare(self, other: System, change: Mapping[Any, Any] | None = None) -> Comparison:
        """Return this system and another side by side: are they one motion, row by row, and where do they differ?

        ``change`` says coordinates of one in those of the other; left out, it is found where positions tell it.
        """
        from lagrangian.compare import compare

        return compare(self, other, change)

    def export(self, path: str | Path, *, overwrite: bool = False) -> tuple[Path, ...]:
        """Write source code of the dynamics: to ``name.c`` (and ``name.h``) or ``name.py``; return what was written.

        Raises `Error` where a file is there already, unless ``overwrite``, or where it cannot be written.
        """
        from lagrangian.compiled import LANGUAGES, sources

        target = _path(path)
        languages = {suffix: language for language, suffix in LANGUAGES.items()}
        if target.suffix not in languages:
            raise ModelError(
                f"the ending of '{target.name}' is not supported",
                fix=f"use one of {', '.join(languages)}",
                code="E402",
            )
        files = sources(self.model, languages[target.suffix], target.stem)
        found = {target.parent / name: text for name, text in files.items()}
        for file in found:
            check_free(file, overwrite=overwrite)
        return tuple(write_file(file, text) for file, text in found.items())

    def to_toml(self) -> str:
        """Return the system as the text of a model file."""
        return read.dumps(self.model)

    def save(self, path: str | Path, *, overwrite: bool = False) -> Path:
        """Write the system to a model file, whole or not at all; return the path.

        Raises `Error` where the file is there already, unless ``overwrite``, or where it cannot be written.
        """
        target = _path(path)
        check_free(target, overwrite=overwrite)
        return write_file(target, self.to_toml())

    def __repr__(self) -> str:
        """Say what the system has so far."""
        return cut(f"<System {self.name!r}: {self._builder.summary()}{self._told()}>")

    def _repr_html_(self) -> str:
        from lagrangian.write.views import system_view, words_view

        words = f"{self._builder.summary()}{self._told()}"
        try:
            return system_view(self.model, words)
        except ModelError:  # not complete yet
            return words_view(self.name, [words])

    def _told(self) -> str:
        """The notices of a system that is complete, for its short description."""
        try:
            return "".join(f"; notice {n}" for n in self.notices)
        except ModelError:  # not complete yet: a description must be seen all the same
            return ""


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
    if text.strip().endswith(".toml") and "\n" not in text.strip():
        raise ModelError(
            f"loads reads the text of a model, and {text.strip()[:60]!r} names a file",
            fix=f"load({text.strip()[:60]!r})",
            code="E406",
        )
    builder = read.loads(text, name)
    return System(builder.name, _builder=builder)


def example(name: str) -> System:
    """Return a built-in example, ``example("cart-pole")``; `lagrangian.examples.names` lists them.

    Raises `ModelError` with the nearest name where there is no such example.
    """
    from lagrangian import examples

    return loads(examples.text(name), name=f"<example {name}>")


def _path(path: object) -> Path:
    """A path, if it is text or a path."""
    if isinstance(path, str | Path):
        return Path(path)
    raise ModelError(
        f"the name of a file must be text or a Path (got {type(path).__name__})", fix='such as "arm.toml"', code="E406"
    )


__all__ = ["Place", "System", "example", "load", "loads"]
