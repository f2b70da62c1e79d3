"""L, Ξ and quantities computed from them in normal form: momenta, forces, the rate of the energy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, cast

import sympy as sp

from lagrangian.derive.algebra import Algebra, Form
from lagrangian.errors import ModelError
from lagrangian.model import Input, Model, time
from lagrangian.model.rows import rows_of
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False)
class LagrangianForm:
    """A model's Lagrangian L = T* − V and generalized forces Ξ, and the algebra in which they are expressed.

    ``rows`` are those of its constraints, Σ A_i ξ̇_i + a₀ = 0: the name, A and a₀.
    """

    model: Model
    T: sp.Expr
    V: sp.Expr
    Xi: tuple[sp.Expr, ...]
    rows: tuple[tuple[str, tuple[sp.Expr, ...], sp.Expr], ...] = ()

    @classmethod
    def of(cls, model: Model, vanishing: Sequence[sp.Symbol] = ()) -> LagrangianForm:
        """The energies and forces of a model with definitions written out and ``vanishing`` parameters set to 0.

        Raises `ModelError` for a floating frame, and if something is divided by a vanishing parameter.
        """
        if len(model.velocities) != len(model.coordinates):
            raise ModelError(
                f"system '{model.name}' has a floating frame: the entries of a quaternion are not independent",
                fix="describe its orientation by three angles instead (frames about axes)",
                code="E202",
            )
        T, V = sp.S.Zero, sp.S.Zero
        forces: list[Any] = [sp.S.Zero] * len(model.coordinates)
        for element in model.elements:
            T, V = T + element.kinetic(model), V + element.potential(model)
            for action in element.works(model):
                rate = model.expand(action.rate, constants=True)
                effort = model.expand(action.effort, constants=True)
                for i, c in enumerate(model.coordinates):
                    forces[i] = forces[i] + effort * sp.diff(rate, c.rate)
        T, V = (model.expand(cast("sp.Expr", e), constants=True) for e in (T, V))
        gone: dict[Any, Any] = dict.fromkeys(vanishing, sp.S.Zero)
        made = [cast("sp.Expr", sp.sympify(e).xreplace(gone)) for e in (T, V, *forces)]
        if any(e.has(sp.zoo, sp.nan, sp.oo) for e in made):
            raise ModelError(
                f"the energies and forces have no value where {', '.join(map(str, gone))} = 0",
                fix="give it a value that is not 0, or leave it out",
                code="E406",
            )
        rows = [_row(model, row.rate, gone) for row in rows_of(model)] if model.constraints else []
        named = tuple((row.name, *found) for row, found in zip(rows_of(model), rows, strict=True)) if rows else ()
        return cls(model, made[0], made[1], tuple(made[2:]), named)

    def without_rows(self, form: str) -> LagrangianForm:
        """The same; raises `ModelError` if constraints leave its coordinates dependent, so that a ``form`` is none."""
        if self.model.constraints:
            names = ", ".join(f"'{element.name}'" for element in self.model.constraints[:4])
            raise ModelError(
                f"{form} needs independent coordinates, and the constraints {names} leave those of "
                f"system '{self.model.name}' dependent",
                fix="describe the system in as many coordinates as it has degrees of freedom, without constraints",
                code="E202",
            )
        return self

    @property
    def q(self) -> tuple[Any, ...]:
        """The coordinates."""
        return tuple(c.symbol for c in self.model.coordinates)

    @property
    def v(self) -> tuple[Any, ...]:
        """The rates."""
        return tuple(c.rate for c in self.model.coordinates)

    @cached_property
    def algebra(self) -> Algebra:
        """The ring of normal forms."""
        slopes = [x for _, A, a0 in self.rows for x in (*A, a0)]
        return Algebra(self.model, [self.T, self.V, *self.Xi, *slopes])

    @cached_property
    def pushes_of_rows(self) -> tuple[tuple[str, tuple[Form, ...], Form], ...]:
        """A and a₀ of every row of the constraints, with its name."""
        form = self.algebra.form
        return tuple((name, tuple(map(form, A)), form(a0)) for name, A, a0 in self.rows)

    @cached_property
    def kinetic(self) -> Form:
        """T*."""
        return self.algebra.form(self.T)

    @cached_property
    def potential(self) -> Form:
        """V."""
        return self.algebra.form(self.V)

    @cached_property
    def lagrangian(self) -> Form:
        """L = T* − V."""
        return self.kinetic - self.potential

    @cached_property
    def forces(self) -> tuple[Form, ...]:
        """Ξ."""
        return tuple(self.algebra.form(f) for f in self.Xi)

    @cached_property
    def momenta(self) -> tuple[Form, ...]:
        """p_i = ∂L/∂ξ̇_i."""
        return tuple(self.lagrangian.diff(v) for v in self.v)

    @cached_property
    def slopes(self) -> tuple[Form, ...]:
        """∂L/∂ξ_i."""
        return tuple(self.lagrangian.diff(q) for q in self.q)

    @cached_property
    def pushes(self) -> tuple[Form, ...]:
        """The rates of the momenta: ṗ_i = ∂L/∂ξ_i + Ξ_i."""
        return tuple(a + b for a, b in zip(self.slopes, self.forces, strict=True))

    @cached_property
    def energy(self) -> Form:
        """h = Σ ξ̇_i ∂L/∂ξ̇_i − L."""
        parts = [p * self.algebra.form(v) for p, v in zip(self.momenta, self.v, strict=True)]
        return self.algebra.total([*parts, -self.lagrangian])

    @cached_property
    def power(self) -> Form:
        """The rate of the energy: dh/dt = Σ Ξ_i ξ̇_i − ∂L/∂t."""
        parts = [f * self.algebra.form(v) for f, v in zip(self.forces, self.v, strict=True)]
        return self.algebra.total([*parts, -self.lagrangian.diff(time)])

    def moved_by(self, form: Form) -> tuple[Input, ...]:
        """The inputs in a form: a conserved quantity is constant only while these are.

        ``power`` contains their values, not their rates; if u changes, dh/dt also contains −∂L/∂u u̇.
        """
        return tuple(u for u in self.model.inputs if form.raw().has(u.symbol))

    @property
    def is_total(self) -> bool:
        """Whether h is T* + V, because T* is homogeneous of degree two in the rates."""
        return (self.energy - self.kinetic - self.potential).is_zero

    @cached_property
    def mass(self) -> list[list[Form]]:
        """M_ij = ∂²T*/∂ξ̇_i∂ξ̇_j."""
        return [[p.diff(v) for v in self.v] for p in self.momenta]

    def at(self, form: Form, values: Mapping[Any, Any]) -> Form:
        """The form with symbols replaced."""
        return self.algebra.form(cast("sp.Expr", form.raw().xreplace(dict(values))))


def _row(model: Model, rate: sp.Expr, gone: Mapping[Any, Any]) -> tuple[tuple[sp.Expr, ...], sp.Expr]:
    """A and a₀ of a row, linear in the rates."""
    c = cast("sp.Expr", model.expand(rate, constants=True).xreplace(dict(gone)))
    still = dict.fromkeys((x.rate for x in model.coordinates), sp.S.Zero)
    slopes = tuple(cast("sp.Expr", sp.diff(c, x.rate)) for x in model.coordinates)
    return slopes, cast("sp.Expr", c.xreplace(still))
