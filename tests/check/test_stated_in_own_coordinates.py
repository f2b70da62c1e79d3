"""Momenta, derivatives of energies and generalized forces by coordinates of an answer's own, η with ξ = ξ(η, t).

Oracle: textbook systems by hand, each in other coordinates than the model's. Every line has wrong twins.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg


@cache
def carts() -> lg.Derivation:
    """Two carts between two walls, a damper between them, a force on the second."""
    s = lg.System("two carts")
    x1, x2 = s.coordinates("x1 x2")
    m1, m2, k1, k2, k3, b = s.parameters("m1 m2 k1 k2 k3 b")
    F = s.inputs("F")
    s.particle(m1, at=s.point("A", (x1, 0)), name="first")
    s.particle(m2, at=s.point("B", (x2, 0)), name="second")
    for k, deflection in ((k1, x1), (k2, x2 - x1), (k3, x2)):
        s.spring(k, deflection=deflection)
    s.damper(b, deflection=x2 - x1)
    s.force(F, deflection=x2)
    return s.derive()


@cache
def plank() -> lg.Derivation:
    """A cylinder that rolls on a plank: s = x + R φ."""
    s = lg.System("cylinder on a plank")
    x, u, phi = s.coordinates("x s phi")
    M, m, J, R, k, b = s.parameters("M m J R k b")
    F = s.inputs("F")
    s.particle(M, at=s.point("plank", (x, 0)), name="plank")
    s.rigid_body(mass=m, inertia=J, at=s.point("centre", (u, R)), frame=s.frame(-phi), name="cylinder")
    s.spring(k, deflection=u)
    s.damper(b, deflection=x)
    s.force(F, deflection=x)
    s.constraint(u - x - R * phi, name="rolling")
    return s.derive()


@cache
def beam() -> lg.Derivation:
    """A beam on two springs, with a damper in front and a force at its rear."""
    s = lg.System("beam on two springs")
    y, theta = s.coordinates("y theta")
    m, J, a, b, k1, k2, c, g = s.parameters("m J a b k1 k2 c g")
    F = s.inputs("F")
    s.rigid_body(mass=m, inertia=J, at=s.point("S", (0, y)), frame=s.frame(theta), name="beam")
    s.gravity(g=g)
    s.spring(k1, deflection=y + a * theta)
    s.spring(k2, deflection=y - b * theta)
    s.damper(c, deflection=y + a * theta)
    s.force(F, deflection=y - b * theta)
    return s.derive()


SHEETS = {
    "named anew": (
        carts,
        """\
x = x1
z = x2 - x1
x2' = x' + z'
T = 1/2 m1 x'^2 + 1/2 m2 (x' + z')^2
V = 1/2 k1 x^2 + 1/2 k2 z^2 + 1/2 k3 (x + z)^2
D = 1/2 b z'^2
Q_x = F
Q_z = F
dT/dx' = m1 x' + m2 (x' + z')
dT/dz' = m2 (x' + z')
dV/dz = k2 z + k3 (x + z)
(m1 + m2) x'' + m2 z'' + k1 x + k3 (x + z) = F
m2 (x'' + z'') + k2 z + k3 (x + z) + b z' = F
""",
        {
            "dT/dx' = m1 x' + m2": ["dT/dx' = m1 x' - m2", "dT/dx' = m1 x' + 2 m2"],
            "dT/dz' = m2 (x' + z')": ["dT/dz' = m2 z'"],
            "dV/dz = k2 z + k3": ["dV/dz = k2 z - k3"],
            "Q_x = F": ["Q_x = -F", "Q_x = 0", "Q_x = F - b z'"],
            "Q_z = F": ["Q_z = -F", "Q_z = 0", "Q_z = F + b z'"],
        },
    ),
    "without energies": (
        carts,
        """\
