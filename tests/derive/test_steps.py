"""The seven steps on systems whose answers a lecture prints: kinds of coordinates, boxes, reasons, ledger, sources."""

import pytest
import sympy as sp
from sympy import cos, sin

import lagrangian as lg
from lagrangian.page.formula import Formula, Terms, Total

Pair = tuple[sp.Expr, sp.Expr]


def carts(*, relative: bool) -> lg.System:
    """The lecture's example 3: two carts, a spring between them, a force that pushes them apart."""
    s = lg.System("two carts")
    x1, x2 = s.coordinates("x1 x2")
    m1, m2, k, b = s.parameters("m1 m2 k b")
    F = s.input("F")
    place = x1 + x2 if relative else x2
    gap = place - x1
    s.particle(m1, s.origin + (x1, 0), name="cart 1")
    s.particle(m2, s.origin + (place, 0), name="cart 2")
    s.spring(k, deflection=gap)
    s.damper(b, deflection=gap)
    s.force(F, deflection=gap)
    return s


def arm(*, relative: bool) -> lg.System:
    """The lecture's example 2: two links, three masses, a torque on link 2 that reacts on link 1."""
    s = lg.System("arm")
    th1, th2 = s.coordinates("theta1 theta2")
    La, Lb, Lc, m1, m2, m3 = s.parameters("L_a L_b L_c m1 m2 m3")
    tau = s.input("tau")
    second = th1 + th2 if relative else th2
    p1 = s.origin + (La * cos(th1), La * sin(th1))
    p2 = p1 + (Lb * cos(th1), Lb * sin(th1))
    p3 = p2 + (Lc * cos(second), Lc * sin(second))
    for m, p in ((m1, p1), (m2, p2), (m3, p3)):
        s.particle(m, p)
    s.gravity(direction=(0, -1))
    s.torque(tau, on=second, reaction=th1)
    return s


def kinds(s: lg.System) -> dict[str, str | None]:
    relative = s.derive().steps[1].expressions["relative"]
    return {c.func.__name__: None if to is None else to.func.__name__ for c, to in relative.items()}


def test_step_0_says_why_it_is_holonomic() -> None:
    step = arm(relative=True).derive().steps[0]
    assert step.expressions == {"holonomic": True, "GC": 2, "DDOF": 2}
    assert "#GC = #DDOF = 2" in str(step.reasons[0])


@pytest.mark.parametrize(("relative", "to"), [(True, "theta1"), (False, None)])
def test_an_angle_is_relative_when_every_direction_with_it_holds_another(relative: bool, to: str | None) -> None:
    assert kinds(arm(relative=relative)) == {"theta1": None, "theta2": to}


@pytest.mark.parametrize(("relative", "to"), [(True, "x1"), (False, None)])
def test_a_length_is_relative_when_its_body_is_carried_along(relative: bool, to: str | None) -> None:
    assert kinds(carts(relative=relative)) == {"x1": None, "x2": to}


def test_the_nearest_carrier_is_named_in_a_chain() -> None:
    s = lg.System("chain")
    a, b, c = s.coordinates("a b c")
    m = s.parameters("m")
    for i, x in enumerate((a, a + b, a + b + c), 1):
        s.particle(m, s.origin + (x, 0), name=f"block {i}")
    assert kinds(s) == {"a": None, "b": "a", "c": "b"}


def test_a_frame_in_space_is_measured_from_the_frame_that_carries_it() -> None:
    s = lg.System("gimbal")
    a, b = s.coordinates("a b")
    m, L = s.parameters("m L")
    outer = s.frame(a, axis=(0, 0, 1))
    inner = s.frame(b, axis=(1, 0, 0), parent=outer)
    s.particle(m, inner.point(0, L, L))
    assert kinds(s) == {"a": None, "b": "a"}


def test_a_pendulums_angle_on_a_cart_is_absolute() -> None:
    s = lg.System("cart and pendulum")
    x, th = s.coordinates("x theta")
    M, m, L = s.parameters("M m L")
    cart = s.origin + (x, 0)
    s.particle(M, cart)
    s.particle(m, cart + (L * sin(th), -L * cos(th)))
    assert kinds(s) == {"x": None, "theta": None}


