"""What people type beside equations, and how programs and other schools write them, is read or told.

Oracle: the equations of a pendulum, of a bead in a turning tube and of a plate of a condenser, by hand:

    m L² θ̈ + b θ̇ + m g L sin θ = 0
    m r̈ − m r φ̇² + k (r − l₀) = 0,   (J + m r²) φ̈ + 2 m r ṙ φ̇ = τ
    m ẍ + b ẋ + k x − q²/(2 ε A) = 0
"""

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from built_in import derivation
from constrained_systems import smooth_puck
from lagrangian import Derivation, ParseError, System
from lagrangian.check.reading import parse_answer

BEAD = "m r'' - m r phi'^2 + k (r - l_0) = 0"
TUBE = "(J + m r^2) phi'' + 2 m r r' phi' = tau"


@cache
def bead() -> Derivation:
    """A bead on a spring in a tube that a motor turns about a vertical axle."""
    sys = System("bead in a turning tube")
    r, phi = sys.coordinate("r", positive=True), sys.coordinate("phi")
    m, J, k, l_0 = sys.parameters("m J k l_0", m=0.3, J=0.02, k=12, l_0=0.2)
    (t,) = r.args
    sys.kinetic(m * (r.diff(t) ** 2 + r**2 * phi.diff(t) ** 2) / 2 + J * phi.diff(t) ** 2 / 2)
    sys.spring(k, deflection=r, rest=l_0)
    sys.generalized_force(phi, sys.input("tau"))
    return sys.derive()


@cache
def plate(permittivity: str = "eps") -> Derivation:
    """A plate of a condenser on a spring, in a circuit with a coil, a resistor and a source."""
    sys = System("plate of a condenser")
    x, q = sys.coordinate("x"), sys.coordinate("q", unit="C")
    m, k, b, L_c, R, A, d = sys.parameters("m k b L_c R A d")
    eps = sys.parameter(permittivity)
    (t,) = x.args
    sys.kinetic(m * x.diff(t) ** 2 / 2 + L_c * q.diff(t) ** 2 / 2)
    sys.spring(k, deflection=x)
    sys.damper(b, deflection=x)
    sys.potential(q**2 * (d - x) / (2 * eps * A))
    sys.generalized_force(q, sys.input("u") - R * q.diff(t))
    return sys.derive()


@pytest.mark.sampled(4)
@pytest.mark.parametrize("permittivity", ["eps", "epsilon", "ε", "eps_0"])
@pytest.mark.parametrize("product", ["εA", "eps A", "ε₀A", "(epsilon*A)", "\\varepsilon A", "(2 epsA)/2"])
def test_greek_letters_are_read_in_full_or_shortened_next_to_others(permittivity: str, product: str) -> None:
    force = f"q^2/(2 {product})" if "\\" not in product else rf"\frac{{q^2}}{{2{product}}}"
    written = f"m x'' + b x' + k x = {force}" if "\\" not in product else rf"$m\ddot x + b\dot x + kx = {force}$"
    found = plate(permittivity).check(written)
    assert [f.status.value for f in found.findings] == ["right"], found.to_text()


def test_a_shortened_letter_that_the_answer_defines_or_that_is_a_product_is_none() -> None:
    sys = System("x")
    x = sys.coordinate("x")
    e, p, theta = sys.parameters("e p theta")
    sys.particle(e, at=sys.point("P", (x, 0)))
    sys.spring(p * theta, deflection=x)
    derived = sys.derive()
    assert derived.check("th = 3 e\n e x'' + p theta x + th - 3 e = 0", hint=0).right
    assert derived.check("e x'' + p th x = 0", hint=0).right
    assert not derived.check("ep x'' + p theta x = 0", hint=0).right


