"""Computes linearizations δẋ = A δx + B δu, δy = C δx + D δu with exact derivatives, and the names of all quantities.

A = ∂ẋ/∂x and B = ∂ẋ/∂u of ẋ = f(x, u, p, t), x = [q; q̇], are found by differentiating the graph of the forward
dynamics, which gives q̈ explicitly. About an equilibrium this is equivalent to M δq̈ + D δq̇ + K δq = S δu, with K =
∂h/∂q, D = ∂h/∂q̇, S = −∂h/∂u of h = C q̇ + G − Ξ.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.assembly.assemble import fixed_names
from lagrangian.errors import RunError
from lagrangian.graph import Program
from lagrangian.linear.floating_states import FloatingStates
from lagrangian.linear.jacobians import Arrays, forces, may_kink, rates, reads, values, with_jacobians
from lagrangian.linear.linearization import Linearization
from lagrangian.linear.manifold import Manifold, Tangent
from lagrangian.linear.modes import EPSILON, SLACK
from lagrangian.linear.outputs import Measured, measured
from lagrangian.linear.rest import TIMES, OperatingPoint, rest
from lagrangian.linear.stability import has_minimum, loses_power, loses_power_beyond_potential
from lagrangian.model import Model
from lagrangian.model.rows import named_conditions
from lagrangian.model.without_friction import advice_for
from lagrangian.records import dataclass
from lagrangian.values.values import Given, Named

Array = NDArray[np.float64]
_log = logging.getLogger(__name__)

PERTURBED = 1e-12
"""The relative change of parameters and point from which rounding errors are estimated."""

UNSETTLED = 1e-4
"""If these errors change an entry of A by more than this part of it, the entry is nothing but rounding."""

STEP = 1e-6
"""The step with which a kink in the motion is looked for."""


def linearize(
    model: Model,
    at: Any = None,
    *,
    inputs: Named | None = None,
    params: Named | None = None,
    outputs: Any = None,
    time: object = 0.0,
    operating_point: bool = False,
    fixed: Sequence[Any] | str | None = None,
) -> Linearization:
    """Return the linearization of a model about a point.

    ``at``: values of coordinates and rates by name or symbol (0 unless given), or an `Equilibrium`; each value is a
    number or text with a unit. ``outputs``: expressions, as a list or by name; by default the coordinates. A point that
    is not an equilibrium raises `RunError` unless ``operating_point`` is true; a point very close to an equilibrium is
    moved onto it, and `notes` says so.

    A point of a constrained system must satisfy the constraints; with ``fixed``, the names of coordinates that stay as
    given, it is a guess that is moved onto them. `RunError` is also raised for names and values that do not fit, if M
    is not positive definite on the motions that are allowed, and at a kink.
    """
    linearizer = Linearizer(model)
    given = Given.of(model, linearizer.rates)
    t = given.time_value(time)
    _log.info("linearizing: the point")
    stay = _fixed(linearizer, fixed)
    here = rest(model, linearizer.rates, given, at, inputs, params, t, operating_point, linearizer.manifold, stay)
    _log.info("linearizing: A, B, C, D")
    return linearizer.about(here, t, outputs)


@dataclass(frozen=True, eq=False)
class Linearizer:
    """The programs for linearizations of one model, made once; ``values`` evaluates them."""

    model: Model
    values: Callable[..., Arrays] = values

    @cached_property
    def manifold(self) -> Manifold | None:
        """What the constraints allow; None without any."""
        return Manifold(self.model) if self.model.constraints else None

    @cached_property
    def pushed(self) -> Program:
        """h − Aᵀλ with its slopes, of a system with constraints."""
        return with_jacobians(dynamics.pushed_bias(self.model), {"K": ("h", "q"), "D": ("h", "v"), "S": ("h", "u")})

    @cached_property
    def rates(self) -> Program:
        """ẋ, A and B."""
        return rates(self.model)

    @cached_property
    def forces(self) -> Program:
        """h, K, D and S."""
        return forces(self.model)

    @cached_property
    def mass(self) -> Program:
        """M."""
        return dynamics.mass_matrix(self.model)

    @cached_property
    def power(self) -> Program:
        """The power of the nonconservative forces."""
        return dynamics.power(self.model)

    @cached_property
    def power_slopes(self) -> Program:
        """That power with its first and second derivatives."""
        return with_jacobians(with_jacobians(self.power, {"W": ("P", "x")}), {"slope": ("W", "x")})

    @cached_property
    def _reads_time(self) -> bool:
        return bool(reads(self.rates, "A", "t") or reads(self.rates, "B", "t"))

    @cached_property
    def _may_kink(self) -> bool:
        return may_kink(self.rates, "xdot")

    @cached_property
    def rests_change(self) -> bool:
        """Whether the forces depend on time."""
        return bool(reads(self.forces, "h", "t"))

    @cached_property
    def _plain(self) -> Measured:
        """The coordinates as outputs."""
        return measured(self.model, None, self.rates)

    def at_rest(self, x: Array, u: Array, p: Array) -> Linearization:
        """The linearization about a point that is known to be an equilibrium, with steady currents or at rest."""
        kind = "steady motion" if x[len(self.model.coordinates) :].any() else "rest"
        return self.about(OperatingPoint(self.rates.inputs["x"], x, u, p, kind, 0.0), 0.0, None)

    def about(self, here: OperatingPoint, t: float, outputs: Any) -> Linearization:
        """The linearization about a point of a known kind."""
        program = self.rates
        found = _finite(self.values(program, x=here.x, u=here.u, p=here.p, t=t), here)
        tangent = None if self.manifold is None else self._tangent(self.manifold, here, t, found)
        self._proper(here, t, found, tangent)
        y = self._plain if outputs is None else measured(self.model, outputs, program)
        seen = _finite(self.values(y.program, x=here.x, u=here.u, p=here.p, t=t), here)
        if may_kink(y.program, "y"):
            self._sloped(y.program, "y", seen["C"], here, t, "an output")
        second = None if here.kind == "operating point" else self._second_order(here, t, tangent)
        noise, noise_of_K, settled = self._noise(here, t, found, second, tangent)
        multipliers = None if tangent is None else self._multipliers(here, t, found, tangent)
        if tangent is not None:
            found, seen = tangent.reduced(found), {**seen, "C": seen["C"] @ tangent.basis}
            found |= {name: np.where(settled[name], found[name], 0.0) for name in settled}
        floats = None
        if tangent is None and self.model.floating:
            floats = FloatingStates.at(self.model, here.x, found["xdot"])
            found, seen = floats.reduced(found), {**seen, "C": seen["C"] @ floats.basis}
            noise = (np.abs(floats.back) @ noise[0] @ np.abs(floats.basis), noise[1])
        minimal = tangent if floats is None else floats
        return Linearization(
            model=self.model,
            A=found["A"],
            B=found["B"],
            C=seen["C"],
            D=seen["D"],
            states=_independent(program, tangent) if floats is None else floats.names,
            inputs=program.inputs["u"],
            outputs=y.names,
            at=dict(zip(program.inputs["x"], here.x.tolist(), strict=True)),
            inputs_at=dict(zip(program.inputs["u"], here.u.tolist(), strict=True)),
            outputs_at=dict(zip(y.names, seen["y"].tolist(), strict=True)),
            parameters=dict(zip(program.inputs["p"], here.p.tolist(), strict=True)),
            kind=here.kind,
            drift=found["xdot"],
            residual=here.residual,
            mass=None if second is None else second["M"],
            damping=None if second is None else second["D"],
            stiffness=None if second is None else second["K"],
            input_matrix=None if second is None else -second["S"],
            time=t,
            notes=here.notes,
            free=here.free,
            changing=self._changes(here),
            minimum=here.kind == "rest" and second is not None and self._minimum(second, here, noise_of_K),
            noise=noise,
            basis=None if minimal is None else minimal.basis,
            back=None if floats is None else floats.back,
            transport=None if floats is None else floats.transport,
            multipliers=multipliers or {},
        )

    def _tangent(self, manifold: Manifold, here: OperatingPoint, t: float, found: Arrays) -> Tangent:
        """The directions that constraints allow; speeds of coordinates on which no force depends follow others.

        Entries that are nothing but rounding are 0: where a rod stands upright, cos 90° is.
        """
        n = manifold.size
        slopes = np.abs(found["A"][n:, :n])
        idle = np.flatnonzero(slopes.max(axis=0, initial=0.0) <= 1e-9 * slopes.max(initial=0.0))
        tangent = manifold.tangent(here.x, here.p, t, idle=idle.tolist())
        settled = np.ones_like(tangent.basis, bool)
        for x, p in _neighbours(here):
            change = np.abs(manifold.tangent(x, p, t, tangent.kept).basis - tangent.basis)
            settled &= change <= UNSETTLED * np.abs(tangent.basis)
        return replace(tangent, basis=np.where(settled, tangent.basis, 0.0))

    def _proper(self, here: OperatingPoint, t: float, found: Arrays, tangent: Tangent | None) -> None:
        """Raise an error if the mass matrix is not positive definite, or if the motion has no derivative at the
        point."""
        n = len(self.forces.inputs["q"])
        M = self.values(self.mass, q=here.x[:n], v=here.x[n:], u=here.u, p=here.p, t=t)["M"]
        if tangent is not None:
            M = tangent.speeds.T @ M @ tangent.speeds
        least = float(np.linalg.eigvalsh((M + M.T) / 2).min(initial=np.inf))
        if not least > 0:
            raise RunError(
                f"the mass matrix is not positive definite at {here.shown}: its least eigenvalue is {least:.3g}",
                fix="give positive masses and inertias",
                code="E203",
            )
        if self._may_kink:
            self._sloped(self.rates, "xdot", found["A"], here, t, "the motion")

    def _sloped(self, program: Program, output: str, slope: Array, here: OperatingPoint, t: float, what: str) -> None:
        """Raise an error if the derivative of an output is not the same on both sides of the point."""
        source = np.random.default_rng(6)
        size = max(1.0, _largest(slope))
        start = self.values(program, x=here.x, u=here.u, p=here.p, t=t)[output]
        for _ in range(8):
            step = STEP * source.choice([-1.0, 1.0], len(here.x)) * source.uniform(0.5, 1.0, len(here.x))
            near = self.values(program, x=here.x + step, u=here.u, p=here.p, t=t)[output]
            if not _largest(near - start - slope @ step) <= 1e-3 * size * STEP:
                frictions = self.model.frictions
                why = f" ({frictions[0].title} turns round or begins to slip)" if frictions else ""
                smooth = "choose a point next to it, or replace abs, sign, min, max and piecewise by a smooth law"
                raise RunError(
                    f"{what} has a kink or a jump at {here.shown}{why}: it has no linearization there",
                    fix=advice_for(frictions[0]) if frictions else smooth,
                    code="E525",
                )

    def _second_order(self, here: OperatingPoint, t: float, tangent: Tangent | None) -> Arrays | None:
        """M, D, K, S about an equilibrium, if the velocities are the rates of the coordinates."""
        n = len(self.forces.inputs["q"])
        if n != len(self.forces.inputs["v"]):
            return None
        point = {"q": here.x[:n], "v": here.x[n:], "u": here.u, "p": here.p, "t": t}
        if tangent is not None:
            return self._second_order_along(point, here, tangent)
        return self.values(self.forces, **point) | self.values(self.mass, **point)

    def _second_order_along(self, point: dict[str, Any], here: OperatingPoint, tangent: Tangent) -> Arrays | None:
        """Zᵀ M Z, Zᵀ D Z, Zᵀ ∂(h − Aᵀλ)/∂q Z and Zᵀ S at a rest of a system whose rows all restrict positions.

        q = φ(y) with Z = ∂φ/∂y; that h = Aᵀλ there turns h·∂²φ/∂y² into the slope of −Aᵀλ.
        """
        n, m = len(point["q"]), tangent.positions
        if here.kind != "rest" or tuple(k + n for k in tangent.kept[:m]) != tangent.kept[m:]:
            return None
        Z = tangent.basis[:n, :m]
        lam = self._balancing(point, self.values(self.forces, **point)["h"])
        found = self.values(self.pushed, **point, lam=lam)
        K, D = (Z.T @ found[name] @ Z for name in ("K", "D"))
        M = Z.T @ self.values(self.mass, **point)["M"] @ Z
        return {"M": (M + M.T) / 2, "K": K, "D": D, "S": Z.T @ found["S"]}

    def _balancing(self, point: dict[str, Any], force: Array) -> Array:
        """The shortest λ with Aᵀλ = force."""
        assert self.manifold is not None
        A = self.manifold.at(np.concatenate([point["q"], point["v"]]), point["p"], point["t"])["A"]
        return np.asarray(np.linalg.lstsq(A.T, force, rcond=1e-11)[0], float)

    def _multipliers(self, here: OperatingPoint, t: float, found: Arrays, tangent: Tangent) -> dict[str, float] | None:
        """λ of every row at the point, Aᵀλ = M v̇ + h; None where rows depend on each other, which leaves it open."""
        n = len(self.forces.inputs["q"])
        point = {"q": here.x[:n], "v": here.x[n:], "u": here.u, "p": here.p, "t": t}
        if not tangent.complete:
            return None
        h, M = self.values(self.forces, **point)["h"], self.values(self.mass, **point)["M"]
        force = M @ found["xdot"][n:] + h
        lam = self._balancing(point, force)
        lam[np.abs(lam) <= 1e-12 * (_largest(lam) + _largest(M * found["xdot"][n:]) + _largest(h))] = 0.0
        names = [row.name for row in named_conditions(self.model)]
        return dict(zip(names, lam.tolist(), strict=True))

    def _noise(
        self, here: OperatingPoint, t: float, found: Arrays, second: Arrays | None, tangent: Tangent | None
    ) -> tuple[tuple[Array, float], float, dict[str, NDArray[np.bool_]]]:
        """The rounding errors in the entries of A, in M⁻¹K, and in K: their change when their thirteenth digits change.

        If terms cancel, as at a bifurcation, the errors are much larger than ε times the result. The last result says
        which entries of A and B keep most of their digits then; the others are what rounding leaves of 0.
        """
        dK = dMK = 0.0
        mine = found if tangent is None else tangent.reduced(found)
        dA = np.zeros_like(mine["A"])
        changes = {name: np.zeros_like(mine[name]) for name in ("A", "B")}
        for x, p in _neighbours(here):
            moved = replace(here, x=x, p=p)
            near, there = self.values(self.rates, x=x, u=here.u, p=p, t=t), tangent
            if self.manifold is not None and tangent is not None:
                there = self.manifold.tangent(x, p, t, tangent.kept)
                near = there.reduced(near)
                changes = {k: np.maximum(np.abs(near[k] - mine[k]), d) for k, d in changes.items()}
            dA = np.maximum(dA, np.abs(near["A"] - mine["A"]))
            if second is not None and (other := self._second_order(moved, t, there)) is not None:
                dK = max(dK, _largest(other["K"] - second["K"]))
                n = len(second["K"])
                dMK = max(dMK, _largest(near["A"][n:, :n] - mine["A"][n:, :n]))
        digits = SLACK * EPSILON / PERTURBED
        settled: dict[str, NDArray[np.bool_]] = {}
        if tangent is not None:
            settled = {k: np.asarray(d <= UNSETTLED * np.abs(mine[k]), bool) for k, d in changes.items()}
        return (dA * digits, dMK * digits), dK * digits, settled

    def _minimum(self, second: Arrays, here: OperatingPoint, noise: float) -> bool:
        n = len(self.forces.inputs["q"])
        if not has_minimum(second["M"], second["K"], noise):
            return False
        point = (here.x[:n], here.u, here.p)
        return loses_power(self.values, self.power, *point) or loses_power_beyond_potential(
            self.values, self.power_slopes, *point
        )

    def _changes(self, here: OperatingPoint) -> bool:
        """Whether A or B differs between several times."""
        if not self._reads_time:
            return False
        first, *others = (self.values(self.rates, x=here.x, u=here.u, p=here.p, t=t) for t in TIMES)
        return any(
            np.abs(other[k] - first[k]).max(initial=0.0) > 1e-9 * max(1.0, np.abs(first[k]).max(initial=0.0))
            for other in others
            for k in ("A", "B")
        )


def _neighbours(here: OperatingPoint) -> Iterator[tuple[Array, Array]]:
    """States and parameters like those of a point, with other digits after the twelfth."""
    source = np.random.default_rng(5)
    for _ in range(3):
        x, p = (v * (1 + PERTURBED * source.uniform(-1, 1, len(v))) for v in (here.x, here.p))
        yield x, p


def _independent(program: Program, tangent: Tangent | None) -> tuple[str, ...]:
    """The states that can be chosen: all without constraints."""
    names = program.inputs["x"]
    return names if tangent is None else tuple(names[k] for k in tangent.kept)


def _fixed(linearizer: Linearizer, fixed: Sequence[Any] | str | None) -> tuple[str, ...] | None:
    """The names of the coordinates that stay when a guess is moved onto the constraints; None if it must be on them."""
    if fixed is None:
        return None
    model = linearizer.model
    if linearizer.manifold is None:
        raise RunError(
            f"system '{model.name}' has no constraints, so every point is taken as given",
            fix="leave fixed out",
            code="E501",
        )
    return fixed_names(model, fixed)


def _finite(found: Arrays, here: OperatingPoint) -> Arrays:
    for name, array in found.items():
        if not np.isfinite(array).all():
            raise RunError(
                f"{name} is not finite at {here.shown}",
                fix="check for a square root of 0 or a division by 0 there",
                code="E503",
            )
    return found


def _largest(a: Array) -> float:
    return float(np.abs(a).max(initial=0.0))
