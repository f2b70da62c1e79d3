"""Copies of a system share nothing with it, however they are made."""

import copy
import pickle

import pytest

import lagrangian as lg
from lagrangian import ModelError, examples


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda s: pickle.loads(pickle.dumps(s))])
def test_what_is_added_to_a_copy_is_not_in_the_original(copied) -> None:
    system = lg.loads(examples.text("pendulum"))
    equations = system.derive().equations
    twin = copied(system)
    twin.parameter("k", 3.0)
    twin.potential(twin["k"] * twin["theta"] ** 2 / 2)
    with pytest.raises(ModelError, match="nothing is named 'k'"):
        system["k"]
    system.parameter("c", 1.0)
    with pytest.raises(ModelError, match="nothing is named 'c'"):
        twin["c"]
    assert system.derive().equations == equations
    assert twin.derive().equations != equations


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy])
def test_a_copy_checks_its_own_points_and_frames(copied) -> None:
    """Points and frames found right are remembered by identity; a copy has others."""
    system = lg.loads(examples.text("acrobot"))
    _ = system.model
    twin = copied(system)
    kept = twin._builder._checked
    assert kept and all(key == id(thing) and thing.owner is twin._builder for key, thing in kept.items())
    with pytest.raises(ModelError, match="belongs to another system"):
        twin.particle(1, at=system["elbow"])
    twin.particle(1, at=twin["elbow"])
    assert len(twin.model.elements) == len(system.model.elements) + 1


@pytest.mark.parametrize("wanted", [slice(1, 2), ["theta"], 3, None])
def test_what_is_looked_up_is_a_name(wanted) -> None:
    with pytest.raises(ModelError, match="takes a name"):
        lg.loads(examples.text("pendulum"))[wanted]
