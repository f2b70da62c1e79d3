"""Right equations of motion beside a line that is not right: this is said first, and which line disagrees."""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from built_in import derivation
from student_answers import CART, POLE

YOKE = "J theta'' = tau - lambda r sin(theta)\nM x'' = -lambda\nx = r cos(theta)"


def said(verdict: lg.Verdict) -> str:
    """The first sentences in one line, as they are printed."""
    return " ".join(verdict.to_text().split("Line by line")[0].split())


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("above", "first"),
    [
        ("V = m g l cos(theta)/2", "Line 1 (V) does not agree with them: ½ m g l cos θ should be m g l cos θ."),
        ("Xi_x = F + b x'", "Line 1 (Ξ of x) does not agree with them: b ẋ has the wrong sign."),
        (CART.replace("M + m", "M"), "Line 1 does not agree with them: the term m ẍ is missing."),
        ("V = m g l\nXi_x = 2 F", "Line 1 (V) and line 2 (Ξ of x) do not agree with them."),
    ],
)
def test_what_is_right_is_said_first(above: str, first: str) -> None:
    verdict = derivation("cart-pole").check(f"{above}\n{CART}\n{POLE}")
    assert verdict.status == "wrong" and verdict.motion
    assert f"Your equations of motion are right. {first}" in said(verdict)


@pytest.mark.parametrize("rows", [f"{CART}\n{POLE.replace('- m g', '+ m g')}", CART, f"{CART}\n{POLE}\nx'' = F/M"])
def test_fewer_equations_or_a_wrong_one_at_the_end_are_not_right(rows: str) -> None:
    verdict = derivation("cart-pole").check(f"V = m g l\n{rows}")
    assert not verdict.motion and "equations of motion are right" not in said(verdict)


@pytest.fixture(scope="module")
def yoke() -> lg.Derivation:
    """A crank whose pin runs in the slot of a yoke."""
    s = lg.System("yoke")
    theta, x = s.coordinates("theta x")
    J, M, r = s.parameters("J M r")
    tau = s.inputs("tau")
    crank = s.frame(theta, name="crank")
    s.rigid_body(mass=0, inertia=J, at=s.origin, frame=crank, name="crank")
    s.particle(M, at=s.point("yoke", (x, 0)), name="yoke")
    s.torque(tau, on=crank)
    s.constraint(x - r * sp.cos(theta), name="pin")
    return s.derive()


F = "x - r cos(theta) = 0"


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("answer", "right"),
    [
        (f"J theta'' = tau - lambda r sin(theta)\nM x'' = lambda\n{F}", [False, True, True]),
        (f"J theta'' = tau + lambda r\nM x'' = lambda\n{F}", [False, True, True]),
        (f"J theta'' = tau + lambda r sin(theta)\nM x'' = -lambda\n{F}", [True, False, True]),
        (f"{{J theta'' = lambda r sin(theta) - tau, M x'' = lambda, {F}}}", [False, True, True]),
    ],
)
def test_the_stated_constraint_fixes_the_multiplier(yoke: lg.Derivation, answer: str, right: list[bool]) -> None:
    """Of f = 0 comes λ ∂f/∂ξ: no other λ makes a wrong equation right, also where all stand in one line."""
    verdict = yoke.check(answer)
    assert [f.status.right for f in verdict.findings] == right and len(verdict.mistakes) == 1
    opposite = yoke.check(answer.replace("lambda", "(-mu)"))
    assert [f.status.right for f in opposite.findings].count(False) == 1


def test_equations_with_a_multiplier_are_right_beside_a_wrong_energy(yoke: lg.Derivation) -> None:
    d = yoke
    found = d.check(f"T = J theta'^2/2 + M x'^2\n{YOKE}")
    assert found.motion and "right. Line 1 (T*) does not agree with them" in said(found)
    wrong = d.check(f"T = J theta'^2/2 + M x'^2\n{YOKE.replace('= tau -', '= tau +')}")
    assert not wrong.motion


