"""Runs of systems with constraints: every state satisfies them, and what a run says of that."""

from importlib import import_module
from math import comb

import numpy as np
import pytest
import sympy as sp
from scipy.special import ellipj

import built_in
import lagrangian as lg
from constrained_systems import PEAUCELLIER, peaucellier
from lagrangian.integrate import RunStatus, scipy_methods
from lagrangian.integrate.scipy_history import rescale
from lagrangian.simulate import spared
from redundant_systems import INERTIA, START, WEIGHT, crank_angle, plate_on_cranks

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


@pytest.mark.sampled(9)
@pytest.mark.parametrize("method", ["dop853", "taylor", "tsit5", "rk4", "DOP853", "Radau", "BDF", "LSODA"])
def test_every_sample_satisfies_the_constraints(method):
    run = SYSTEM.simulate(5.0, **RELEASED, method=method, step=0.01 if method == "rk4" else None)
    assert run.success and max(off(run)) < 5e-15
    assert run.drift is not None and run.drift.velocity_after < 5e-15
    assert abs(run["x"] - np.sin(angle(run.t))).max() < (1e-6 if method == "rk4" else 1e-8)
    assert "kept to" in str(run.drift)


@pytest.mark.slow
@pytest.mark.parametrize("method", ["BDF", "LSODA"])
def test_multistep_methods_stay_closed_for_a_hundred_seconds(method):
    run = SYSTEM.simulate(100.0, x=0.6, y=-0.8, method=method, rtol=1e-6, atol=1e-8)
    assert run.success and max(off(run)) < 1e-12
    assert max(run.drift.position_after, run.drift.velocity_after) < 1e-12


@pytest.mark.slow
def test_multistep_methods_say_why_they_are_slow_or_stop_where_a_linkage_can_branch():
    """The cranks lie flat at t = 0.42 s: LSODA takes twenty times the steps for the last 25 ms, BDF stops."""
    plate, loose = plate_on_cranks(), {"rtol": 1e-9, "atol": 1e-12}
    assert plate.simulate(0.4, initial=START, method="LSODA", **loose).steps < 100
    run = plate.simulate(0.6, initial=START, method="BDF", **loose)
    assert not run.success and "come to depend on each other there" in run.message
    assert "E504" in run.message and "method='dop853'" in str(run.message)
    assert plate.simulate(0.6, initial=START).steps < 300
    slow = plate.simulate(0.425, initial=START, method="LSODA", samples=11, **loose)
    (said,) = (n.text for n in slow.notices if "more than one way" in n.text)
    assert slow.success and slow.steps > 1000 and "'LSODA' takes very short steps" in said


@pytest.mark.slow
def test_a_linkage_steps_over_a_position_where_it_can_branch_or_the_run_names_what_does(monkeypatch):
    """At 0.427 s the arms lie on each other; on the same branch the point stays on Peaucellier's line x = 1.25."""
    system = peaucellier()
    for options, within in (({"method": "taylor"}, 1e-6), ({"method": "rk4", "step": 1e-3}, 1e-6)):
        run = system.simulate(1.0, initial=PEAUCELLIER, **options)
        assert run.success, run.message
        assert np.abs(run["x"] - 1.25).max() < 1e-12
        assert run["beta1"][-1] < run["beta2"][-1] and float(run.audit) < within
    monkeypatch.setattr(scipy_methods, "PATIENCE", 4000)
    for method in ("BDF", "LSODA"):  # noise stops the one at a margin of 0.001; the other goes on in ever shorter steps
        stopped = system.simulate(1.0, initial=PEAUCELLIER, method=method)
        assert not stopped.success and stopped.t[-1] > 0.42 and stopped.steps < 10_000
        assert "E504" in stopped.message and "come to depend on each other there" in stopped.message
    late = system.simulate(1.0, initial=PEAUCELLIER, method="LSODA", max_steps=2000)
    assert "E505" in late.message and "method='dop853'" in late.message
    stopped = system.simulate(1.0, initial=PEAUCELLIER, rtol=1e-6)
    assert stopped.success or "come to depend on each other there" in stopped.message
    assert stopped.success or "method='taylor' or method='rk4' with a step" in stopped.message


