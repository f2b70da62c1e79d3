"""Runs of systems with constraints: every state satisfies them, and what a run says of that."""

import numpy as np
import pytest
import sympy as sp
from scipy.special import ellipj

import lagrangian as lg
from lagrangian.integrate import RunStatus

G = 9.81


def rod():
    """A pendulum in x and y on a rod of length 1."""
    s = lg.System("rod")
    g, m, l = s.parameter("g", G), s.parameter("m", 2.0), s.parameter("l", 1.0)
    x, y = s.coordinate("x"), s.coordinate("y")
    s.particle(m, at=s.origin + (x, y), name="bob")
    s.gravity((0, -1), g)
    s.constraint(x**2 + y**2 - l**2, name="rod")
    return s


def parallelogram():
    """Two cranks of length 1 and a coupler of length 2, which can turn over where it lies flat."""
    s = lg.System("parallelogram")
    g, l = s.parameter("g", G), s.parameter("l", 1.0)
    a, b, c = (s.coordinate(n) for n in "abc")
    P = s.origin + (l * sp.cos(a), l * sp.sin(a))
    Q = P + (2 * l * sp.cos(b), 2 * l * sp.sin(b))
    R = s.origin + (2 * l + l * sp.cos(c), l * sp.sin(c))
    for k, point in enumerate((P, Q, R)):
        s.particle(1.0, at=point, name=f"p{k}")
    s.gravity((0, -1), g)
    s.constraint(between=(Q, R), name="coupler")
    return s


SYSTEM = rod()
RELEASED = {"x": 1.0, "y": 0.0}


def off(run):
    return abs(np.hypot(run["x"], run["y"]) - 1).max(), abs(run["x"] * run["x'"] + run["y"] * run["y'"]).max()


def angle(t):
    """A pendulum released at 90°: sin(θ/2) = k cd(√g t), k = sin 45° (DLMF 22.19)."""
    k = np.sqrt(0.5)
    _, cn, dn, _ = ellipj(np.sqrt(G) * t, k * k)
    return 2 * np.arcsin(k * cn / dn)


@pytest.mark.parametrize("method", ["dop853", "taylor", "tsit5", "rk4", "DOP853", "Radau", "BDF", "LSODA"])
def test_every_sample_satisfies_the_constraints(method):
    run = SYSTEM.simulate(5.0, **RELEASED, method=method, step=0.01 if method == "rk4" else None)
    assert run.success and max(off(run)) < 5e-15
    assert run.drift is not None and run.drift.velocity_after < 5e-15
    assert abs(run["x"] - np.sin(angle(run.t))).max() < (1e-6 if method in ("rk4", "BDF", "LSODA") else 1e-7)
    assert "kept to" in str(run.drift)


def test_without_projection_the_drift_is_measured():
    run = SYSTEM.simulate(20.0, **RELEASED, method="rk4", step=0.02, project=False)
    assert run.drift.position_before == run.drift.position_after > 1e-6
    assert run.drift.position_before == pytest.approx(2 * off(run)[0], rel=1e-2)  # f = x² + y² − l²
    assert any(n.code == "E507" for n in run.notices)
    with pytest.raises(lg.RunError, match="True or False"):
        SYSTEM.simulate(1.0, project="no")


def test_steps_that_are_too_long_are_told():
    run = SYSTEM.simulate(5.0, **RELEASED, method="rk4", step=0.05, samples=11)
    (notice,) = (n for n in run.notices if n.code == "E507")
    assert "shorter step" in notice.text and max(off(run)) < 1e-12
    assert not SYSTEM.simulate(5.0, **RELEASED, method="rk4", step=0.002).notices


def test_a_system_without_constraints_has_no_drift():
    assert lg.example("pendulum").simulate(1.0, theta=0.3).drift is None
    assert not lg.example("pendulum").ensemble(1.0, theta=[0.3, 0.4]).drift


def test_symplectic_methods_are_refused():
    for verb in (lambda: SYSTEM.simulate(1.0, method="gauss4", step=0.01),
                 lambda: SYSTEM.ensemble(1.0, x=[1.0], method="gauss4", step=0.01)):  # fmt: skip
        with pytest.raises(lg.RunError, match="momenta") as caught:
            verb()
        assert "dop853" in str(caught.value.fix)


def test_ensembles_and_sweeps_are_projected(tmp_path):
    theta = np.linspace(0.3, 2.0, 9)
    runs = SYSTEM.ensemble(5.0, x=np.sin(theta), y=-np.cos(theta), reduce=None, times=51)
    assert abs(np.hypot(runs["x"], runs["y"]) - 1).max() < 5e-15
    assert (runs.drift["left"] < 5e-15).all() and runs.drift["margin"].shape == (9,)
    one = SYSTEM.simulate(5.0, x=np.sin(theta[4]), y=-np.cos(theta[4]), samples=51)
    assert np.array_equal(one["x"], runs["x"][4])
    free = SYSTEM.ensemble(20.0, x=np.sin(theta), y=-np.cos(theta), method="rk4", step=0.02, project=False)
    assert (free.drift["left"] == np.maximum(free.drift["position"], free.drift["velocity"])).all()
    assert free.drift["left"].max() > 1e-6 and "E507" in str(free.notices)
    swept = SYSTEM.sweep(2.0, {"m": [0.5, 1.0]}, x=1.0, y=0.0, method="rk4", step=0.01)
    assert swept.drift["left"].max() < 5e-15


