"""Plots quantities over time as stacked panels with a common time axis.

The `Figure` is returned. One that is ``shown`` belongs to pyplot: ``plt.show()`` opens it, and notebooks show it once.
Any other leaves matplotlib's global state unchanged.
"""

from __future__ import annotations

import importlib
import io
import re
import sys
import textwrap
import threading
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import MissingExtra
from lagrangian.records import dataclass, field

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]

WIDTH, HEIGHT, LEAST = 7.2, 1.9, 3.2
"""In inches: the width of the figure, the height of a panel, and the smallest height of a figure."""

_SUPERSCRIPTS = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")

WRAP = 80
"""The largest number of characters in a line of the title."""

IN_LEGEND = 8
"""The largest number of curves in one column of a legend."""


@dataclass(frozen=True, eq=False)
class Series:
    """A curve: its label as LaTeX (``tex``) and as text, and its values at the times of the figure."""

    tex: str
    text: str
    values: Array
    style: str = "-"


@dataclass(frozen=True, eq=False)
class Panel:
    """Curves of the same unit; ``what`` is their common meaning, such as "angle"."""

    what: str
    unit: str
    series: tuple[Series, ...]


@dataclass(frozen=True, eq=False)
class Marks:
    """Times that are marked by thin lines through all panels: events."""

    label: str
    times: Array


@dataclass(frozen=True, eq=False)
class Plotted:
    """The content of a figure."""

    title: str
    t: Array
    panels: tuple[Panel, ...]
    marks: tuple[Marks, ...] = field(default_factory=tuple)
    footer: str = ""
    failure: str = ""


def draw(picture: Plotted, *, shown: bool = False) -> Figure:
    """Draw the figure: panels below each other, labels with units, legends in panels with several curves.

    A failed run is marked by a cross at the end of every curve, and by the reason in red.
    """
    height = max(LEAST, HEIGHT * len(picture.panels) + 0.7)
    figure = new_figure((WIDTH, height), shown=shown)
    rows: Any = figure.subplots(len(picture.panels), 1, sharex=True, squeeze=False)[:, 0]
    for axes, panel in zip(rows, picture.panels, strict=True):
        _panel(axes, picture.t, panel)
        for number, marks in enumerate(picture.marks):
            for time in marks.times:
                axes.axvline(time, color="0.55", linewidth=0.7, linestyle=("--", ":", "-.")[number % 3], zorder=0)
        if picture.failure:
            for s in panel.series:
                axes.plot(
                    picture.t[-1:], s.values[-1:], "x", color="C3", markersize=8, markeredgewidth=2, clip_on=False
                )
    if len(picture.t) > 1:
        rows[-1].set_xlim(picture.t[0], picture.t[-1])
    rows[-1].set_xlabel(r"$t$ [s]")
    figure.suptitle(_safe(picture.title), fontsize="medium")
    if picture.failure:
        words = textwrap.fill(f"FAILED: {picture.failure}", WRAP)
        figure.suptitle(f"{_safe(picture.title)}\n{_safe(words)}", fontsize="medium", color="C3")
    if picture.footer:
        figure.supxlabel(_safe(picture.footer), fontsize="x-small", color="0.4", x=0.99, ha="right")
    return figure


def _panel(axes: Any, t: Array, panel: Panel) -> None:
    unit = f" [{_raised(panel.unit)}]" if panel.unit else ""
    names = [_math(s) for s in panel.series]
    for s, name in zip(panel.series, names, strict=True):
        axes.plot(t, s.values, s.style if len(t) > 1 else "o", label=name, linewidth=1.3)
    if len(names) == 1:
        axes.set_ylabel(names[0] + unit)
    else:
        axes.set_ylabel(_safe(panel.what) + unit if panel.what else unit.strip() or "value")
        columns = 1 + (len(names) - 1) // IN_LEGEND
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, ncols=columns, fontsize="small")
    axes.grid(True, color="0.9", linewidth=0.6)
    axes.margins(y=0.08)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    axes.ticklabel_format(axis="y", scilimits=(-4, 5), useMathText=True)
    spread = max((float(np.ptp(s.values)) for s in panel.series if len(s.values)), default=0.0)
    middle = max((float(np.max(np.abs(s.values))) for s in panel.series if len(s.values)), default=0.0)
    if spread <= 1e-9 * middle:  # a constant is drawn as a straight line, without its rounding errors
        axes.set_ylim(-1.2 * middle, 1.2 * middle) if middle else axes.set_ylim(-1.0, 1.0)


def _math(series: Series) -> str:
    """A label that matplotlib can typeset: its LaTeX, or its text if it contains LaTeX that matplotlib does not
    know."""
    from matplotlib.mathtext import MathTextParser

    written = f"${series.tex}$"
    try:
        MathTextParser("agg").parse(written)
    except ValueError:
        return _safe(series.text)
    return written


def _raised(unit: str) -> str:
    """A unit with its exponents raised: m^2 → m²."""
    return re.sub(r"\^(-?\d+)", lambda m: m.group(1).translate(_SUPERSCRIPTS), unit)


def _safe(text: str) -> str:
    """Escape text so that matplotlib finds no mathematics in it."""
    return text.replace("$", r"\$")


def new_figure(size: tuple[float, float], *, shown: bool) -> Figure:
    """Make an empty figure; if it is to be ``shown``, and in the main thread, it belongs to pyplot.

    Only one setting is changed and put back: ``plt.rc_context`` would also put back that the first figure in a notebook
    makes pyplot interactive, and no later figure would be shown.
    """
    figure_class = _figure_class()
    if not shown or threading.current_thread() is not threading.main_thread():
        return figure_class(figsize=size, layout="constrained")
    plt = importlib.import_module("matplotlib.pyplot")
    settings, key = plt.rcParams, "figure.max_open_warning"
    limit, settings[key] = settings[key], 0
    try:
        return plt.figure(figsize=size, layout="constrained", FigureClass=figure_class)
    finally:
        settings[key] = limit


def _figure_class() -> type[Figure]:
    """A `Figure` that notebooks show by themselves, once."""
    try:
        base = importlib.import_module("matplotlib.figure").Figure
    except ImportError:
        raise MissingExtra(
            "plots need the package 'matplotlib'", fix="pip install 'lagrangian[plot]'", code="E801"
        ) from None
    return type("Figure", (base,), {"_repr_png_": _png, "_ipython_display_": _shown_once})


def _shown_once(figure: Any) -> None:
    """Remove the figure from those that a notebook shows at the end of its cell, because it is being shown now."""
    matplotlib, plt = sys.modules["matplotlib"], sys.modules.get("matplotlib.pyplot")
    if plt is not None and "inline" in matplotlib.get_backend().lower():
        plt.close(figure)
    raise NotImplementedError  # IPython's signal to show the object in the usual way


def _png(figure: Any) -> bytes:
    out = io.BytesIO()
    figure.savefig(out, format="png", dpi=110)
    return out.getvalue()


def joined(panels: Sequence[Panel]) -> tuple[Panel, ...]:
    """Combine panels of the same unit and meaning, in the order of the first of each."""
    found: dict[tuple[str, str], Panel] = {}
    for panel in panels:
        key = (panel.what, panel.unit)
        before = found[key].series if key in found else ()
        found[key] = Panel(panel.what, panel.unit, (*before, *panel.series))
    return tuple(found.values())