PENDULUM = "m L^2 theta'' + b theta' + m g L sin(theta)"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "written",
    [
        PENDULUM.replace("theta''", "thetadotdot").replace("theta'", "theta_dot") + " = 0",
        "eom_theta = " + PENDULUM,
        "residual = " + PENDULUM,
        "m L² D²θ + b Dθ + m g L sin θ = 0",
        "m L^2 D^2 theta + b D theta = -m g L sin(theta)".replace("D theta", "theta'"),
        "Pendulum: ΣM = m L^2 theta'':  -m g L sin(theta) - b theta' = m L^2 theta''",
        "$\\sum M = mL^2\\ddot\\theta = -b\\dot\\theta - mgL\\sin\\theta$",
        f"Name: Marie Curie        Student no.: 1234567\nDate: 12.05.2024\nHomework 4\n{PENDULUM} = 0",
        f"{PENDULUM} = 0. This is Newton's law.",
        f"Equation of motion: {PENDULUM} = 0",
        f"d/dt(m L^2 theta') worked out: {PENDULUM} = 0",
        f"We set T = 1/2 m L^2 theta'^2     kinetic\n{PENDULUM} = 0",
        f"N is the force in the rod (a pull) = m g\n{PENDULUM} = 0",
        f"(L sin θ, -L cos θ)\n{PENDULUM} = 0",
        "r = (L sin θ, -L cos θ)\nr' = (L θ' cos θ, L θ' sin θ)\nT = 1/2 m |r'|²\nV = -m g L cos θ",
        "v = (L θ' cos θ, L θ' sin θ)\nT = 1/2 m v²",
        "m L 2[L/2] theta'' + b [theta'] + m g L sin(theta) = 0",
        "ode1 := m*L^2*diff(theta(t),`$`(t,2)) + b*diff(theta(t),t) + m*g*L*sin(theta(t)) = 0:",
        "D = m L^2\ntheta'' = -(b theta' + m g L sin(theta))/D",
        "P = m g L\nm L^2 theta'' + b theta' + P sin(theta) = 0",
    ],
)
def test_the_pendulum_in_other_hands_is_right(written: str) -> None:
    verdict = derivation("pendulum").check(written)
    assert verdict.right, verdict.to_text()


@pytest.mark.parametrize(
    ("written", "told"),
    [
        ("(L sin θ, -L cos θ)", "it is a list without an equals sign"),
        ("theta' = sum of all rates", "was not read and not judged"),
        ("N is the force in the rod = m g", "nothing else uses rod"),
        ("E = 1/2 m L² θ'² + m g L", "nothing else uses E"),
        ("where the pull (of the rod) = m g", "one side consists of words"),
        ("r' = (L θ' cos θ, L θ' sin θ)", "nothing says what r is"),
    ],
)
def test_what_is_not_judged_is_told(written: str, told: str) -> None:
    verdict = derivation("pendulum").check(f"{written}\n{PENDULUM} = 0")
    assert verdict.right and told in " ".join(map(str, verdict.notes))


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "wrong",
    [
        "r = (L sin θ, -L cos θ)\nr' = (L θ' cos θ, -L θ' sin θ)\nT = 1/2 m L^2 θ'^2",
        "D = m L\ntheta'' = -(b theta' + m g L sin(theta))/D",
        "T = 1/2 m L^2 theta^2\nV = -m g L cos(theta)\nL = T - V",
        f"eom_theta = {PENDULUM} + m g",
        "m L² D²θ + b D²θ + m g L sin θ = 0",
    ],
)
def test_mistakes_in_other_hands_stay_wrong(wrong: str) -> None:
    assert not derivation("pendulum").check(wrong, hint=0).right


def test_lists_of_values_are_statements_in_any_sentence() -> None:
    values = "Numbers: m = 1 kg, L = 0,5 m, b=0.02 Ns/m (bearing), angle 30 deg, g=9.81"
    verdict = derivation("pendulum").check(f"{values}\n0,25 θ'' + 0,02 θ' + 4,905 sin θ = 0")
    assert verdict.right and "Line 1 was read as a list of values." in map(str, verdict.notes)
    assert not derivation("pendulum").check(f"{values}\n0,25 θ'' + 0,02 θ' + 4,9 sin θ = 0", hint=0).right
    other = derivation("pendulum").check("m = 2 kg, L = 2 m\n8 θ'' + b θ' + 4 g sin θ = 0")
    assert other.right and "Right if" in " ".join(map(str, other.notes))


