"""The methods of a compiled system that differentiate it: accelerations, forces, linear models, single steps."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite
from typing import Any, Literal, overload

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike, NDArray

from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.derivatives.results import Derivatives, HessianProduct, InverseDerivatives, Pullback
from lagrangian.derivatives.steps import Rates, VelocityMap, differentiated, stepped, tableau
from lagrangian.errors import RunError
from lagrangian.page.plain import plain
from lagrangian.queries import by_name
from lagrangian.restricted import Restricted, Values

Array = NDArray[np.float64]
VARIED = dynamics.VARIED

DEPENDENT = 1e-9
"""A singular value of the rows of constraints, each of length 1, below this counts as 0."""


class Differentiated(Restricted):
    """The part of a compiled system that differentiates it; `lagrangian.compiled.Compiled` adds the equations."""

    def _kernel(self, name: str) -> machine.Kernel:
        """The kernel of a program by its name."""
        raise TypeError(f"{type(self).__name__} compiles no program")

    @overload
    def derivatives(
        self,
        q: ArrayLike,
        v: ArrayLike,
        u: Values = None,
        p: Values = None,
        t: ArrayLike = 0.0,
        *,
        a: None = None,
        wrt: Any = VARIED,
    ) -> Derivatives: ...

    @overload
    def derivatives(
        self,
        q: ArrayLike,
        v: ArrayLike,
        u: Values = None,
        p: Values = None,
        t: ArrayLike = 0.0,
        *,
        a: ArrayLike,
        wrt: Any = VARIED,
    ) -> InverseDerivatives: ...

    def derivatives(
        self,
        q: ArrayLike,
        v: ArrayLike,
        u: Values = None,
        p: Values = None,
        t: ArrayLike = 0.0,
        *,
        a: ArrayLike | None = None,
        wrt: Any = VARIED,
    ) -> Derivatives | InverseDerivatives:
        """Return the accelerations a = M⁻¹ (Ξ − C v − G) with their exact derivatives, as `lagrangian.Derivatives`.

        ∂a/∂x = −M⁻¹ ∂(M a + C v + G − Ξ)/∂x at a held constant: ``d.a_q``, ``d.a_v`` and ``d.Minv`` = ∂a/∂Ξ have the
        shape ``(..., n, n)``, ``d.a_u`` ``(..., n, number of inputs)``, in SI units. For floating frames column k of
        ``a_q`` is the change along the k-th velocity, δq = N(q) e_k. ``wrt`` says what is computed: "q", "v", "u",
        names of parameters, whose derivatives are ``d.a_p["m"]``, ``(..., n)``, and names of single coordinates,
        velocities and inputs, which are ``d["theta"]``. Names may be symbols; that of a parameter called q, v or u has
        to be. Every set is compiled at its first call.

        With ``a`` given, the forces r = M a + C v + G − Ξ of inverse dynamics are differentiated:
        `lagrangian.InverseDerivatives` with ``d.r``, ``d.r_q``, ``d.r_v``, ``d.r_u``, ``d.r_p`` and ``d.M``.

        With constraints the multipliers change too: a and λ are differentiated as the functions of q and v that
        `forward` and `multipliers` return in every state, and ``d.Minv`` is ∂a/∂Ξ, which is singular. A change of the
        state that satisfies the constraints is still up to you; where rows depend on each other wherever they hold,
        only such changes have a derivative.

        Raises `ModelError` for unknown names in ``wrt``, and what `forward` raises.
        """
        names = self._names(wrt)
        if a is None:
            kernel = self._slopes(names)
            return Derivatives(kernel.program, self._called(kernel, (q, v, u, p, t)), names)
        kernel = self._made(
            ("inverse derivatives", names), lambda: dynamics.inverse_derivatives(self._model, names), still=False
        )
        return InverseDerivatives(kernel.program, self._called(kernel, (q, v, a, u, p, t)), names)

    def linearized(
        self, q: ArrayLike, v: ArrayLike, u: Values = None, p: Values = None, t: ArrayLike = 0.0
    ) -> tuple[Array, Array]:
        """Return A and B of δẋ = A δx + B δu about any states, shapes ``(..., 2n, 2n)`` and ``(..., 2n, n_u)``.

        δx = (δq, δv), A = [[0, 1], [∂a/∂q, ∂a/∂v]] and B = [[0], [∂a/∂u]] with n velocities. For a floating frame δq
        are the six components ξ along its velocities, δq = N(q) ξ, whose rate is ξ̇ = δv − ad_v ξ with the Lie bracket
        of velocities; −ad_v then stands in place of 0. About an equilibrium `System.linearize` returns the same in
        coordinates, with poles and modes.

        With constraints A and B belong to `forward` in all states; only the changes T y that satisfy the constraints,
        with T from `allowed_changes`, are changes of a motion. Raises as `derivatives`.
        """
        d = self.derivatives(q, v, u, p, t)
        n = len(self.velocities)
        A, B = np.zeros((*d.a.shape[:-1], 2 * n, 2 * n)), np.zeros((*d.a.shape[:-1], 2 * n, len(self.inputs)))
        A[..., :n, n:], A[..., n:, :n], A[..., n:, n:] = np.eye(n), d.a_q, d.a_v
        B[..., n:, :] = d.a_u
        if (tangent := self._tangent(q, v)) is not None:
            A[..., :n, :n] = -tangent.ad
        return A, B

    @overload
    def step(
        self,
        q: ArrayLike,
        v: ArrayLike,
        u: Values,
        dt: float,
        *,
        method: str = "rk4",
        derivatives: Literal[False] = False,
        p: Values = None,
        t: ArrayLike = 0.0,
    ) -> Array: ...

    @overload
    def step(
        self,
        q: ArrayLike,
        v: ArrayLike,
        u: Values,
        dt: float,
        *,
        method: str = "rk4",
        derivatives: Literal[True],
        p: Values = None,
        t: ArrayLike = 0.0,
    ) -> tuple[Array, Array, Array]: ...

    def step(
        self,
        q: ArrayLike,
        v: ArrayLike,
        u: Values,
        dt: float,
        *,
        method: str = "rk4",
        derivatives: bool = False,
        p: Values = None,
        t: ArrayLike = 0.0,
    ) -> Array | tuple[Array, Array, Array]:
        """Return the state x₁ = [q₁; v₁] after one step of ``dt`` seconds with constant inputs, ``(..., n_q + n_v)``.

        ``method`` is "rk4", "midpoint" or "euler". With ``derivatives``, return x₁, A and B: A = ∂x₁/∂x has the shape
        ``(..., 2n, 2n)`` and B = ∂x₁/∂u ``(..., 2n, n_u)``. They are the exact derivatives of this discrete step, not
        of the motion that it approximates, in δx = (δq, δv); for a floating frame δq are components along its
        velocities, before and after the step. With constraints a step leaves them by its own error, and `assemble`
        returns to them; its derivatives are those along T of `allowed_changes`, and A T lies in the T of the new state
        to that error. Raises as `derivatives`, and for another method or step.
        """
        table = tableau(method)
        if isinstance(dt, bool) or not isinstance(dt, (int, float, np.floating, np.integer)) or not isfinite(dt):
            raise RunError(f"dt must be a finite number of seconds (got {dt!r:.60})", code="E501")
        start, time = (_array(q, self.coordinates, "q"), _array(v, self.velocities, "v")), np.asarray(t, float)

        def rates(q: Array, v: Array, later: float) -> Rates:
            return self._rates((q, v, u, p, time + later), derivatives=derivatives)

        x, stages = stepped(table, float(dt), *start, rates)
        if not derivatives:
            return x
        places = len(self.coordinates)
        return x, *differentiated(table, float(dt), stages, self._tangent(x[..., :places], x[..., places:]))

    def allowed_changes(self, q: ArrayLike, v: ArrayLike, p: Values = None, t: ArrayLike = 0.0) -> Array:
        """Return T, shape ``(..., 2n, k)``: the changes δx = T y are those that satisfy the constraints.

        δx = (δq, δv) as in `linearized`, ∂f δq = 0 for rows on positions and A δv + ∂(A v)/∂q δq = 0 for all rows. The
        columns are orthonormal, so that y = Tᵀ δx; of a step x₁ = A x₀ + B u with T₀ and T₁ before and after it, T₁ᵀ A
        T₀ and T₁ᵀ B are the matrices in the fewest states. Without constraints T = 1. Raises `RunError` if as many
        rows are not independent in every one of the states, as where a linkage can branch.
        """
        kernel = self._made("changes", lambda: dynamics.changes(self._model), still=False)
        rows = self._called(kernel, (q, v, None, p, t)) if kernel.program.outputs["rows"].ids else None
        n = 2 * len(self.velocities)
        if rows is None:
            lead = np.broadcast_shapes(np.shape(q)[:-1], np.shape(v)[:-1])
            return np.broadcast_to(np.eye(n), (*lead, n, n)).copy()
        found = np.asarray(rows["rows"] if isinstance(rows, Mapping) else rows)
        size = np.linalg.norm(found, axis=-1, keepdims=True)
        _, singular, right = np.linalg.svd(found / np.where(size > 0, size, 1.0))
        ranks = (singular > DEPENDENT).sum(axis=-1)
        rank = int(ranks.max(initial=0))
        if (ranks != rank).any():
            raise RunError(
                f"the constraints restrict {int(ranks.min())} changes in one of the states and {rank} in another",
                fix="leave out states in which one constraint depends on others; margin(q) is 0 there",
                code="E501",
            )
        return np.ascontiguousarray(np.swapaxes(right[..., rank:, :], -1, -2))

    def pullback(
        self,
        q: ArrayLike,
        v: ArrayLike,
        u: Values,
        w: ArrayLike,
        p: Values = None,
        t: ArrayLike = 0.0,
        *,
        wrt: Any = VARIED,
    ) -> Pullback:
        """Return wᵀ ∂a/∂(q, v, u, p) for weights w of the accelerations, as `lagrangian.Pullback`.

        ``g.q`` and ``g.v`` have the shape ``(..., n)``, ``g.u`` ``(..., number of inputs)``, ``g.p["m"]`` ``(...)``,
        ``g["theta"]`` is one entry; ``g.a`` are the accelerations. It is the gradient of w·a, by one backward pass: a
        few times the cost of a, whatever the number of entries. ``wrt`` and errors are those of `derivatives`.
        """
        names = self._names(wrt)
        kernel = self._made(
            ("pullback", names), lambda: dynamics.pullback(self._model, names), still=False, admitted=True
        )
        weights = _array(w, self.velocities, "w")
        return Pullback(kernel.program, self._every(kernel, (q, v, weights, u, p, t)), names)

    def hessian_product(
        self,
        q: ArrayLike,
        v: ArrayLike,
        u: Values,
        w: ArrayLike,
        dq: ArrayLike,
        dv: ArrayLike,
        p: Values = None,
        t: ArrayLike = 0.0,
        *,
        wrt: Any = VARIED,
    ) -> HessianProduct:
        """Return how wᵀ ∂a/∂(q, v, u, p) changes along (dq, dv), as `lagrangian.HessianProduct`.

        These are products of the Hessian matrix of w·a with a vector, by the names of `pullback`. For floating frames
        dq are components along the velocities, δq = N(q) dq. All arrays are of shape ``(..., n)``.
        """
        names = self._names(wrt)
        kernel = self._made(
            ("hessian product", names), lambda: dynamics.hessian_product(self._model, names), still=False, admitted=True
        )
        given = (_array(x, self.velocities, what) for x, what in ((w, "w"), (dq, "dq"), (dv, "dv")))
        return HessianProduct(kernel.program, self._every(kernel, (q, v, *given, u, p, t)), names)

    def _every(self, kernel: machine.Kernel, given: tuple[Any, ...]) -> Mapping[str, Array]:
        """The outputs of a kernel by name, one alone too."""
        found = self._called(kernel, given)
        return found if isinstance(found, Mapping) else {next(iter(kernel.program.outputs)): found}

    def _names(self, wrt: Any) -> tuple[str, ...]:
        """What is asked for, as names; a symbol called q, v or u is that parameter, and a text is the group.

        Raises `RunError` for anything else.
        """
        listed = [wrt] if isinstance(wrt, (str, sp.Basic)) else wrt
        if not isinstance(listed, Sequence) or not all(isinstance(name, (str, sp.Basic)) for name in listed):
            raise RunError(
                f"wrt must be names (got {wrt!r:.60})",
                fix="such as ('q', 'v', 'u') and names of parameters",
                code="E501",
            )
        found = [name if isinstance(name, str) else plain(name) for name in listed]
        for k, name in enumerate(listed):
            if not isinstance(name, str) and found[k] in VARIED:
                found[k] = f"{dynamics.PARAMETER}{found[k]}"
        return tuple(found)

    def _rates(self, given: tuple[Any, ...], *, derivatives: bool) -> Rates:
        """q̇ and v̇ at a state, which is given as for `forward`."""
        q, v, *_ = given
        tangent = self._tangent(q, v)
        qdot = v if tangent is None else tangent.qdot
        if not derivatives:
            return Rates(qdot, self._called(self._kernel("forward"), given))
        d = self.derivatives(*given)
        return Rates(qdot, d.a, d.a_q, d.a_v, d.a_u, tangent)

    def _tangent(self, q: ArrayLike, v: ArrayLike) -> VelocityMap | None:
        """How q moves with v; None where q̇ = v."""
        if not self._model.floating:
            return None
        kernel = self._made("tangent", lambda: dynamics.tangent(self._model))
        found = self._called(kernel, (q, v, None, None, 0.0))
        return VelocityMap(found["qdot"], found["N"], found["Nq"], found["back"], found["ad"])

    def _slopes(self, wrt: tuple[str, ...]) -> machine.Kernel:
        """The kernel of `derivatives`; parameters are checked as those of `forward` are."""
        return self._made(
            ("derivatives", wrt), lambda: dynamics.derivatives(self._model, wrt), still=False, admitted=True
        )


def _array(given: Any, names: tuple[str, ...], what: str) -> Array:
    """q or v as an array, (..., n), of a mapping by name or an array; raises `RunError` if it does not fit."""
    named = by_name(given)
    if isinstance(named, Mapping):
        if set(named) != set(names):
            raise RunError(f"{what} must have a value for each of {', '.join(names)[:200]}", code="E401")
        given = np.stack(np.broadcast_arrays(*(_numbers(named[name], name) for name in names)), axis=-1)
    found = _numbers(given, what)
    if found.ndim == 0 or found.shape[-1] != len(names):
        raise RunError(
            f"{what} has the shape {found.shape}; its last axis must have {len(names)} entries",
            fix="one number each, in the order " + ", ".join(names[:12]),
            code="E501",
        )
    return found


def _numbers(given: Any, what: str) -> Array:
    """An array of float64; raises `RunError` for what is not a number."""
    try:
        return np.asarray(given, float)
    except (TypeError, ValueError) as cause:
        raise RunError(f"{what} must consist of numbers (got {given!r:.60})", code="E501") from cause
