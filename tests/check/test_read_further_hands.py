"""More of what students write is read: starred names, lists of results, drawn columns, lines of a derivation.

Oracle: the equations of the cart with a pole, in the grammar of model files. Every form has a wrong twin.
"""

import pytest

from built_in import derivation
from constrained_systems import smooth_puck
from student_answers import CART, POLE, right

LATEX = (
    r"$$%s\ddot x + ml\ddot\theta\cos\theta - ml\dot\theta^2\sin\theta + b\dot x = F$$"
    r"$$(J+ml^2)\ddot\theta + ml\ddot x\cos\theta - mgl\sin\theta = 0$$"
)


@pytest.mark.parametrize("star", [r"m^\ast", "m^{*}", r"M_{\text{r}}^\star", r"\mu^*_1"])
def test_a_name_with_a_star_in_latex(star: str) -> None:
    assert right(f"With ${star} = M + m$\n{LATEX % star}")
    assert not right(f"With ${star} = M + 2m$\n{LATEX % star}")


@pytest.mark.sampled(3)
@pytest.mark.parametrize("star", ["m*", "m^*", r"μ\*", "m_r⋆"])
def test_a_name_with_a_star_in_plain_text(star: str) -> None:
    sheet = f"{star} = M + m\nT* = 1/2 {star} x'^2 + m*l x' theta' cos theta + 1/2 (J + m*l^2) theta'^2\n"
    assert right(f"{sheet}{CART.replace('(M + m)', star)}\n{POLE}")
    assert not right(f"{sheet.replace('= M', '= 2 M')}{CART.replace('(M + m)', star)}\n{POLE}")


def test_the_constants_and_greek_letters_of_maxima() -> None:
    first = "(%o4) (M+m)*'diff(x,t,2)"
    first += "+m*l*cos(%theta)*'diff(%theta,t,2)-m*l*sin(%theta)*'diff(%theta,t,1)^2+b*'diff(x,t,1)=F"
    second = "(%o5) (J+m*l^2)*'diff(%theta,t,2)+m*l*sin(%pi/2 - %theta)*'diff(x,t,2)-m*g*l*sin(%theta)=0"
    assert right(f"{first}\n{second}")
    assert not right(f"{first}\n{second.replace('pi/2', 'pi/3')}")


@pytest.mark.parametrize("said", ["", "\n\n(* both = 0 *)", " (* == 0 each *)", "\n# = 0"])
def test_a_list_of_mathematica_whose_entries_are_zero(said: str) -> None:
    first = "b*x'[t] - F + m*x''[t] + M*x''[t] - l*m*Sin[theta[t]]*theta'[t]^2 + l*m*Cos[theta[t]]*theta''[t]"
    second = "J*theta''[t] + l^2*m*theta''[t] + l*m*Cos[theta[t]]*x''[t] - g*l*m*Sin[theta[t]]"
    sheet = f"In[8]:= {{D[D[L, x'[t]], t] - D[L, x[t]] - Qx}} // Expand\n\nOut[8]= {{{first}, {second}}}{said}"
    assert right(sheet)
    assert not right(sheet.replace("- g*l", "+ g*l"))


def test_what_mathematica_rewrites_is_what_stands_in_its_brackets() -> None:
    energies = "L = (M + m)/2*x'[t]^2 + m*l*x'[t]*theta'[t]*Cos[theta[t]] + (J + m*l^2)/2*theta'[t]^2"
    energies += " - m*g*l*Cos[theta[t]]\n"
    sheet = "Expand[D[D[L, x'[t]], t] - D[L, x[t]]] == F - b*x'[t]\n"
    sheet = energies + sheet + "FullSimplify[D[D[L, theta'[t]], t] - D[L, theta[t]]] == 0"
    assert right(sheet)
    assert not right(sheet.replace("F - b", "F + b")) and not right(sheet.replace(" == 0", " == F"))