@pytest.mark.slow
def test_coordinates_in_brackets_in_front_are_labels_where_they_are_no_factors() -> None:
    assert bead().check(f"(r)  {BEAD}\n(φ)  {TUBE}", hint=0).right
    assert not bead().check(f"(r)  {BEAD.replace(' = 0', ' = tau')}\n{TUBE}", hint=0).right
    assert "was read without '(r)'" in bead().check(f"(r) {BEAD}\n{TUBE}").to_text()


def test_general_equations_in_matrices_are_told() -> None:
    verdict = bead().check(f"matrix form M(q) q'' + h = f, q = [r; phi]\n{BEAD}\n{TUBE}")
    assert verdict.right and "nothing says what M and h are" in " ".join(map(str, verdict.notes))
    verdict = bead().check(
        "M(q) q'' = f\nM = [m, 0; 0, J + m r^2]\nf = [m r phi'^2 - k (r - l_0); tau - 2 m r r' phi']"
    )
    assert verdict.right


@pytest.mark.slow
def test_a_multiplier_takes_up_no_mistake() -> None:
    turn = "m r^2 theta'' + 2 m r r' theta' - m g r sin(theta) = 0\nr = R"
    for right in ("m r'' - m r theta'^2 + m g cos(theta) = lambda", "r'' = r theta'^2 - g cos(theta) + N/m"):
        assert smooth_puck().check(f"{right}\n{turn}", hint=0).right
    for wrong in ("m r'' + m g cos(theta) = lambda", "m r'' - m r theta'^2 - m g cos(theta) = lambda"):
        assert not smooth_puck().check(f"{wrong}\n{turn}", hint=0).right


def test_a_name_of_the_system_alone_on_the_right_is_no_energy() -> None:
    sys = System("x")
    x = sys.coordinate("x")
    m, k, R = sys.parameters("m k R")
    sys.particle(m, at=sys.point("P", (x, 0)))
    sys.spring(k, deflection=x, rest=R)
    assert sys.derive().check("m x''/(k) + x = R", hint=0).right


@pytest.mark.parametrize("written", ["foo bar", "2 foo"])
def test_unknown_terms_of_an_equation_are_no_words(written: str) -> None:
    with pytest.raises(ParseError):
        parse_answer(f"{PENDULUM} + {written} = 0", derivation("pendulum").model)


SLOPE = "m x'' + k x - m g sin(beta) = 0"


@cache
def slope() -> Derivation:
    """A cart of 2 kg on a slope of 25 degrees, with a spring of 30 N/m: m ẍ + k x = m g sin β = 8.2917703 N."""
    sys = System("cart on a slope")
    x = sys.coordinate("x")
    m, k, beta, g = sys.parameters("m k beta g", m="2 kg", k="30 N/m", beta="25 deg", g="9.81 m/s^2")
    (t,) = x.args
    sys.kinetic(m * x.diff(t) ** 2 / 2)
    sys.potential(k * x**2 / 2 - m * g * x * sp.sin(beta))
    return sys.derive()


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("written", "right"),
    [
        ("2 x'' + 30 x = 8.2917703", True),
        ("2 x'' + 30 x - 8,292 = 0", True),
        ("x'' = 4.1459 - 15 x", True),
        ("m=2, k=30, beta=25 deg, g=9.81: 2 x'' + 30 x = 8.29177", True),
        ("2 x'' + 30 x = 8.29", True),
        ("x'' = -15 x + 4.15", True),
        ("2 x'' + 30 x = 8.3", False),
        ("2 x'' + 30 x = 8.30", False),
        ("2 x'' + 30 x = 8.25", False),
        ("2.01 x'' + 30 x = 8.29", False),
        ("2 x'' + 8.29 x = 30", False),
        ("2 x'' - 30 x = 8.29", False),
        ("m x'' + k x = 8.29", False),
        ("4 x'' + 60 x = 8.29", False),
        ("2 x'' + 30 x = 8.2918703", False),
        ("2 x'' + 30 x = 8.2914", False),
        ("2 x'' + 30 x = 17.7819", False),
        ("2 x'' + 8.2918 x = 30", False),
        ("m x'' + k x = 8.2918", False),
        ("2.0001 x'' + 30 x = 8.2918", False),
    ],
)
def test_decimals_are_read_as_rounded_from_three_digits_on(written: str, right: bool) -> None:
    verdict = slope().check(written)
    assert verdict.right == right, verdict.to_text()
    assert not right or "as rounded." in " ".join(map(str, verdict.notes))


