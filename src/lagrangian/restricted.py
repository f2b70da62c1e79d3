"""The methods of a compiled system for its constraints: multipliers, residuals, positions that close the loops."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lagrangian import dynamics
from lagrangian.errors import RunError, did_you_mean
from lagrangian.model.rows import named_conditions
from lagrangian.page.plain import plain
from lagrangian.queries import Looking, by_name

if TYPE_CHECKING:
    from lagrangian.simulate.reaction import Reaction

Values = ArrayLike | Mapping[Any, Any] | None
"""Inputs or parameters: an array in declared order, a mapping by name or symbol, or None for the declared values."""

ASSEMBLED = 1000
"""The number of random guesses from which `assemblies` starts."""


class Restricted(Looking):
    """The part of a compiled system that is about its constraints; `lagrangian.compiled.Compiled` adds the equations.

    The sign is the same everywhere: M v̇ + h = Ξ + Aᵀ λ with A v̇ + γ = 0. A positive λ acts in the direction that
    increases f (or c), the quantity that the constraint keeps at zero.
    """

    coordinates: tuple[str, ...]
    velocities: tuple[str, ...]
    parameters: tuple[str, ...]

    @cached_property
    def _reactions(self) -> dict[Any, dynamics.ReactionProgram]:
        return {}

    @property
    def rows(self) -> tuple[str, ...]:
        """The names of the constraints' rows, such as "loop.x" and "loop.y", in the order of the multipliers."""
        return tuple(row.name for row in named_conditions(self._model))

    def multipliers(
        self, q: ArrayLike, v: ArrayLike, u: Values = None, p: Values = None, t: ArrayLike = 0.0
    ) -> dict[str, NDArray[np.float64]]:
        """Return the multipliers λ by the names of their rows, each of shape ``(...)``; [N] for points and distances.

        The state must satisfy the constraints; `assemble` computes one. If a row depends on others, `margin` is near 0:
        the sum of their forces is right, but not the share of each.
        """
        lam = self._constraint("multipliers", (q, v, u, p, t))["lam"]
        return {name: lam[..., i] for i, name in enumerate(self.rows)}

    def reaction(
        self,
        joint: Any,
        q: ArrayLike,
        v: ArrayLike,
        u: Values = None,
        p: Values = None,
        t: ArrayLike = 0.0,
        *,
        on: Any = None,
        axes: Any = None,
    ) -> Reaction:
        """Return the force and the torque in a joint at any states, as a `lagrangian.Reaction`.

        ``joint`` is the name of a constraint, of a point at which a body is held, or of a body that is held; ``on`` the
        side that it acts on (`lagrangian.Trajectory.reaction`). Accelerations are those of `forward`.
        """
        from lagrangian.simulate.reaction import worked_out

        key = ("reaction", joint, on, axes)
        if key not in self._reactions:
            self._reactions[key] = dynamics.reaction(self._model, joint, on, axes)
        made = self._reactions[key]
        answer = self._called(self._made(key, lambda: made.program), (q, v, u, p, t))
        return worked_out(self._model, made, answer if isinstance(answer, Mapping) else {"wrench": answer})

    def residual(
        self, q: ArrayLike, v: ArrayLike | None = None, p: Values = None, t: ArrayLike = 0.0
    ) -> dict[str, dict[str, NDArray[np.float64]]]:
        """Return how far a state is from its constraints: ``{"position": {row: f}, "velocity": {row: A v + a₀}}``.

        Rows on velocities have no entry under "position". All are 0 if the constraints are satisfied.
        """
        found = self._constraint("residual", (q, v, None, p, t))
        placed = [row.name for row in named_conditions(self._model) if row.condition.on_positions]
        return {
            "position": {name: found["f"][..., i] for i, name in enumerate(placed)},
            "velocity": {name: found["Av"][..., i] for i, name in enumerate(self.rows)},
        }

    def margin(self, q: ArrayLike, p: Values = None, t: ArrayLike = 0.0) -> NDArray[np.float64]:
        """Return how independent the constraints are, shape ``(...)``: near 0 if one of them depends on the others.

        It is the smallest sin² of the angle between a row and the span of the rows before it, measured by M⁻¹.
        """
        return self._constraint("multipliers", (q, np.zeros(len(self.velocities)), None, p, t))["margin"]

    def constraint_matrix(
        self, q: ArrayLike, p: Values = None, t: ArrayLike = 0.0, *, v: ArrayLike | None = None
    ) -> NDArray[np.float64]:
        """Return A(q), shape ``(..., m, n)``: every motion satisfies A v + a₀ = 0."""
        return self._constraint("constraint_matrix", (q, v, None, p, t))["A"]

    def assemble(
        self,
        q: Any,
        v: Any = None,
        *,
        fixed: Sequence[str] | str = (),
        p: Values = None,
        t: float = 0.0,
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return q and v that satisfy every constraint, near a guess; both may be mappings by name.

        Coordinates named in ``fixed`` and their rates stay as given. The others change as little as the constraints
        allow, measured with the mass matrix. Raises `RunError` if no position (E304, with the gap and the fixed
        coordinate that prevents it) or no rates (E305) satisfy the constraints.
        """
        from lagrangian.assembly.assemble import consistent, fixed_names

        self._needed()
        guess, rates = self._guess(q, self.coordinates, "q"), self._guess(v, self.velocities, "v")
        return consistent(
            self._model, guess, rates, self._parameters(p), float(t), fixed=fixed_names(self._model, fixed)
        )

    def assemblies(
        self, q: Any = None, *, fixed: Sequence[str] | str = (), p: Values = None, t: float = 0.0
    ) -> NDArray[np.float64]:
        """Return the different positions that satisfy the constraints, shape ``(found, n)``, the nearest to q first.

        They are found from 1000 random guesses, always the same ones; coordinates in ``fixed`` stay as in q. With as
        many fixed coordinates as degrees of freedom these are the ways in which the loops can be put together.
        """
        from lagrangian.assembly.assemble import assembler_of, fixed_names

        self._needed()
        guess = self._guess(q, self.coordinates, "q")
        assembler = assembler_of(self._model, fixed_names(self._model, fixed))
        return assembler.positions(guess, self._parameters(p), float(t), spread=None, count=ASSEMBLED)

    # -- what was given -----------------------------------------------------------------------------------------

    def _constraint(self, name: str, given: tuple[Any, ...]) -> Any:
        self._needed()
        make = {
            "multipliers": dynamics.multipliers,
            "residual": dynamics.residual,
            "constraint_matrix": dynamics.constraint_matrix,
        }[name]
        return self._called(self._made(("constraints", name), lambda: make(self._model)), given)

    def _needed(self) -> None:
        if not self._model.constraints:
            raise RunError(
                f"system '{self._model.name}' has no constraints",
                fix="describe one: constraint(expression), pin((P, Q)), rolling(body, at=P, along=…)",
                code="E402",
            )

    def _guess(self, given: Any, names: tuple[str, ...], what: str) -> NDArray[np.float64]:
        """A guess as an array. Coordinates missing from a mapping are 0, and a missing quaternion means no rotation."""
        start = {c.name: c.start for c in self._model.coordinates}
        if given is None:
            return np.array([start.get(name, 0.0) for name in names])
        if isinstance(given, Mapping):
            table = {key if isinstance(key, str) else plain(key): value for key, value in given.items()}
            for key in table:
                if key not in names:
                    raise RunError(f"there is no '{key[:64]}' in {what}", fix=did_you_mean(key, names), code="E402")
            return np.array([float(table.get(name, start.get(name, 0.0))) for name in names])
        values = np.asarray(given, float)
        if values.shape != (len(names),) or not np.isfinite(values).all():
            raise RunError(
                f"{what} must be {len(names)} finite numbers (got the shape {values.shape})",
                fix="one number each, in the order " + ", ".join(names[:12]),
                code="E501",
            )
        return values

    def _parameters(self, p: Values) -> NDArray[np.float64]:
        """All parameters in order: the declared values, replaced by those given by name."""
        declared = {x.name: x.value for x in self._model.parameters}
        if p is not None and not isinstance(p, Mapping):
            return np.asarray(p, float)
        given = by_name(p) or {}
        for name in given:
            if name not in declared:
                raise RunError(f"there is no parameter '{name}'", fix=did_you_mean(name, declared), code="E402")
        values = {**declared, **given}
        if missing := [name for name, value in values.items() if value is None]:
            raise RunError(f"parameter '{missing[0]}' has no value", fix=f"p={{'{missing[0]}': …}}", code="E401")
        return np.array([float(values[name]) for name in self.parameters])
