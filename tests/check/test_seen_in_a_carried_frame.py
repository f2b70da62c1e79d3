"""Energies as they are seen in a frame that is carried along as prescribed: a wagon, a lift, a turning table.

The oracle is what an answer states: it was right but for one slip, which is to be named, and nothing besides.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

from lagrangian import Derivation, System
from lagrangian.check.verb import CheckedAnswer
from lagrangian.model import time


@cache
def wagon() -> Derivation:
    sys = System("pendulum in a wagon that is pulled")
    u, theta = sys.coordinate("u"), sys.coordinate("theta")
    M, m, l, k, a, g = sys.parameters("M m l k a g")
    s_0 = sys.define("s_0", a * time**2 / 2)
    sys.particle(M, at=sys.point("P", (s_0 + u, 0)))
    sys.particle(m, at=sys.point("Q", (s_0 + u + l * sp.sin(theta), -l * sp.cos(theta))))
    sys.gravity((0, -1), g)
    sys.spring(k, deflection=u)
    return sys.derive()


@cache
def lift() -> Derivation:
    sys = System("pendulum in a lift")
    theta = sys.coordinate("theta")
    m, l, a, g, c = sys.parameters("m l a g c")
    sys.particle(m, at=sys.point("Q", (l * sp.sin(theta), a * time**2 / 2 - l * sp.cos(theta))))
    sys.gravity((0, -1), g)
    sys.damper(c, deflection=theta)
    return sys.derive()


@cache
def table() -> Derivation:
    sys = System("bead on a turning table")
    x, y = sys.coordinate("x"), sys.coordinate("y")
    m, k, W = sys.parameters("m k Omega")
    c, s = sp.cos(W * time), sp.sin(W * time)
    sys.particle(m, at=sys.point("P", (x * c - y * s, x * s + y * c)))
    sys.spring(k, deflection=x)
    sys.spring(k, deflection=y)
    return sys.derive()


T = "T = (M + m) u'^2/2 + m l u' theta' cos(theta) + m l^2 theta'^2/2"
V = "V = -m g l cos(theta) + k u^2/2"
WITH = f"{V} + (M + m) a u + m a l sin(theta)"
FORCES = "Q_u = -(M + m) a\nQ_theta = -m a l cos(theta)"
ALONG = "(M + m) u'' + m l theta'' cos(theta) - m l theta'^2 sin(theta) + k u = -(M + m) a"
ARM = "m l^2 theta'' + m l u'' cos(theta) + m g l sin(theta) = -m a l cos(theta)"
FORGOTTEN = "prescribed motion is missing"


def wrong_lines(verdict: CheckedAnswer) -> list[int]:
    return [f.line.number for f in verdict.findings if f.is_open]


def told(verdict: CheckedAnswer) -> str:
    return " ".join(str(m.what) for m in (*verdict.mistakes, *verdict.alternatives))


@pytest.mark.parametrize(
    "answer",
    [
        f"{T}\n{V}\n{FORCES}\n{ALONG}\n{ARM}",
        f"{T}\n{WITH}\n{ALONG}\n{ARM}",
        f"Energies relative to the wagon, with fictitious forces:\n{T}\n{V}\n{ALONG}\n{ARM}",
        f"d'Alembert, the force -m a on each mass\n{T}\n{V}\n{ALONG}\n{ARM}",
    ],
)
def test_what_is_right_in_the_wagon_is_right(answer: str) -> None:
    assert wagon().check(answer, hint=0).right
    assert not wagon().check(answer.replace("m g l", "m g u"), hint=0).right
    assert not wagon().check(answer.replace("- m l theta'^2", "+ m l theta'^2"), hint=0).right
    assert not wagon().check(answer.replace("= -m a l", "= m a l"), hint=0).right


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("answer", "open_lines", "said"),
    [
        (f"{T}\n{WITH}\n{ALONG}\n{ARM}".replace("m l u' theta' cos", "m l u' theta' sin"), [1], "sin θ"),
        (f"{T}\n{WITH}\n{ALONG}\n{ARM}".replace("+ m a l sin", "- m a l sin"), [2], "m a l sin θ"),
        (f"{T}\n{V}\n{FORCES}\n{ALONG}\n{ARM}".replace("m g l cos(theta)", "m g l sin(theta)"), [2], "sin θ"),
        (f"{T}\n{V}\n{FORCES}\n{ALONG}\n{ARM}".replace("+ m l^2 theta'^2/2", "+ m l^2 theta'^2"), [1], "½"),
        (f"inertia forces\n{T}\n{V}\n{ALONG}\n{ARM}".replace("+ k u^2/2", "+ k u^2"), [3], "½"),
    ],
)
def test_one_slip_in_the_wagon_is_named(answer: str, open_lines: list[int], said: str) -> None:
    verdict = wagon().check(answer)
    assert not verdict.right and wrong_lines(verdict)[: len(open_lines)] == open_lines
    assert FORGOTTEN not in told(verdict) and "ground" not in str(verdict)
    assert said in str(verdict).partition("What went wrong")[2]
    assert all(" t " not in str(d.term) for f in verdict.findings for d in f.differences)


def test_a_potential_of_inertia_forces_may_stand_apart() -> None:
    beside = "inertia potential (M + m) a u + m a l sin theta"
    slopes = "∂L/∂u = -k u - (M + m) a\n∂L/∂theta = -m l u' theta' sin(theta) - m g l sin(theta) - m a l cos(theta)"
    momenta = "∂L/∂u' = (M + m) u' + m l theta' cos(theta)\n∂L/∂theta' = m l u' cos(theta) + m l^2 theta'"
    answer = f"{V}\n{beside}\n{momenta}\n{slopes}\n{ALONG}\n{ARM}"
    wrong = wagon().check(answer.replace("-k u - (M", "k u - (M"))
    assert wrong_lines(wrong) == [5] and FORGOTTEN not in told(wrong)


@pytest.mark.parametrize("said", ["", "velocities relative to the wagon\n", "in the frame of the wagon\n"])
def test_a_motion_that_is_nowhere_was_forgotten(said: str) -> None:
    rest = f"{ALONG}\n{ARM}".replace("-(M + m) a", "0").replace("-m a l cos(theta)", "0")
    verdict = wagon().check(f"{said}{T}\n{V}\n{rest}")
    assert not verdict.right and FORGOTTEN in told(verdict)


def test_without_a_word_a_relative_energy_does_not_fit() -> None:
    assert not wagon().check(f"{T}\n{V}\n{ALONG}\n{ARM}", hint=0).right


@pytest.mark.parametrize(
    ("wrong", "said"),
    [("V = -m (g - a) l cos(theta)\nm l^2 theta'' + m l (g - a) sin(theta) + c theta' = 0", "inertia force"),
     ("V = -m (g + a) l cos(theta)\nm l theta'' + m (g + a) sin(theta) + c theta' = 0", "divided by l")],
)  # fmt: skip
def test_effective_gravity_in_a_lift(wrong: str, said: str) -> None:
    kinetic = "T = m l^2 theta'^2/2"
    right = "V = -m (g + a) l cos(theta)\nm l^2 theta'' + m l (g + a) sin(theta) + c theta' = 0"
    assert lift().check(f"{kinetic}\n{right}", hint=0).right
    verdict = lift().check(f"{kinetic}\n{wrong}")
    assert not verdict.right and said in told(verdict) and FORGOTTEN not in told(verdict)


@pytest.mark.parametrize(
    ("energies", "right", "wrong"),
    [
        ("V = k (x^2 + y^2)/2", "- m Omega^2 x", "+ m Omega^2 x"),
        ("V = k (x^2 + y^2)/2", "- 2 m Omega y'", "- m Omega y'"),
        ("V = k (x^2 + y^2)/2 - m Omega^2 (x^2 + y^2)/2", "- 2 m Omega y'", "+ 2 m Omega y'"),
    ],
)
def test_on_a_turning_table_the_wrong_force_is_named(energies: str, right: str, wrong: str) -> None:
    rows = "m x'' - 2 m Omega y' - m Omega^2 x + k x = 0\nm y'' + 2 m Omega x' - m Omega^2 y + k y = 0"
    answer = f"On the table, with fictitious forces\nT = m (x'^2 + y'^2)/2\n{energies}\n"
    assert table().check(answer + rows, hint=0).right
    verdict = table().check(answer + rows.replace(right, wrong))
    assert not verdict.right and wrong_lines(verdict) == [4]
    assert "inertia force" in str(verdict) and FORGOTTEN not in told(verdict)


STILL = f"{ALONG}\n{ARM}".replace("-(M + m) a", "0").replace("-m a l cos(theta)", "0")


@pytest.mark.parametrize(
    "stated",
    [
        "x_A' = a",
        "v_A = x_A' = a, y_A' = 0",
        "v_A = a",
        "the wagon has a: v² = (u' + a + l theta' cos(theta))² + (l theta' sin(theta))²",
        "v_x = u' + a + l theta' cos(theta)\nv_y = l theta' sin(theta)",
    ],
)
def test_a_speed_that_is_stated_wrongly_is_not_called_missing(stated: str) -> None:
    verdict = wagon().check(f"{stated}\n{STILL}")
    assert not verdict.right and FORGOTTEN not in told(verdict)
    assert "is a*t, not a." in told(verdict)


def test_a_speed_that_is_right_got_lost() -> None:
    verdict = wagon().check(f"v_x = u' + a t + l theta' cos(theta)\nv_y = l theta' sin(theta)\n{STILL}")
    assert not verdict.right and "in your velocities" in told(verdict)
    assert FORGOTTEN in told(wagon().check(f"v_x = u' + l theta' cos(theta)\nv_y = l theta' sin(theta)\n{STILL}"))
    for said in ("", "v_A = a t\n", "v_A = g\n"):
        assert FORGOTTEN in told(wagon().check(said + STILL))


def test_what_follows_from_a_wrong_speed_is_marked() -> None:
    verdict = wagon().check(f"x_A' = a\n{STILL}")
    assert wrong_lines(verdict) == [1] and not any("'x_A' = a'" in str(note) for note in verdict.notes)


def test_a_plain_speed_keeps_what_time_alone_gives() -> None:
    energy = "T = M v_M^2/2 + m ((u' + a t + l theta' cos(theta))^2 + (l theta' sin(theta))^2)/2"
    assert "is a*t + u', not a + u'" in told(wagon().check(f"v_M = u' + a\n{energy}"))
