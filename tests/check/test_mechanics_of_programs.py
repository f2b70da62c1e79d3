"""SymPy's mechanics in programs that are carried out: frames, points and bodies, LagrangesMethod and KanesMethod.

Oracle: the equations of the cart with a pole, and of a wheel that rolls. Every form has a wrong twin.
"""

from __future__ import annotations

import pytest
from test_forces_between_bodies import wheel

from built_in import derivation
from lagrangian import ParseError

BODIES = """from sympy import symbols, sin, cos
from sympy.physics.mechanics import *
M, m, l, J, b, g, F = symbols('M m l J b g F')
x, theta = dynamicsymbols('x theta')
xd, thetad = dynamicsymbols('x theta', 1)
N = ReferenceFrame('N')
A = N.orientnew('A', 'Axis', [-theta, N.z])
O = Point('O'); O.set_vel(N, 0)
C = O.locatenew('C', x*N.x)
C.set_vel(N, xd*N.x)
G = C.locatenew('G', l*A.y)
G.v2pt_theory(C, N, A)
cart = Particle('cart', C, M)
pole = RigidBody('pole', G, A, m, (inertia(A, 0, 0, J), G))
pole.potential_energy = m*g*l*cos(theta)
"""
LAGRANGE = f"""{BODIES}L = Lagrangian(N, cart, pole)
LM = LagrangesMethod(L, [x, theta], forcelist=[(C, (F - b*xd)*N.x)], frame=N)
eqs = LM.form_lagranges_equations()
print(simplify(eqs))"""
ENTRIES = """from sympy import *
from sympy.physics.mechanics import dynamicsymbols, LagrangesMethod, ReferenceFrame, Point
M, m, l, J, b, g, F = symbols('M m l J b g F')
x, th = dynamicsymbols('x theta')
xd, thd = dynamicsymbols('x theta', 1)
N = ReferenceFrame('N')
P = Point('P')
P.set_vel(N, xd*N.x)
T = (M+m)*xd**2/2 + m*l*xd*thd*cos(th) + (J+m*l**2)*thd**2/2
V = m*g*l*cos(th)
lm = LagrangesMethod(T - V, [x, th], forcelist=[(P, F*N.x), (P, -b*xd*N.x)], frame=N)
eom = lm.form_lagranges_equations().applyfunc(simplify)
lm.mass_matrix
lm.forcing"""
KANE = f"""{BODIES.replace("xd, thetad = ", "u1, u2 = dynamicsymbols('u1 u2'); xd, thetad = ")}
A.set_ang_vel(N, -u2*N.z)
C.set_vel(N, u1*N.x)
G.v2pt_theory(C, N, A)
kd = [xd - u1, thetad - u2]
loads = [(C, (F - b*u1)*N.x), (G, -m*g*N.y)]
KM = KanesMethod(N, q_ind=[x, theta], u_ind=[u1, u2], kd_eqs=kd)
fr, frstar = KM.kanes_equations([cart, pole], loads)
MM = KM.mass_matrix_full"""
DYAD = KANE.replace("inertia(A, 0, 0, J)", "J*outer(N.z, N.z)").replace(
    "'Axis', [-theta, N.z]", "'Axis', (theta, -N.z)"
)


def right(program: str) -> bool:
    """Whether an answer is right; one that cannot be read is not."""
    try:
        return derivation("cart-pole").check(program, hint=0).right
    except ParseError:
        return False


@pytest.mark.sampled(12)
@pytest.mark.parametrize(
    ("program", "old", "new"),
    [
        (LAGRANGE, "(F - b*xd)*N.x", "(F + b*xd)*N.x"),
        (LAGRANGE, "m*g*l*cos(theta)", "-m*g*l*cos(theta)"),
        (LAGRANGE, "l*A.y", "l*A.x"),
        (LAGRANGE, "[-theta, N.z]", "[theta, N.z]"),
        (ENTRIES, "(P, -b*xd*N.x)", "(P, b*xd*N.x)"),
        (ENTRIES, "P.set_vel(N, xd*N.x)", "P.set_vel(N, thd*N.x)"),
        (KANE, "-m*g*N.y", "m*g*N.y"),
        (KANE, "(F - b*u1)", "(F - b*u2)"),
        (KANE, "-u2*N.z", "-2*u2*N.z"),
        (DYAD, "J*outer", "2*J*outer"),
    ],
)
def test_methods_of_mechanics_are_carried_out(program: str, old: str, new: str) -> None:
    assert old in program
    assert right(program)
    assert not right(program.replace(old, new))


ROLLING = """from sympy import *
from sympy.physics.mechanics import *
x, phi = dynamicsymbols('x phi')
m, M, J, R, k, F = symbols('m M J R k F')
N = ReferenceFrame('N')
P = Point('P'); P.set_vel(N, x.diff()*N.x)
L = (M + m)*x.diff()**2/2 + J*phi.diff()**2/2 - k*x**2/2
LM = LagrangesMethod(L, [x, phi], nonhol_coneqs=[x.diff() - R*phi.diff()], forcelist=[(P, F*N.x)], frame=N)
print(LM.form_lagranges_equations())
# x: (M + m)*x'' + k*x + lam1 - F = 0"""


@pytest.mark.slow
def test_methods_of_mechanics_may_have_multipliers() -> None:
    assert wheel().check(ROLLING, hint=0).right
    for old, new in (
        ("- R*phi.diff()]", "+ R*phi.diff()]"),
        ("F*N.x", "F*N.y"),
        ("+ lam1", "- lam1"),
        ("- k*x**2/2", "+ k*x**2/2"),
    ):
        assert old in ROLLING and not wheel().check(ROLLING.replace(old, new), hint=0).right


COMPARED = """from sympy import *
from sympy.physics.mechanics import dynamicsymbols, LagrangesMethod
x, th = dynamicsymbols('x theta')
xd, thd = dynamicsymbols('x theta', 1)
xdd, thdd = dynamicsymbols('x theta', 2)
M, m, l, J, b, g, F = symbols('M m l J b g F')
T = (M+m)*xd**2/2 + m*l*xd*thd*cos(th) + (J+m*l**2)*thd**2/2
V = m*g*l*cos(th)
eq_x = (M+m)*xdd + m*l*cos(th)*thdd - m*l*sin(th)*thd**2 + b*xd - F
eq_th = (J+m*l**2)*thdd + m*l*cos(th)*xdd - m*g*l*sin(th)
eqs = LagrangesMethod(T - V, [x, th]).form_lagranges_equations()
print(expand(eqs - Matrix([eq_x - b*xd + F, eq_th])))"""


def test_a_difference_that_is_zero_is_a_check() -> None:
    assert right(COMPARED)
    assert not right(COMPARED.replace("+ b*xd - F", "- b*xd - F").replace("eq_x - b*xd", "eq_x + b*xd"))
    assert not right(COMPARED.replace("- m*g*l*sin", "+ m*g*l*sin"))
