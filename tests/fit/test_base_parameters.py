"""Base parameters against published counts, the inverse dynamics, and a formula for chains."""

import sys
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.errors import ModelError, RunError
from lagrangian.fit.regressor import rigids
from lagrangian.model import time

sys.path.append(str(Path(__file__).parents[1] / "structured"))  # where the arms are
import robots


def agrees(s, base):
    """Y_b π_b is the inverse dynamics of a system in which nothing but inertia and weight acts."""
    q, v, a = np.random.default_rng(3).uniform(-1, 1, (3, 5, len(s.model.velocities)))
    expected = s.compile().inverse(q, v, a)
    found = base.regressor(q, v, a) @ base.values
    assert found.shape == expected.shape
    assert np.abs(found - expected).max() < 1e-12 * max(1.0, np.abs(expected).max())


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("make", "count", "of"),
    [
        (robots.puma, 36, 60),  # Gautier and Khalil 1990, table II: 36 of a PUMA 560
        (robots.seven_joints, 43, 70),  # 1 + 6 · 7: a first axis along gravity
        (lambda: lg.example("robot-arm"), 15, 30),
        (lambda: lg.example("two-disk-shaft"), 2, 8),
    ],
)
def test_published_counts_and_the_inverse_dynamics(make, count, of) -> None:
    s = make()
    base = s.base_parameters()
    assert (len(base), len(base.names)) == (count, of)
    assert base.exact
    if all(e.ledger != "V" or e.title == "gravity g" for e in s.model.elements):  # no springs
        agrees(s, base)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("links", [1, 2, 3])
def test_a_chain_in_general_position_has_one_and_seven_more_a_link(links: int) -> None:
    source = np.random.default_rng(links)
    s, frame, joint = lg.System("chain"), None, None
    for k in range(links):
        q = s.coordinate(f"q{k}")
        joint = s.origin if frame is None else frame.point(*map(float, source.uniform(0.2, 1, 3)), at=joint)
        axis = (0, 0, 1) if k == 0 else tuple(map(int, source.integers(1, 9, 3)))
        frame = s.frame(q, axis=axis, parent=frame, origin=joint)
        J = [[2, 0.1, 0.2], [0.1, 3, 0.3], [0.2, 0.3, 4]]
        s.rigid_body(1.5, J, frame.point(0.1, 0.2, 0.3, at=joint), frame)
    s.gravity(direction=(0, 0, -1))
    base = s.base_parameters()
    assert len(base) == 1 + 7 * (links - 1)
    agrees(s, base)


def test_in_the_plane_bodies_on_one_link_are_one_part() -> None:
    """Two links with a motor on the second: J₁ + m₂ l² (+ …), m₂ c₂, J₂; gravity adds the first moments."""
    s = lg.System("two links")
    q1, q2 = s.coordinates("q1 q2")
    m1, m2, m3, J1, J2 = s.parameters("m1 m2 m3 J1 J2")  # masses and inertias need no values
    l1, c1, c2 = s.parameters("l1 c1 c2", l1=0.7, c1=0.3, c2=0.2)
    one = s.frame(q1, name="one")
    elbow = one.point(l1, 0)
    two = s.frame(q2, parent=one, origin=elbow)
    s.rigid_body(m1, J1, one.point(c1, 0), one)
    s.rigid_body(m2, J2, two.point(c2, 0, at=elbow), two)
    s.particle(m3, two.point(2 * c2, c2, at=elbow))
    s.gravity()
    assert [len(part.bodies) for part in rigids(s.model)] == [1, 2]
    base = s.base_parameters()
    assert len(base) == 6 and len(base.names) == 8  # both first moments and J of each; m1 and m2 join the first link
    assert "m_1" in base.unseen
    assert base.meaning["J_2"] == J2 + m2 * c2**2 + m3 * 5 * c2**2
    assert base.meaning["my_2"] == m3 * c2
    (carried,) = [b for b in base.bases if "J_1" in b]
    assert carried["m_2"] == pytest.approx(0.49)  # J₁ + m l₁²
    assert np.isnan(base.values).any()
    text = base.to_text()
    assert "6 combinations of 8" in text and "No motion shows m₁" in text
    assert base.to_dict()["count"] == 6


def test_identification_from_a_motion() -> None:
    s = lg.example("robot-arm")
    base = s.base_parameters()
    q, v, a = np.random.default_rng(1).uniform(-1, 1, (3, 60, 3))
    Y = base.regressor(q, v, a)
    found = np.linalg.lstsq(Y.reshape(-1, len(base)), s.compile().inverse(q, v, a).ravel(), rcond=None)[0]
    assert np.allclose(found, base.values, atol=1e-10)


def test_what_does_not_fit_is_told() -> None:
    s = lg.System("energies")
    x = s.coordinate("x")
    s.kinetic(x.diff() ** 2)
    with pytest.raises(ModelError, match="no bodies"):
        s.base_parameters()
    s = lg.System("pendulum")
    q, L = s.coordinate("q"), s.parameter("L")
    s.particle(s.parameter("m"), s.origin + (L * sp.sin(q), -L * sp.cos(q)))
    s.gravity()
    with pytest.raises(RunError, match=r"'L' has no value") as error:
        s.base_parameters()
    assert error.value.code == "E401"
    assert len(s.base_parameters({"L": 2.0})) == 1
    with pytest.raises(RunError):
        s.base_parameters({"nothing": 1.0})


def pendulums(length: float):
    """Two links, each with a body half of the way along it."""
    s = lg.System("pendulums")
    one = s.frame(s.coordinate("a"), name="one")
    elbow = one.point(0, -length)
    two = s.frame(s.coordinate("b"), origin=elbow, name="two")
    s.rigid_body(1, length**2, one.point(0, -length / 2), one)
    s.rigid_body(2, length**2, two.point(0, -length / 2, at=elbow), two)
    s.gravity()
    return s


@pytest.mark.parametrize("length", [2e-5, 2e5])
def test_small_and_large_lengths_lose_no_parameter(length: float) -> None:
    """J₁ + m₂ l² of two pendulums: all combinations are found, and what is printed is not rounded to 0."""
    s = pendulums(length)
    base = s.base_parameters()
    assert len(base) == 6 and base.exact and base.unseen == ("m_1",)
    q, v, a = np.random.default_rng(3).uniform(-1, 1, (3, 5, 2))
    expected = s.compile().inverse(q, v, a)
    assert np.abs(base.regressor(q, v, a) @ base.values - expected).max() < 1e-9 * np.abs(expected).max()
    (row,) = [line for line in str(base).splitlines() if line.startswith("3 ")]
    assert "m₂" in row and "J₁" in row


def test_the_regressor_of_a_prescribed_motion_is_at_a_time() -> None:
    s = lg.System("shaken pendulum")
    x = s.point("pivot", (0.5 * sp.sin(3 * time), 0))
    rod = s.frame(s.coordinate("theta"), name="rod", origin=x)
    s.rigid_body(2, 0.1, rod.point(0, -0.3, at=x), rod)
    s.gravity()
    base, system = s.base_parameters(), s.compile()
    q, v, a = np.random.default_rng(3).uniform(-1, 1, (3, 4, 1))
    times = np.array([0.1, 0.4, 0.7, 1.1])
    assert base.regressor(q, v, a, times) @ base.values == pytest.approx(system.inverse(q, v, a, t=times))
    assert base.regressor(q[0], v[0], a[0], 0.4) @ base.values == pytest.approx(system.inverse(q[0], v[0], a[0], t=0.4))
