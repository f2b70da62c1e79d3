"""Controllability and observability of δẋ = A δx + B δu, δy = C δx.

The staircase: orthogonal transformations split off what B reaches, then what A maps it to, and so on; the rest is never
reached. Ranks are determined from singular values, with A balanced and the columns of B normalized, so that units do
not matter. The test of Popov, Belevitch and Hautus identifies the modes: a pole λ is uncontrollable if some w ≠ 0 has
wᵀA = λ wᵀ and wᵀB = 0: the left null space of A − λ within what is left over. Source: Paige, IEEE Trans. AC-26 (1981)
130–138.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import RunError
from lagrangian.linear.eigenspaces import eigenspaces, plain_basis
from lagrangian.records import dataclass
from lagrangian.viewed import Brief

Array = NDArray[np.float64]

SMALL = 1e-11
"""A singular value below this fraction of the norm of the balanced A and B counts as zero."""


LEFT_OVER = 1e-13
"""The rounding error of what the staircase leaves over, relative to that norm; it may all be 0."""


@dataclass(frozen=True)
class Missing(Brief):
    """A pole that the inputs cannot control (or the outputs cannot show), with its combination of states.

    For controllability ``combination`` is the w of Popov, Belevitch and Hautus: Σ w_i x_i evolves independently of the
    inputs. For observability it is the motion for which all outputs are zero. The largest component is 1. If a pole has
    several combinations, they are a basis in reduced row echelon form. ``times`` is the multiplicity of the pole among
    those that are missing; it exceeds the number of combinations if one of them drives another, as momentum drives
    position.
    """

    pole: complex
    combination: dict[str, complex]
    times: int = 1


@dataclass(frozen=True)
class Reach(Brief):
    """``rank`` of ``order`` dimensions are reached; ``missing`` are the other modes, one of each pair."""

    order: int
    rank: int
    missing: tuple[Missing, ...]

    @property
    def complete(self) -> bool:
        """Whether the whole state is reached."""
        return self.rank == self.order

    @property
    def enough(self) -> bool:
        """Whether all missing modes decay: stabilizable (by inputs), detectable (from outputs)."""
        return all(m.pole.real < 0 for m in self.missing)


def controllable(A: Array, B: Array, states: tuple[str, ...]) -> Reach:
    """Controllability by the inputs. Raises `RunError` if there are none."""
    if not B.shape[1]:
        raise RunError(
            "the system has no input",
            fix="declare one: system.input(…), or under [inputs] in a model file",
            code="E401",
        )
    return _reach(A, B, states)


def observable(A: Array, C: Array, states: tuple[str, ...]) -> Reach:
    """Observability from the outputs. Raises `RunError` if there are none."""
    if not C.shape[0]:
        raise RunError("no output is given", fix="write outputs=[expression, …]", code="E401")
    return _reach(A.T, C.T, states)


def _reach(A: Array, B: Array, states: tuple[str, ...]) -> Reach:
    import scipy.linalg

    found: Any = scipy.linalg.matrix_balance(A, permute=False, separate=True)
    balanced, scale = found[0], found[1][0]
    inputs = B / scale[:, None]
    sizes = np.linalg.norm(inputs, axis=0)
    inputs = inputs / np.where(sizes > 0, sizes, 1.0)
    size = float(np.linalg.norm(balanced, 2)) or 1.0
    basis, rank = _staircase(balanced / size, inputs)
    rest = basis[:, rank:]
    own = rest.T @ balanced @ rest
    missing = []
    for space in eigenspaces(own.T, LEFT_OVER * size) if len(own) else []:
        pole = _clean(space.pole, size)
        if pole.imag >= 0:
            basis = plain_basis(rest @ space.basis) / scale[:, None]
            missing += [Missing(pole, _named(w, states), space.times) for w in basis.T]
    return Reach(len(A), rank, tuple(sorted(missing, key=_slowest_first)))


def _slowest_first(missing: Missing) -> tuple[float, float]:
    return float(f"{abs(missing.pole):.9e}"), missing.pole.real


def _staircase(A: Array, B: Array) -> tuple[Array, int]:
    """An orthogonal basis whose first ``rank`` columns span what B, AB, A²B, … reach."""
    n = len(A)
    basis, rank, step = np.eye(n), 0, B
    while rank < n:
        U, values, _ = np.linalg.svd(step)
        fresh = int((values > SMALL).sum())
        if not fresh:
            break
        basis[:, rank:] = basis[:, rank:] @ U
        inside = basis[:, rank : rank + fresh]
        rank += fresh
        step = basis[:, rank:].T @ A @ inside
    return basis, rank


def _clean(value: complex, size: float) -> complex:
    real = 0.0 if abs(value.real) < 1e3 * SMALL * size else value.real
    return complex(real, 0.0 if abs(value.imag) < 1e3 * SMALL * size else value.imag)


def _named(w: NDArray[Any], states: tuple[str, ...]) -> dict[str, complex]:
    """The components by name relative to the largest, without those that are rounding errors."""
    lead = int(np.argmax(np.abs(w) >= (1 - 1e-9) * np.abs(w).max()))
    shares = w / w[lead]
    return {
        name: complex(x.real if abs(x.real) > 1e-9 else 0.0, x.imag if abs(x.imag) > 1e-9 else 0.0)
        for name, x in zip(states, shares, strict=True)
        if abs(x) > 1e-9
    }
