"""Checks masses and inertias with the parameter values of a run, by the same rule as those in a file."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.codegen import Look
from lagrangian.errors import Notice
from lagrangian.integrate.fitness import MAX_SETS_IN_PYTHON, Fitness
from lagrangian.model import Model
from lagrangian.model.body_checks import ConstantValues, check_body


def check_masses(model: Model, p: NDArray[np.float64], varied: Iterable[str] = ()) -> tuple[Notice, ...]:
    """Return the notices for a system with the parameters ``p``; ``varied`` ones count as unknown.

    Raises `ModelError`, which names the body, if a mass is not positive or an inertia makes M indefinite.
    """
    unknown = set(varied)
    values = [None if q.name in unknown else float(x) for q, x in zip(model.parameters, p, strict=True)]
    if all(value is None or value == q.value for q, value in zip(model.parameters, values, strict=True)):
        return dynamics.notices(model)
    parameters = tuple(replace(q, value=x) for q, x in zip(model.parameters, values, strict=True))
    held = replace(model, parameters=parameters, _memo={"dependent rows": dynamics.dependent_rows(model)})
    numbers = ConstantValues.of_model(held)
    for body in held.bodies:
        check_body(numbers, body)
    return dynamics.notices(held)


def fitness(model: Model, varied: Iterable[str]) -> Fitness | None:
    """The check of parameter sets that differ in ``varied``; None if these do not affect a mass or an inertia."""
    bodies = dynamics.body_numbers(model, varied)
    if bodies is None:
        return None
    if not any(name.startswith("inertia") for name in bodies.outputs):
        return Fitness(bodies)
    return Fitness(bodies, dynamics.mass_matrix(model), np.array(list(dynamics.configurations(model))))


class Admission:
    """Refuses impossible parameter sets before anything is computed with them."""

    def __init__(self, model: Model, fitness: Fitness) -> None:
        self._model, self._fitness, self._seen = model, fitness, 0

    def __call__(self, p: NDArray[np.float64]) -> Look | None:
        """Check parameter sets (..., n_p); raise `ModelError`, which names the body, for the first impossible one.

        Return an object that checks single sets, for use after some sets have been checked.
        """
        rows, look = np.ascontiguousarray(p.reshape(-1, p.shape[-1])), None
        self._seen += len(rows)
        if self._seen > MAX_SETS_IN_PYTHON and len(rows):
            look = self._fitness.look
            if look is not None and look(rows) == 0:
                return look
        for k in np.flatnonzero(self._fitness.unfit(rows))[:1]:
            check_masses(self._model, rows[k])
        return look