z = x2 - x1
Q_x1 = F
Q_z = F - b z'
p_z = m2 (x1' + z')
∂L/∂x1' = m1 x1' + m2 (x1' + z')
d/dt(∂L/∂z') = m2 (x1'' + z'')
∂L/∂z = -k2 z - k3 (x1 + z)
∂L/∂x1 = -k1 x1 - k3 (x1 + z)
(m1 + m2) x1'' + m2 z'' + k1 x1 + k3 (x1 + z) = F
m2 (x1'' + z'') + k2 z + k3 (x1 + z) + b z' = F
""",
        {
            "Q_z = F - b z'": ["Q_z = F + b z'", "Q_z = -F - b z'", "Q_z = 2 F - b z'"],
            "∂L/∂x1' = m1 x1' + m2": ["∂L/∂x1' = m1 x1' - m2"],
            "d/dt(∂L/∂z') = m2 (x1''": ["d/dt(∂L/∂z') = m2 (-x1''"],
            "∂L/∂z = -k2 z - k3": ["∂L/∂z = -k2 z + k3"],
            "∂L/∂x1 = -k1 x1 - k3": ["∂L/∂x1 = -k1 x1 + k3"],
            "p_z = m2 (x1'": ["p_z = m1 (x1'"],
        },
    ),
    "the system's in the answer's": (
        carts,
        """\
x2 = x1 + z
T = 1/2 m1 x1'^2 + 1/2 m2 (x1' + z')^2
∂T/∂z' = m2 (x1' + z')
∂L/∂z = -k2 z - k3 (x1 + z)
∂L/∂x1' = (m1 + m2) x1' + m2 z'
Q_x1 = F
Q_z = F - b z'
(m1 + m2) x1'' + m2 z'' + k1 x1 + k3 (x1 + z) = Q_x1
m2 (x1'' + z'') + k2 z + k3 (x1 + z) = Q_z
""",
        {
            "∂T/∂z' = m2 (x1'": ["∂T/∂z' = m2 (-x1'"],
            "∂L/∂z = -k2 z": ["∂L/∂z = k2 z"],
            "∂L/∂x1' = (m1 + m2) x1' + m2 z'": ["∂L/∂x1' = (m1 + m2) x1' - m2 z'"],
        },
    ),
    "a constraint put in": (
        plank,
        """\
s = x + R phi
T = 1/2 M x'^2 + 1/2 m (x' + R phi')^2 + 1/2 J phi'^2
V = 1/2 k (x + R phi)^2
d/dt ∂L/∂x' = M x'' + m (x'' + R phi'')
∂L/∂x = -k (x + R phi)
∂L/∂phi' = m R (x' + R phi') + J phi'
∂L/∂phi = -k R (x + R phi)
Q_x = F - b x'
Q_phi = 0
(M + m) x'' + m R phi'' + k (x + R phi) = F - b x'
m R x'' + (J + m R^2) phi'' + k R (x + R phi) = 0
""",
        {
            "d/dt ∂L/∂x' = M x'' + m": ["d/dt ∂L/∂x' = M x'' - m"],
            "∂L/∂x = -k (x": ["∂L/∂x = k (x", "∂L/∂x = -k (2 x"],
            "∂L/∂phi' = m R (x'": ["∂L/∂phi' = m (x'"],
            "∂L/∂phi = -k R": ["∂L/∂phi = k R"],
            "Q_x = F - b x'": ["Q_x = F + b x'"],
            "Q_phi = 0": ["Q_phi = R F"],
        },
    ),
    "both by number": (
        beam,
        """\
z1 = y + a*theta
z2 = y - b*theta
T = 1/2*m*(b*z1' + a*z2')^2/(a + b)^2 + 1/2*J*(z1' - z2')^2/(a + b)^2
V = 1/2*k1*z1^2 + 1/2*k2*z2^2 + m*g*(b*z1 + a*z2)/(a + b)
Q1 = -c*z1'
Q2 = F
(m*b^2 + J)/(a + b)^2*z1'' + (m*a*b - J)/(a + b)^2*z2'' + k1*z1 + m*g*b/(a + b) = -c*z1'
(m*a*b - J)/(a + b)^2*z1'' + (m*a^2 + J)/(a + b)^2*z2'' + k2*z2 + m*g*a/(a + b) = F
""",
        {
            "Q1 = -c*z1'": ["Q1 = c*z1'", "Q1 = F", "Q1 = F - c*z1'"],
            "Q2 = F": ["Q2 = -F", "Q2 = b*F"],
        },
    ),
}


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", SHEETS)
def test_what_is_stated_in_own_coordinates_is_right_in_these(name: str) -> None:
    system, sheet, _ = SHEETS[name]
    found = system().check(sheet)
    assert found.right, found.to_text()


@pytest.mark.sampled(35)
@pytest.mark.parametrize(
    ("name", "now", "wrong"), [(name, a, b) for name, (_, _, twins) in SHEETS.items() for a in twins for b in twins[a]]
)
def test_its_wrong_twins_are_wrong(name: str, now: str, wrong: str) -> None:
    system, sheet, _ = SHEETS[name]
    assert now in sheet
    assert not system().check(sheet.replace(now, wrong, 1), hint=0).right


def test_a_force_of_the_answers_own_name_that_its_equations_use_is_no_generalized_force() -> None:
    """As for the system's coordinates: what stands on the right may be called Q_z, with the springs."""
    sheet = SHEETS["without energies"][1].replace("Q_z = F - b z'", "Q_z = F - b z' - k2 z")
    used = sheet.replace("m2 (x1'' + z'') + k2 z + k3 (x1 + z) + b z' = F", "m2 (x1'' + z'') + k3 (x1 + z) = Q_z")
    found = carts().check(used)
    assert found.right and any("a name of your own" in str(note) for note in found.notes)
    assert not carts().check(used.replace("b z' - k2 z", "b z' + k2 z"), hint=0).right


def test_in_latex_a_coordinate_with_a_dot_in_braces_is_one_that_is_used() -> None:
    text = r"""$z = x_2 - x_1$, $Q_z = F - b \dot{z}$, $Q_{x_1} = F$

$(m_1 + m_2) \ddot{x}_1 + m_2 \ddot{z} + k_1 x_1 + k_3 (x_1 + z) = F$

$m_2 (\ddot{x}_1 + \ddot{z}) + k_2 z + k_3 (x_1 + z) + b \dot{z} = F$"""
    assert carts().check(text, hint=0).right
    assert not carts().check(text.replace("Q_z = F -", "Q_z = F +"), hint=0).right
    assert not carts().check(text.replace("$Q_{x_1} = F$", "$Q_{x_1} = -F$"), hint=0).right


VARIANTS = r"""\section*{Half a car}
I count $z$ downwards ($z = -y$), and $\vartheta = -\theta$.
\begin{align*}
T &= \tfrac12 m \dot z^2 + \tfrac12 J\dot\vartheta^2\\
V &= \tfrac12 k_1 (z + a\vartheta)^2 + \tfrac12 k_2 (z - b\vartheta)^2 - m g z\\
Q_z &= -F - c(\dot z + a\dot\vartheta)\\
Q_\vartheta &= F b - c a(\dot z + a\dot\vartheta)\\
m\ddot z + c(\dot z + a\dot\vartheta) + k_1(z + a\vartheta) + k_2(z - b\vartheta) &= m g - F\\
J\ddot\vartheta + c a(\dot z + a\dot\vartheta) + k_1 a(z + a\vartheta) - k_2 b(z - b\vartheta) &= b F
\end{align*}
"""


@pytest.mark.slow
def test_two_forms_of_a_letter_are_two_names_where_one_is_given_by_the_other() -> None:
    found = beam().check(VARIANTS)
    assert found.right, found.to_text()
    for now, wrong in ((r"Q_\vartheta &= F b", r"Q_\vartheta &= -F b"), (r"(z - b\vartheta)^2", r"(z + b\vartheta)^2")):
        assert now in VARIANTS and not beam().check(VARIANTS.replace(now, wrong), hint=0).right
    same = VARIANTS.replace(r"$\vartheta = -\theta$", "no other angle").replace(r"\dot\vartheta", r"\dot\theta")
    for now, other in (("z = -y", "z = y"), ("-F - c", "F - c"), ("F b -", "-F b -"), ("- m g z", "+ m g z")):
        same = same.replace(now, other)
    same = same.replace("m g - F", "F - m g").replace("&= b F", "&= -b F")
    assert r"\theta" in same and r"\vartheta" in same and beam().check(same, hint=0).right  # one letter in two forms


def test_a_rate_of_a_coordinate_of_the_answers_own_does_not_follow_from_energies() -> None:
    rows = """m*y'' + k1*(y + a*th) + k2*(y - b*th) + m*g = F - c*(y' + a*thd)
J*theta'' + k1*a*(y + a*th) - k2*b*(y - b*th) = -b*F - c*a*(y' + a*thd)"""
    found = beam().check(f"th = theta\nthd = theta'\n{rows}")
    assert found.right and "energies" not in found.to_text()


@cache
def plane() -> lg.Derivation:
    """A mass in a plane, on a spring to the origin."""
    s = lg.System("plane")
    x, y = s.coordinates("x y")
    m, k = s.parameters("m k")
    at, F = s.point("P", (x, y)), s.inputs("F")
    s.particle(m, at=at)
    s.potential(k * (x**2 + y**2) / 2)
    s.force((F, 0), at=at)
    return s.derive()


POLAR = """\
x = r cos(phi)
y = r sin(phi)
T = 1/2 m (r'^2 + r^2 phi'^2)
V = 1/2 k r^2
Q_r = F cos(phi)
Q_phi = -F r sin(phi)
∂T/∂r = m r phi'^2
∂L/∂phi = 0
d/dt ∂L/∂phi' = m r^2 phi'' + 2 m r r' phi'
m r'' - m r phi'^2 + k r = F cos(phi)
m r^2 phi'' + 2 m r r' phi' = -F r sin(phi)
"""


def test_coordinates_of_the_system_may_be_any_functions_of_the_answers() -> None:
    found = plane().check(POLAR)
    assert found.right and "other coordinates" in found.to_text(), found.to_text()


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    ("now", "wrong"),
    [
        ("Q_r = F cos", "Q_r = F sin"),
        ("Q_phi = -F r", "Q_phi = F r"),
        ("∂T/∂r = m r", "∂T/∂r = -m r"),
        ("∂L/∂phi = 0", "∂L/∂phi = F"),
        ("phi'' + 2 m r r' phi'\nm r''", "phi'' + m r r' phi'\nm r''"),
        ("m r^2 phi'' + 2 m r r' phi' = -F", "m r^2 phi'' + m r r' phi' = -F"),
        ("x = r cos(phi)\ny = r sin(phi)", "x = r cos(phi)\ny = 2 r sin(phi)"),
    ],
)
def test_functions_of_the_answers_coordinates_have_wrong_twins(now: str, wrong: str) -> None:
    assert now in POLAR and not plane().check(POLAR.replace(now, wrong, 1), hint=0).right


