"""Where a run begins in another program: the state, inputs and parameters of the model file."""

from __future__ import annotations

from lagrangian.export.programs import program_of
from lagrangian.model import Model
from lagrangian.records import dataclass


@dataclass(frozen=True)
class Start:
    """x = [q; v] and t at the start, inputs and parameters in declared order, and the duration of a run [s].

    ``driven`` names inputs that the model file gives as functions of time or of the state: an export leaves inputs to
    the program that calls it, so ``u`` is 0 for them.
    """

    x: tuple[float, ...]
    u: tuple[float, ...]
    p: tuple[float, ...]
    t: float
    duration: float
    driven: tuple[str, ...]


def start_of(model: Model) -> Start:
    """Return the start of a model, which satisfies its constraints.

    Raises `ModelError` or `RunError` for a parameter without a value, and for constraints that cannot be satisfied;
    `MissingExtra` without LLVM, which the rooms of runs need.
    """
    from lagrangian.simulate.inputs import driving
    from lagrangian.simulate.settings import RunSettings
    from lagrangian.simulate.simulation import initial_state, named
    from lagrangian.simulate.starts import held, onto_constraints
    from lagrangian.values.values import Given

    settings = RunSettings()
    given = Given.of(model, named(model))
    p = given.parameter_values(None)
    guess = initial_state(given, model, program_of(model, "rhs"), model.settings.get("initial", {}), None, {})
    t = float(settings.start)
    x, _ = onto_constraints(model, guess, p, t, held(model, None))
    drive = driving(model, None, model.settings.get("inputs", {}))
    values = {u.name: s for u, s in zip(drive.free, drive.sources, strict=True) if isinstance(s, (int, float))}
    u = tuple(float(values.get(u.name, 0.0)) for u in model.inputs)
    driven = tuple(u.name for u in model.inputs if u.name not in values)
    duration = 10.0
    if model.settings.get("duration") is not None:
        times = RunSettings(samples=2).instants(model, 1)
        duration = float(times[-1] - times[0]) or 10.0
    return Start(tuple(map(float, x)), u, tuple(map(float, p)), t, duration, driven)