def test_a_hint_of_level_one_names_the_line_alone() -> None:
    verdict = derivation("cart-pole").check(f"V = m g l\n{CART}\n{POLE}", hint=1)
    assert "Line 1 (V) does not agree with them." in said(verdict) and verdict.to_dict()["motion"]
    hidden = derivation("cart-pole").check(f"V = m g l\n{CART}\n{POLE}", hint=0)
    assert "equations of motion" not in said(hidden) and "motion" not in hidden.to_dict()


def hoist() -> lg.Derivation:
    """A rotor phi_m with a torque, an elastic shaft, and a drum phi_1 with friction and a weight."""
    s = lg.System("hoist")
    phi_m, phi_1 = s.coordinates("phi_m phi_1")
    J_m, m, R, c, d, g = s.parameters("J_m m R c d g")
    rotor = s.frame(phi_m, name="rotor")
    s.rigid_body(mass=0, inertia=J_m, at=s.origin, frame=rotor, name="rotor")
    s.particle(m, at=s.point("weight", (0, R * phi_1)), name="weight")
    s.gravity((0, -1), g)
    s.spring(k=c, deflection=phi_m - phi_1)
    s.damper(d, deflection=phi_1)
    s.torque(s.inputs("tau"), on=phi_m)
    return s.derive()


HOIST = "J_m phi_m'' + c (phi_m - phi_1) = tau\nm R^2 phi_1'' - c (phi_m - phi_1) + m g R = -d phi_1'"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("above", "right"),
    [
        ("Q_m = tau\nQ_1 = -d phi_1'", True),  # by the ends of names, since Q_m is
        ("Q_1 = tau\nQ_2 = -d phi_1'", True),  # by numbers alone
        ("Q_m = tau\nQ_1 = d phi_1'", False),
        ("D = d phi_1'^2/2\nQ_m = Q_1 = 0", False),
        ("T = J_m phi_m'^2/2 + m R^2 phi_1'^2/2\nV = c (phi_m - phi_1)^2/2\nQ_m = tau\nQ_1 = -d phi_1' - m g R", True),
        ("T = J_m phi_m'^2/2 + m R^2 phi_1'^2/2\nV = c (phi_m - phi_1)^2/2\nQ_m = tau\nQ_1 = -d phi_1' + m g R", False),
        ("L = J_m phi_m'^2/2 + m R^2 phi_1'^2/2 - c (phi_m - phi_1)^2/2\nQ_m = tau\nQ_1 = -d phi_1' - m g R", True),
        ("L = J_m phi_m'^2/2 + m R^2 phi_1'^2/2 - c (phi_m - phi_1)^2/2\nQ_m = tau\nQ_1 = -d phi_1'", False),
    ],
)
def test_forces_are_called_by_names_and_right_with_the_energies_beside_them(above: str, right: bool) -> None:
    verdict = hoist().check(f"{above}\n{HOIST}")
    assert verdict.right is right and (right or verdict.motion)


BEAD = "m s'' - m alpha'^2 s + m g sin(alpha) + k s = 0\n\n"


