"""Rests against closed forms."""

import itertools
import json
import math
from typing import Any

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg
from built_in import system as built_in
from lagrangian.cli import main
from lagrangian.errors import RunError


def values_of(system: lg.System) -> dict[str, float]:
    return {x.name: x.value for x in system.model.parameters if x.value is not None}


def chain(n: int) -> lg.System:
    """A pendulum of n equal links, absolute angles from hanging."""
    system = lg.System("chain")
    at = system.origin
    m, L = system.parameters("m L", m="1 kg", L="0.5 m")
    from sympy import cos, sin

    for k in range(n):
        theta = system.coordinate(f"theta{k + 1}")
        at = at + (L * sin(theta), -L * cos(theta))
        system.particle(m, at=at)
    system.gravity(direction=(0, -1))
    return system


@pytest.mark.sampled(2)
@pytest.mark.parametrize("n", [1, 2, 3, 5])
def test_a_chain_of_n_links_rests_in_two_to_the_n_ways_and_hangs_stably(n: int) -> None:
    found = chain(n).equilibria()
    angles = [tuple(round(e[f"theta{k + 1}"], 9) for k in range(n)) for e in found]
    assert angles == sorted(itertools.product((0.0, round(math.pi, 9)), repeat=n))
    assert [e.stability.stable for e in found] == [True] + [False] * (2**n - 1)
    assert found.sure
    assert max(e.residual for e in found) < 1e-12


@pytest.mark.parametrize("Omega", [3.0, 8.0])
def test_the_bead_on_a_hoop_has_a_pitchfork(Omega: float) -> None:
    """cos θ = g/(R Ω²) once Ω² > g/R; Strogatz, Nonlinear Dynamics and Chaos, § 3.5."""
    found = built_in("bead-on-hoop").equilibria(params={"Omega": Omega})
    ratio = 9.81 / (0.3 * Omega**2)
    if ratio > 1:
        assert [e["theta"] for e in found] == pytest.approx([0, math.pi])
        assert [e.stability.stable for e in found] == [True, False]
    else:
        side = math.acos(ratio)
        assert [e["theta"] for e in found] == pytest.approx([-side, 0, side, math.pi])
        assert [e.stability.stable for e in found] == [True, False, True, False]


def test_the_pitchfork_itself_is_one_degenerate_rest() -> None:
    found = built_in("bead-on-hoop").equilibria(params={"Omega": math.sqrt(9.81 / 0.3)})
    assert [e["theta"] for e in found] == pytest.approx([0, math.pi], abs=1e-3)
    assert found[0].dimension == 0
    assert found[0].stability.verdict == "marginal"


def test_the_elastic_pendulum_hangs_and_stands() -> None:
    """k (r − l) = ± m g."""
    system = built_in("elastic-pendulum")
    p = values_of(system)
    rest, sag = p["L_0"], p["m"] * p["g"] / p["k"]
    found = system.equilibria()
    assert [(e["r"], e["theta"]) for e in found] == [
        (pytest.approx(rest - sag), pytest.approx(math.pi)),
        (pytest.approx(rest + sag), 0.0),
    ]
    assert [e.stability.stable for e in found] == [False, True]


def test_free_coordinates_are_held_and_named() -> None:
    found = built_in("cart-pole").equilibria()
    assert [(e["x"], e["theta"]) for e in found] == [(0, 0), (0, pytest.approx(math.pi))]
    assert found.free == ({"x": 1.0},)
    assert "no force depends on x, so" in found.notes[0]


def test_shifts_of_several_coordinates_together_are_free() -> None:
    found = built_in("lecture-3a").equilibria()
    assert len(found) == 1
    assert found.free == ({"x1": 1.0, "x2": pytest.approx(1.0)},)


def ring() -> lg.System:
    system = lg.System("ring")
    x, y = system.coordinates("x y")
    m, k, R = system.parameters("m k R", m=1, k=3, R=2)
    system.particle(m, at=system.origin + (x, y))
    system.potential(k * (x**2 + y**2 - R**2) ** 2)
    return system


@pytest.mark.slow
def test_a_circle_of_rests_is_one_family_and_the_hilltop_another_rest() -> None:
    found = ring().equilibria(box={"x": (-5, 5), "y": (-5, 5)})
    assert len(found) == 2
    (family,) = [e for e in found if e.dimension]
    (top,) = [e for e in found if not e.dimension]
    assert math.hypot(family["x"], family["y"]) == pytest.approx(2)
    assert family.moves == ("x", "y")
    assert (family["x"], family["y"]) == (pytest.approx(2, rel=1e-12), 0.0)  # |x| + |y| is least at four places
    assert top["x"] == pytest.approx(0, abs=1e-9) and top.stability.stable is False


@pytest.mark.slow
def test_the_place_that_stands_for_a_curve_is_the_nearest_to_0() -> None:
    """On the line 3 x + 4 y = 12 that is (0, 3); on the parabola y = (x − 1)² + 1, where 2 (1 − x) = 1, (1/2, 5/4)."""
    for law, x, y in ((lambda x, y: 3 * x + 4 * y - 12, 0.0, 3.0), (lambda x, y: y - (x - 1) ** 2 - 1, 0.5, 1.25)):
        system = lg.System("valley")
        q = system.coordinates("x y")
        system.particle(1.0, at=system.origin + q)
        system.potential(law(*q) ** 2)
        (rest,) = system.equilibria(box={"x": (-5, 5), "y": (-5, 5)})
        assert (rest["x"], rest["y"]) == (pytest.approx(x, abs=1e-7), pytest.approx(y, abs=1e-7))


