"""Computes poles and modes, with bounds of their rounding errors.

    M δq̈ + D δq̇ + K δq = 0        δẋ = A δx,  x = [q; q̇]

Without damping and with symmetric K the poles are ±√(−κ) of the symmetric pair K φ = κ M φ, and shapes are real; in
general they are the eigenvalues of A. Equal poles have shapes that span theirs, in reduced row echelon form. Sources:
Meirovitch, Fundamentals of Vibrations (2001), ch. 7; the error of an eigenvalue is ε‖A‖ over the cosine between its
left and right eigenvectors: Golub & Van Loan, Matrix Computations (4th ed.), §7.2.2.
"""

from __future__ import annotations

from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.linear.eigenspaces import EPSILON, EQUAL, SLACK, eigenspaces, graded_eigenvectors, plain_basis
from lagrangian.records import dataclass
from lagrangian.viewed import Brief

Array = NDArray[np.float64]

SYMMETRIC = 1e-10
"""The relative difference up to which K counts as symmetric and D as zero."""

GRADED = 1e-8
"""Squares of frequencies whose ratio is smaller are computed one by one: errors of the largest would hide others."""

ZERO_SHAPE_TOLERANCE = 1e-9
"""Components of a shape below this fraction of the largest are shown as zero."""


@dataclass(frozen=True)
class Mode(Brief):
    """A mode of the linear system: a motion of the form e^(λt).

    ``pole`` is λ [1/s] (of a pair, the one with a positive imaginary part), ``frequency`` ω_n = |λ| [rad/s],
    ``damping`` ζ = −Re λ/|λ| (1 for decay without oscillation, NaN at λ = 0). ``shape`` is the displacement of every
    coordinate, with 1 for the largest; it is real if the system is undamped. ``pair`` says whether the conjugate pole
    belongs to the mode.
    """

    pole: complex
    frequency: float
    damping: float
    shape: dict[str, complex]
    pair: bool

    @property
    def period(self) -> float:
        """2π/|Im λ| [s]; infinite if there is no oscillation."""
        return 2 * np.pi / abs(self.pole.imag) if self.pole.imag else float("inf")

    @property
    def is_real(self) -> bool:
        """Whether all coordinates move in phase or in opposite phase."""
        return all(x.imag == 0 for x in self.shape.values())


@dataclass(frozen=True, eq=False)
class Spectrum(Brief):
    """The eigenvalues of A [1/s] with bounds of their rounding errors, and the eigenvectors in columns."""

    poles: NDArray[np.complex128]
    errors: Array
    vectors: NDArray[np.complex128]

    @cached_property
    def sides(self) -> NDArray[np.int64]:
        """−1 in the left half plane, 0 on the imaginary axis to within rounding, +1 in the right half plane."""
        real = self.poles.real
        return np.where(np.abs(real) <= self.errors, 0, np.sign(real)).astype(np.int64)


def spectrum(
    A: Array, second_order: tuple[Array, Array, Array] | None = None, noise: tuple[Array | float, float] = (0.0, 0.0)
) -> Spectrum:
    """The spectrum of A (n×n); ``second_order`` is (M, D, K) if A is made of these.

    ``noise`` are the errors in the entries of A, each, and in those of M⁻¹K if they are known to be larger than ε.
    """
    if A.shape[0] == 0:
        return Spectrum(np.zeros(0, complex), np.zeros(0), np.zeros((0, 0), complex))
    if second_order is not None and is_conservative(*second_order):
        return _undamped(second_order[0], second_order[2], A, noise)
    even, sizes = balanced(A, noise[0])
    spaces = eigenspaces(even, float(np.max(noise[0] * sizes / sizes[:, None])))
    poles: NDArray[np.complex128] = np.array([s.pole for s in spaces for _ in range(s.times)], np.complex128)
    errors = np.array([s.error for s in spaces for _ in range(s.times)])
    vectors = [sizes[:, None] * _columns(plain_basis(s.basis), s.times) for s in spaces]
    real = np.where(np.abs(poles.real) <= errors, 0.0, poles.real)
    imag = np.where(np.abs(poles) <= errors, 0.0, poles.imag)
    return _sorted(np.asarray(real + 1j * imag, np.complex128), errors, np.asarray(np.hstack(vectors), complex))


def balanced(A: Array, noise: Array | float) -> tuple[Array, Array]:
    """Return D⁻¹ A D with rows and columns of like sizes, and the diagonal of D.

    Entries that are rounding errors, as ``noise`` says, do not count: in the column of a coordinate on which nothing
    depends they would set its scale, and shapes would lose half of their digits.
    """
    import scipy.linalg

    known = np.where(np.abs(A) > SLACK * np.asarray(noise), A, 0.0)
    _, scaling = scipy.linalg.matrix_balance(known, permute=False, separate=False)
    sizes: Array = np.diag(scaling).astype(float)
    return A * sizes / sizes[:, None], sizes


def _columns(basis: NDArray[Any], count: int) -> NDArray[Any]:
    """``count`` columns: those of the basis, repeated if there are fewer."""
    return basis[:, np.arange(count) % basis.shape[1]]


def is_conservative(M: Array, D: Array, K: Array) -> bool:
    """Whether D vanishes, K is symmetric and M is positive definite."""
    size = float(np.abs(K).max(initial=0.0))
    rate = np.sqrt(size * float(np.abs(M).max(initial=0.0)))
    return (
        K.shape[0] == K.shape[1]
        and bool(np.abs(D).max(initial=0.0) <= SYMMETRIC * rate)
        and bool(np.abs(K - K.T).max(initial=0.0) <= SYMMETRIC * size)
        and bool(np.all(np.linalg.eigvalsh((M + M.T) / 2) > 0))
    )