@cache
def tilted() -> lg.Derivation:
    """A bead on a rail that a servo tilts."""
    system = lg.System("tilted rail")
    s = system.coordinates("s")
    m, k, A, W, g = system.parameters("m k A W g")
    alpha = system.define("alpha", A * sp.sin(W * system.t))
    system.particle(m, at=system.point("bead", (s * sp.cos(alpha), s * sp.sin(alpha))))
    system.gravity((0, -1), g)
    system.spring(k=k, deflection=s)
    return system.derive()


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("line", "right"),
    [
        ("For small A: m s'' + k s = -m g A sin(W t)", True),
        ("With alpha small: m s'' - m alpha'^2 s + m g alpha + k s = 0", True),
        ("Linearised: s'' + k/m s = -g alpha", True),
        ("Small tilts, sin(alpha) = alpha and alpha'^2 = 0: m s'' + m g alpha + k s = 0", True),
        ("cos(alpha) = 1 for small tilts.", True),
        ("For small A: m s'' + k s = m g A sin(W t)", False),
        ("For small A: m s'' + k s = -m A sin(W t)", False),
        ("For small A: m s'' + k s = 0", False),
        ("For small W: m s'' + m g sin(alpha) + k s = 0", False),
        ("cos(alpha) = alpha for small tilts.", False),
        ("For small tilts, sin(alpha) = 1.", False),
    ],
)
def test_a_prescribed_angle_may_be_small(line: str, right: bool) -> None:
    assert tilted().check(BEAD + line, hint=0).right is right


def test_equations_for_a_small_prescribed_angle_alone_are_not_right() -> None:
    assert not tilted().check("m s'' + k s = -m g A sin(W t)", hint=0).right
    assert not tilted().check("For small A:\nm s'' - m alpha'^2 s + m g alpha + k s = 0", hint=0).right


PENDULUM = "m L^2 theta'' + m g L sin(theta) + b theta' = 0"


@pytest.mark.parametrize(
    "sheet",
    [
        "T = 1/2 m L^2 theta'^2\nV = -m g L cos(theta)\nT = 1/2 m L^2 theta'^2",
        "v = L theta'\nT = m/2*abs(v)^2\nT = m*L^2*theta'^2/2",
    ],
    ids=["letters that are units", "speed of its own"],
)
def test_an_energy_that_is_stated_twice_is_judged_twice(sheet: str) -> None:
    """Neither are m L units because the wrong one is none in numbers, nor is T another name."""
    assert derivation("pendulum").check(f"{sheet}\n{PENDULUM}", hint=0).right
    above, _, below = sheet.rpartition("L^2")
    assert not derivation("pendulum").check(f"{above}L{below}\n{PENDULUM}", hint=0).right


ALL_FORCES = "Q_x = F - b x', Q_theta = m g l sin theta"
GIBBS = "S = 1/2 M x''^2 + 1/2 (J + m l^2) theta''^2 + m l x'' theta'' cos theta\n"


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    "sheet",
    [
        f"{GIBBS}{ALL_FORCES}\n{CART}\n{POLE}",
        f"{GIBBS}{ALL_FORCES}   [from V = m g l cos theta]\ndS/dx'' = Q_x\n{CART}\ndS/dtheta'' = Q_theta\n{POLE}",
        f"Virtual work of all forces: {ALL_FORCES}\n{CART}\n{POLE}",
        f"V = m g l cos theta\n{ALL_FORCES}\nd/dt dT/dtheta' - dT/dtheta = Q_theta\n{CART}\n{POLE}",
    ],
)
def test_forces_with_those_of_the_potential_are_right_where_nothing_else_accounts_for_it(sheet: str) -> None:
    pole = derivation("cart-pole")
    assert pole.check(sheet, hint=0).right
    assert not pole.check(sheet.replace("Q_theta = m", "Q_theta = - m"), hint=0).right
    assert not pole.check(sheet.replace("- m g l sin", "+ m g l sin"), hint=0).right
    assert not pole.check(
        f"L = 1/2 (M + m) x'^2 + m l x' theta' cos theta - m g l cos theta + 1/2 (J + m l^2) theta'^2\n{sheet}", hint=0
    ).right


def test_a_potential_above_such_forces_counts_its_forces_twice() -> None:
    pole = derivation("cart-pole")
    assert not pole.check(f"V = m g l cos theta\n{ALL_FORCES}\n{CART}\n{POLE}", hint=0).right
    assert not pole.check(f"{ALL_FORCES}\nd/dt dL/dtheta' - dL/dtheta = Q_theta\n{CART}\n{POLE}", hint=0).right
