"""The PUMA 560 beside the matrix by hand in B. Armstrong, O. Khatib, J. Burdick (ICRA 1986, 510-518), and Craig's arm.

Their a_ij and I_k are quoted without the paper at hand. That the entries here agree with them vouches for the
quotation, but not for I_1 and I_3: the paper's masses and inertias give 1.55 and 1.60. These masses, centres and
inertias, with the inertia 0.066 of link 3 about z for 0.086, are also in puma560akb.m of P. Corke's Robotics Toolbox.
"""

import numpy as np
import pytest
import robots
import sympy as sp

import lagrangian as lg
from lagrangian import dynamics
from lagrangian.graph import evaluate
from lagrangian.structured.derive import derive_structured

I = [0, 1.43, 1.75, 1.38, 0.69, 0.372, 0.333, 0.298, -0.134, 0.0238, -0.0213, -0.0142, -0.011, -3.79e-3, 1.64e-3]
I += [1.25e-3, 1.24e-3, 6.42e-4, 4.31e-4, 3e-4, -2.02e-4, -1e-4, -5.8e-5, 4e-5]
MOTOR = [0, 1.14, 4.71, 0.827, 0.2, 0.179, 0.193]


def entries(q: np.ndarray) -> dict[tuple[int, int], float]:
    """The a_ij of the paper's appendix, less those that are small throughout."""
    (_, S2, S3, S4, S5, _), (_, C2, C3, C4, C5, _) = np.sin(q), np.cos(q)
    S23, C23 = np.sin(q[1] + q[2]), np.cos(q[1] + q[2])
    wrist = I[20] * S4**2 * S5**2 + I[21] * S4**2
    stretched = I[5] * S3 + I[12] * C3 + I[16] * (S3 * C5 + C3 * C4 * S5)
    bent = 2 * (I[15] * C5 + I[22] * C4 * S5)
    across = I[8] * C23 + I[13] * S23 - I[15] * C23 * S4 * S5 + I[18] * (S23 * C4 * S5 - C23 * C5)
    across += I[20] * S4 * (S23 * C4 * S5**2 - C23 * S5 * C5) + I[22] * S23 * S4 * S5
    return {
        (1, 2): across + I[4] * S2 + I[9] * C2 + I[16] * S2 * S4 * S5,
        (1, 3): across,
        (2, 2): MOTOR[2] + I[2] + I[6] + wrist + 2 * stretched + bent,
        (2, 3): I[6] + wrist + stretched + bent,
        (3, 3): MOTOR[3] + I[6] + wrist + bent,
        (4, 4): MOTOR[4] + I[14] - I[20] * S5**2,
        (4, 5): 0.0,
        (4, 6): I[23] * C5,
        (5, 5): MOTOR[5] + I[17],
        (5, 6): 0.0,
        (6, 6): MOTOR[6] + I[23],
    }


def functions(q: np.ndarray) -> list[float]:
    """The functions of the motion in a_11."""
    (_, S2, _, S4, S5, _), (_, C2, _, C4, C5, _) = np.sin(q), np.cos(q)
    S23, C23 = np.sin(q[1] + q[2]), np.cos(q[1] + q[2])
    turned = S5**2 * (S23**2 * (1 + C4**2) - 1) - 2 * S23 * C23 * C4 * S5 * C5
    hand = S23**2 * C5 + S23 * C23 * C4 * S5, C2 * (S23 * C5 + C23 * C4 * S5), S4 * S5
    rest = S23 * C23 * C5 + C23**2 * C4 * S5, turned, S23**2 * C4**2
    return [1, C2**2, S23**2, S23 * C23, S2 * C2, C2 * S23, C2 * C23, *hand, *rest]


def test_the_entries_of_m_are_those_by_hand() -> None:
    model = robots.armstrongs_puma().model
    program, p = dynamics.mass_matrix(model), [x.value for x in model.parameters]
    source = np.random.default_rng(1)
    states, found = source.uniform(-3, 3, (15, 6)), []
    for q in states:
        M = np.array(evaluate(program, {"q": q, "v": np.zeros(6), "u": [], "p": p, "t": [0.0]})["M"])
        found.append(M[0, 0])
        for (i, j), by_hand in entries(q).items():
            assert M[i - 1, j - 1] == pytest.approx(by_hand, abs=1.5e-3 if j < 4 else 1e-5)
    shown = np.array([functions(q) for q in states])
    constants, left, *_ = np.linalg.lstsq(shown, np.array(found), rcond=None)
    assert left.max() < 1e-20  # a_11 is made of these functions alone
    ours = [*constants[2:5], *(constants[5:11] / 2), *constants[11:]]
    assert ours == pytest.approx([I[k] for k in (7, 10, 11, 5, 12, 15, 16, 18, 22, 20, 21)], rel=1e-2)
    assert [constants[0] - MOTOR[1], constants[1]] == pytest.approx([1.553, 1.602], rel=1e-3)  # I_1, I_3: see above


@pytest.mark.slow
def test_two_links_in_names_are_craigs_closed_equations() -> None:
    """J. J. Craig, Introduction to Robotics, the arm of two point masses by iterated Newton-Euler equations (quoted
    without the book at hand). His n_i, summed inwards, are the left-hand sides N_i⁺ = τ_i here."""
    s = lg.System("two links")
    q1, q2 = s.coordinates("q1 q2")
    l1, l2, m1, m2 = s.parameters("l1 l2 m1 m2", l1=1, l2=2, m1=3, m2=4)
    upper = s.frame(q1)
    elbow = upper.point(l1, 0)
    s.particle(m1, at=elbow)
    s.particle(m2, at=s.frame(q2, parent=upper, origin=elbow).point(l2, 0, at=elbow))
    g = s.gravity().g
    for q, tau in zip((q1, q2), s.inputs("tau1 tau2"), strict=True):
        s.torque(tau, on=q)
    d = derive_structured(s.model)
    assert [e.rhs.func.__name__ for e in d.equations] == ["tau1", "tau2"]
    assert [str(e.lhs) for e in d.equations] == ["N_1_out", "N_2_out"]
    (v1, a1), (v2, a2) = ((q.diff(), q.diff().diff()) for q in (q1, q2))
    c2, s2, c1, c12 = sp.cos(q2), sp.sin(q2), sp.cos(q1), sp.cos(q1 + q2)
    first = m2 * l2**2 * (a1 + a2) + m2 * l1 * l2 * c2 * (2 * a1 + a2) + (m1 + m2) * l1**2 * a1
    first += -m2 * l1 * l2 * s2 * v2**2 - 2 * m2 * l1 * l2 * s2 * v1 * v2 + m2 * l2 * g * c12 + (m1 + m2) * l1 * g * c1
    second = m2 * l1 * l2 * c2 * a1 + m2 * l1 * l2 * s2 * v1**2 + m2 * l2 * g * c12 + m2 * l2**2 * (a1 + a2)
    for k, by_hand in enumerate((first, second)):
        apart = sp.expand(sp.expand_trig(d.expanded(k).lhs - by_hand))
        assert sp.expand(apart.subs({sp.sin(q) ** 2: 1 - sp.cos(q) ** 2 for q in (q1, q2)})) == 0
