"""The class `Trajectory`: a run returned by `system.simulate`, with its tables and plots."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from lagrangian.errors import RunError
from lagrangian.records import dataclass
from lagrangian.simulate import plot
from lagrangian.simulate.recorded import Recorded
from lagrangian.viewed import cut
from lagrangian.write import tables

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    import pandas
    import xarray
    from matplotlib.figure import Figure

    from lagrangian.simulate.animating import Pictured
    from lagrangian.simulate.animation import Animation
    from lagrangian.simulate.sensitivities import Sensitivities


@dataclass(eq=False)
class Trajectory(Recorded):
    """A run of a system, with the same fields as the results of SciPy's solvers, and quantities by name.

    ``t`` (S,) are the times [s], ``y`` (n_states, S) the states x = [q; v] in declared order, ``states`` their names.
    ``run["theta1"]``, ``run["theta1'"]``, ``run["theta1''"]`` and ``run[expression]`` are arrays (S,), in SI units.
    ``success`` says whether the run reached its end (or a terminal event), and ``message`` how it ended; a run that
    failed contains the results up to that time. ``notices`` are those of the system with these parameters. ``drift`` is
    how far it was from its constraints (None without any), ``nfev`` the number of evaluations of the right-hand side,
    ``method`` the integration method. ``reactions`` names the joints whose reactions are in tables; it can be set.
    """

    def to_xarray(self) -> xarray.Dataset:
        """Return an `xarray.Dataset` over ``t``: states, inputs, energies, points; units as attributes."""
        return tables.to_xarray(plot.table(self))

    def to_pandas(self) -> pandas.DataFrame:
        """Return a `pandas.DataFrame` indexed by ``t`` with the same columns."""
        return tables.to_pandas(plot.table(self))

    def to_csv(self) -> str:
        """Return the same columns as CSV text: a line of names, then a line for each sample."""
        return tables.to_csv(plot.table(self))

    def save(self, path: str | Path, *, overwrite: bool = False) -> Path:
        """Write the run to a ``.csv``, ``.nc`` (NetCDF), ``.parquet`` or ``.npz`` file, completely or not at all.

        Raises `Error` if the file exists, unless ``overwrite``, or if it cannot be written.
        """
        return tables.save(plot.table(self), path, overwrite=overwrite)

    def plot(self, *quantities: Any, energy: bool | None = None, audit: bool = False) -> Figure:
        """Return a pyplot figure of ``quantities`` (names, text or SymPy expressions) over time.

        By default it shows the coordinates, the inputs that are not 0, ``reactions`` and energies. ``energy`` adds or
        omits the energies; ``audit`` adds the error of their balance. Angles are in degrees, large ones in turns.
        A failed run is marked by crosses at its end, with the reason. Notebooks show the figure, ``plt.show()`` opens
        it, and ``run.plot().savefig("run.png")`` writes it.
        """
        return plot.plot(self, quantities, energy=energy, audit=audit, shown=True)

    def figure(self, *quantities: Any, energy: bool | None = None, audit: bool = False) -> Figure:
        """Return the same figure as `plot` without using pyplot, for programs, threads and servers."""
        return plot.plot(self, quantities, energy=energy, audit=audit)

    def animate(
        self,
        *,
        speed: float | None = None,
        trail: Sequence[Any] | None = None,
        fps: float = 25.0,
        width: float | None = None,
        look: Pictured | None = None,
    ) -> Animation:
        """Return the run as an `Animation`, which shows itself in notebooks and is saved to a file.

        ``speed`` is how many seconds of the run are shown in a second; by default 1, but for runs of less than 2 s or
        more than 30 s, and the picture says so. ``trail`` names points whose paths are drawn, by default those of the
        model file. ``fps`` is the number of frames a second, ``width`` [px] is how wide it is. ``look`` is the picture
        that moves, by default ``system.look()``. The frame holds the whole motion. Raises `RunError` if the samples of
        the run are too far apart, and `ModelError` for an unknown point.
        """
        from lagrangian.simulate.animating import animate

        return animate(self, speed=speed, trail=trail, fps=fps, width=width, look=look)

    def sensitivities(self, wrt: Any = None) -> Sensitivities:
        """Return how the run changes with parameters, initial values and inputs, as `lagrangian.Sensitivities`.

        >>> from lagrangian import example
        >>> run = example("pendulum").simulate(2.0, theta=0.5)
        >>> run.sensitivities(["L", "theta"])["theta"].shape
        (1001, 2)

        The variational equations δẋ = ∂f/∂x δx + ∂f/∂p are integrated together with the run, to its tolerances, with
        the jumps that events cause. ``wrt`` names parameters, states (for their initial values) and inputs: one that is
        constant changes at all times, a table has one column for each of its values. By default all parameters. Raises
        `RunError` for unknown names, for systems with constraints, for inputs that are Python functions and for
        accelerations that jump with the state; `ModelError` for dry friction.
        """
        from lagrangian.simulate.sensitivities import sensitivities

        return sensitivities(self, wrt)

    def _repr_html_(self) -> str:
        from lagrangian.write.views import table_view

        words = [f"{self.method}, {self.steps} steps, {len(self.t)} samples", self.message, *map(str, self.notices)]
        if len(self.t):
            words[0] = f"t = {self.t[0]:g} … {self.t[-1]:g} s; {words[0]}; {self.audit}"
        header = ("quantity", "start", "end", "least", "greatest", "unit")
        rows = [(c.name, *(f"{x:.6g}" for x in plot.extremes(c.values)), c.unit) for c in plot.table(self).columns]
        return table_view(self.model.name, words, header, rows if len(self.t) else [])

    # -- showing ------------------------------------------------------------------------------------------------

    def __repr__(self) -> str:
        """Summarize the run: the time, the method, and how well its energy is balanced."""
        span = f"t = {self.t[0]:g} … {self.t[-1]:g} s" if len(self.t) else "nothing"
        end = "" if self.success else f"; FAILED: {self.message}"
        try:
            audit = (self.success and self.audit.missed) or str(self.audit)
        except RunError as trouble:  # an energy that is not finite somewhere must not hide the run
            audit = f"no energy balance: {trouble.what}"
        return cut(
            f"<Trajectory {self.model.name!r}: {span}, {len(self.t)} samples, {self.method}, {self.steps} steps, "
            f"{audit}{end}{''.join(f'; notice {n}' for n in self.notices)}>"
        )