def test_an_energy_that_is_missed_is_told_with_its_figure(monkeypatch):
    monkeypatch.setattr(import_module("lagrangian.simulate.simulation"), "KEPT", 1e-13)
    run = SYSTEM.simulate(1.0, **RELEASED, method="RK45")
    (said,) = (n for n in run.notices if n.code == "E511")
    assert f"missed by {float(run.audit):.1e} of what moves" in said.text and "'dop853'" in said.text
    loose = SYSTEM.simulate(1.0, **RELEASED, rtol=1e-6)
    assert float(loose.audit) > 1e-13 and not any(n.code == "E511" for n in loose.notices)  # as it was asked for


def test_a_row_that_others_imply_anyway_is_no_position_where_a_linkage_can_branch():
    s = lg.System("held disc")
    x, y, phi = s.coordinates("x y phi")
    centre = s.point("C", (x, y))
    disc = s.rigid_body(1, 1, at=centre, frame=s.frame(phi, origin=centre))
    s.rolling(disc, at=s.origin, along=[(1, 0), (0, 1), (1, 1)], name="hold")
    run = s.simulate(0.1, x=0.3, y=0.2, phi=0.1)
    assert run.success and run.drift.margin > 0.5
    assert [n.code for n in (*s.notices, *run.notices)] == ["E306", "E306"]


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
    assert built_in.system("pendulum").simulate(1.0, theta=0.3).drift is None
    assert not built_in.system("pendulum").ensemble(1.0, theta=[0.3, 0.4]).drift


def test_symplectic_methods_are_refused():
    for verb in (lambda: SYSTEM.simulate(1.0, method="gauss4", step=0.01),
                 lambda: SYSTEM.ensemble(1.0, x=[1.0], method="gauss4", step=0.01)):  # fmt: skip
        with pytest.raises(lg.RunError, match="momenta") as caught:
            verb()
        assert "dop853" in str(caught.value.fix)


@pytest.mark.slow
def test_ensembles_and_sweeps_are_projected():
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


@pytest.mark.slow
def test_a_store_keeps_the_drift(tmp_path):
    pytest.importorskip("zarr")
    store, given = tmp_path / "s.zarr", {"x": [1.0, 1.0, 1.0], "y": 0.0}
    kept = SYSTEM.ensemble(2.0, **given, store=store)
    assert (kept.drift["left"] < 5e-15).all()
    with pytest.raises(lg.RunError, match="another"):
        SYSTEM.ensemble(2.0, **given, store=store, resume=True, project=False)
    assert (lg.Ensemble.of_store(store).drift["left"] == kept.drift["left"]).all()


@pytest.mark.slow
def test_feedback_and_inputs_that_jump_keep_the_constraints():
    s = rod()
    F = s.input("F")
    x, y = (c.symbol for c in s.model.coordinates)
    s.force((F, 0), at=s.origin + (x, y), name="push")
    run = s.simulate(5.0, **RELEASED, inputs={"F": "5*sign(sin(3*t))"})
    assert run.success and max(off(run)) < 5e-15 and float(run.audit) < 1e-9
    run = s.simulate(5.0, **RELEASED, inputs={F: -2 * s.model.velocities[0].symbol})
    assert run.success and max(off(run)) < 5e-15 and float(run.audit) < 1e-9


@pytest.mark.sampled(2)
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


