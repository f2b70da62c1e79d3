"""What `System.fit` returns: the estimate, how sure it is, what the data cannot tell, and what is left over."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import special

from lagrangian.errors import NoSuchEntry, RunError
from lagrangian.fit.uncertainty import Undetermined
from lagrangian.model import Model
from lagrangian.page.figures import figure, or_none
from lagrangian.page.formula import Check, Item, Table, Verbatim, text
from lagrangian.page.report import Part, Report
from lagrangian.quantities.quantity import unit_dimension
from lagrangian.records import dataclass, field
from lagrangian.simulate.guesses import by_key, checks_data, lettered
from lagrangian.simulate.trajectory import Trajectory
from lagrangian.values.dimensions import Dim
from lagrangian.values.values import key_name, number
from lagrangian.viewed import Entries
from lagrangian.write.numerals import unit
from lagrangian.write.written import Written

Array = NDArray[np.float64]

UNLIKELY = 4.0
"""Standard deviations of the number of stretches of one sign beyond which residuals are no noise."""

ROUNDING = 1e-6
"""Residuals below this fraction of the range of the data are rounding, in which there is order."""

USUAL = 0.95
"""The confidence of the intervals in tables."""


@dataclass(frozen=True, eq=False)
class Fit(Written):
    """The unknowns that fit measured data best, by name, and how well the data determine them.

    ``estimate`` and ``std``: the value of every unknown and its standard deviation (infinite if the data do not
    determine it, NaN if it lies on a bound). ``covariance`` and ``correlation`` (n, n) are in the order of ``names``.
    ``sigma`` is the standard deviation of the noise of each column, given or estimated; ``known_sigma`` says which.
    ``residuals`` has for each run the model minus the data by column, NaN where a sample is missing. ``undetermined``
    names the unknowns that cannot be told apart, ``at_bound`` those on a bound. ``runs`` are the runs with the
    estimate. ``chi2`` is Σ (residual/σ)², ``dof`` the number of samples minus that of what is determined. ``ranges``
    has the greatest minus the least value of each column of the data. ``success`` says whether the search ended at a
    minimum, and ``message`` how. ``checks`` hold the residuals and their derivatives
    against runs that were integrated without variational equations.
    """

    model: Model = field(repr=False)
    names: tuple[str, ...]
    estimate: Mapping[str, float]
    std: Mapping[str, float]
    covariance: Array = field(repr=False)
    sigma: Mapping[str, float]
    known_sigma: bool
    residuals: tuple[Mapping[str, Array], ...] = field(repr=False)
    undetermined: tuple[Undetermined, ...]
    at_bound: tuple[str, ...]
    runs: tuple[Trajectory, ...] = field(repr=False)
    chi2: float
    dof: int
    evaluations: int
    success: bool
    message: str
    units: Mapping[str, str] = field(repr=False)
    ranges: Mapping[str, float] = field(default_factory=dict[str, float], repr=False)
    checks: tuple[Check, ...] = field(default=(), repr=False)

    @property
    def correlation(self) -> Array:
        """The correlation of the unknowns, (n, n); NaN for those that are not determined or lie on a bound."""
        size = np.sqrt(np.diag(self.covariance))
        usable = np.isfinite(size) & (size > 0)
        found = np.full(self.covariance.shape, np.nan)
        both = np.ix_(usable, usable)
        found[both] = self.covariance[both] / np.outer(size[usable], size[usable])
        return found

    def interval(self, name: Any, confidence: float = USUAL) -> tuple[float, float]:
        """Return the interval that contains the true value with this probability: estimate ± quantile · std.

        The quantile is that of Student's t with ``dof`` degrees of freedom, of the normal distribution if ``sigma`` was
        given. Raises `NoSuchEntry` for an unknown name and `RunError` for a confidence that is not between 0 and 1.
        """
        shown = key_name(name)
        if shown not in self.names:
            raise NoSuchEntry.among("the fit has no unknown", shown, self.names)
        level = (1 + _checked(confidence)) / 2
        times = float(special.ndtri(level) if self.known_sigma else special.stdtrit(max(self.dof, 1), level))
        middle, half = self.estimate[shown], times * self.std[shown]
        return middle - half, middle + half

    def intervals(self, confidence: float = USUAL) -> dict[str, tuple[float, float]]:
        """Return the interval of every unknown by name."""
        return Entries({name: self.interval(name, confidence) for name in self.names}, "intervals")

    def contains(self, values: Mapping[Any, float | str], confidence: float = USUAL) -> bool:
        """Return whether values of all unknowns lie in their joint region, the ellipsoid δᵀ C⁻¹ δ ≤ quantile.

        The quantile is n F(n, dof), or χ²(n) if ``sigma`` was given. Raises `RunError` if a name is missing, or if an
        unknown is not determined.
        """
        given = {
            name: number(value, f"the value of '{name}'", self._dimension(name))
            for name, value in by_key(values, "values").items()
        }
        if missing := [name for name in self.names if name not in given]:
            raise RunError(f"there is no value of '{missing[0]}'", fix="give one for every unknown", code="E401")
        if not np.isfinite(self.covariance).all() or self.at_bound:
            raise RunError("an unknown is not determined, so that there is no joint region", code="E501")
        n = len(self.names)
        away = np.array([self.estimate[name] - given[name] for name in self.names])
        size = np.sqrt(np.diag(self.covariance))
        far = float((away / size) @ np.linalg.solve(self.correlation, away / size))
        level = _checked(confidence)
        most = (
            2 * special.gammaincinv(n / 2, level) if self.known_sigma else n * special.fdtri(n, max(self.dof, 1), level)
        )
        return far <= float(most)

    def _dimension(self, name: str) -> Dim | None:
        """The dimension of an unknown, None where it is not known."""
        own = self.units.get(name)
        return Dim(unit_dimension(own)) if own else None

    def report(self) -> Report[Model]:
        """Return the report: the estimates with their intervals, what is not determined, and the residuals."""
        return fit_report(self)

    def __repr__(self) -> str:
        """Name the estimates."""
        shown = ", ".join(f"{n} = {self.estimate[n]:.6g} ± {self.std[n]:.2g}" for n in self.names)
        failed = "" if self.success else f"; FAILED: {self.message}"
        failed += "".join(f"; {c.what}: DOES NOT HOLD" for c in self.checks if c.holds is False)
        return f"<Fit {self.model.name!r}: {shown}{failed}>"


def _checked(confidence: float) -> float:
    if isinstance(confidence, bool) or not isinstance(confidence, (int, float)) or not 0 < confidence < 1:
        raise RunError(
            f"a confidence is a number between 0 and 1 (got {confidence!r:.30})", fix="such as 0.95", code="E501"
        )
    return float(confidence)


def fit_report(fit: Fit) -> Report[Model]:
    """The report of a fit."""
    header = (text("unknown"), text("estimate"), text("standard deviation"), text("95 % interval"), text("unit"))
    rows = []
    for name in fit.names:
        low, high = fit.interval(name)
        shown = (figure(fit.std[name]), f"{figure(low)} … {figure(high)}")
        if name in fit.at_bound:
            shown = ("on a bound", "")
        elif not np.isfinite(fit.std[name]):
            shown = ("not determined", "")
        cells = (figure(fit.estimate[name]), *shown)
        own = text(Verbatim(unit(fit.units.get(name, ""))))
        rows.append((lettered(fit.model, name), *(text(cell) for cell in cells), own))
    items: list[Item] = [Table(header, tuple(rows))]
    items += [text(Verbatim(f"Not determined: {x}.")) for x in fit.undetermined]
    end = "" if fit.success else f"The search did not end at a minimum: {fit.message}."
    parts = [Part(text("The estimate"), (*items, *([text(end)] if end else []))), _left_over(fit)]
    parts += [Part(text("What was checked"), (), fit.checks)] if fit.checks else []
    return Report(f"{fit.model.name}: fit of {', '.join(fit.names)}", fit.model, tuple(parts), _data(fit))


def _left_over(fit: Fit) -> Part:
    """The section on residuals."""
    given = "given" if fit.known_sigma else "estimated"
    rows = []
    for name, sigma in fit.sigma.items():
        found = np.concatenate([run[name] for run in fit.residuals])
        count, missing = int(np.isfinite(found).sum()), int(np.isnan(found).sum())
        largest = float(np.nanmax(np.abs(found)))
        figures = (str(count), str(missing), figure(sigma), figure(largest), figure(fit.ranges.get(name, np.nan)))
        rows.append((text(Verbatim(name)), *(text(x) for x in figures)))
    header = ("column", "samples", "missing", f"σ, {given}", "largest residual", "range of the data")
    if fit.known_sigma:
        said = f"χ² = {figure(fit.chi2)} with {fit.dof} degrees of freedom."
    else:
        said = (
            "σ was estimated from these residuals, so χ² equals the degrees of freedom whatever the fit is like: it "
            "says nothing of it. If the σ of the measurement were given, as sigma, it would."
        )
    uneven = [text(Verbatim(words)) for name in fit.sigma if (words := _not_random(fit, name))]
    return Part(text("Model minus data"), (Table(tuple(map(text, header)), tuple(rows)), text(said), *uneven))


def _not_random(fit: Fit, name: str) -> str:
    """What the test of Wald and Wolfowitz finds: residuals that keep their sign for longer than noise does."""
    stretches, expected, variance = 0, 0.0, 0.0
    for run in fit.residuals:
        signs = run[name][np.isfinite(run[name]) & (run[name] != 0)] > 0
        n, up = len(signs), int(signs.sum())
        if n < 2 or up in (0, n):
            stretches, expected = stretches + (n > 0), expected + n / 2
            variance += n / 4
            continue
        mean = 2 * up * (n - up) / n + 1
        stretches, expected = stretches + 1 + int((signs[1:] != signs[:-1]).sum()), expected + mean
        variance += (mean - 1) * (mean - 2) / (n - 1)
    rounding = ROUNDING * fit.ranges.get(name, 0.0)
    if fit.sigma[name] <= rounding or not expected - stretches > UNLIKELY * variance**0.5 > 0:
        return ""
    return (
        f"The residuals of {name} are not random: they keep their sign in {stretches} stretches, where noise has about "
        f"{expected:.0f}. The model misses something, or an input or a start was not as it is given (inputs that are "
        "not given are 0); the deviations above are then too small."
    )


def _data(fit: Fit) -> dict[str, Any]:
    return {
        "system": fit.model.name,
        "unknowns": list(fit.names),
        "estimate": {name: fit.estimate[name] for name in fit.names},
        "std": {name: or_none(fit.std[name]) for name in fit.names},
        "interval": {name: [or_none(x) for x in fit.interval(name)] for name in fit.names},
        "correlation": [[or_none(x) for x in row] for row in fit.correlation.tolist()],
        "sigma": {name: fit.sigma[name] for name in fit.sigma},
        "undetermined": [{"names": list(x.names), "proportions": list(x.proportions)} for x in fit.undetermined],
        "at_bound": list(fit.at_bound),
        "chi2": fit.chi2,
        "dof": fit.dof,
        "success": fit.success,
        "message": fit.message,
        "checks": checks_data(fit.checks),
    }


def residuals_of(away: Sequence[Array], places: Sequence[NDArray[np.int64]], length: int) -> list[Array]:
    """Residuals on all times of a run, NaN where nothing was measured."""
    found = []
    for values, at in zip(away, places, strict=True):
        full = np.full(length, np.nan)
        full[at] = values
        found.append(full)
    return found
