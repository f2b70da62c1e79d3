"""The point about which a system is linearized: an equilibrium, a steady motion, or neither?"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.advice import Advice, Argument, Verb
from lagrangian.errors import RunError
from lagrangian.graph import Program
from lagrangian.linear.jacobians import Arrays, reads, values
from lagrangian.linear.manifold import Manifold, point_words
from lagrangian.model import Model
from lagrangian.records import dataclass
from lagrangian.values.dimensions import RATE
from lagrangian.values.values import Given, Named

Array = NDArray[np.float64]

ANY_POINT = Argument("operating_point", "True")
"""The argument that accepts a point that is not an equilibrium."""

NEAR = 1e-4
"""A point counts as an equilibrium typed with few digits if Newton's step, relative to 1 + |q|, is at most this."""

ROUNDING = 1e-9
"""The largest remaining acceleration at an equilibrium, relative to the largest entry of A."""

TIMES = (0.0, 0.37, 1.91, 7.13)
"""The times [s] at which expressions of t are compared."""


@dataclass(frozen=True, eq=False)
class OperatingPoint:
    """A point x, u, p, and what moves there.

    ``kind``: "rest", "steady motion" or "operating point"; ``residual`` is the largest |q̈|; ``free`` are the
    coordinates on which nothing depends.
    """

    names: tuple[str, ...]
    x: Array
    u: Array
    p: Array
    kind: str
    residual: float
    free: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def shown(self) -> str:
        """The point in words."""
        return point_words(self.names, self.x)


def rest(
    model: Model,
    program: Program,
    given: Given,
    at: Any,
    inputs: Named | None,
    params: Named | None,
    t: float,
    any_point: bool,
    manifold: Manifold | None = None,
    fixed: Sequence[str] | None = None,
) -> OperatingPoint:
    """Return the requested point. Raises `RunError` if it is not an equilibrium and ``any_point`` is not set.

    With constraints, ``manifold``, the point must satisfy them; it is moved onto them if ``fixed`` names what stays.
    """
    states = program.inputs["x"]
    if at is not None and not isinstance(at, Mapping) and hasattr(at, "at"):  # an Equilibrium, with its own inputs
        inputs = {**at.inputs, **given.inputs.values(inputs)}
        params = {**at.parameters, **given.parameters.values(params)}
        at = at.at
    start = dict.fromkeys(states, 0.0) | {c.name: c.start for c in model.coordinates}
    x = np.array(list((start | given.states.values(at)).values()))
    u, p = given.input_values(inputs), given.parameter_values(params)
    here = OperatingPoint(states, x, u, p, "operating point", 0.0)
    if manifold is not None:
        here = _allowed(manifold, here, t, fixed)
    q = x[: len(model.coordinates)]
    if manifold is None and (moved := dynamics.loose(model, q.tolist(), u.tolist(), p.tolist(), t)):
        raise RunError(
            f"the mass matrix is singular at {point_words(states[: len(q)], q)}: {moved}, so that nothing decides the "
            "accelerations",
            fix="add a mass or an inertia that they move, or choose a neighbouring point or other coordinates",
            code="E203",
        )
    found = _values(program, here, t)
    n = len(model.coordinates)
    here = replace(here, residual=_largest(found["xdot"][n:]), free=free_coordinates(program, here, n, t))
    if manifold is not None and manifold.moves_with_time:
        if not any_point:
            raise _driven(here)
        return here
    settled = _classified(here, found, n) if any_point else _settled(model, program, here, found, n, t, manifold)
    later = None if settled.kind == "operating point" else _moved_later(program, settled, t)
    if later is None:
        return settled
    if any_point:
        return replace(settled, kind="operating point")
    raise RunError(
        f"{settled.shown} is at rest at t = {t:g} s only: forces change with time, and at {later:g} s it moves",
        fix=Advice(ANY_POINT, " linearizes about any point and keeps the constant term (drift) of that moment"),
        code="E521",
    )


def _allowed(manifold: Manifold, here: OperatingPoint, t: float, fixed: Sequence[str] | None) -> OperatingPoint:
    """The point on the constraints; an error if it is not on them, not even nearly, and ``fixed`` is not given."""
    if manifold.holds(here.x, here.p, t):
        return here
    x = manifold.moved(here.x, here.p, t, fixed or ())
    change = np.abs(x - here.x)
    worst = int(np.argmax(change))
    if _largest(change / (1 + np.abs(here.x))) <= 1e-12:
        return replace(here, x=x)
    name = here.names[worst]
    if fixed is None and _largest(change / (1 + np.abs(here.x))) > NEAR:
        raise RunError(
            f"{here.shown} does not satisfy the constraints: the nearest point that does has {name} = {x[worst]:.6g}",
            fix=Advice(
                "give ",
                Argument("fixed", repr(here.names[0])),
                " with the coordinates that stay, and the others are moved onto the constraints; or "
                "take the point that compile().assemble(q, v) returns",
            ),
            code="E521",
        )
    note = f"moved onto the constraints: {name} from {here.x[worst]:.6g} to {x[worst]:.6g}"
    return replace(here, x=x, notes=(*here.notes, note))


def _driven(here: OperatingPoint) -> RunError:
    return RunError(
        f"{here.shown} is no equilibrium: constraints move with time, so that nothing stays at rest",
        fix=Advice(ANY_POINT, " linearizes about any point and keeps the constant term (drift) of that moment"),
        code="E521",
    )