@pytest.mark.slow
def test_a_reset_that_breaks_a_constraint_fails_a_run_of_many():
    x, vy = SYSTEM.model.coordinates[0].symbol, SYSTEM.model.velocities[1].symbol
    kick = lg.event(x, direction=-1, reset={vy: vy - 1}, name="kick")
    runs = SYSTEM.ensemble(3.0, x=[1.0, 1.0], y=0.0, events=[kick])
    assert (runs.status == RunStatus.BROKEN).all()
    assert np.isnan(runs["final x"]).all() and "breaks a constraint" in str(runs)


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("method", "step"), [("dop853", None), ("tsit5", None), ("rk4", 0.01), ("Radau", None)])
def test_a_parallelogram_passes_where_it_is_flat(method, step):
    turning = {"a": 1.0, "b": 0.0, "c": 1.0, "a'": 3.0, "b'": 0.0, "c'": 3.0}
    run = parallelogram().simulate(2.0, initial=turning, method=method, step=step)
    assert run.success and run["a"][-1] > 5
    assert np.ptp(run["b"]) < 1e-9 and abs(run["a"] - run["c"]).max() < 1e-9  # it stays on its branch
    assert float(run.audit) < 1e-8
    told = [n for n in run.notices if n.code == "E508"]
    assert bool(told) == (run.drift.margin < 1e-6) and all("'coupler' comes within" in n.text for n in told)


@pytest.mark.sampled(5)
@pytest.mark.parametrize(
    ("options", "within"),
    [
        ({}, 2e-10),
        ({"rtol": 1e-6}, 1e-8),  # a hundredth of rtol: which steps are taken depends on last digits
        ({"rtol": 1e-12, "atol": 1e-12}, 2e-10),
        ({"method": "rk4", "step": 1e-3}, 2e-10),
        ({"method": "taylor"}, 2e-10),
    ],
)
@pytest.mark.slow
def test_a_plate_on_three_cranks_moves_as_with_one_coordinate(options, within):
    """One of the six rows is spare, each at other angles; on its way the plate passes two flat positions."""
    run = plate_on_cranks().simulate(2.0, initial=START, **options)
    assert run.success, run.message
    a, rate = crank_angle(run.t)
    for name in ("a1", "a2", "a3"):
        assert abs(run[name] - a).max() < within and abs(run[f"{name}'"] - rate).max() < 1e-7
    assert max(run.drift.position_after, run.drift.velocity_after) < 1e-9 and float(run.audit) < 1e-9
    (told,) = [n.text for n in run.notices if "one follows" in n.text]
    assert "'p0.x', 'p0.y', 'p1.x', 'p1.y', 'p2.x', 'p2.y'" in told and "not determined" in told


@pytest.mark.slow
def test_a_plate_on_three_cranks_goes_on_turning():
    """30 s by energy: h is constant to 1e-9 of it; and the same with friction, whose regimes know of the row too."""
    run = plate_on_cranks().simulate(30.0, initial=START)
    assert run.success and float(run.audit) < 1e-9 and run.drift.velocity_after < 1e-8
    s = plate_on_cranks()
    s.friction(limit=0.4, deflection=s.model.coordinates[0].symbol, name="bearing")
    run = s.simulate(3.0, initial=START)
    assert run.success and float(run.audit) < 1e-9 and run.drift.velocity_after < 1e-8


@pytest.mark.slow
def test_forces_of_a_plate_on_three_cranks_add_up_to_those_of_its_motion():
    """On the plate: Σ forces = m (r″ − g), and no torque about its centre, as it does not turn."""
    run = plate_on_cranks().simulate(1.0, initial=START, samples=41)
    force = sum(run.reaction(f"p{k}").force for k in range(3))
    rate, a = run["a1'"], run["a1"]
    bend = -WEIGHT / INERTIA * np.cos(a)
    path = 0.6 * np.array(
        [-np.sin(a) * bend - np.cos(a) * rate**2, np.cos(a) * bend - np.sin(a) * rate**2 + 9.81 / 0.6]
    )
    assert force == pytest.approx(3.0 * path.T, abs=1e-6)
    turning = sum(place * run.reaction(f"p{k}").force[:, 1] for k, place in enumerate((-0.5, 0.0, 0.5)))
    assert turning == pytest.approx(0.0, abs=1e-6)