def test_a_store_keeps_the_drift(tmp_path):
    pytest.importorskip("zarr")
    store, given = tmp_path / "s.zarr", {"x": [1.0, 1.0, 1.0], "y": 0.0}
    kept = SYSTEM.ensemble(2.0, **given, store=store)
    assert (kept.drift["left"] < 5e-15).all()
    with pytest.raises(lg.RunError, match="another"):
        SYSTEM.ensemble(2.0, **given, store=store, resume=True, project=False)
    assert (lg.Ensemble.of_store(store).drift["left"] == kept.drift["left"]).all()


def test_feedback_and_inputs_that_jump_keep_the_constraints():
    s = rod()
    F = s.input("F")
    x, y = (c.symbol for c in s.model.coordinates)
    s.force((F, 0), at=s.origin + (x, y), name="push")
    run = s.simulate(5.0, **RELEASED, inputs={"F": "5*sign(sin(3*t))"})
    assert run.success and max(off(run)) < 5e-15 and float(run.audit) < 1e-9
    run = s.simulate(5.0, **RELEASED, inputs={F: -2 * s.model.velocities[0].symbol})
    assert run.success and max(off(run)) < 5e-15 and float(run.audit) < 1e-9


@pytest.mark.parametrize("method", ["dop853", "LSODA"])
def test_a_reset_that_breaks_a_constraint_ends_the_run_by_name(method):
    x = SYSTEM.model.coordinates[0].symbol
    vx, vy = (v.symbol for v in SYSTEM.model.velocities)
    bounce = lg.event(x, direction=-1, reset={vx: -0.8 * vx, vy: -0.8 * vy})
    run = SYSTEM.simulate(3.0, **RELEASED, events=[bounce], method=method)
    (found,) = run.events.values()
    assert run.success and len(found) == 3 and max(off(run)) < 5e-15
    assert abs(np.hypot(found.y[0], found.y[1]) - 1).max() < 5e-15
    kick = lg.event(x, direction=-1, reset={vy: vy - 1}, name="kick")
    run = SYSTEM.simulate(3.0, **RELEASED, events=[kick], method=method)
    assert not run.success and "reset of event 'kick' breaks the constraint 'rod': its rate is 2" in run.message


def test_a_reset_that_breaks_a_constraint_fails_a_run_of_many():
    x, vy = SYSTEM.model.coordinates[0].symbol, SYSTEM.model.velocities[1].symbol
    kick = lg.event(x, direction=-1, reset={vy: vy - 1}, name="kick")
    runs = SYSTEM.ensemble(3.0, x=[1.0, 1.0], y=0.0, events=[kick])
    assert (runs.status == RunStatus.BROKEN).all()
    assert np.isnan(runs["final x"]).all() and "breaks a constraint" in str(runs)


@pytest.mark.parametrize(("method", "step"), [("dop853", None), ("tsit5", None), ("rk4", 0.01), ("Radau", None)])
def test_a_parallelogram_passes_where_it_is_flat(method, step):
    turning = {"a": 1.0, "b": 0.0, "c": 1.0, "a'": 3.0, "b'": 0.0, "c'": 3.0}
    run = parallelogram().simulate(2.0, initial=turning, method=method, step=step)
    assert run.success and run["a"][-1] > 5
    assert np.ptp(run["b"]) < 1e-9 and abs(run["a"] - run["c"]).max() < 1e-9  # it stays on its branch
    assert float(run.audit) < 1e-8
    told = [n for n in run.notices if n.code == "E508"]
    assert bool(told) == (run.drift.margin < 1e-6) and all("'coupler' comes within" in n.text for n in told)


def test_constraints_that_are_missed_after_the_projection_too_are_told():
    """A plate on three cranks: a row follows from the others, and inside long steps the guard does not see it."""
    s = lg.System("plate on three cranks")
    a1, a2, a3, x, y, th = s.coordinates("a1 a2 a3 x y th")
    plate = s.frame(th, origin=s.point("G", (x, y)), name="plate")
    s.rigid_body(3.0, 0.4, at=plate.point(0, 0), frame=plate)
    s.gravity()
    for k, (angle, place) in enumerate(zip((a1, a2, a3), (-0.5, 0.0, 0.5), strict=True)):
        crank = s.frame(angle, origin=s.point(f"O{k}", (place, 0)))
        s.rigid_body(0.5, 0.01, at=crank.point(0.3, 0), frame=crank)
        s.pin((plate.point(place, 0), crank.point(0.6, 0)), name=f"p{k}")
    start = {"a1": 1.0, "a2": 1.0, "a3": 1.0, "x": 0.6 * np.cos(1), "y": 0.6 * np.sin(1)}
    run = s.simulate(2.0, initial=start)
    left = max(run.drift.position_after, run.drift.velocity_after)
    assert any("still missed by up to" in str(notice) for notice in run.notices) == (left > 1e-6)
    fine = s.simulate(2.0, initial=start, method="rk4", step=1e-3)
    assert max(fine.drift.position_after, fine.drift.velocity_after) < 1e-6
    assert not any("still missed" in str(notice) for notice in fine.notices)
