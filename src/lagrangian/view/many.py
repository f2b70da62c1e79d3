"""Results of many runs as a figure: a panel a result, drawn by how many axes vary.

samples alone            a histogram
one axis                 a curve; with samples their median, and the band that holds nine of ten
two axes                 a map in colours; with samples, or further axes, of the median along those
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.records import dataclass
from lagrangian.view.plots import _raised, _safe, new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]

WIDTH, HEIGHT, LEAST = 6.4, 2.4, 3.6
BAND = (0.05, 0.95)
"""The quantiles that bound the band."""

MOST_PANELS = 12


@dataclass(frozen=True, eq=False)
class SweptAxis:
    """An axis of a sweep: its name, its unit, and the values."""

    label: str
    unit: str
    values: Array


@dataclass(frozen=True, eq=False)
class SweptResult:
    """A result over the axes and, if there are samples, over these as the last axis; NaN if a run failed."""

    label: str
    unit: str
    values: Array


def draw_many(
    title: str, axes: tuple[SweptAxis, ...], results: tuple[SweptResult, ...], *, failed: str = "", shown: bool = False
) -> Figure:
    """Return the figure with at most `MOST_PANELS` results. ``failed`` is a sentence with the number of failed runs, if
    any.

    Failed runs are marked by red crosses, in maps and below curves.
    """
    kept = results[:MOST_PANELS]
    height = max(LEAST, HEIGHT * len(kept) + 0.7) if len(axes) < 2 else (HEIGHT + 1.2) * len(kept) + 0.7
    figure = new_figure((WIDTH, height), shown=shown)
    rows: Any = figure.subplots(len(kept), 1, squeeze=False)[:, 0]
    for place, result in zip(rows, kept, strict=True):
        _panel(figure, place, axes, result)
    dropped = [a.label for a in axes[2:]]
    notes = [title, *([f"median over {', '.join(dropped)}"] if dropped else [])]
    if len(results) > len(kept):
        notes.append(f"{len(kept)} of {len(results)} results")
    figure.suptitle(_safe("; ".join(notes)), fontsize="medium")
    if failed:
        figure.suptitle(_safe("; ".join(notes) + f"\n{failed}"), fontsize="medium", color="C3")
    return figure


def _panel(figure: Any, place: Any, axes: tuple[SweptAxis, ...], result: SweptResult) -> None:
    for side in ("top", "right"):
        place.spines[side].set_visible(False)
    if not np.isfinite(result.values).any():
        place.text(0.5, 0.5, "every run failed", ha="center", va="center", transform=place.transAxes)
        place.set_ylabel(_named(result))
    elif not axes:
        _histogram(place, result)
    elif len(axes) == 1:
        _curve(place, axes[0], result)
    else:
        _map(figure, place, axes[0], axes[1], result)


def _named(thing: SweptAxis | SweptResult) -> str:
    return _safe(thing.label) + (f" [{_raised(thing.unit)}]" if thing.unit not in ("", "1") else "")


def _histogram(place: Any, result: SweptResult) -> None:
    values = result.values[np.isfinite(result.values)]
    bins = int(np.clip(np.sqrt(values.size), 5, 100))
    place.hist(values, bins=bins, color="C0", edgecolor="white", linewidth=0.4)
    middle, (low, high) = float(np.median(values)), np.quantile(values, BAND)
    place.axvline(middle, color="0.2", linewidth=1.0, label=f"median {middle:.4g}")
    place.axvspan(low, high, color="0.5", alpha=0.15, linewidth=0, label=f"nine of ten: {low:.4g} … {high:.4g}")
    place.legend(frameon=False, fontsize="small")
    place.set_xlabel(_named(result))
    place.set_ylabel("runs")


def _curve(place: Any, along: SweptAxis, result: SweptResult) -> None:
    order = np.argsort(along.values, kind="stable")
    x, y = along.values[order], result.values[order]
    style = "-" if len(x) > 30 else ".-" if len(x) > 1 else "o"
    if y.ndim == 1:
        place.plot(x, y, style, linewidth=1.3)
    else:
        low, middle, high = _quantiles(y, (BAND[0], 0.5, BAND[1]))
        place.fill_between(x, low, high, color="C0", alpha=0.25, linewidth=0, label="nine of ten")
        place.plot(x, middle, style, color="C0", linewidth=1.3, label="median")
        place.legend(frameon=False, fontsize="small")
    lost = ~np.isfinite(y).reshape(len(x), -1).all(axis=1)
    if lost.any():
        foot = place.get_xaxis_transform()
        place.plot(x[lost], np.zeros(int(lost.sum())), "x", color="C3", transform=foot, clip_on=False, label="failed")
        place.legend(frameon=False, fontsize="small")
    if _geometric(x):
        place.set_xscale("log")
    place.set_xlabel(_named(along))
    place.set_ylabel(_named(result))
    place.grid(True, color="0.9", linewidth=0.6)


def _map(figure: Any, place: Any, across: SweptAxis, up: SweptAxis, result: SweptResult) -> None:
    values = result.values
    if values.ndim > 2:
        values = _quantiles(values.reshape(*values.shape[:2], -1), (0.5,))[0]
    i, k = np.argsort(across.values, kind="stable"), np.argsort(up.values, kind="stable")
    mesh = place.pcolormesh(
        across.values[i], up.values[k], values[np.ix_(i, k)].T, shading="nearest", cmap="viridis", rasterized=True
    )
    figure.colorbar(mesh, ax=place, label=_named(result))
    at = np.argwhere(~np.isfinite(values))
    if len(at):
        place.plot(across.values[at[:, 0]], up.values[at[:, 1]], "x", color="C3", label="failed")
    for set_scale, along in ((place.set_xscale, across), (place.set_yscale, up)):
        if _geometric(np.sort(along.values)):
            set_scale("log")
    place.set_xlabel(_named(across))
    place.set_ylabel(_named(up))


def _quantiles(y: Array, shares: tuple[float, ...]) -> Array:
    """Quantiles of the finite values along the last axis, with the quantiles on the first axis; NaN if there are
    none."""
    some = np.asarray(np.isfinite(y).any(axis=-1))
    filled = np.where(np.isfinite(y), y, np.nan)
    filled[~some] = 0.0  # NumPy warns about quantiles of no values
    return np.where(some, np.nanquantile(filled, shares, axis=-1), np.nan)


def _geometric(x: Array) -> bool:
    """Whether the logarithms of the values are spaced more evenly than the values."""
    if len(x) < 4 or x[0] <= 0:
        return False
    steps = np.diff(np.log(x))
    return bool(np.allclose(steps, steps[0], rtol=1e-6) and not np.allclose(np.diff(x), x[1] - x[0], rtol=0.1))
