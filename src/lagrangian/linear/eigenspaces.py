"""Computes the poles of a matrix with their eigenspaces, with the same result on every processor.

Rounding splits a pole of a Jordan block of m rows into m poles about (ε‖A‖)^(1/m) apart, differently on every machine,
and replaces the vectors of equal poles by others that span the same space. Therefore poles that rounding cannot tell
apart are combined into one at their mean, which is exact to first order; their vectors are the null space of A − λ by
singular values. The multiplicity of λ is found by the staircase: the null space, the null space of what remains across
it, and so on.

Sources: Golub & Van Loan, Matrix Computations (4th ed.), §§ 7.1.6, 7.2.2; Kublanovskaya, USSR Comp. Math. 6 (1966).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.linear.echelon import reduced
from lagrangian.records import dataclass
from lagrangian.viewed import Brief

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

EPSILON = float(np.finfo(float).eps)
SLACK = 100.0
"""A real part is not zero if it exceeds the first-order bound of its rounding error by this factor."""

EQUAL = float(np.sqrt(EPSILON))
"""Two poles may be the same if their difference, relative to their size, is at most this."""

MAX_JORDAN_BLOCK = 6
"""The largest number of rows of a Jordan block that is looked for."""

SWEEPS = 40
"""Sweeps of rotations after which a matrix counts as diagonal; five to ten are usual."""

ILL = 1e-2
"""If the cosine between its left and right vectors is smaller, a pole may belong to a Jordan block."""


@dataclass(frozen=True, eq=False)
class Eigenspace(Brief):
    """A pole with its multiplicity ``times``, its rounding error, and {w : A w = λ w} with a basis in the columns of
    ``basis``."""

    pole: complex
    times: int
    error: float
    basis: Complex


def eigenspaces(A: Array, noise: float = 0.0) -> list[Eigenspace]:
    """The poles of A (n×n, balanced), each once; ``noise`` is the error in the entries of A if it is larger than
    rounding."""
    import scipy.linalg  # the import takes a third of a second, so only those who ask for poles pay for it

    found: Any = scipy.linalg.eig(A, left=True, right=True)
    poles, left, right = (np.asarray(x, np.complex128) for x in found)
    cosine = np.abs(np.einsum("ik,ik->k", left.conj(), right))
    error = SLACK * EPSILON * float(np.linalg.norm(A, 2)) + noise
    errors = error / np.maximum(cosine, EQUAL)
    listed = []
    for group in _groups(A, poles, cosine, errors, error):
        pole = complex(poles[group].mean())
        basis = right[:, group]
        if len(group) > 1 or np.linalg.norm(A @ basis - pole * basis) > error:  # LAPACK scales A, perhaps by rounding
            basis = _null_space(A, pole, len(group), error)
        listed.append(Eigenspace(pole, len(group), float(errors[group].max()), basis))
    return listed


def _groups(A: Array, poles: Complex, cosine: Array, errors: Array, error: float) -> list[list[int]]:
    """The indices of poles that are the same."""
    left, found = list(range(len(poles))), []
    for m in range(min(MAX_JORDAN_BLOCK, len(poles)), 1, -1):
        for k in list(left):
            near = sorted(left, key=lambda i: abs(poles[i] - poles[k]))[:m]
            if k in left and len(near) == m and _is_block(A, poles[near], cosine[near], error):
                found.append(near)
                left = [i for i in left if i not in near]
    while left:
        group = [left.pop(0)]
        for i in group:
            close = [
                j
                for j in left
                if abs(poles[i] - poles[j]) <= max(EQUAL * max(abs(poles[i]), abs(poles[j])), errors[i] + errors[j])
            ]
            group += close
            left = [j for j in left if j not in close]
        found.append(sorted(group))
    return found


def _is_block(A: Array, poles: Complex, cosine: Array, error: float) -> bool:
    """Whether poles are those into which rounding splits a multiple pole with too few vectors."""
    size = float(np.linalg.norm(A, 2)) or 1.0
    mean = complex(poles.mean())
    spread = float(np.abs(poles - mean).max())
    if cosine.max() > ILL or spread > size * (error / size) ** (1 / len(poles)):
        return False
    return _multiplicity(A, mean, error) == len(poles)


def _multiplicity(A: Array, pole: complex, error: float) -> int:
    """The multiplicity of ``pole`` in A, from the staircase of null spaces."""
    rest = A - pole * np.eye(len(A))
    count = 0
    while len(rest):
        _, values, rows = np.linalg.svd(rest)
        null = int((values <= error).sum())
        if not null:
            break
        count += null
        across = rows[: len(rest) - null]
        rest = across @ rest @ across.conj().T
    return count


def _null_space(A: Array, pole: complex, times: int, error: float) -> Complex:
    """An orthonormal basis of {w : A w = λ w}, with at least one and at most ``times`` columns."""
    _, values, rows = np.linalg.svd(A - pole * np.eye(len(A)))
    count = int((values <= error + 2 * EQUAL * abs(pole)).sum())
    return rows[len(A) - min(max(count, 1), times) :].conj().T


def graded_eigenvectors(H: Array) -> tuple[Array, Array]:
    """The eigenvalues of a symmetric H, rising, with orthonormal eigenvectors in columns, by Jacobi's rotations.

    In a graded matrix, H = D A D with a diagonal D and a well-conditioned A, every eigenvalue keeps its own digits,
    however small it is beside the largest. Source: Demmel & Veselić, SIAM J. Matrix Anal. Appl. 13 (1992).
    """
    H, n = H.copy(), len(H)
    turned = np.eye(n)
    for _ in range(SWEEPS):
        still = True
        for i in range(n):
            for j in range(i + 1, n):
                if abs(H[i, j]) <= EPSILON * np.sqrt(abs(H[i, i])) * np.sqrt(abs(H[j, j])):
                    continue
                still = False
                slope = (H[j, j] - H[i, i]) / (2 * H[i, j])
                t = (1.0 if slope >= 0 else -1.0) / (abs(slope) + np.hypot(1.0, slope))
                c = 1 / np.hypot(1.0, t)
                rotation, shift = np.array([[c, c * t], [-c * t, c]]), t * H[i, j]
                ends = H[i, i] - shift, H[j, j] + shift
                H[:, [i, j]] = H[:, [i, j]] @ rotation
                H[[i, j]] = H[:, [i, j]].T
                H[i, i], H[j, j], H[i, j], H[j, i] = *ends, 0.0, 0.0
                turned[:, [i, j]] = turned[:, [i, j]] @ rotation
        if still:
            break
    order = np.argsort(np.diag(H))
    return np.diag(H)[order], turned[:, order]


def plain_basis(basis: Any) -> Any:
    """The same space with a readable basis: the reduced row echelon form of its columns."""
    return reduced(basis.T)[0].T if basis.shape[1] > 1 else basis