def test_entries_of_a_matrix_that_are_set_in_columns() -> None:
    rows = "[ M + m        m l cos θ   -1 ] [ x'' ]   [ m l θ'^2 sin θ - b x' ]\n"
    rows += "[ m l cos(θ)   J + m l^2   0  ] [ θ'' ] = [ m g l sin θ           ]\n"
    rows += "[ 0            0 1            ] [ F   ]   [ F                     ]"
    assert right(rows)
    assert not right(rows.replace("J + m l^2", "J - m l^2"))


@pytest.mark.parametrize("half", ["¹⁄₂ ", "¹⁄₂", "¹/₂ ", "1⁄2 "])
def test_fractions_with_small_digits(half: str) -> None:
    sheet = f"T = {half}(M + m) x'^2 + m l x' theta' cos theta + {half}m l^2 theta'^2 + {half}J theta'^2"
    assert right(sheet)
    assert not right(sheet.replace("J", "2 J"))


def test_small_fractions_of_packages_of_latex() -> None:
    sheet = r"$T = \nicefrac12 (M + m)\dot x^2 + m l\dot x\dot\theta\cos\theta + \sfrac{1}{2} (J + m l^2)\dot\theta^2$"
    assert right(sheet)
    assert not right(sheet.replace("nicefrac12", "nicefrac13"))


@pytest.mark.sampled(4)
@pytest.mark.parametrize("by_time", ["d/dt(..) =", "- d/dt →", "d/dt -> ", "d/dt[…] =", 'd/dt(") =', "⇒ d/dt …:"])
def test_a_derivative_of_what_stands_above(by_time: str) -> None:
    mark = "- " if by_time.startswith("-") else ""
    sheet = f"{mark}dL/dtheta' = (J + m l^2) theta' + m l x' cos theta\n"
    sheet += f"{by_time} (J + m l^2) theta'' + m l x'' cos theta - m l x' theta' sin theta\n{CART}\n{POLE}"
    assert right(sheet)
    assert not right(sheet.replace("- m l x'", "+ m l x'"))


def test_a_derivative_of_dots_in_latex() -> None:
    sheet = r"$$\frac{\partial L}{\partial\dot x} = (M+m)\dot x + ml\dot\theta\cos\theta$$" + LATEX % "(M+m)"
    by_time = r"$$\frac{d}{dt}(\dots) = (M+m)\ddot x + ml\ddot\theta\cos\theta - ml\dot\theta^2\sin\theta$$"
    assert right(sheet.replace("$$$$", f"$${by_time}$$", 1))
    assert not right(sheet.replace("$$$$", f"$${by_time.replace('- ml', '+ ml')}$$", 1))


HEADED = """\
Lagrange: d/dt(∂T/∂q') − ∂T/∂q + ∂V/∂q = Q
*for x1*
- ∂T/∂x1' = (m1 + m2) x1' + m2 x2r'
- d/dt → (m1 + m2) x1'' + m2 x2r''
- Q1 = 0

*for x2r*
- ∂T/∂x2r' = m2 (x1' + x2r')
- d/dt → m2 (x1'' + x2r'')
- Q2 = F

**Answer**

(m1 + m2) x1'' + m2 x2r'' = 0

m2 (x1'' + x2r'') + k x2r = F
"""


def test_steps_in_a_list_below_headings_in_italics() -> None:
    assert right(HEADED, "lecture-3b")
    assert not right(HEADED.replace("→ m2", "→ 2 m2"), "lecture-3b")


def test_forces_without_dampers_are_right_beside_a_wrong_dissipation() -> None:
    found = derivation("two-disk-shaft").check("D = b*phi2'^2/2 + b_load*phi2'^2/2\nQ_phi1 = tau\nQ_phi2 = 0").findings
    assert [x.status.right for x in found] == [False, True, True]


def test_what_stands_in_which_equation_renames_nothing() -> None:
    sheet = "Constraint: r - R = 0\nMultiplier: 0 for theta, λ for r\nm r'' - m r theta'^2 = λ\n"
    sheet += "m r^2 theta'' + 2 m r r' theta' - m g r sin(theta) = 0\nr = R"
    assert "'lambda' was read as λ_contact" in smooth_puck().check(sheet).to_text()