def _values(program: Program, here: OperatingPoint, t: float) -> Arrays:
    found = values(program, x=here.x, u=here.u, p=here.p, t=t)
    if np.isfinite(found["xdot"]).all() and not all(np.isfinite(a).all() for a in found.values()):
        raise RunError(
            f"the accelerations have no finite slope at {here.shown}",
            fix="choose a neighbouring point: there is a square root of 0 or a division by 0 here",
            code="E525",
        )
    if not np.isfinite(found["xdot"]).all():
        raise RunError(
            f"the accelerations are not finite at {here.shown}",
            fix="choose a neighbouring point: there is a square root of a negative number or a division by 0",
            code="E203",
        )
    return found


def _moved_later(program: Program, here: OperatingPoint, t: float) -> float | None:
    """A time at which ẋ differs from that at t; None if there is none."""
    if not reads(program, "xdot", "t"):
        return None
    found = _values(program, here, t)
    bound = ROUNDING * max(1.0, _largest(found["A"]))
    changes = (s for s in TIMES if _largest(_values(program, here, s)["xdot"] - found["xdot"]) > bound)
    return next(changes, None)


def _largest(a: Array) -> float:
    return float(np.abs(a).max(initial=0.0))


def free_coordinates(program: Program, here: OperatingPoint, n: int, t: float) -> tuple[str, ...]:
    """The coordinates on which ẋ does not depend, at the point and at random states."""
    source = np.random.default_rng(2)
    constant = np.ones(n, bool)
    for k in range(4):
        x = here.x + (k > 0) * 0.3 * source.standard_normal(len(here.x))
        A = values(program, x=x, u=here.u, p=here.p, t=t)["A"]
        if np.isfinite(A).all():
            constant &= np.abs(A[:, :n]).max(axis=0) <= 1e-11 * max(1.0, _largest(A))
        if not constant.any():
            break
    return tuple(name for name, c in zip(here.names, constant, strict=False) if c)


def _classified(here: OperatingPoint, found: Arrays, n: int) -> OperatingPoint:
    """The kind of the point as it is."""
    bound = ROUNDING * max(1.0, _largest(found["A"]))
    if here.residual > bound:
        return here
    moving = [name for name, rate in zip(here.names[:n], found["xdot"][:n], strict=True) if abs(rate) > bound]
    if not moving:
        return replace(here, kind="rest")
    if set(moving) <= set(here.free):
        note = f"steady motion of {', '.join(moving)}, on which nothing depends"
        return replace(here, kind="steady motion", notes=(*here.notes, note))
    return here


def _settled(
    model: Model, program: Program, here: OperatingPoint, found: Arrays, n: int, t: float, manifold: Manifold | None
) -> OperatingPoint:
    """The equilibrium at the point, or very close to it; otherwise an explanatory error."""
    start = here.x
    moved = 0.0
    for _ in range(6):
        step = _newton(here, found, n) if manifold is None else _newton_along(here, found, n, t, manifold)
        if _largest(step / (1 + np.abs(here.x))) < 1e-14:
            break
        moved = _largest((here.x + step - start) / (1 + np.abs(start)))
        if moved > NEAR:
            break
        here = replace(here, x=here.x + step)
        if manifold is not None and not manifold.holds(here.x, here.p, t):
            here = replace(here, x=manifold.moved(here.x, here.p, t))
        found = _values(program, here, t)
        here = replace(here, residual=_largest(found["xdot"][n:]))
    settled = _classified(here, found, n)
    if moved > NEAR or settled.kind == "operating point":
        raise _refused(model, replace(here, x=start), program, n, t)
    if moved > 1e-12:
        note = f"moved by {moved:.1e} onto the rest at {point_words(here.names[:n], here.x[:n])}"
        settled = replace(settled, notes=(*settled.notes, note))
    return settled


def _newton(here: OperatingPoint, found: Arrays, n: int) -> Array:
    """The shortest change of the coordinates that are not free for which q̈ vanishes, with the same rates."""
    A, a = found["A"][n:, :n], found["xdot"][n:]
    step = np.zeros(len(here.x))
    step[:n] = -np.linalg.lstsq(A, a, rcond=1e-12)[0]
    return step


def _newton_along(here: OperatingPoint, found: Arrays, n: int, t: float, manifold: Manifold) -> Array:
    """The same along the constraints: a change of the independent coordinates."""
    tangent = manifold.tangent(here.x, here.p, t)
    along = tangent.basis[:, : tangent.positions]
    return -along @ np.linalg.lstsq(found["A"][n:] @ along, found["xdot"][n:], rcond=1e-12)[0]


def _unit(model: Model, program: Program, k: int) -> str:
    """The unit of the rate of state number ``k`` after a space, as far as it is known."""
    dim = Given.of(model, program).states.dims[k]
    if dim is None or dim.unknown:
        return ""
    text = str(dim.times(RATE))
    return f" rad{text[1:]}" if text.startswith("1/") else f" {text}"


def _refused(model: Model, here: OperatingPoint, program: Program, n: int, t: float) -> RunError:
    found = _values(program, here, t)
    worst = int(np.argmax(np.abs(found["xdot"][n:])))
    bound = ROUNDING * max(1.0, _largest(found["A"]))
    if np.abs(found["xdot"][n:]).max(initial=0.0) > bound:
        name = here.names[n + worst]
        why = f"{name}' = {found['xdot'][n + worst]:.6g}{_unit(model, program, n + worst)} there"
    else:
        k = int(np.argmax(np.abs(found["xdot"][:n])))
        why = f"{here.names[k]} changes at {found['xdot'][k]:.6g}{_unit(model, program, k)}"
    search = ["give the inputs that hold it still"] if model.floating else [Verb("equilibria"), " finds equilibria"]
    return RunError(
        f"{here.shown} is not an equilibrium: {why}",
        fix=Advice(*search, "; ", ANY_POINT, " linearizes about any point and keeps the constant term (drift)"),
        code="E521",
    )