@pytest.mark.slow
def test_a_surface_of_rests_has_coordinates_that_are_0() -> None:
    system = lg.System("shell")
    x, y, z = system.coordinates("x y z")
    system.particle(1.0, at=system.origin + (x, y, z))
    system.potential((x**2 + 4 * y**2 + z**2 - 9) ** 2)
    found = system.equilibria(box=dict.fromkeys(("x", "y", "z"), (-5, 5)))
    (rest,) = [e for e in found if e.dimension]
    assert rest.dimension == 2
    assert (rest["x"], abs(rest["y"]), rest["z"]) == (0.0, pytest.approx(1.5, rel=1e-9), 0.0)


def test_what_nothing_balances_is_said() -> None:
    found = built_in("atwood").equilibria()
    assert len(found) == 0
    assert any("nothing balances" in note for note in found.notes)
    assert not any("any value will do" in note or "box that was given" in note for note in found.notes)


def test_a_constant_input_moves_the_rest() -> None:
    """θ = asin(τ/(m g L)) of a pendulum with a torque."""
    system = built_in("lecture-2")
    at = system.equilibria(box={"theta1": (-2, 0), "theta2": (-1, 1)}, inputs={"tau": 1.0})
    p = values_of(system)
    assert len(at) == 1
    assert p["m3"] * p["g"] * p["L_c"] * math.cos(at[0]["theta1"] + at[0]["theta2"]) == pytest.approx(1.0)


def test_a_box_limits_and_may_have_units() -> None:
    found = built_in("pendulum").equilibria(box={"theta": ("90 deg", "270 deg")})
    assert [e["theta"] for e in found] == pytest.approx([math.pi])
    assert found.box["theta"] == (pytest.approx(math.pi / 2), pytest.approx(3 * math.pi / 2))


def test_an_equilibrium_is_a_point_to_linearize_about() -> None:
    system = built_in("bead-on-hoop")
    rest = system.equilibria(params={"Omega": 9.0})[-2]
    linear = system.linearize(rest)
    assert linear.parameters["Omega"] == 9.0
    # small motion about the leaning rest: ω² = Ω² sin² θ
    assert linear.frequencies[0] == pytest.approx(9.0 * math.sin(rest["theta"]), rel=1e-12)


def test_where_the_mass_matrix_is_singular_is_said() -> None:
    found = built_in("spherical-pendulum").equilibria()
    assert any("singular at theta = 0" in note for note in found.notes)


@pytest.mark.parametrize(
    ("box", "message"),
    [
        ({"thta": (0, 1)}, "Did you mean 'theta'"),
        ({"theta": (1, 0)}, "empty"),
        ({"theta": 3}, r"\(low, high\)"),
        ({"theta": (0, float("nan"))}, "nan"),
        ([1], "mapping"),
    ],
)
def test_bad_boxes_are_named(box: Any, message: str) -> None:
    with pytest.raises(RunError, match=message):
        built_in("pendulum").equilibria(box=box)


def test_bad_starts_are_named() -> None:
    with pytest.raises(RunError, match="starts"):
        built_in("pendulum").equilibria(starts=0)


def test_a_list_that_would_be_chance_is_refused() -> None:
    """V = cos 200x + x²/10⁶: at x = kπ/200 to within 10⁻⁹, so 1273 from −10 to 10 and 13 from −0.1 to 0.1."""
    system = lg.System("comb")
    x = system.coordinates("x")
    system.particle(1, at=system.origin + (x, 0))
    system.potential(sp.cos(200 * x) + sp.Rational(1, 10**6) * x**2)
    with pytest.raises(RunError, match="system 'comb' has more than 500 equilibria in the box") as refused:
        system.equilibria()
    assert refused.value.fix == "narrow box to those you look for, or say from how many starts"
    assert len(system.equilibria(starts=20)) > 10
    found = system.equilibria(box={"x": (-0.1, 0.1)})
    assert [e["x"] for e in found] == pytest.approx([k * math.pi / 200 for k in range(-6, 7)], abs=1e-9)


def test_the_command_writes_text_and_data(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["equilibria", "-e", "double-pendulum", "--box", "theta1=-pi:pi"]) == 0
    assert "unstable" in capsys.readouterr().out
    assert main(["equilibria", "-e", "double-pendulum", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["equilibria"]
    assert len(found) == 4
    assert main(["equilibria", "-e", "pendulum", "--box", "theta=3"]) == 2
    assert "low:high" in capsys.readouterr().err


def test_starts_fill_the_box_evenly() -> None:
    from lagrangian.equilibria.roots import starting_points

    points = starting_points(4096, np.zeros(3), np.ones(3))
    assert np.abs(points.mean(axis=0) - 0.5).max() < 0.01
    counts, _ = np.histogramdd(points, bins=(4, 4, 4), range=[(0, 1)] * 3)
    assert counts.min() > 40
