"""Marks around statements say nothing of the system: bullets before code, headings between rules, numbers of entries.

Oracle: the equations of the cart with a pole, and the same with another sign.
"""

from __future__ import annotations

import pytest
import sympy as sp

from built_in import derivation
from lagrangian.check import Status
from student_answers import CART, POLE, right

CART_TYPED = "(M + m)*x'' + m*l*theta''*cos(theta) - m*l*theta'^2*sin(theta) + b*x' = F"
POLE_TYPED = "(J + m*l^2)*theta'' + m*l*x''*cos(theta) - m*g*l*sin(theta) = 0"
KINETIC = "T = 1/2 M x'^2 + 1/2 m (x'^2 + 2 l x' theta' cos theta + l^2 theta'^2) + 1/2 J theta'^2"
DETERMINANT = "((M + m)*(J + m*l^2) - m^2*l^2*cos(theta)^2)"
CART_SOLVED = f"((J + m*l^2)*(F - b*x' + m*l*theta'^2*sin(theta)) - m^2*l^2*g*sin(theta)*cos(theta))/{DETERMINANT}"
POLE_SOLVED = f"((M + m)*m*g*l*sin(theta) - m*l*cos(theta)*(F - b*x' + m*l*theta'^2*sin(theta)))/{DETERMINANT}"

ANSWERS = [
    f"1. `{KINETIC}`\n\nFinal:\n\n- `{CART_TYPED}`\n- `{POLE_TYPED}`",
    f"- `u = x + l*sin(theta)` (pole)\n\n```\n{CART_TYPED}\n{POLE_TYPED}\n```",
    f"--- x ---\n{CART}\n--- theta ---\n{POLE}",
    f"=== Equation of the cart ===\n{CART}\n-- 2nd --\n{POLE}",
    f"eq(1) = {CART_TYPED.replace(' = ', ' == ')};\neqn[2] := {POLE_TYPED};",
    f">> S = solve([eq1, eq2], [xdd, thdd]);\n>> simplify(S.xdd)\n \nans =\n \n{CART_SOLVED}\n \n>> S.thdd\n \nans ="
    f"\n \n{POLE_SOLVED}\n \n% xdd = x'', thdd = theta''",
    f"{CART}\n{POLE}\nPower of the force: P = F x'",
    f"{CART}  q.e.d.\n{POLE}, Q.E.D.",
    f"{CART} (w.z.b.w.)\n{POLE}. ∎",
    f"{KINETIC}\n(d/dt)(dT/dx') = (M + m) x'' + m l theta'' cos theta - m l theta'^2 sin theta\n{CART}\n{POLE}",
]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("answer", ANSWERS)
def test_marks_around_statements_are_no_part_of_them(answer: str) -> None:
    assert right(answer)
    sign = next(x for x in ("- m*g*l", "- m g l", "(M + m)*m*g") if x in answer)
    assert not right(answer.replace(sign, sign.replace("- ", "+ ").replace("(M + m)", "(M - m)")))


@pytest.mark.parametrize("line", ["P = - m g l cos theta", f"{KINETIC}\n(d/dt)(dT/dx') = (M + m) x'' + m l theta''"])
def test_what_is_marked_so_is_judged(line: str) -> None:
    assert not right(f"{line}\n{CART}\n{POLE}")


def test_two_equations_drawn_below_each_other_are_two() -> None:
    """The second begins with a minus, and does not go on with the first; the carts of the lecture."""
    t, m1, m2, k, F = sp.symbols("t m1 m2 k F")
    x, r = (sp.Function(name)(t) for name in ("x1", "x2r"))
    first = sp.pretty(sp.Eq(m1 * x.diff(t, 2) - k * r, -F), use_unicode=True)
    for force, sound in ((k * r - F, True), (-k * r - F, False)):
        rows = sp.pretty(sp.Eq(-m2 * (x.diff(t, 2) + r.diff(t, 2)), force), use_unicode=True).split("\n")
        second = "\n".join(f"- {row[1:]}" if row[0] == "-" else f" {row}" for row in rows)
        assert right(f">>> pprint(e1)\n{first}\n>>> pprint(e2)\n{second}", "lecture-3b") is sound