def test_a_block_on_a_wedge_is_measured_from_the_wedge() -> None:
    s = lg.System("wedge")
    X, u = s.coordinates("X u")
    M, m, al = s.parameters("M m alpha")
    s.particle(M, s.origin + (X, 0))
    s.particle(m, s.origin + (X + u * cos(al), -u * sin(al)))
    assert kinds(s) == {"X": None, "u": "X"}


@pytest.mark.parametrize("relative", [True, False])
def test_example_2_has_the_lectures_forces(relative: bool) -> None:
    s = arm(relative=relative)
    d, tau = s.derive(), s["tau"]
    expected = (0, tau) if relative else (-tau, tau)
    assert tuple(d.Xi.values()) == expected


def test_the_box_explains_why_a_pair_cancels() -> None:
    d = arm(relative=True).derive()
    first, second = d.steps[6].reasons
    assert "inside the box and move together: the pair cancels" in str(first)
    assert "inside the box" in str(second) and "outside: it counts" in str(second)


@pytest.mark.parametrize("relative", [True, False])
def test_example_3_comes_out_as_the_lecture_prints_it(relative: bool) -> None:
    s = carts(relative=relative)
    d = s.derive()
    x1, x2, m1, m2, k, b, F = (s[n] for n in ["x1", "x2", "m1", "m2", "k", "b", "F"])
    a1, a2, v1, v2 = x1.diff(s.t, 2), x2.diff(s.t, 2), x1.diff(), x2.diff()
    if relative:
        expected = [(m1 + m2) * a1 + m2 * a2, m2 * a1 + m2 * a2 + k * x2 + b * v2 - F]
    else:
        pull = k * (x1 - x2) + b * (v1 - v2) + F
        expected = [m1 * a1 + pull, m2 * a2 - pull]
    for equation, e in zip(d.equations, expected, strict=True):
        assert sp.expand(equation.lhs - equation.rhs - e) == 0


def test_dampers_agree_by_rayleigh_by_the_fake_spring_and_by_virtual_work() -> None:
    d = carts(relative=False).derive()
    assert all(check.holds for check in d.steps[6].checked)
    assert any("fake spring" in str(check.what) for check in d.steps[6].checked)


def test_every_element_is_in_the_ledger_once() -> None:
    s = carts(relative=True)
    d = s.derive()
    assert [row.element for row in d.ledger] == [e.title for e in s.elements]
    assert [row.column for row in d.ledger] == ["T*", "T*", "V", "Ξ", "Ξ"]


def test_a_term_is_traced_to_the_elements_that_make_it() -> None:
    s = carts(relative=True)
    d = s.derive()
    x1, k, x2, F = s["x1"], s["k"], s["x2"], s["F"]
    inertia = {(o.element.title, o.coordinate, o.step) for o in d.where(s["m1"] * x1.diff(s.t, 2))}
    assert inertia == {
        ("particle 'cart 1'", "x1", 2),
        ("particle 'cart 2'", "x1", 2),
        ("particle 'cart 2'", "x2", 2),
    }
    assert [(o.element.title, o.coordinate, o.share, o.step) for o in d.where(k * x2)] == [
        ("spring 'k'", "x2", k * x2, 3)
    ]
    assert [(o.element.title, o.share) for o in d.where(F)] == [("force 'F'", F)]


def test_every_term_of_every_equation_has_a_source() -> None:
    for s in (carts(relative=True), carts(relative=False), arm(relative=True)):
        for row in s.derive().terms:
            assert row and all(term.elements for term in row)


def test_the_matrix_form_is_the_equations() -> None:
    s = arm(relative=True)
    d = s.derive()
    q = sp.Matrix(d.coordinates)
    v, a = q.diff(s.t), q.diff(s.t, 2)
    left = d.mass_matrix * a + d.coriolis_matrix * v + d.gravity_vector - d.generalized_forces
    for i, equation in enumerate(d.equations):
        difference = sp.expand(sp.expand_trig(left[i] - equation.lhs + equation.rhs))
        assert sp.trigsimp(difference) == 0


