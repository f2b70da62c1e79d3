"""Lines of Newton and Euler belong to no step of Lagrange's method; what lacks a moment is told with it.

Oracle: by hand. A hatch (mass m, J about its centre at a from the hinge H) turns with φ above the level; a rod pulls
its end at 2 a with a force F downwards, a rope carries a weight M over a drum on the same axis, at the radius r:

    cut free: m a_x = X, m a_y = Y − m g − F, J φ̈ = X a sin φ − Y a cos φ − F a cos φ + S r, M r φ̈ = M g − S
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

from lagrangian import Derivation, System


@cache
def hatch() -> Derivation:
    """A hatch that a weight lifts and a force pulls down."""
    sys = System("hatch")
    phi = sys.coordinates("phi")
    m, J, a, M, r, g = sys.parameters("m J a M r g")
    F = sys.inputs("F")
    turned = sys.frame(phi, name="hatch")
    sys.rigid_body(m, J, at=turned.point(a, 0), frame=turned, name="hatch")
    sys.particle(M, at=sys.point("W", (0, -r * phi)), name="weight")
    sys.gravity((0, -1), g)
    sys.force((0, -F), at=turned.point(2 * a, 0), name="pull")
    return sys.derive()


BALANCES = """a_x = -a (phi'' sin(phi) + phi'^2 cos(phi))
a_y = a (phi'' cos(phi) - phi'^2 sin(phi))
m a_x = X
m a_y = Y - m g - F
J phi'' = X a sin(phi) - Y a cos(phi) - F a cos(phi) + S r
M r phi'' = M g - S
"""


@pytest.mark.slow
def test_a_missing_moment_is_written_out_and_no_step_is_named() -> None:
    assert hatch().check(BALANCES).right
    verdict = hatch().check(BALANCES.replace(" - F a cos(phi)", ""))
    words = " ".join(verdict.to_text().split())
    assert "In line 5, force 'pull' is missing; its moment is F a cos φ." in words, words
    assert "belongs to step" not in words and "It concerns force 'pull'." in words, words


def test_results_alone_belong_to_a_step() -> None:
    right = "(J + m a^2 + M r^2) phi'' + m g a cos(phi) - M g r = -2 a F cos(phi)"
    assert hatch().check(right).right
    words = " ".join(hatch().check(right.replace("- M g r", "+ M g r")).to_text().split())
    assert "This belongs to step" in words


def test_lagranges_equations_beside_what_is_true_are_lagranges_equations() -> None:
    rows = "(J + m a^2 + M r^2) phi'' + m g a cos(phi) - M g r + 2 a F cos(phi) = 0"
    power = "(J + m a^2 + M r^2) phi'' phi' = (M g r - m g a cos(phi) - 2 a F cos(phi)) phi'"
    both = hatch().check(f"{power}\n{rows}")
    assert both.right and "one by one" not in both.to_text()
    alone = hatch().check(power)
    assert alone.right and "one by one" in alone.to_text()


def test_a_moment_of_a_force_of_its_own_with_a_wrong_sign_is_of_no_element() -> None:
    """Nor are terms told that only stand in the line once the force is put in."""
    sys = System("hanging leg")
    theta, phi = sys.coordinates("theta phi")
    J, L, m, I, b, g = sys.parameters("J L m I b g")
    F, tau = sys.inputs("F tau")
    sys.rigid_body(0, J, at=sys.origin, frame=sys.frame(theta, name="arm"), name="arm")
    at = sys.point("G", (L * sp.cos(theta) + b * sp.sin(phi), L * sp.sin(theta) - b * sp.cos(phi)))
    sys.rigid_body(m, I, at=at, frame=sys.frame(phi, name="leg"), name="leg")
    sys.gravity((0, -1), g)
    sys.torque(tau, on=theta, name="drive")
    sys.force((F, 0), at=at, name="wind")
    leg = sys.derive()
    answer = r"""
\begin{align}
m\ddot x_2 &= A_x + F, & m\ddot y_2 &= A_y - mg\\
I\ddot\varphi &= -A_x b\cos\varphi - A_y b\sin\varphi
\end{align}
with
\begin{align}
\ddot x_2 &= -L\ddot\theta\sin\theta - L\dot\theta^2\cos\theta + b\ddot\varphi\cos\varphi - b\dot\varphi^2\sin\varphi\\
\ddot y_2 &= L\ddot\theta\cos\theta - L\dot\theta^2\sin\theta + b\ddot\varphi\sin\varphi + b\dot\varphi^2\cos\varphi
\end{align}
\begin{equation}
J\ddot\theta = \tau SIGN A_xL\sin\theta - A_yL\cos\theta
\end{equation}
Elimination of $A_x = m\ddot x_2 - F$ and $A_y = m\ddot y_2+mg$: the equations.
"""
    assert leg.check(answer.replace("SIGN", "+")).right
    verdict = leg.check(answer.replace("SIGN", "-"))
    [mistake] = verdict.mistakes
    assert "has the wrong sign" in str(mistake.what) and "A_x" in str(mistake.what)
    assert verdict.concerned(mistake) == []
    assert all(d.kind == "sign" and not d.origins for f in verdict.open_findings for d in f.differences)
