"""The equations of every built-in example as a book prints them, grouped by hand: how short they can be.

Written in plain text with primes for rates; the tests check them against Kane's equations before they count anything.
"""

from __future__ import annotations

import re

import sympy as sp

APART = "((x1 - x2)**2 + (y1 - y2)**2)"
CLOSING = "((x1 - x2)*(x1' - x2') + (y1 - y2)*(y1' - y2'))"


ONE, TWO = "(1 - L_0/sqrt(x1**2 + y1**2))", "(1 - L_0/sqrt((x2 - D)**2 + y2**2))"
BETWEEN = f"(k2*(1 - L_0/sqrt{APART}) + b*{CLOSING}/{APART} - F/sqrt{APART})"

_ARM = "(m1*L_a + (m2 + m3)*(L_a + L_b))*g*cos(theta1)"
_DOUBLE = "m2*L1*L2"
_RELATIVE = "(L1*cos(theta2) + L2)"

BOOK: dict[str, list[str]] = {
    # The lecture's four examples.
    "lecture-1": ["m*L_m**2*theta'' + b*L_b**2*theta' + k*L_k**2*theta + m*g*L_m*sin(theta) = tau"],
    "lecture-2": [
        "(m1*L_a**2 + (m2 + m3)*(L_a + L_b)**2 + m3*L_c*(L_c + 2*(L_a + L_b)*cos(theta2)))*theta1''"
        " + m3*L_c*(L_c + (L_a + L_b)*cos(theta2))*theta2''"
        f" - m3*(L_a + L_b)*L_c*sin(theta2)*(2*theta1' + theta2')*theta2' + {_ARM} + m3*g*L_c*cos(theta1 + theta2) = 0",
        "m3*L_c*(L_c + (L_a + L_b)*cos(theta2))*theta1'' + m3*L_c**2*theta2''"
        " + m3*(L_a + L_b)*L_c*sin(theta2)*theta1'**2 + m3*g*L_c*cos(theta1 + theta2) = tau",
    ],
    "lecture-2-absolute": [
        "(m1*L_a**2 + (m2 + m3)*(L_a + L_b)**2)*theta1'' + m3*(L_a + L_b)*L_c*cos(theta1 - theta2)*theta2''"
        f" + m3*(L_a + L_b)*L_c*sin(theta1 - theta2)*theta2'**2 + {_ARM} = -tau",
        "m3*(L_a + L_b)*L_c*cos(theta1 - theta2)*theta1'' + m3*L_c**2*theta2''"
        " - m3*(L_a + L_b)*L_c*sin(theta1 - theta2)*theta1'**2 + m3*g*L_c*cos(theta2) = tau",
    ],
    "lecture-3a": ["m1*x1'' + k*(x1 - x2) = -F", "m2*x2'' - k*(x1 - x2) = F"],
    "lecture-3b": ["(m1 + m2)*x1'' + m2*x2r'' = 0", "m2*x1'' + m2*x2r'' + k*x2r = F"],
    "two-carts": ["(m1 + m2)*x1'' + m2*x2'' = 0", "m2*x1'' + m2*x2'' + k*x2 = F"],
    "pendulum": ["m*L**2*theta'' + b*theta' + m*g*L*sin(theta) = 0"],
    # Landau and Lifshitz, Mechanics, §5, problem 2 (a pendulum on a support that slides), upright, with J, b and F.
    "cart-pole": [
        "(M + m)*x'' + m*l*cos(theta)*theta'' - m*l*sin(theta)*theta'**2 + b*x' = F",
        "m*l*cos(theta)*x'' + (J + m*l**2)*theta'' - m*g*l*sin(theta) = 0",
    ],
    # Landau and Lifshitz, §5, problem 1.
    "double-pendulum": [
        f"(m1 + m2)*L1**2*theta1'' + {_DOUBLE}*cos(theta1 - theta2)*theta2''"
        f" + {_DOUBLE}*sin(theta1 - theta2)*theta2'**2 + (m1 + m2)*g*L1*sin(theta1) = 0",
        f"{_DOUBLE}*cos(theta1 - theta2)*theta1'' + m2*L2**2*theta2''"
        f" - {_DOUBLE}*sin(theta1 - theta2)*theta1'**2 + m2*g*L2*sin(theta2) = 0",
    ],
    "double-pendulum-relative": [
        f"((m1 + m2)*L1**2 + m2*L2*(2*L1*cos(theta2) + L2))*theta1'' + m2*L2*{_RELATIVE}*theta2''"
        f" - {_DOUBLE}*sin(theta2)*theta2'*(2*theta1' + theta2')"
        " + (m1 + m2)*g*L1*sin(theta1) + m2*g*L2*sin(theta1 + theta2) = 0",
        f"m2*L2*{_RELATIVE}*theta1'' + m2*L2**2*theta2''"
        f" + {_DOUBLE}*sin(theta2)*theta1'**2 + m2*g*L2*sin(theta1 + theta2) = 0",
    ],
    # Newton's law in polar coordinates: r̈ − r θ̇² and r θ̈ + 2 ṙ θ̇.
    "elastic-pendulum": [
        "m*r'' - m*r*theta'**2 + k*(r - L_0) - m*g*cos(theta) = 0",
        "m*r**2*theta'' + 2*m*r*r'*theta' + m*g*r*sin(theta) = 0",
    ],
    # Newton's law in spherical coordinates; the second is d/dt of the angular momentum m L² sin²θ φ̇.
    "spherical-pendulum": [
        "m*L**2*theta'' - m*L**2*sin(theta)*cos(theta)*phi'**2 + m*g*L*sin(theta) = 0",
        "m*L**2*sin(theta)**2*phi'' + 2*m*L**2*sin(theta)*cos(theta)*theta'*phi' = 0",
    ],
    "furuta-pendulum": [
        "(J1 + m1*l1**2 + m2*L1**2 + A2*cos(theta2)**2 + (J2 + m2*l2**2)*sin(theta2)**2)*theta1''"
        " + m2*L1*l2*cos(theta2)*theta2'' + 2*(J2 - A2 + m2*l2**2)*sin(theta2)*cos(theta2)*theta1'*theta2'"
        " - m2*L1*l2*sin(theta2)*theta2'**2 + b1*theta1' = tau",
        "m2*L1*l2*cos(theta2)*theta1'' + (J2 + m2*l2**2)*theta2''"
        " - (J2 - A2 + m2*l2**2)*sin(theta2)*cos(theta2)*theta1'**2 + b2*theta2' + m2*g*l2*sin(theta2) = 0",
    ],
    "quarter-car": [
        "m_s*z_s'' + b_s*(z_s' - z_u') + k_s*(z_s - z_u) = F",
        "m_u*z_u'' - b_s*(z_s' - z_u') - k_s*(z_s - z_u) + k_t*(z_u - z_r) = -F",
    ],
    # Balance of moments in the axes of the hoop, with the centrifugal force.
    "bead-on-hoop": ["m*R**2*theta'' - m*R**2*Omega**2*sin(theta)*cos(theta) + m*g*R*sin(theta) = 0"],
    "atwood": ["(m1 + m2 + J/R**2)*x'' - (m1 - m2)*g = 0"],
    # Tufillaro, Abbott and Griffiths, American Journal of Physics 52 (1984), 895.
    "swinging-atwood": [
        "(M + m)*r'' - m*r*theta'**2 + M*g - m*g*cos(theta) = 0",
        "m*r**2*theta'' + 2*m*r*r'*theta' + m*g*r*sin(theta) = 0",
    ],
    # Momentum of both along the floor; the block along the slope.
    "wedge": [
        "(M + m)*x'' + m*cos(alpha)*s'' = F",
        "m*cos(alpha)*x'' + m*s'' - m*g*sin(alpha) = 0",
    ],
    "three-masses": [
        "m1*x1'' + (k1 + k2)*x1 - k2*x2 = 0",
        "m2*x2'' + b*(x2' - x3') - k2*x1 + (k2 + k3)*x2 - k3*x3 = F",
        "m3*x3'' - b*(x2' - x3') - k3*x2 + (k3 + k4)*x3 = 0",
    ],
    # Landau and Lifshitz, §5, problem 3 (c), from upright: the pivot's acceleration adds to g.
    "kapitza-pendulum": ["m*L**2*theta'' + b*theta' - m*L*(g - a*omega**2*cos(omega*t))*sin(theta) = 0"],
    "planar-quadrotor": [
        "m*x'' + b*x' = -(F1 + F2)*sin(theta)",
        "m*y'' + b*y' + m*g = (F1 + F2)*cos(theta)",
        "J*theta'' = L*(F1 - F2)",
    ],
    "rolling-cylinder": ["(m + J/R**2)*x'' - m*g*sin(alpha) = 0"],
    "ball-and-beam": [
        "(m + J/R**2)*r'' - (J/R + m*R)*theta'' - m*r*theta'**2 + m*g*sin(theta) = 0",
        "-(J/R + m*R)*r'' + (J + J_b + m*(r**2 + R**2))*theta'' + 2*m*r*r'*theta'"
        " + m*g*(r*cos(theta) - R*sin(theta)) = tau",
    ],
    # Landau and Lifshitz, §35, problem 1, with their I₁' = A + m l², differentiated.
    "spinning-top": [
        "((A + m*l**2)*sin(theta)**2 + C*cos(theta)**2)*phi'' + C*cos(theta)*psi''"
        " + 2*(A - C + m*l**2)*sin(theta)*cos(theta)*phi'*theta' - C*sin(theta)*theta'*psi' = 0",
        "(A + m*l**2)*theta'' - (A - C + m*l**2)*sin(theta)*cos(theta)*phi'**2 + C*sin(theta)*phi'*psi'"
        " - m*g*l*sin(theta) = 0",
        "C*cos(theta)*phi'' + C*psi'' - C*sin(theta)*theta'*phi' = 0",
    ],
    "scara": [
        "(J1 + J2 + J3 + m1*l1**2 + m2*(L1**2 + l2**2) + m3*(L1**2 + L2**2)"
        " + 2*(m2*l2 + m3*L2)*L1*cos(theta2))*theta1''"
        " + (J2 + J3 + m2*l2**2 + m3*L2**2 + (m2*l2 + m3*L2)*L1*cos(theta2))*theta2'' + J3*theta4''"
        " - (m2*l2 + m3*L2)*L1*sin(theta2)*theta2'*(2*theta1' + theta2') = tau1",
        "(J2 + J3 + m2*l2**2 + m3*L2**2 + (m2*l2 + m3*L2)*L1*cos(theta2))*theta1''"
        " + (J2 + J3 + m2*l2**2 + m3*L2**2)*theta2'' + J3*theta4'' + (m2*l2 + m3*L2)*L1*sin(theta2)*theta1'**2 = tau2",
        "m3*d'' + b*d' - m3*g = F",
        "J3*(theta1'' + theta2'' + theta4'') = tau4",
    ],
    "robot-arm": [
        "(J1 + A2*sin(q2)**2 + (B2 + m2*l2**2)*cos(q2)**2 + A3*sin(q2 + q3)**2 + B3*cos(q2 + q3)**2"
        " + m3*(L2*cos(q2) + l3*cos(q2 + q3))**2)*q1''"
        " + 2*q1'*((A2 - B2 - m2*l2**2)*sin(q2)*cos(q2)*q2' + (A3 - B3)*sin(q2 + q3)*cos(q2 + q3)*(q2' + q3')"
        " - m3*(L2*cos(q2) + l3*cos(q2 + q3))*(L2*sin(q2)*q2' + l3*sin(q2 + q3)*(q2' + q3'))) = tau1",
        "(B2 + B3 + m2*l2**2 + m3*(L2**2 + l3**2 + 2*L2*l3*cos(q3)))*q2'' + (B3 + m3*l3*(l3 + L2*cos(q3)))*q3''"
        " - m3*L2*l3*sin(q3)*q3'*(2*q2' + q3') - q1'**2*((A2 - B2 - m2*l2**2)*sin(q2)*cos(q2)"
        " + (A3 - B3)*sin(q2 + q3)*cos(q2 + q3)"
        " - m3*(L2*cos(q2) + l3*cos(q2 + q3))*(L2*sin(q2) + l3*sin(q2 + q3)))"
        " + (m2*l2 + m3*L2)*g*cos(q2) + m3*g*l3*cos(q2 + q3) = tau2",
        "(B3 + m3*l3*(l3 + L2*cos(q3)))*q2'' + (B3 + m3*l3**2)*q3'' + m3*L2*l3*sin(q3)*q2'**2"
        " - q1'**2*((A3 - B3)*cos(q2 + q3) - m3*l3*(L2*cos(q2) + l3*cos(q2 + q3)))*sin(q2 + q3)"
        " + m3*g*l3*cos(q2 + q3) = tau3",
    ],
    "two-disk-shaft": [
        "J1*phi1'' + b*(phi1' - phi2') + k*(phi1 - phi2) = tau",
        "J2*phi2'' - b*(phi1' - phi2') + b_load*phi2' - k*(phi1 - phi2) = 0",
    ],
    "bead-on-parabola": ["m*(1 + 4*c**2*x**2)*x'' + 4*m*c**2*x*x'**2 + 2*m*g*c*x = 0"],
    "spring-net": [
        f"m1*x1'' + k1*{ONE}*x1 + {BETWEEN}*(x1 - x2) = 0",
        f"m1*y1'' + k1*{ONE}*y1 + {BETWEEN}*(y1 - y2) + m1*g = 0",
        f"m2*x2'' + k3*{TWO}*(x2 - D) - {BETWEEN}*(x1 - x2) = 0",
        f"m2*y2'' + k3*{TWO}*y2 - {BETWEEN}*(y1 - y2) + m2*g = 0",
    ],
    "acrobot": [
        "(J1 + J2 + m1*l1**2 + m2*(L1**2 + l2**2 + 2*L1*l2*cos(theta2)))*theta1''"
        " + (J2 + m2*l2*(l2 + L1*cos(theta2)))*theta2'' - m2*L1*l2*sin(theta2)*theta2'*(2*theta1' + theta2')"
        " + b1*theta1' + (m1*l1 + m2*L1)*g*sin(theta1) + m2*g*l2*sin(theta1 + theta2) = 0",
        "(J2 + m2*l2*(l2 + L1*cos(theta2)))*theta1'' + (J2 + m2*l2**2)*theta2'' + m2*L1*l2*sin(theta2)*theta1'**2"
        " + b2*theta2' + m2*g*l2*sin(theta1 + theta2) = tau",
    ],
    "segway": [
        "(m_w + m_r + J_w/R**2)*x'' + m_r*l*cos(theta)*theta'' - m_r*l*sin(theta)*theta'**2 = tau/R",
        "m_r*l*cos(theta)*x'' + (J_r + m_r*l**2)*theta'' - m_r*g*l*sin(theta) = -tau",
    ],
    "crane": [
        "(M + m)*x'' + m*sin(theta)*l'' + m*l*cos(theta)*theta'' + 2*m*cos(theta)*l'*theta'"
        " - m*l*sin(theta)*theta'**2 + b*x' = F",
        "m*sin(theta)*x'' + m*l'' - m*l*theta'**2 - m*g*cos(theta) = -F_h",
        "m*l*cos(theta)*x'' + m*l**2*theta'' + 2*m*l*l'*theta' + m*g*l*sin(theta) = 0",
    ],
    "dc-motor": [
        "L*q'' + R*q' + K*theta' = u",
        "(J + m*l**2)*theta'' + b*theta' + m*g*l*sin(theta) = K*q'",
    ],
    "loudspeaker": ["L*q'' + R*q' + Bl*x' = u", "m*x'' + b*x' + k*x = Bl*q'"],
    "capacitive-actuator": [
        "L*q'' + R*q' + (d - x)*q/(epsilon*A) = u",
        "m*x'' + b*x' + k*x - q**2/(2*epsilon*A) = 0",
    ],
    "duffing": ["m*x'' + b*x' + k*x + k3*x**3 = F_0*cos(omega*t)"],
}


def sides(name: str) -> list[tuple[sp.Expr, sp.Expr]]:
    """Left and right sides in plain symbols, ``x''`` as ``x_acceleration``."""
    found = []
    for line in BOOK.get(name, []):
        line = re.sub(r"(\w+)''", r"\1_acceleration", line)
        line = re.sub(r"(\w+)'", r"\1_rate", line)
        names = {n: sp.Symbol(n) for n in re.findall(r"[A-Za-z_]\w*", line)} | {"sin": sp.sin, "cos": sp.cos}
        left, right = (sp.sympify(side, locals=names | {"sqrt": sp.sqrt}) for side in line.split("="))
        found.append((left, right))
    return found