@pytest.mark.sampled(4)
@pytest.mark.parametrize("of", ["f(r, theta)", "f", "g_1(r)"])
def test_a_stated_function_is_differentiated_by_a_coordinate(of: str) -> None:
    sheet = f"{of} = r^2/(2 R) - R/2 = 0\ndf/dr = r/R\ndf/dtheta = 0\nm r'' - m r theta'^2 + m g cos(theta) = lambda\n"
    sheet = "T = m/2 (r'^2 + r^2 theta'^2)\nd/dt(dT/dr') = m r''\n" + sheet.replace("df", f"d{of.partition('(')[0]}")
    sheet += "m r^2 theta'' + 2 m r r' theta' - m g r sin(theta) = 0\nr = R"
    assert smooth_puck().check(sheet, hint=0).right
    assert not smooth_puck().check(sheet.replace("r/R", "r/(2 R)"), hint=0).right


def test_a_sheet_in_numbers_for_a_system_with_a_constraint() -> None:
    sheet = (
        "Data: m = 0.4 kg, R = 1.2 m, g = 9.81 m/s^2\nT = 0.2 (r'^2 + r^2 theta'^2), V = 3.924 r cos(theta)\nr = 1.2\n"
    )
    sheet += "0.4 r'' - 0.4 r theta'^2 + 3.924 cos(theta) = lambda\n"
    sheet += "0.4 r^2 theta'' + 0.8 r r' theta' - 3.924 r sin(theta) = 0"
    assert smooth_puck().check(sheet, hint=0).right
    found = smooth_puck().check(sheet.replace("0.4 r theta'^2", "0.8 r theta'^2"))
    assert [x.line.number for x in found.findings if not x.status.right] == [4]
    assert not smooth_puck().check(sheet.replace("V = 3.924", "V = 3.9"), hint=0).right


@pytest.mark.sampled(2)
@pytest.mark.parametrize("amount", ["0.6 m", "0.6", "0.60 m"])
def test_what_an_abbreviation_amounts_to_is_no_other_value_of_it(amount: str) -> None:
    sheet = f"a = 2 l = {amount}\n{CART.replace('m l', '1/2 m a')}\n{POLE.replace('m l x', '1/2 m a x')}"
    assert right(sheet)
    assert not right(sheet.replace("2 l", "3 l"))


@pytest.mark.parametrize(
    "work", ["δW = F δx - b x' δx + 0 · δtheta", "δW = Fδx - bx'δx", "δW_F = (F - b x')·δx, δW = 0 δtheta"]
)
def test_virtual_displacements_are_no_unknown_names(work: str) -> None:
    verdict = derivation("cart-pole").check(f"{work}\nQ_x = F - b x'\n{CART}\n{POLE}")
    assert verdict.right
    assert "delta" not in verdict.to_text()
    assert "δ" not in verdict.to_text()
    assert right(f"δ = theta\n{CART.replace('theta', 'δ')}\n{POLE.replace('theta', 'δ')}")


@pytest.mark.parametrize("named", ["theta", "th"])
def test_declarations_of_functions_behind_another_on_one_line(named: str) -> None:
    sheet = f">>> t = symbols('t'); x = Function('x')(t); {named} = sp.Function('theta')(t)\n>>> print(eq1, '= 0')\n"
    sheet += f"{CART.replace('theta', f'{named}').replace('= F', '- F = 0')}\n{POLE.replace('theta', named)}"
    assert right(sheet)
    assert not right(sheet.replace("- m g", "+ m g"))


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    [
        "(track begins at x = 0)",
        "(rest position: theta = pi/2)",
        "V = 0 at theta = pi/2",
        "[x = 0, the spring relaxed]",
    ],
)
def test_where_a_coordinate_or_an_energy_is_zero_is_a_remark(said: str) -> None:
    assert right(f"V = m g l cos theta\n   {said}\n{CART}\n{POLE}")
    assert not right(f"V = m g l sin theta\n   {said}\n{CART}\n{POLE}")
