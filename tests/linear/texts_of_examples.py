"""Prints the equilibria, linearizations and conserved quantities of examples; a number above 0 shakes last digits.

Run as a program: ``python texts_of_examples.py 1 2`` shakes by 1, and takes every second example. Other processors
round differently, and so do arrays that lie elsewhere in memory. A shaken run stands for all of them: what NumPy's and
SciPy's linear algebra takes is changed in its last digits, each entry by up to two roundings of the largest.
"""

import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import scipy.linalg

SHAKEN = ("eig", "eigvals", "eigh", "eigvalsh", "svd", "solve", "inv", "lstsq", "qr", "pinv", "schur")


def shaking(function: Callable[..., Any], source: np.random.Generator) -> Callable[..., Any]:
    def shaken(x: Any) -> Any:
        if not isinstance(x, np.ndarray) or x.dtype.kind not in "fc" or not x.size:
            return x
        size = np.abs(x[np.isfinite(x)]).max(initial=0.0)
        return x + 4e-16 * size * source.uniform(-1, 1, x.shape) * (x != 0)

    def call(*given: Any, **options: Any) -> Any:
        return function(*map(shaken, given), **options)

    return call


def shake(seed: int) -> None:
    source = np.random.default_rng(seed)
    for module in (np.linalg, scipy.linalg):
        for name in SHAKEN:
            if hasattr(module, name):
                setattr(module, name, shaking(getattr(module, name), source))


def show(step: int) -> None:
    import lagrangian as lg
    from lagrangian import examples

    for name in examples.names()[::step]:
        system = lg.example(name)
        try:
            rests = system.equilibria()
            print(name, rests.to_text(), *(system.linearize(e).to_text() for e in rests[:3]))
        except lg.Error as trouble:
            print(name, trouble)
        try:
            print(name, system.linearize().to_text())
        except lg.Error as trouble:
            print(name, trouble)
        if name == "whipple-bicycle":
            continue  # minutes of symbols
        try:
            print(name, system.conserved_quantities().to_text())
        except lg.Error as trouble:
            print(name, trouble)


if __name__ == "__main__":
    if seed := int(sys.argv[1]):
        shake(seed)
    show(int(sys.argv[2]))