@pytest.mark.parametrize(
    ("written", "right"),
    [
        ("m x'' = m g sin(beta) - S\nS = k x", True),
        ("m x'' = H + m g sin(beta)\nH/2 = -k x/2", True),
        (f"m x'' = S1 - S2\nS1 + S2 = m g sin(beta) + k x\nS1 - m g sin(beta) = 0\n{SLOPE}", True),
        ("m x'' = m g sin(beta) - S\nS = -k x", False),
        (f"m x'' = S1 - S2\n{SLOPE.replace('sin', 'cos')}", False),
    ],
)
def test_forces_that_equations_determine_are_eliminated(written: str, right: bool) -> None:
    assert slope().check(written, hint=0).right == right


def test_a_force_that_nothing_determines_is_asked_about() -> None:
    with pytest.raises(ParseError, match="what is 'H'"):
        slope().check("m x'' = m g sin(beta) - S - H\nS = k x")


@pytest.mark.parametrize(
    "written",
    [
        "mL² θ̈ + b θ̇ + mgL sin θ = 0",
        "Paso 2. T = ½mL²θ̇²\nPaso 3. V = −mgL cos θ",
        "h = L(1 − cos θ)\nT = ½ m L² θ̇²\nV = mgh + 0·mḣ²",
        "L = ½mL²θ̇² + mgL cos θ\ndL/dθ' = m L² θ'        dL/dθ = -m g L sin θ",
        f"Since {PENDULUM} = 0 always, I get the motion at once:\nT = 1/2 m L^2 theta'^2",
        f"Balance of torques, f = hinge force * radius\n{PENDULUM} = 0",
        f"J_A = m L^2 ... used below\n{PENDULUM} = 0",
        f"angle (phi = 2 theta): {PENDULUM} = 0",
        "m L² θ̈ = −b θ̇ − m g L sin θ cosθ 1/cosθ",
        "2 m L² θ̇θ̈ = −2 b θ̇θ̇ − 2 m g L sinθ θ̇",
    ],
)
def test_letters_with_marks_and_words_around_the_pendulum_are_kept_apart(written: str) -> None:
    verdict = derivation("pendulum").check(written)
    assert verdict.right, verdict.to_text()


def test_a_factor_with_a_raised_digit_in_front_is_no_word() -> None:
    assert not derivation("pendulum").check("mL² mL² θ̈ + b θ̇ + mgL sin θ = 0", hint=0).right
    assert not derivation("pendulum").check("mg² m L² θ̈ + b θ̇ + mgL sin θ = 0", hint=0).right


