"""Checks of a derivation with constraints: its rows, its multipliers, and its equations without them.

Everything is compared at states that satisfy the rows: only there are the accelerations those of the system, and only
there do rows in the axes of a body have one meaning in every language. With the derived M, C, G, Ξ, A and γ

    [ M  −Aᵀ ] [ ξ̈ ]   [ Ξ − C ξ̇ − G ]
    [ A   0  ] [ λ ] = [     −γ      ]

is solved as one dense system by NumPy, and held against what is compiled and against the equations in fewer speeds.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, TypeAlias, cast

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian import bounded, dynamics
from lagrangian.derive import Derived, Minimal
from lagrangian.derive.sample import Sampler
from lagrangian.model import time
from lagrangian.model.rows import rows_of
from lagrangian.page.formula import Check, Name, text
from lagrangian.records import dataclass
from lagrangian.verify.in_regimes import Routes
from lagrangian.verify.on_rows import Groups, OnRows, State
from lagrangian.verify.states import evaluated

Array: TypeAlias = NDArray[np.float64]

RANK = 1e-11
"""The relative size under which a singular value of the whole system is rounding."""


@dataclass
class RowFigures:
    """The largest differences found."""

    rows: float = 0.0
    accelerations: float = 0.0
    dual: float | None = 0.0
    minimal: float = 0.0
    count: int = 0


class RowChecks:
    """What is compared at a state that satisfies the rows."""

    def __init__(self, derivation: Derived) -> None:
        model = derivation.model
        self.derivation, self.model = derivation, model
        self.figures = RowFigures()
        self._on_rows = OnRows(model)
        self._matrix = dynamics.constraint_matrix(model)
        names = [row.name for row in rows_of(model)]
        self._kept = [names.index(name) for name in derivation.multipliers]
        self._minimal = None if derivation.minimal is None else _MinimalRoute(derivation, derivation.minimal)

    def states(self, sampler: Sampler, count: int, seed: int) -> Iterator[tuple[State, Groups]]:
        """Up to ``count`` random states on the rows; if there are none, the parameters keep their values."""
        for given in (False, True):
            yield from self._on_rows.states(sampler, count, seed, given=given)
            if self.figures.count:
                return

    def pushed(self, groups: Groups, multipliers: Array) -> Array:
        """Aᵀ λ with the compiled A."""
        return _of(evaluated(self._matrix, groups)["A"], -1, len(groups["v"]))[self._kept].T @ multipliers

    def solved(self, got: Mapping[str, Array]) -> tuple[Array, Array]:
        """ξ̈ and λ of the derived equations and rows."""
        n, A = len(got["v"]), got["A"].reshape(-1, len(got["v"]))
        M, C = (got[k].reshape(n, n) for k in ("M", "C"))
        whole = np.block([[M, -A.T], [A, np.zeros((len(A), len(A)))]])
        right = np.concatenate([got["Xi"] - C @ got["v"] - got["G"], -got["gamma"]])
        found = _of(np.linalg.lstsq(whole, right, rcond=RANK)[0])
        return found[:n], found[n:]

    def smallest(self, got: Mapping[str, Array]) -> float:
        """The smallest eigenvalue of M on the motions that the rows allow; infinite where there are none."""
        n, A = len(got["v"]), got["A"].reshape(-1, len(got["v"]))
        _, singular, turned = np.linalg.svd(A)
        allowed = turned[int((singular > RANK * singular.max(initial=0.0)).sum()) :].T
        M = got["M"].reshape(n, n)
        return float(np.linalg.eigvalsh(allowed.T @ (M + M.T) @ allowed / 2).min(initial=np.inf))

    def hold(self, got: Mapping[str, Array], groups: Groups, state: State, routes: Routes) -> None:
        """Compare the rows, the accelerations, the multipliers and the equations without them at a state."""
        assert routes.multipliers is not None and routes.dual is not None
        self.figures.count += 1
        found, n = self.figures, len(got["v"])
        A, gamma, v = got["A"].reshape(-1, n), got["gamma"], got["v"]
        machine = evaluated(self._matrix, groups)
        size = max(1.0, float(np.abs(A).max()), float(np.abs(gamma).max(initial=0.0)))
        whole, drive, change = _of(machine["A"], -1, n), _of(machine["a0"]), _of(machine["gamma"])
        for off in (whole[self._kept] - A, change[self._kept] - gamma, whole @ v + drive):
            found.rows = _worse(found.rows, float(np.abs(off).max(initial=0.0)) / size)
        a, lam = self.solved(got)
        compiled = _of(evaluated(routes.forward, groups)["a"]), _of(evaluated(routes.multipliers, groups)["lam"])
        found.accelerations = _worse(found.accelerations, _apart((a, A.T @ lam), (compiled[0], whole.T @ compiled[1])))
        if found.dual is not None:
            found.dual = self._against_dual(got, evaluated(routes.dual, groups), (a, A.T @ lam), whole)
        if self._minimal is not None:
            found.minimal = _worse(found.minimal, self._minimal.difference(state, a))

    def _against_dual(
        self, got: Mapping[str, Array], other: Mapping[str, Any], found: tuple[Array, Array], A: Array
    ) -> float | None:
        """The dense second route; None where M alone is singular, for it divides by M."""
        n = len(got["v"])
        if np.linalg.matrix_rank(got["M"].reshape(n, n), tol=RANK * np.abs(got["M"]).max()) < n:
            return None
        assert self.figures.dual is not None
        return _worse(self.figures.dual, _apart(found, (_of(other["a"]), A.T @ _of(other["lam"]))))

    def checks(self, tolerance: float) -> Iterator[Check]:
        """What was found, in words."""
        found = self.figures
        count = f"{found.count} random state{'s' if found.count != 1 else ''} that satisfy the constraints"
        if not found.count:
            what = text("the equations hold where the constraints do")
            yield Check(
                what, None, "not checked: no random position could be moved to where it satisfies the constraints"
            )
            return
        A, lam = Name("A"), Name("lambda")
        yield Check(
            text(
                "the compiled rows of the constraints are those of the derivation: ",
                A,
                ", the terms without rates, and γ",
            ),
            found.rows < tolerance,
            f"largest relative difference {found.rows:.1e} at {count}",
        )
        yield Check(
            text("the compiled accelerations and ", lam, " solve the equations and the rows together"),
            found.accelerations < tolerance,
            f"largest relative difference {found.accelerations:.1e}",
        )
        if found.dual is not None:
            yield Check(
                text(
                    "a second route, by the inverse of ",
                    Name("M"),
                    ", gives the same accelerations and constraint forces",
                ),
                found.dual < tolerance,
                f"largest relative difference {found.dual:.1e}",
            )
        if self._minimal is not None:
            yield Check(
                text("the equations without multipliers give the same accelerations"),
                found.minimal < tolerance,
                f"largest relative difference {found.minimal:.1e}",
            )


class _MinimalRoute:
    """The equations in fewer speeds: solved for u̇ at a state, and turned into accelerations of the coordinates."""

    def __init__(self, derivation: Derived, minimal: Minimal) -> None:
        model = derivation.model
        self._coordinates = model.coordinates
        self._speeds = minimal.speeds
        self._changes = [cast("sp.Expr", sp.Derivative(u, time).doit()) for u in minimal.speeds]
        rates = list(minimal.rates.values())
        meanings = [minimal.meanings.get(u, u) for u in minimal.speeds]
        residuals = [cast("sp.Expr", e.lhs) - cast("sp.Expr", e.rhs) for e in minimal.equations]
        self._meanings = Sampler(model, meanings)
        self._residuals = Sampler(model, residuals)
        self._rates = Sampler(model, rates)
        self._accelerations = Sampler(model, [bounded.diff(x, time) for x in rates])

    def difference(self, state: State, a: Array) -> float:
        """How far its rates and accelerations are from those of the state and from ``a``."""
        here = dict(state)
        here.update(zip(self._speeds, self._meanings.at(here), strict=True))
        v = np.array([state[c.rate] for c in self._coordinates])
        rates = np.array(self._rates.at(here))
        k = len(self._speeds)
        columns = []
        for row in (np.zeros(k), *np.eye(k)):
            here.update(zip(self._changes, row.tolist(), strict=True))
            columns.append(np.array(self._residuals.at(here)))
        M = np.array([c - columns[0] for c in columns[1:]]).T.reshape(k, k)
        change = np.linalg.solve(M, -columns[0])
        here.update(zip(self._changes, change.tolist(), strict=True))
        return _apart((v, a), (rates, np.array(self._accelerations.at(here))))


def _of(values: object, *shape: int) -> Array:
    found = np.array(values, float)
    return found.reshape(shape) if shape else found


def _worse(a: float, b: float) -> float:
    """The larger; not-a-number is the worst and stays."""
    return float(np.maximum(a, b))


def _apart(found: tuple[Array, ...], other: tuple[Array, ...]) -> float:
    """The largest difference of vectors, each in parts of the larger of 1 and its own size."""
    worst = 0.0
    for x, y in zip(found, other, strict=True):
        size = max(1.0, float(np.abs(x).max(initial=0.0)))
        worst = _worse(worst, float(np.abs(x - y).max(initial=0.0)) / size)
    return worst