@cache
def trammel() -> lg.Derivation:
    """A rod whose ends slide on the floor and on the wall, pulled by a spring and a force on the floor."""
    s = lg.System("trammel")
    phi = s.coordinate("phi")
    m, l, k, b, g = s.parameters("m l k b g")
    F = s.inputs("F")
    s.particle(m, at=s.point("A", (l * sp.cos(phi), 0)), name="block A")
    s.particle(m, at=s.point("B", (0, l * sp.sin(phi))), name="block B")
    s.gravity(g=g)
    s.spring(k, deflection=l * sp.cos(phi))
    s.damper(b, deflection=l * sp.sin(phi))
    s.force(F, deflection=l * sp.cos(phi))
    return s.derive()


IN_PLACE = """u = l cos(phi)
V = m g sqrt(l^2 - u^2) + 1/2 k u^2
m l^2/(l^2 - u^2) u'' + m l^2 u u'^2/(l^2 - u^2)^2 - m g u/sqrt(l^2 - u^2) + k u = F - b u^2/(l^2 - u^2) u'"""


@pytest.mark.slow
def test_a_root_is_a_length_where_a_coordinate_of_the_answer_s_own_determines_the_motion() -> None:
    """There √(l² − u²) is l sin φ; in φ itself it is so only on one side."""
    assert trammel().check(IN_PLACE, hint=0).right
    for old, new in (("sqrt(l^2 - u^2) +", "sqrt(l^2 + u^2) +"), ("- m g u/", "+ m g u/"), ("m g sqrt", "-m g sqrt")):
        assert not trammel().check(IN_PLACE.replace(old, new), hint=0).right
    assert not trammel().check("V = m g sqrt(l^2 sin(phi)^2) + 1/2 k l^2 cos(phi)^2", hint=0).right