def _undamped(M: Array, K: Array, A: Array, noise: tuple[Array | float, float]) -> Spectrum:
    """λ = ±√(−κ) with K φ = κ M φ; values that are zero to within rounding are set to zero.

    With frequencies that are far apart, as of a mass of 1e-14 kg beside one of 1 kg, every κ has an error of its own:
    that of |φᵀ| |K| |φ| for φᵀ M φ = 1.
    """
    import scipy.linalg

    own = np.diag(K) / np.diag(M)
    if np.min(np.abs(own)) > GRADED * np.max(np.abs(own)):
        kappa, shapes = scipy.linalg.eigh((K + K.T) / 2, (M + M.T) / 2)
        bound = np.full(len(kappa), SLACK * EPSILON * float(np.abs(kappa).max(initial=0.0)) + noise[1])
    else:
        L = np.linalg.cholesky((M + M.T) / 2)
        half = scipy.linalg.solve_triangular(L, (K + K.T) / 2, lower=True)
        H = scipy.linalg.solve_triangular(L, half.T, lower=True)
        kappa, turned = graded_eigenvectors((H + H.T) / 2)
        shapes = scipy.linalg.solve_triangular(L.T, turned)
        n = len(kappa)
        errors = SLACK * EPSILON * np.abs(A[n:, :n]) + (noise[0][n:, :n] if isinstance(noise[0], np.ndarray) else 0.0)
        bound = np.einsum("ik,ij,jk->k", np.abs(M @ shapes), errors, np.abs(shapes))
    kappa = np.where(np.abs(kappa) <= bound, 0.0, kappa)
    unit = np.sqrt(np.diag(M))[:, None]
    for group in _equal(kappa, bound):
        kappa[group] = kappa[group].mean()
        shapes[:, group] = plain_basis(shapes[:, group] * unit) / unit
    roots = np.sqrt(-kappa.astype(complex))
    poles = np.concatenate([roots, -roots])
    # λ² = −κ, so the error of λ is that of κ over 2|λ|
    least = np.where(bound > 0, bound, 1.0)
    error = np.where(kappa == 0, 0.0, bound / (2 * np.sqrt(np.maximum(np.abs(kappa), least))))
    vectors = np.vstack([np.hstack([shapes, shapes]), np.hstack([shapes * roots, -shapes * roots])])
    return _sorted(poles, np.concatenate([error, error]), vectors)


def _equal(rising: Array, bound: Array) -> list[slice]:
    """The groups of ascending numbers that are equal to within their bounds."""
    room = np.maximum(EQUAL * np.maximum(np.abs(rising[1:]), np.abs(rising[:-1])), bound[1:] + bound[:-1])
    ends = [0, *(np.flatnonzero(np.diff(rising) > room) + 1).tolist(), len(rising)]
    return [slice(a, b) for a, b in pairwise(ends)]


def _sorted(poles: NDArray[np.complex128], errors: Array, vectors: NDArray[np.complex128]) -> Spectrum:
    """The spectrum, slowest first; of a pair, the pole above the real axis comes first."""
    order = slowest_first(poles)
    return Spectrum(np.asarray(poles[order] + 0.0, complex), errors[order], np.asarray(vectors[:, order], complex))


def slowest_first(poles: NDArray[np.complex128]) -> NDArray[np.int64]:
    """The order of poles: by size, then by real part, then the pole above the real axis first."""
    size = np.abs(poles)
    rising = np.sort(size)
    steps = np.concatenate([[0], np.cumsum(np.diff(rising) > ZERO_SHAPE_TOLERANCE * rising[1:])])
    return np.lexsort((-poles.imag, poles.real, steps[np.searchsorted(rising, size)]))


def modes(found: Spectrum, coordinates: tuple[str, ...]) -> tuple[Mode, ...]:
    """One mode for each real pole or conjugate pair, its shape by the names of the coordinates.

    A double pole has two modes if it has two shapes. Otherwise it has one, as for a free position and its drift, or for
    critical damping.
    """
    listed: list[Mode] = []
    for k, pole in enumerate(found.poles):
        if pole.imag < 0:
            continue
        size = abs(pole)
        ratio = float(-pole.real / size) if size else float("nan")
        shape = _shape(found.vectors[: len(coordinates), k], coordinates)
        if any(m.pole == pole and m.shape == shape for m in listed):
            continue
        listed.append(Mode(complex(pole), float(size), ratio, shape, bool(pole.imag > 0)))
    return tuple(listed)


def _shape(vector: NDArray[np.complex128], names: tuple[str, ...]) -> dict[str, complex]:
    """The displacements relative to the largest (the first of equal ones), with rounding errors set to zero."""
    sizes = np.abs(vector)
    if not len(sizes) or not sizes.max():
        return dict.fromkeys(names, 0j)
    lead = int(np.argmax(sizes >= (1 - 1e-9) * sizes.max()))
    scaled = vector / vector[lead]
    real = np.where(np.abs(scaled.real) < ZERO_SHAPE_TOLERANCE, 0.0, scaled.real)
    imag = np.where(np.abs(scaled.imag) < ZERO_SHAPE_TOLERANCE, 0.0, scaled.imag)
    return {name: complex(a, b) for name, a, b in zip(names, real, imag, strict=True)}
