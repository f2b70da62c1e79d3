"""Reactions of joints as outputs of ensembles, against those of single runs."""

import numpy as np
import pytest

import lagrangian as lg


def arm():
    """Two links, the second one closed to the ground by a rod."""
    s = lg.System("arm")
    q1, q2 = s.coordinates("q1 q2")
    m = s.parameters("m", m=2)
    upper = s.frame(q1, name="upper")
    s.rigid_body(m, 0.2, at=upper.point(0.5, 0), frame=upper, name="rod 1")
    B = upper.point(1, 0, name="B")
    lower = s.frame(q2, origin=B, name="lower")
    s.rigid_body(1, 0.1, at=lower.point(0.4, 0), frame=lower, name="rod 2")
    end = lower.point(0.8, 0, name="end")
    s.gravity()
    s.constraint(between=(end, s.origin + (1.5, 0.2)), distance=0.5, name="link")
    return s


@pytest.mark.slow
def test_outputs_of_an_ensemble_are_the_reactions_of_its_runs():
    """|F| and components in a joint of the tree and of a constraint, reduced and as samples."""
    s, masses = arm(), [1.0, 2.0]
    asked = ["max reaction B", "mean reaction B.y", "min reaction link.x", "max reaction origin.torque"]
    start = {"q1": 0.4, "q2": -0.6}
    runs = s.ensemble(0.2, params={"m": masses}, initial=start, fixed="q1", outputs=asked, times=101)
    whole = s.ensemble(
        0.2, params={"m": masses}, initial=start, fixed="q1", outputs="reaction link", reduce=None, times=101
    )
    for k, mass in enumerate(masses):
        run = s.simulate(0.2, params={"m": mass}, initial=start, fixed="q1", samples=101)
        B, link, base = (run.reaction(name) for name in ("B", "link", "origin"))
        assert runs["max reaction B"][k] == pytest.approx(np.linalg.norm(B.force, axis=1).max(), rel=1e-6)
        y = B.force[:, 1]
        mean = ((y[1:] + y[:-1]) / 2 @ np.diff(run.t)) / 0.2
        assert runs["mean reaction B.y"][k] == pytest.approx(mean, rel=1e-6)
        assert runs["min reaction link.x"][k] == pytest.approx(link.force[:, 0].min(), rel=1e-6)
        assert runs["max reaction origin.torque"][k] == pytest.approx(base.torque.max(), abs=1e-6)
        assert whole["reaction link"][k] == pytest.approx(np.linalg.norm(link.force, axis=1), rel=1e-6)


@pytest.mark.slow
def test_reactions_of_a_run_are_entries_and_curves():
    run = arm().simulate(0.2, q1=0.4, q2=-0.6, fixed="q1", samples=11)
    pin = run.reaction("B")
    assert run["reaction B"] == pytest.approx(np.hypot(*pin.force.T), abs=1e-12)
    assert run["reaction B.y"] == pytest.approx(pin.force[:, 1], abs=1e-12)
    assert run["reaction B.torque"] == pytest.approx(pin.torque, abs=1e-12)
    figure = run.plot("reaction B", "reaction B.x", "reaction B.torque")
    assert [ax.get_ylabel().rpartition(" [")[2] for ax in figure.axes] == ["N]", "N m]"]
    curves = [line.get_ydata() for line in figure.axes[0].get_lines() if len(line.get_ydata()) == 11]
    assert any(np.array_equal(curve, run["reaction B.x"]) for curve in curves)
    with pytest.raises(lg.Error, match="'C'"):
        run.plot("reaction C")


def test_what_is_no_joint_is_refused():
    with pytest.raises(lg.Error, match="E4"):
        arm().ensemble(0.1, q1=[0.1, 0.2], outputs="max reaction C")
