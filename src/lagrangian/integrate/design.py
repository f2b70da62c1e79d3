"""Determines the runs of an ensemble: every run's initial state, inputs and parameters, which are made when needed.

Runs are numbered 0 … count − 1 in C order over a shape, such as (50, 20, 1000) for two axes of a grid and 1000 samples.
An entry of a run is a constant, comes from an array that is broadcast to the shape, or is drawn from a distribution;
the draw depends on the run's position along the last axis. Nothing of the size of the whole ensemble is stored.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import RunError
from lagrangian.quantities.largest import SMALLER, too_large
from lagrangian.records import dataclass, field

Array: TypeAlias = NDArray[np.float64]

MOST_RUNS = 10**12
"""The largest number of runs in an ensemble; more is probably a typing mistake."""

GROUPS = ("x", "u", "p")
_WORDS = 4  # number of 64-bit words for each step of Philox's counter


def _normal(u: Array, mean: float, deviation: float) -> Array:
    from scipy.special import ndtri

    return mean + deviation * ndtri(u)


def _lognormal(u: Array, mu: float, sigma: float) -> Array:
    return np.exp(_normal(u, mu, sigma))


def _uniform(u: Array, low: float, high: float) -> Array:
    return low + (high - low) * u


LAWS: Mapping[str, Callable[[Array, float, float], Array]] = {
    "normal": _normal,  # mean, standard deviation
    "uniform": _uniform,  # lowest, highest
    "lognormal": _lognormal,  # mean and standard deviation of the logarithm
}
"""Distributions by name as quantile functions: 0 < u < 1 → the value below which a fraction u of all draws lies.

Their two parameters have the same meaning as in NumPy.
"""


@dataclass(frozen=True)
class RandomColumn:
    """Random draws of one entry: sample k for seed s is always the same number, in whatever order samples are
    requested.

    Philox counts through the samples (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", 2011), with a key
    made from the seed and the entry's name, so that another entry that is drawn does not affect this one. A word w
    becomes u = (w + ½)/2⁵³ from its upper 53 bits, and the quantile function of the distribution gives the value.
    """

    name: str
    law: str
    a: float
    b: float
    seed: int

    def sample(self, index: NDArray[np.int64]) -> Array:
        """The values of the samples in ``index``, which are close together or fill whole ranges."""
        if index.size == 0:
            return np.empty(0)
        first = int(index.min()) // _WORDS
        last = int(index.max()) // _WORDS
        key = int.from_bytes(hashlib.blake2b(self.name.encode(), digest_size=8).digest(), "little")
        bits = np.random.Philox(key=np.array([self.seed, key], np.uint64)).advance(first)
        words = np.asarray(bits.random_raw((last - first + 1) * _WORDS), np.uint64)
        u = ((words >> np.uint64(11)).astype(np.float64) + 0.5) * 2.0**-53
        return LAWS[self.law](u, self.a, self.b)[index - first * _WORDS]


@dataclass(frozen=True)
class DesignColumn:
    """Entry ``index`` of a group ("x", "u", "p") and the source of its values: an array, or draws."""

    group: str
    index: int
    name: str
    source: Array | RandomColumn


@dataclass(frozen=True)
class Rows:
    """The runs of a range: x (n, nx); u (nu,) or (n, nu); p (np,) or (n, np), with one dimension if all runs agree."""

    x: Array
    u: Array
    p: Array

    def __len__(self) -> int:
        return len(self.x)

    def only(self, chosen: NDArray[np.bool_]) -> Rows:
        """Some of the runs."""
        return Rows(self.x[chosen], *(a if a.ndim == 1 else a[chosen] for a in (self.u, self.p)))


@dataclass(frozen=True)
class Design:
    """Runs over ``shape`` with axes named ``dims``: constants ``base`` by group, and the columns that vary.

    Raises `RunError` if an array cannot be broadcast to the shape, if a number is not finite, or if there are no runs.
    """

    dims: tuple[str, ...]
    shape: tuple[int, ...]
    base: Mapping[str, Array]
    columns: Sequence[DesignColumn] = ()
    count: int = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "count", math.prod(self.shape))
        if self.count == 0:
            empty = [d for d, n in zip(self.dims, self.shape, strict=True) if n == 0]
            raise RunError(f"there are no runs: '{empty[0]}' is empty", code="E501", fix="give at least one value")
        if self.count > MOST_RUNS:
            sizes = " × ".join(f"{d}: {n}" for d, n in zip(self.dims, self.shape, strict=True))
            raise RunError(
                f"{self.count} runs are too many ({sizes})", code="E501", fix=f"at most {MOST_RUNS}: take fewer values"
            )
        for column in self.columns:
            if not isinstance(column.source, RandomColumn):
                self._check(column.name, column.source)

    def _check(self, name: str, values: Array) -> None:
        try:
            np.broadcast_to(values, self.shape)
        except ValueError:
            raise RunError(
                f"'{name}' has shape {values.shape}, which does not broadcast to {self.shape}",
                code="E501",
                fix="make the shapes of all arrays equal, or 1 along an axis",
            ) from None
        if not np.isfinite(values).all():
            where = np.argwhere(~np.isfinite(values))[0]
            at = f" at {tuple(int(k) for k in where)}" if values.ndim else ""
            raise RunError(f"'{name}' is {values[tuple(where)]}{at}", code="E502", fix="give finite numbers")
        if values.size and (trouble := too_large(float(values.flat[np.abs(values).argmax()]))):
            raise RunError(f"'{name}' {trouble}", code="E101", fix=SMALLER)

    def values(self, column: DesignColumn, start: int, stop: int) -> Array:
        """The values of a column in runs start … stop − 1."""
        index: Any = np.unravel_index(np.arange(start, stop), self.shape) if self.shape else ()
        if isinstance(column.source, RandomColumn):
            drawn = column.source.sample(index[-1])
            if not np.isfinite(drawn).all():
                raise RunError(
                    f"a draw of '{column.name}' is not finite",
                    code="E502",
                    fix="take a narrower distribution",
                )
            return drawn
        spread = np.broadcast_to(column.source, self.shape)
        return np.array(spread[index]).reshape(stop - start)

    def rows(self, start: int, stop: int) -> Rows:
        """Runs start … stop − 1."""
        varying = {c.group for c in self.columns} | {"x"}
        arrays = {g: np.tile(self.base[g], (stop - start, 1)) if g in varying else self.base[g] for g in GROUPS}
        for column in self.columns:
            arrays[column.group][:, column.index] = self.values(column, start, stop)
        return Rows(arrays["x"], arrays["u"], arrays["p"])
