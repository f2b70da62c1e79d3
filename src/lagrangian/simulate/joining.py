"""Joins ensembles that were computed one after another to the one that they are parts of."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lagrangian.simulate.ensemble import Ensemble


def joined(parts: Sequence[Ensemble]) -> Ensemble:
    """Return the ensemble of which ``parts`` are pieces along its first axis, in their order.

    The parts must be runs of the same system, for the same outputs, that differ only in the values along this axis.
    """
    first = parts[0]
    axis = first.dims[0]
    arrays = {
        name: np.concatenate([part[name] for part in parts]) if first.axes_of(name)[:1] == (axis,) else first[name]
        for name in first
    }
    coordinates = dict(first.coordinates)
    for name, (dims, values) in first.coordinates.items():
        if dims[:1] == (axis,) or (name == axis and not dims):  # of a single value, the axis is left out
            found = np.concatenate([np.atleast_1d(part.coordinates[name][1]) for part in parts])
            coordinates[name] = (dims or (axis,), found)
        elif axis in dims:
            raise ValueError(f"{name} varies along {axis}, but not first")
        else:
            coordinates[name] = (dims, values)
    notices = tuple(dict.fromkeys(notice for part in parts for notice in part.notices))
    dims = {name: first.axes_of(name) for name in first}
    words = {name: first.words_of(name) for name in (*first, *first.coordinates)}
    return Ensemble(first.name, arrays, dims, coordinates, words, first.settings, notices)