@pytest.mark.slow
def test_an_ensemble_of_plates_knows_of_the_row_if_all_runs_have_it():
    s = plate_on_cranks()
    angles = np.array([1.0, 0.7, 0.4])
    start = {f"a{k}": angles for k in (1, 2, 3)} | {"x": 0.6 * np.cos(angles), "y": 0.6 * np.sin(angles)}
    runs = s.ensemble(2.0, initial=start)
    assert runs.success and runs.drift["left"].max() < 1e-9
    assert any("one follows" in said for said in runs.notices)
    one = s.simulate(2.0, initial=START)
    assert runs["final a1"][0] == pytest.approx(one["a1"][-1], abs=1e-9)


def growing():
    """A rod of length 1 given twice, the second of which grows: they agree for 1 s, and then contradict each other."""
    s = lg.System("two rods")
    x, y = s.coordinates("x y")
    s.particle(1.0, at=s.origin + (x, y))
    s.gravity((0, -1), G)
    s.constraint(sp.sqrt(x**2 + y**2) - 1, name="rod")
    s.constraint(x**2 + y**2 - 1 - sp.exp(20 * (s.t - 2)), name="growing")
    return s


@pytest.mark.slow
def test_a_run_ends_where_a_row_that_was_left_out_does_not_hold_any_more():
    """f = e^{20 (t − 2)} is 1e-6 at 1.31 s, its rate already at 1.16 s."""
    run = growing().simulate(2.0, **RELEASED)
    assert run.status == RunStatus.APART and not run.success
    assert run.t[-1] == pytest.approx(1.16, abs=0.01)
    assert "E510" in run.message and "'rod' and 'growing'" in run.message and "breaks the constraint" in run.message
    runs = growing().ensemble(2.0, x=[1.0, 0.8], y=[0.0, 0.6])
    assert (runs.status == RunStatus.APART).all() and not runs.success


@pytest.mark.slow
def test_constraints_that_are_missed_after_the_projection_too_are_told(monkeypatch):
    """Without knowing that a row is spare, the guard does not see it inside long steps."""
    monkeypatch.setattr(spared, "spare_rows", lambda *_: ())
    s = plate_on_cranks()
    run = s.simulate(2.0, initial=START)
    assert max(run.drift.position_after, run.drift.velocity_after) > 1e-6
    assert any("still missed by up to" in str(notice) for notice in run.notices)
    runs = s.ensemble(2.0, initial={name: [value, value] for name, value in START.items()})
    assert any("in 2 runs after the projection they are still missed" in said for said in runs.notices)
    fine = s.simulate(2.0, initial=START, method="rk4", step=1e-3)
    assert max(fine.drift.position_after, fine.drift.velocity_after) < 1e-6
    assert not any("still missed" in str(notice) for notice in fine.notices)


@pytest.mark.slow
def test_a_step_taken_back_leaves_a_multistep_method_its_order():
    """With a new solver for every step whose correction is too great, it takes 2332 steps at order 1 and 2."""
    system = peaucellier()
    kept, free = (
        system.simulate(0.2, initial=PEAUCELLIER, method="BDF", rtol=1e-9, project=project) for project in (True, False)
    )
    assert kept.rejected > 0 and kept.steps < 3 * free.steps
    assert float(kept.audit) < 1e-8 and abs(kept["x"][-1] - 1.25) < 1e-14


def test_differences_at_another_step_are_those_of_the_same_polynomial():
    """∇ʲ of t³ at t = 2, at the steps 1 and 0.3: by their definition, sums of values with binomial coefficients."""

    def differences(h):
        values = np.array([(2.0 - k * h) ** 3 for k in range(4)])
        return np.array([sum((-1) ** k * comb(j, k) * values[k] for k in range(j + 1)) for j in range(4)])[:, None]

    D = differences(1.0)
    rescale(D, 3, 0.3)
    assert pytest.approx(differences(0.3), abs=1e-13) == D
