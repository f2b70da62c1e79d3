"""Lines of virtual work, δW = F δx − b ẋ δx, are judged: a wrong one is a wrong Ξ."""

import pytest
import sympy as sp
from small_systems import cart

import lagrangian as lg
from built_in import derivation
from lagrangian import System

ROWS = """(M + m) x'' + m l theta'' cos(theta) - m l theta'^2 sin(theta) = F - b x'
m l x'' cos(theta) + (J + m l^2) theta'' - m g l sin(theta) = 0
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "work",
    [
        "δW = F δx - b x' δx",
        "δW = (F - b x') δx + 0 δtheta",
        "friction: δW = -b x' δx",
        "δW = (F - b x') δx + m g l sin(theta) δtheta",
        "δW_F = F δx",
        r"\[ \delta W = F\,\delta x - b\dot x\,\delta x \]",
    ],
)
def test_a_virtual_work_of_some_forces_or_of_all_is_right(work: str) -> None:
    assert derivation("cart-pole").check(f"{work}\n{ROWS}" if "\\" not in work else work + _latex()).right


def test_displacements_may_be_spelled_where_words_say_that_they_are_virtual() -> None:
    above = "Principle of virtual work:\ndelta x_P = delta x + l cos(theta) delta theta\n"
    right, wrong = (derivation("cart-pole").check(above + x) for x in (ROWS, ROWS.replace("F - b", "F + b")))
    assert right.right and not wrong.right
    assert not any("'delta'" in str(note) for v in (right, wrong) for note in v.notes)


@pytest.mark.parametrize(
    ("work", "told"),
    [
        ("δW = F δx + b x' δx", "Damper 'b' has the wrong sign."),
        ("δW = -F δx - b x' δx", "Force 'F' has the wrong sign."),
        ("δW = F δx - m x' δx", "In the term -m*x', m stands in place of b."),
        ("friction: δW = b x' δx", "Damper 'b' has the wrong sign."),
        (
            "δW = F δx - b x' δx - m g l sin(theta) δtheta",
            "In line 1 (Ξ of theta), -g*l*m*sin(theta) has the wrong sign.",
        ),
    ],
)
def test_a_wrong_virtual_work_is_told_above_right_equations(work: str, told: str) -> None:
    verdict = derivation("cart-pole").check(f"{work}\n{ROWS}")
    assert not verdict.right
    assert verdict.motion
    assert [f.line.number for f in verdict.findings if not f.status.right] == [1]
    assert [str(m.what) for m in verdict.mistakes] == [told]


def test_what_follows_from_a_wrong_virtual_work_is_told_by_it() -> None:
    wrong = ROWS.replace("- b x'", "+ b x'")
    verdict = derivation("cart-pole").check("δW = F δx + b x' δx\n" + wrong)
    assert [(f.line.number, f.follows) for f in verdict.findings if not f.status.right] == [(1, False), (2, True)]


@pytest.mark.parametrize("work", ["δW = F δx - b x' δx", "dW = F dx - b x' dx", "dW = (F - b*x')*dx"])
def test_the_virtual_work_of_all_forces_states_every_generalized_force(work: str) -> None:
    verdict = derivation("cart-pole").check(f"{work}\n{ROWS}")
    told = [(f.line.number, f.line.name, f.status.right) for f in verdict.findings if f.line.kind == "Xi"]
    assert told == [(1, "x", True), (1, "theta", True)]


def test_a_force_that_is_counted_for_another_coordinate_is_told_in_differentials() -> None:
    rows = ROWS.replace("sin(theta) = 0", "sin(theta) = F l cos(theta)")
    verdict = derivation("cart-pole").check("dW = F dx - b x' dx + F l cos(theta) dtheta\n" + rows)
    told = [(f.line.number, f.line.name, f.follows) for f in verdict.findings if not f.status.right]
    assert told == [(1, "theta", False), (3, None, True)]
    assert "where it does no work" in str(verdict.mistakes[0].what)


def test_an_energy_that_is_stated_again_follows_from_the_first_time() -> None:
    text = """T = 1/2 M x'^2 + 1/2 m ((x' - l cos(theta) theta')^2 + (l sin(theta) theta')^2) + 1/2 J theta'^2
    V = m g l cos(theta)
    T = 1/2 (M + m) x'^2 - m l x' theta' cos(theta) + 1/2 (J + m l^2) theta'^2"""
    verdict = derivation("cart-pole").check(text)
    assert [(f.line.number, f.follows) for f in verdict.findings if not f.status.right] == [(1, False), (3, True)]


def test_a_force_with_a_potential_is_compared_with_all_forces_where_no_V_is_stated() -> None:
    text = "T = 1/2 (M + m) x'^2 + m l x' theta' cos(theta) + 1/2 (J + m l^2) theta'^2\nQ_theta = m g l cos(theta)\n"
    verdict = derivation("cart-pole").check(text + "Q_x = F - b x'\n" + ROWS.replace("g l sin", "g l cos"))
    wrong = next(f for f in verdict.findings if f.line.number == 2)
    assert [str(d.term) for d in wrong.differences] == ["g*l*m*sin(theta(t))"]


def test_beside_a_constraint_only_a_term_beside_its_right_one_is_told() -> None:
    s = System("rope on a drum")
    phi, x = s.coordinates("phi x")
    J, m, R, c, b, g = s.parameters("J m R c b g")
    tau = s.input("tau")
    s.kinetic(J * phi.diff() ** 2 / 2 + m * x.diff() ** 2 / 2)
    s.potential(-m * g * x)
    s.torque(tau, on=phi)
    s.damper(b=c, deflection=phi)
    s.damper(b=b, deflection=x)
    s.constraint(x - R * phi)
    rows = "x = R phi\n(J + m R^2) phi'' = tau - c phi' - b R^2 phi' + m g R\n"
    check = s.derive().check
    assert check(rows).right
    assert check("δW = (tau - c phi' - b R^2 phi') δphi\n" + rows).right
    assert not check("δW = (tau - phi') δphi\n" + rows).right


def _latex() -> str:
    return (
        r"\[ (M + m)\ddot x + ml\ddot\theta\cos\theta - ml\dot\theta^2\sin\theta = F - b\dot x \]"
        r"\[ ml\ddot x\cos\theta + (J + ml^2)\ddot\theta - mgl\sin\theta = 0 \]"
    )


def test_the_equations_in_dalemberts_principle_are_judged() -> None:
    principle = (
        "((M + m) x'' + m l cos(theta) theta'' - m l sin(theta) theta'^2 + b x' - F) δx"
        " + (m l cos(theta) x'' + (J + m l^2) theta'' - m g l sin(theta)) δtheta = 0\n"
    )
    cart = derivation("cart-pole")
    assert cart.check(principle + ROWS).right
    verdict = cart.check(principle.replace("+ b x'", "- b x'") + ROWS)
    assert [f.line.number for f in verdict.findings if not f.status.right] == [1]
    assert cart.check("inertia of rotation: -(J + m l^2) theta'' δtheta\n" + ROWS).right


def test_dalemberts_principle_alone_holds_all_equations() -> None:
    """The virtual displacements are independent, so that each of their factors is 0."""
    masses = "- M x'' δx - m (x'' + l θ'' cos θ - l θ'² sin θ)(δx + l cos θ δθ)"
    principle = f"(F - b x') δx {masses} + m (l θ'' sin θ + l θ'² cos θ)(-l sin θ δθ) + m g l sin θ δθ - J θ'' δθ = 0"
    cart = derivation("cart-pole")
    verdict = cart.check(principle)
    assert verdict.right and "what multiplies each of them" in str(verdict)
    for old, new in (
        ("- b x'", "+ b x'"),
        ("+ m g", "- m g"),
        (" - J θ'' δθ", ""),
        ("δx + l cos θ δθ", "δx"),
        ("= 0", ""),
    ):
        assert not cart.check(principle.replace(old, new)).right, new


def test_virtual_works_that_alone_state_the_forces_hold_all_of_them() -> None:
    energies = "T = 1/2 (M + m) x'^2 + m l x' theta' cos(theta) + 1/2 (J + m l^2) theta'^2\nV = m g l cos(theta)\n"
    cart = derivation("cart-pole")
    assert cart.check(energies + "δW = F δx - b x' δx").right
    assert cart.check(energies + "push: δW_1 = F δx\nfriction: δW_2 = -b x' δx").right
    (mistake,) = cart.check(energies + "δW = F δx").mistakes
    assert "Damper" in str(mistake.what) and "is missing" in str(mistake.what)


PRINCIPLE = r"""\begin{align*}
\delta W ={}& -\bigl[(M+m)\ddot x+ml(\ddot\phi\cos\phi-\dot\phi^2\sin\phi)\bigr]\delta x-k\,e\,\delta e\\
&-\bigl[ml\ddot x\cos\phi+ml^2\ddot\phi\bigr]\delta\phi-mg\,\delta h=0 .
\end{align*}
Here $e=x$ and $h=-l\cos\phi$, so \[ \delta e=\delta x,\qquad \delta h=l\sin\phi\,\delta\phi . \]
\begin{align*}
\delta x:&\quad (M+m)\ddot x+ml(\ddot\phi\cos\phi-\dot\phi^2\sin\phi)+ke=0\\
\delta\phi:&\quad ml\ddot x\cos\phi+ml^2\ddot\phi+mgl\sin\phi=0
\end{align*}"""


def test_a_principle_over_several_rows_is_one_and_its_own_displacements_are_written_out() -> None:
    """A row that begins with a minus at the mark behind = goes on; δh is that of the height h that is defined below."""
    assert cart().check(PRINCIPLE).right
    for right, wrong in (
        ("-k\\,e", "+k\\,e"),
        ("-mg\\,", "+mg\\,"),
        ("\\phi\\bigr]\\delta\\phi", "\\phi/2\\bigr]\\delta\\phi"),
    ):
        verdict = cart().check(PRINCIPLE.replace(right, wrong))
        assert {f.line.number for f in verdict.findings if not f.status.right} <= {2, 3}
        assert not verdict.right
    assert not cart().check(PRINCIPLE.replace("+mgl", "-mgl")).right
    assert not cart().check(PRINCIPLE.replace("+ke=0", "-ke=0")).right


def test_equations_below_each_other_that_begin_with_a_minus_are_two() -> None:
    first = r"(M+m)\ddot x+ml(\ddot\phi\cos\phi-\dot\phi^2\sin\phi) ={}& -kx"
    second = r"& -l\ddot\phi-\ddot x\cos\phi-g\sin\phi=0"
    assert cart().check(rf"\begin{{align}} {first}\\ {second} \end{{align}}").right
    assert not cart().check(rf"\begin{{align}} {first}\\ {second.replace('-g', '+g')} \end{{align}}").right


WORK_OF_DELTA = r"""\[ \delta W_M = M\,\delta\delta, \]
\[ \delta W_c = -c\dot\delta\,\delta \delta + N \sin(\delta)\,\delta x \]
\[ m\ddot x = N\sin\delta, \qquad J\ddot\delta + c\dot\delta = M \]
"""


def _rudder() -> lg.Derivation:
    s = System("a ship's rudder, whose angle is δ")
    x, delta = s.coordinates("x delta")
    m, J, c = s.parameters("m J c")
    at = s.point("C", (x, 0))
    s.particle(m, at=at, name="ship")
    s.kinetic(J * delta.diff() ** 2 / 2, name="rudder")
    s.damper(c, deflection=delta, name="bearing")
    s.force(s.input("M"), deflection=delta, name="motor")
    s.force((s.input("N") * sp.sin(delta), 0), at=at, name="flow")
    return s.derive()


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("", "", 0),
        (r"M\,\delta\delta", r"-M\,\delta\delta", 1),
        (r"-c\dot\delta\,\delta \delta", r"c\dot\delta\,\delta \delta", 2),
        (r"N \sin(\delta)\,\delta x", r"N \cos(\delta)\,\delta x", 2),
    ],
)
def test_displacements_of_a_coordinate_that_is_called_delta(old: str, new: str, line: int) -> None:
    verdict = _rudder().check(WORK_OF_DELTA.replace(old, new) if old else WORK_OF_DELTA)
    assert verdict.right is (line == 0), verdict.to_text()
    assert {f.line.number for f in verdict.findings if not f.status.right} == ({line} if line else set())


def _pushed_at_an_angle() -> System:
    sys = System("block and wheel, pushed at an angle delta")
    x, theta = sys.coordinate("x"), sys.coordinate("theta")
    m, J, k, delta = sys.parameters("m J k delta")
    F = sys.input("F")
    sys.particle(m, at=sys.point("P", (x, 0)))
    sys.kinetic(J * theta.diff() ** 2 / 2)
    sys.spring(k, deflection=x - theta)
    sys.force(F * sp.cos(delta), deflection=x)
    return sys


@pytest.mark.parametrize(
    ("said", "virtual"),
    [("Virtual work", True), ("d'Alembert", True), ("virtuelle Arbeit", True), ("small terms", False)],
)
def test_displacements_beside_an_angle_delta(said: str, virtual: bool) -> None:
    rows = "m x'' = F cos δ - k (x - θ)\nJ θ'' = k (x - θ)"
    verdict = _pushed_at_an_angle().check(f"{said}: (F cos δ - k (x - θ)) δx + k (x - θ) δθ\n{rows}")
    assert verdict.right
    assert any("δx as δ x" in str(note) for note in verdict.notes) is not virtual
