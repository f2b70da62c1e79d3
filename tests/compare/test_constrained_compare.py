"""Systems with constraints compared: by the motions that they allow."""

import pytest
import sympy as sp

import lagrangian as lg
from constrained_systems import cart_pole
from redundant_systems import plate_on_cranks


def bob(name, law=None, g=9.81, l=1.5):
    """A particle in x and y; ``law``: "rod", "square" or nothing ties it to the origin."""
    s = lg.System(name)
    x, y = s.coordinates("x y")
    m, length, weight = s.parameters("m l g", m=2.0, l=l, g=g)
    at = s.point("P", (x, y))
    s.particle(m, at=at, name="bob")
    s.gravity((0, -1), weight)
    if law == "rod":
        s.constraint(between=(at, s.origin), distance=length, name="rod")
    elif law == "square":
        s.constraint(x**2 + y**2 - length**2, name="circle")
    return s


def pendulum(factor=1):
    s = lg.System("pendulum")
    theta = s.coordinates("theta")
    m, l, g = s.parameters("m l g", m=2.0, l=1.5, g=9.81)
    s.particle(m, at=s.point("P", (l * sp.sin(theta), -l * sp.cos(theta))), name="bob")
    s.gravity((0, -1), factor * g)
    return s


@pytest.mark.slow
def test_a_rod_pendulum_in_x_and_y_is_the_pendulum_in_theta():
    for a, b in ((bob("rod", "rod"), pendulum()), (pendulum(), bob("rod", "rod"))):
        found = lg.compare(a, b)
        assert found.same and found and found.equations_same
        assert len(found.motions) == 3 and all(check.holds for check in found.motions)
        assert {str(c.symbol): str(found.change.table[c.symbol]) for c in found.change.old} == {
            "x(t)": "l*sin(theta(t))",
            "y(t)": "-l*cos(theta(t))",
        }
        assert "describe the same motion" in found.to_text() and found.to_dict()["same"] is True


@pytest.mark.slow
def test_two_ways_to_write_a_rod_are_the_same():
    assert lg.compare(bob("rod", "rod"), bob("circle", "square"))


@pytest.mark.slow
def test_what_differs_is_said():
    found = lg.compare(bob("rod", "rod"), pendulum(factor=1.1))
    assert (not found.same and "x'' is" in str(found.why)) or "y'' is" in str(found.why)
    found = lg.compare(bob("rod", "rod"), bob("free"))
    assert not found.same and "constraints of (A) do not hold" in str(found.why)
    found = lg.compare(bob("free"), bob("rod", "rod"))
    assert not found.same and "same ways (2 in (A), 1 in (B))" in str(found.why)


def test_equal_equations_with_other_values_are_not_the_same_system():
    found = lg.compare(bob("short", "rod", l=1.0), bob("long", "rod", l=1.5))
    assert found.equations_same and not found.same
    assert [p.name for p in found.parameters] == ["l"]


@pytest.mark.slow
def test_redundant_coordinates_change_no_motion_with_inputs_either():
    assert lg.compare(cart_pole(redundant=True), cart_pole(redundant=False))


@pytest.mark.slow
def test_a_plate_with_a_row_too_many_is_the_system_with_one_coordinate():
    s = lg.System("one angle")
    a = s.coordinates("a")
    s.particle(3.0, at=s.origin + (0.6 * sp.cos(a), 0.6 * sp.sin(a)))
    s.gravity()
    for k, place in enumerate((-0.5, 0.0, 0.5)):
        crank = s.frame(a, origin=s.point(f"O{k}", (place, 0)))
        s.rigid_body(0.5, 0.01, at=crank.point(0.3, 0), frame=crank)
    change = {"a1": "a", "a2": "a", "a3": "a", "x": "0.6*cos(a)", "y": "0.6*sin(a)", "th": "0"}
    assert lg.compare(plate_on_cranks(), s, change=change)
    wrong = change | {"a3": "-a"}
    found = lg.compare(plate_on_cranks(), s, change=wrong)
    assert not found.same and "do not hold" in str(found.why)


def test_a_change_that_loses_a_way_to_move_is_not_taken():
    """x = y = 0 satisfies x = y, and says nothing of how both move."""
    a = lg.System("slope")
    x, y = a.coordinates("x y")
    a.particle(1.0, at=a.origin + (x, y))
    a.constraint(x - y, name="slope")
    b = lg.System("line")
    s = b.coordinates("s")
    b.particle(1.0, at=b.origin + (s, s))
    assert lg.compare(a, b, change={"x": "s", "y": "s"})
    found = lg.compare(a, b, change={"x": "0", "y": "0"})
    assert not found.same and "same ways" in str(found.why)


@pytest.mark.slow
def test_velocity_rows_are_compared_too():
    def sleigh(row):
        s = lg.System("sleigh")
        x, y, theta = s.coordinates("x y theta")
        m, J, a = s.parameters("m J a", m=1.0, J=0.5, a=0.3)
        body = s.frame(theta, origin=s.point("A", (x, y)))
        s.rigid_body(m, J, at=body.point(a, 0), frame=body)
        s.velocity_constraint(row(x, y, theta), name="blade")
        return s

    def blade(x, y, theta):
        return y.diff() * sp.cos(theta) - x.diff() * sp.sin(theta)

    assert lg.compare(sleigh(blade), sleigh(lambda x, y, q: 3 * (1 + x**2) * blade(x, y, q)))
    assert not lg.compare(sleigh(blade), sleigh(lambda x, y, q: blade(x, y, q + sp.pi / 7)))


def test_a_system_that_cannot_be_put_together_is_not_compared():
    s = bob("rod", "rod")
    other = bob("square", "square")
    x, y = (c.symbol for c in other.model.coordinates)
    other.constraint(x**2 + y**2 + 1, name="nowhere")
    with pytest.raises((lg.ModelError, lg.RunError)):
        lg.compare(s, other)