def test_inertia_about_the_centre_of_mass_counts_beside_its_velocity() -> None:
    """A uniform rod about its end: J = m L²/12 and the centre at L/2 give m L²/3 (Steiner)."""
    s = lg.System("rod")
    th = s.coordinates("theta")
    m, L = s.parameters("m L")
    s.rigid_body(m, m * L**2 / 12, at=s.origin + (L / 2 * cos(th), L / 2 * sin(th)), frame=th)
    assert sp.expand(s.derive().T - m * L**2 * th.diff() ** 2 / 6) == 0


def test_prescribed_motion_is_said_to_depend_on_time() -> None:
    s = lg.System("driven pivot")
    th = s.coordinates("theta")
    m, L, A, Om = s.parameters("m L A Omega")
    s.particle(m, s.origin + (L * sin(th), A * cos(Om * s.t) - L * cos(th)))
    s.gravity()
    d = s.derive()
    assert any("rheonomic" in str(item) for item in d.steps[0].items)
    g = s["g"]
    expected = m * L**2 * th.diff(s.t, 2) + m * L * (g - A * Om**2 * cos(Om * s.t)) * sin(th)
    assert sp.simplify(d.equations[0].lhs - d.equations[0].rhs - expected) == 0


def test_definitions_of_constants_stay_named_in_the_equations() -> None:
    s = lg.System("named")
    th = s.coordinates("theta")
    La, Lb, m = s.parameters("L_a L_b m")
    Lab = s.define("L_ab", La + Lb)
    s.particle(m, s.origin + (Lab * cos(th), Lab * sin(th)))
    assert m * Lab**2 * th.diff() ** 2 / 2 == s.derive().T


def test_from_energies_gives_the_same_as_from_elements() -> None:
    """Goldstein, Classical Mechanics, 3rd ed., section 1.6: the Atwood machine without pulley mass."""
    x = sp.Function("x")(sp.Symbol("t"))
    m1, m2, g = sp.symbols("m1 m2 g")
    s = lg.System.from_energies([x], T=(m1 + m2) * x.diff() ** 2 / 2, V=-m1 * g * x + m2 * g * x)
    (equation,) = s.derive().equations
    solved = sp.solve(sp.expand(equation.lhs - equation.rhs), x.diff(s.t, 2))[0]
    assert sp.simplify(solved - (m1 - m2) / (m1 + m2) * g) == 0


@pytest.mark.slow
def test_detail_takes_the_time_derivative_term_by_term() -> None:
    """Against SymPy: each term's derivative is its own, and they add up to d/dt(∂L/∂ξ̇)."""
    s = arm(relative=True)
    usual, full = s.derive(), s.derive(detail="full")
    assert len(full.steps[5].items) > len(usual.steps[5].items)
    taken = [
        item.sides
        for item in full.steps[5].items
        if isinstance(item, Formula) and isinstance(item.sides[0], Total) and isinstance(item.sides[0].of, sp.Expr)
    ]
    whole = sp.S.Zero
    for left, right in taken:
        assert isinstance(left, Total) and isinstance(right, Terms)
        result = sp.Add(*[t for t in right.terms if isinstance(t, sp.Expr)])
        assert sp.simplify(sp.diff(left.of, s.t) - result) == 0
        whole += result
    momenta = sum(sp.diff(sp.diff(full.L, q.diff(s.t)), s.t) for q in full.coordinates)
    assert sp.simplify(sp.expand(sp.expand_trig(momenta - whole))) == 0
    with pytest.raises(lg.ModelError, match="there is no level of detail 'ful'"):
        s.derive(detail="ful")  # type: ignore[arg-type]


def test_detail_adds_nothing_where_only_a_rate_moves() -> None:
    s = lg.System("mass")
    x = s.coordinate("x")
    s.particle(s.parameter("m"), s.origin + (x, 0))
    assert len(s.derive(detail="full").steps[5].items) == len(s.derive().steps[5].items)