RATE = "-g/L*sin(theta) - b/(m*L**2)*omega"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("written", "right"),
    [
        (f"def f(t, y):\n    theta, omega = y\n    return [omega, {RATE}]", True),
        (f"def f(t, y, p):\n    theta, omega = y\n    a = {RATE}\n    return np.array([omega,\n        a])", True),
        ("def f(t, y):\n    th, dth = y\n    ddth = -g/L*np.sin(th) - b/(m*L**2)*dth\n    return [dth, ddth]", True),
        (f"function dz = f(t, z)\n theta = z(1); \n omega = z(2);\n dz = [omega; {RATE}];\nend", True),
        ("function dz = f(t, z)\ndz = zeros(2,1);\ndz(1) = z(2);\ndz(2) = -g/L*sin(z(1)) - b/(m*L^2)*z(2);\nend", True),
        (f"def f(t, y):\n    theta, omega = y\n    dydt = [omega, {RATE}]\n    return dydt", True),
        (f"def f(t, y):\n    theta, omega = y\n    out = np.array([omega, {RATE}])\n    return out", True),
        (f"function dydt = f(t, y)\n theta = y(1); \n omega = y(2);\n dydt = [omega; {RATE}];\nend", True),
        (f"def f(t, y):\n    theta, omega = y\n    dydt = [2*omega, {RATE}]\n    return dydt", False),
        (f"def f(t, y):\n    omega, theta = y\n    dydt = [omega, {RATE}]\n    return dydt", False),
        (f"def f(t, y):\n    theta, omega = y\n    return [omega, {RATE.replace('- b', '+ b')}]", False),
        (f"def f(t, y):\n    theta, omega = y\n    return [2*omega, {RATE}]", False),
        (f"def f(t, y):\n    omega, theta = y\n    return [omega, {RATE}]", False),
        ("def f(t, y):\n    th, dth = y\n    return [dth, th]", False),
    ],
)
def test_functions_that_return_the_rates_of_a_state_are_read(written: str, right: bool) -> None:
    assert judged_right(written) == right


def judged_right(written: str) -> bool:
    """Whether an answer is judged right; one that is refused is not."""
    try:
        return derivation("pendulum").check(written, hint=0).right
    except ParseError:
        return False


def test_spelled_greek_letters_stand_beside_names() -> None:
    """The Python word lambda is a multiplier in an answer."""
    sys = System("bead on a line")
    x, y = sys.coordinates("x y")
    m, g, a = sys.parameters("m g a")
    sys.particle(m, sys.origin + (x, y))
    sys.gravity(g=g)
    sys.constraint(y - a * x, name="wire")
    own = sys.derive()
    assert own.check("m x'' = -lambda a\nm y'' = -m g + lambda\ny = a x", hint=0).right
    assert not own.check("m x'' = lambda a\nm y'' = -m g + lambda\ny = a x", hint=0).right
    with pytest.raises(ParseError):
        own.check("m x'' = lambda x: x")


def test_numbers_behind_a_letter_with_dots_are_no_factors() -> None:
    """q̇ has a combining dot, which is no letter."""
    plain, numbered = (parse_answer(f"m ẍ + k x = b q̇{n}", plate().model).equations for n in ("", "  (2)"))
    assert [(x.lhs, x.rhs) for x in plain] == [(x.lhs, x.rhs) for x in numbered]


def test_a_quarter_in_a_formula_is_no_value_of_a_parameter() -> None:
    """The ¼ of an energy of a rolling disc, in a system in which a length is 0.25 m: nothing is read as that length."""
    s = lg.System("disc on a plank")
    x = s.coordinate("x")
    m, k = s.parameters("m k")
    s.parameter("r", 0.25)
    s.particle(m, at=s.point("C", (x, 0)), name="disc")
    s.kinetic(m * x.diff() ** 2 / 4, name="rolling")
    s.spring(k, deflection=x)
    d = s.derive()
    wrong = d.check("T = 1/2 m x'^2 + 1/4 m x'^2\n3/2 m x'' - k x = 0")
    assert not wrong.right and not [n for n in wrong.notes if "was read as" in str(n)]
    assert wrong.first_wrong is not None and wrong.first_wrong.line.number == 2
    assert any("0.25 was read as r" in str(n) for n in d.check("T = 0.25 m x'^2").notes)
