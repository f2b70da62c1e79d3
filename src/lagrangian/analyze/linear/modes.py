"""Poles, modes and what they say of stability.

    M δq̈ + D δq̇ + K δq = 0        δẋ = A δx,  x = [q; q̇]

Without damping and with symmetric K the poles are ±√(−κ) of the symmetric pair K φ = κ M φ, and shapes are real; in
general they are the eigenvalues of A. Sources: Meirovitch, Fundamentals of Vibrations (2001), ch. 7; the error of an
eigenvalue is ε‖A‖ over the cosine between its left and right eigenvectors: Golub & Van Loan, Matrix Computations
(4th ed.), §7.2.2.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

EPSILON = float(np.finfo(float).eps)
SLACK = 100.0
"""How many times the first-order bound of its rounding error a real part must exceed to count as not zero."""

SYMMETRIC = 1e-10
"""Relative difference up to which K counts as symmetric and D as zero."""


@dataclass(frozen=True)
class Mode:
    """One way in which the linear system moves by itself.

    ``pole`` λ [1/s] (of a pair, the one with positive imaginary part), ``frequency`` ω_n = |λ| [rad/s], ``damping``
    ζ = −Re λ/|λ| (1 for decay without swinging, nan at λ = 0), ``shape`` the displacement of every coordinate, the
    largest one 1: real where the system is undamped. ``pair`` says whether the conjugate pole belongs to it.
    """

    pole: complex
    frequency: float
    damping: float
    shape: dict[str, complex]
    pair: bool

    @property
    def period(self) -> float:
        """2π/|Im λ| [s]; infinite where nothing swings."""
        return 2 * np.pi / abs(self.pole.imag) if self.pole.imag else float("inf")

    @property
    def is_real(self) -> bool:
        """Whether all coordinates move in step or opposite."""
        return all(x.imag == 0 for x in self.shape.values())


@dataclass(frozen=True, eq=False)
class Spectrum:
    """The eigenvalues of A, [1/s], with the bound of each one's rounding error, and their vectors, a column each."""

    poles: NDArray[np.complex128]
    errors: Array
    vectors: NDArray[np.complex128]

    @cached_property
    def sides(self) -> NDArray[np.int64]:
        """−1 in the left half plane, 0 on the imaginary axis as far as rounding lets one tell, +1 in the right one."""
        real = self.poles.real
        return np.where(np.abs(real) <= self.errors, 0, np.sign(real)).astype(np.int64)


def spectrum(
    A: Array, second_order: tuple[Array, Array, Array] | None = None, noise: tuple[float, float] = (0.0, 0.0)
) -> Spectrum:
    """The spectrum of A (n×n); ``second_order`` is (M, D, K) where A is made of them.

    ``noise`` are the rounding errors in the entries of A and of M⁻¹K, where these are known to be larger than ε.
    """
    if A.shape[0] == 0:
        return Spectrum(np.zeros(0, complex), np.zeros(0), np.zeros((0, 0), complex))
    if second_order is not None and is_conservative(*second_order):
        return _undamped(second_order[0], second_order[2], noise[1])
    import scipy.linalg  # a third of a second that only who asks for poles pays

    balanced, scaling = scipy.linalg.matrix_balance(A, permute=False, separate=False)
    found: Any = scipy.linalg.eig(balanced, left=True, right=True)
    poles, left, right = (np.asarray(x, np.complex128) for x in found)
    cosine = np.abs(np.einsum("ik,ik->k", left.conj(), right))
    error = SLACK * EPSILON * float(np.linalg.norm(balanced, 2)) + noise[0]
    errors = error / np.maximum(cosine, np.sqrt(EPSILON))
    real = np.where(np.abs(poles.real) <= errors, 0.0, poles.real)
    imag = np.where(np.abs(poles) <= errors, 0.0, poles.imag)
    return _sorted(real + 1j * imag, errors, scaling @ right)


def is_conservative(M: Array, D: Array, K: Array) -> bool:
    """Whether D vanishes, K is symmetric and M positive definite."""
    size = float(np.abs(K).max(initial=0.0))
    rate = np.sqrt(size * float(np.abs(M).max(initial=0.0)))
    return (
        K.shape[0] == K.shape[1]
        and bool(np.abs(D).max(initial=0.0) <= SYMMETRIC * rate)
        and bool(np.abs(K - K.T).max(initial=0.0) <= SYMMETRIC * size)
        and bool(np.all(np.linalg.eigvalsh((M + M.T) / 2) > 0))
    )


def _undamped(M: Array, K: Array, noise: float) -> Spectrum:
    """λ = ±√(−κ) with K φ = κ M φ; what is zero up to rounding is zero."""
    import scipy.linalg

    kappa, shapes = scipy.linalg.eigh((K + K.T) / 2, (M + M.T) / 2)
    bound = SLACK * EPSILON * float(np.abs(kappa).max(initial=0.0)) + noise
    kappa = np.where(np.abs(kappa) <= bound, 0.0, kappa)
    roots = np.sqrt(-kappa.astype(complex))
    poles = np.concatenate([roots, -roots])
    # of λ² = −κ: the error of λ is that of κ over 2|λ|
    error = np.where(kappa == 0, 0.0, bound / (2 * np.sqrt(np.maximum(np.abs(kappa), bound or 1.0))))
    vectors = np.vstack([np.hstack([shapes, shapes]), np.hstack([shapes * roots, -shapes * roots])])
    return _sorted(poles, np.concatenate([error, error]), vectors)


def _sorted(poles: NDArray[np.complex128], errors: Array, vectors: NDArray[np.complex128]) -> Spectrum:
    """The spectrum, slowest first; of a pair the pole above the real axis first."""
    order = _order(poles)
    return Spectrum(np.asarray(poles[order] + 0.0, complex), errors[order], np.asarray(vectors[:, order], complex))


def _order(poles: NDArray[np.complex128]) -> NDArray[np.int64]:
    size = np.array([float(f"{abs(x):.9e}") for x in poles])
    return np.lexsort((-poles.imag, poles.real, size))


def modes(found: Spectrum, coordinates: tuple[str, ...]) -> tuple[Mode, ...]:
    """One mode a real pole, conjugate pair or double 0, its shape by the names of the coordinates."""
    listed: list[Mode] = []
    for k, pole in enumerate(found.poles):
        if pole.imag < 0:
            continue
        size = abs(pole)
        ratio = float(-pole.real / size) if size else float("nan")
        shape = _shape(found.vectors[: len(coordinates), k], coordinates)
        if not size and any(m.pole == 0 and m.shape == shape for m in listed):  # standing still and drifting
            continue
        listed.append(Mode(complex(pole), float(size), ratio, shape, bool(pole.imag > 0)))
    return tuple(listed)


def _shape(vector: NDArray[np.complex128], names: tuple[str, ...]) -> dict[str, complex]:
    """The displacements over the largest of them (the first of equals), dust swept to zero."""
    sizes = np.abs(vector)
    if not len(sizes) or not sizes.max():
        return dict.fromkeys(names, 0j)
    lead = int(np.argmax(sizes >= (1 - 1e-9) * sizes.max()))
    scaled = vector / vector[lead]
    real = np.where(np.abs(scaled.real) < 1e-12, 0.0, scaled.real)
    imag = np.where(np.abs(scaled.imag) < 1e-12, 0.0, scaled.imag)
    return {name: complex(a, b) for name, a, b in zip(names, real, imag, strict=True)}
