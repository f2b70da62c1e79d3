"""Texts that say of a joint's reaction on which side and in which axes it is: "B on rod 1 in axes of lower"."""

import numpy as np
import pytest

import lagrangian as lg
from lagrangian.model.joint_texts import AskedJoint, asked_joint

KNOWN = ("B", "rod 1", "front wheel", "front wheel on the ground")


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("B", AskedJoint("B")),
        ("B on rod 1", AskedJoint("B", "rod 1")),
        ("B in axes of lower", AskedJoint("B", None, "lower")),
        ("B on rod 1 in axes of lower", AskedJoint("B", "rod 1", "lower")),
        ("front wheel on the ground", AskedJoint("front wheel on the ground")),
        ("front wheel on the ground on fork", AskedJoint("front wheel on the ground", "fork")),
        ("front wheel on fork", AskedJoint("front wheel", "fork")),
        ("nothing on rod 1", AskedJoint("nothing on rod 1")),
        (" in axes of lower", AskedJoint("in axes of lower")),
    ],
)
def test_a_text_is_taken_apart_by_the_names_that_there_are(text: str, found: AskedJoint) -> None:
    assert asked_joint(text, KNOWN) == found


def pendulum() -> lg.System:
    """A mass on a massless rod; ``theta`` from the downward vertical."""
    s = lg.System("pendulum")
    theta = s.coordinate("theta")
    m, l, g = s.parameters("m l g", m="2 kg", l="0.5 m", g="9.81 m/s^2")
    rod = s.frame(theta, name="rod")
    s.particle(m, rod.point(0, -l), name="bob")
    s.gravity((0, -1), g)
    return s


def test_the_force_along_and_across_a_rod() -> None:
    """Along the rod the pivot pulls with m g cos θ + m l θ′² (Newton), and across it with nothing."""
    run = pendulum().simulate(1.0, theta=0.8, samples=51)
    theta, rate = run["theta"], run["theta'"]
    pull = 2.0 * 9.81 * np.cos(theta) + 2.0 * 0.5 * rate**2
    assert run["reaction origin in axes of rod.y"] == pytest.approx(pull, rel=1e-9)
    assert run["reaction origin in axes of rod.x"] == pytest.approx(0.0 * pull, abs=1e-9)
    assert run["reaction origin on ground in axes of rod.y"] == pytest.approx(-pull, rel=1e-9)
    assert run["reaction origin"] == pytest.approx(pull, rel=1e-9)


def test_tables_and_ensembles_take_such_texts() -> None:
    s = pendulum()
    run = s.simulate(0.5, theta=0.8, samples=11)
    run.reactions = ["origin on ground in axes of rod"]
    assert "reaction.origin on ground in axes of rod.y" in run.to_pandas().columns
    asked = "max reaction origin in axes of rod.y"
    runs = s.ensemble(0.5, theta=[0.8], outputs=[asked], times=201)
    whole = s.simulate(0.5, theta=0.8, samples=201)
    assert runs[asked][0] == pytest.approx(whole["reaction origin in axes of rod.y"].max(), rel=1e-6)


@pytest.mark.parametrize("text", ["origin on moon", "origin in axes of moon", "nowhere on bob"])
def test_what_there_is_not_is_refused_by_name(text: str) -> None:
    with pytest.raises(lg.ModelError, match=r"moon|nowhere"):
        pendulum().simulate(0.1).reaction(text)
