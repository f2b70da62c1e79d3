"""Ensembles that are joined again are the ensemble that they are parts of."""

import numpy as np
import pytest

import built_in
from lagrangian.simulate.joining import joined

KS, XS = np.linspace(20.0, 60.0, 7), np.linspace(0.1, 0.4, 3)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("cuts", [[3], [1, 2], [1, 2, 3, 4, 5, 6]], ids=str)
@pytest.mark.parametrize("other", [{}, {"x2r": XS}], ids=["curve", "map"])
def test_parts_along_the_first_axis_make_the_whole(cuts: list[int], other: dict[str, np.ndarray]) -> None:
    system = built_in.system("lecture-3b")
    outputs = {"far": "max x2r", "end": "final x1"}
    whole = system.sweep(1.0, {"k": KS, **other}, outputs=outputs)
    made = joined([system.sweep(1.0, {"k": part, **other}, outputs=outputs) for part in np.split(KS, cuts)])
    assert made.dims == whole.dims
    assert made.shape == whole.shape
    assert list(made) == list(whole)
    for name in whole:
        assert np.array_equal(made[name], whole[name])
        assert made.words_of(name) == whole.words_of(name)
    for name, (dims, values) in whole.coordinates.items():
        assert made.coordinates[name][0] == dims
        assert np.array_equal(made.coordinates[name][1], values)
    place = (2, *(1 for _ in other))
    assert made.at(place) == whole.at(place)