PRINTED = r"""
\begin{{align}}
- {} l m \sin{{\left(\theta \right)}} \dot{{\theta}}^{{2}} + l m \cos{{\left(\theta \right)}} \ddot{{\theta}}
  + \left(M + m\right) \ddot{{x}} + b \dot{{x}} = F \\
- g l m \sin{{\left(\theta \right)}} + l m \cos{{\left(\theta \right)}} \ddot{{x}}
  + \left(J + l^{{2}} m\right) \ddot{{\theta}} = 0
\end{{align}}"""
SHEET = f"### Cart\n\n- {KINETIC}\n- V = {{}} m g l cos theta\n- Q_x = F - b x'\n\nEquations:\n\n1. {CART}\n2. {POLE}"
BROKEN = "> EOM;\n[{}*l*m*cos(theta)*theta'' + (M + m)*x'' - l*m*sin(theta)*theta'^2 + b*x' = F,\n " + POLE_TYPED + "]"


@pytest.mark.sampled(3)
@pytest.mark.parametrize("answer", [PRINTED, PRINTED.replace("\\left", "").replace("\\right", ""), SHEET, BROKEN])
def test_a_minus_in_mathematics_is_none_of_a_list_and_a_bullet_no_minus(answer: str) -> None:
    assert right(answer.format(1))
    assert not right(answer.format(2))


def test_energies_with_bullets_are_judged() -> None:
    verdict = derivation("cart-pole").check(SHEET.format("2"))
    assert [(f.line.kind, f.status.right) for f in verdict.findings][:3] == [("T", True), ("V", False), ("Xi", True)]


STATES = f"""z' = (v, w, {CART_SOLVED}, {POLE_SOLVED})^T
where z = (x, theta, v, w)^T, v = x', w = theta'"""


@pytest.mark.parametrize(
    ("answer", "old", "new"),
    [
        (
            f"{KINETIC}   (1)\nV = m g l cos theta   (2)\nL = (1) - (2)   (3)\n{CART}   (4)\n{POLE}   (5)",
            "(1) -",
            "(1) +",
        ),
        (STATES, "(v, w, ", "(w, v, "),
    ],
    ids=["numbers behind lines", "states below their rates"],
)
def test_what_is_said_elsewhere_is_found(answer: str, old: str, new: str) -> None:
    assert right(answer)
    assert not any("not judged" in str(note) for note in derivation("cart-pole").check(answer).notes)
    assert not right(answer.replace(old, new))


@pytest.mark.sampled(4)
@pytest.mark.parametrize("said", ["Step 7: 5 = 6", "7. (5) = (6):", "Equating (5 = 6)"])
def test_numbers_that_are_equated_name_steps(said: str) -> None:
    assert right(f"{KINETIC}\n{said}\n{CART}\n{POLE}")
    assert not right(f"{said}\n{CART}")
    assert not right(f"{said.replace('5', '0')}\n{CART}\n{POLE}")


@pytest.mark.parametrize("label", ["(I)+(II):", "(a) - r·(b): ", "Gl. (I) + Gl. (II):", "(1)+(2):"])
def test_a_sum_of_labels_in_front_of_an_equation_says_which_were_added(label: str) -> None:
    total = f"{CART.partition('=')[0]} + {POLE.partition('=')[0]} = F"
    assert right(f"{label} {total}\n(II): {POLE}")
    assert not right(f"{label} {total} + b\n(II): {POLE}")


def test_a_dash_of_print_joins_the_words_of_a_label() -> None:
    """Also of a wrong equation, which is read and judged."""
    answer = f"E–L for x: {CART}\nE–L for θ: {POLE}"
    assert right(answer)
    assert derivation("cart-pole").check(answer.replace("+ b x'", "- b x'"), hint=0).status is Status.WRONG


PULL = "m (x'' + l theta'' cos theta - l theta'^2 sin theta)"


@pytest.mark.parametrize("last", ["**Pole:**", "The pole, with both put together:"])
def test_a_line_with_a_bullet_below_words_is_one_of_a_list_like_others(last: str) -> None:
    pole = "(J + m l^2) theta'' = m g l sin theta - m l x'' cos theta"
    answer = f"**Cart:**\n\n- M x'' = F - b x' - H\n- H = {PULL}\n\n{last}\n\n- {pole}\n\nSo\n\n{CART}\n{POLE}"
    assert right(answer)
    assert not right(answer.replace("= m g", "= - m g"))
