"""Answers in LaTeX: the ways people write them, and the package's own documents read back."""

from __future__ import annotations

from random import Random

import pytest
import sympy as sp
from sympy.core.function import AppliedUndef

import built_in
import lagrangian as lg
from built_in import derivation
from lagrangian.check.reading import ENERGIES, generalized_force, parse_answer

t = sp.Symbol("t")
theta = sp.Function("theta")(t)
m, L, b, g = sp.symbols("m L b g")


def read(text: str, example: str = "pendulum"):
    return parse_answer(text, built_in.system(example).model)


PENDULUM = m * L**2 * theta.diff(t, 2) + b * theta.diff(t) + m * g * L * sp.sin(theta)


@pytest.mark.parametrize(
    "written",
    [
        r"mL^2\ddot\theta + b\dot\theta + mgL\sin\theta = 0",
        r"m L^{2} \ddot{\theta} + b \dot{\theta} + m g L \sin{\left(\theta \right)} = 0",
        r"\[ m\,L^2\,\ddot{\theta}(t)+b\cdot\dot\theta(t) = -mg\,L\sin(\theta(t)) \]",
        r"$$mL^2\frac{d^2\theta}{dt^2}+b\frac{d\theta}{dt}+mgL\sin\theta=0$$",
        r"\begin{equation} L\left(mL\frac{\mathrm{d}^2}{\mathrm{d}t^2}\theta+mg\sin\theta\right)=-bθ̇ \end{equation}",
        r"\frac{d}{dt}\left(mL^2\dot\theta\right) + b\theta' + mgL\sin(\theta) = 0",
        r"\begin{align*} mL^2\theta'' &= -b\dot\theta \\ &\quad - mgL\sin\theta \tag{1}\end{align*}",
        r"so we get $mL^2\ddot\vartheta + b\dot{\vartheta} = -mgL\sin\vartheta$, as it should be.",
        r"\boxed{mL^2\ddot\theta + b\dot\theta + mgL\sin\theta = 0}",
        r"$$\underline{\underline{m\underline{L}^2\ddot\theta + b\dot\theta + mgL\sin\theta = 0}}$$",
        r"\begin{align*} \theta:&\quad mL^2\ddot\theta + b\dot\theta + mgL\sin\theta = 0 \end{align*}",
        r"\begin{align*} \delta\theta:&\quad mL^2\ddot\theta + b\dot\theta + mgL\sin\theta = 0 \end{align*}",
        r"\begin{eqnarray} mL^2\ddot\theta + b\dot\theta &=& - mgL\sin\theta:\end{eqnarray}",
        r"(1)\quad mL^2\ddot\theta = -b\dot\theta - mgL\sin\theta \qquad (1)",
        r"\mathrm{m}L^2\ddot{\theta}+\frac{b}{1}\dot\theta+\tfrac22 mgL\sin \theta=0",
        r"mL^2 d^2\theta/dt^2 + bd\theta/dt + mgL\sin\theta = 0",
        r"L m\, \mathrm{d}(L\dot\theta)/\mathrm{d}t + b d{\theta}/d t + mgL\sin\theta = 0",
        r"\frac{d}{dt} mL^2\dot\theta + b\dot\theta + mgL\,\sin\theta = 0 % a comment",
        r"m_{}L^2θ̈ + bθ̇ + mgL\sin θ = 0",
    ],
)
def test_one_equation_in_many_hands(written):
    (line,) = read(written).lines
    assert sp.expand((line.residual - PENDULUM).doit()) == 0


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        (r"\sin 2\theta \dot\theta", sp.sin(2 * theta) * theta.diff(t)),
        (r"\sin^2\theta\cos\theta", sp.sin(theta) ** 2 * sp.cos(theta)),
        (r"\sin^{-1}\theta", sp.asin(theta)),
        (r"\cos\theta\sin\theta", sp.cos(theta) * sp.sin(theta)),
        (r"\cos bt", sp.cos(b * t)),
        (r"\cos\theta m", sp.cos(theta) * m),
        (r"\frac12 m", m / 2),
        (r"\frac{1}{2}{m}", m / 2),
        (r"\sqrt{m}\sqrt[3]{L}", sp.sqrt(m) * L ** sp.Rational(1, 3)),
        (r"e^{-bt}", sp.exp(-b * t)),
        (r"\left|\theta\right| + \lvert b\rvert", sp.Abs(theta) + sp.Abs(b)),
        (r"\operatorname{sign}(\dot\theta)", sp.sign(theta.diff(t))),
        (r"\arctan\theta", sp.atan(theta)),
        (r"m\times L\cdot b/g", m * L * b / g),
        (r"\dot{(\theta^2)}", 2 * theta * theta.diff(t)),
        (r"\dot\theta^2L", theta.diff(t) ** 2 * L),
        (r"\theta^{\prime\prime}", theta.diff(t, 2)),
        (r"½m²", m**2 / 2),
        (r"\pi t", sp.pi * t),
        (r"-\bigl[m-(L)\bigr]^2", -((m - L) ** 2)),
    ],
)
def test_notation(written, meant):
    (line,) = read(rf"{written} = 0 \quad").lines
    assert sp.expand(line.lhs - meant) == 0


def test_letters_are_told_apart_by_what_the_model_knows():
    (line,) = read(r"m_1gL_1\sin\theta_1 + m1 L_{2}x = 0", "double-pendulum").lines
    m1, L1, L2, x = sp.symbols("m1 L1 L2 x")
    assert line.lhs == m1 * g * L1 * sp.sin(sp.Function("theta1")(t)) + m1 * L2 * x


@pytest.mark.parametrize(
    "frame",
    [
        r"\begin{cases} %s \end{cases}",
        r"\left\{\begin{array}{l} %s \end{array}\right.",
        r"\begin{align} \begin{split} %s \end{split} \end{align}",
        r"\[ \boxed{\begin{aligned} %s \end{aligned}} \]",
        r"\begin{gather*} %s \end{gather*}",
        "%s",
    ],
)
def test_a_system_of_equations_in_many_frames(frame):
    answer = read(frame % r"m_1\ddot x_1 + k(x_1-x_2) = -F \\ m_2\ddot x_2 - k(x_1-x_2) = F,", "lecture-3a")
    m1, m2, k = sp.symbols("m1 m2 k")
    x1, x2, F = (sp.Function(n)(t) for n in ("x1", "x2", "F"))
    first, second = (line.residual for line in answer.lines)
    assert sp.expand(first - m1 * x1.diff(t, 2) - k * (x1 - x2) - F) == 0
    assert sp.expand(second - m2 * x2.diff(t, 2) + k * (x1 - x2) + F) == 0


def test_a_hand_derivation_in_latex():
    answer = read(
        r"""We choose $x_1$ and $x_{2r}$. Then
\begin{align}
 T^* &= \frac12 m_1 \dot{x}_1^2 + \tfrac{1}{2} m_2 (\dot x_1+\dot{x_{2r}})^2 \\
 V &= \frac{1}{2}k x_{2r}^2, \qquad \mathcal{L} = T^* - V
\end{align}
\[ \frac{d}{dt}\left(\frac{\partial \mathcal L}{\partial \dot x_1}\right) - \frac{\partial L}{\partial x_1} = \Xi_1 \]
$$ \begin{bmatrix} m_1+m_2 & m_2 \\ m_2 & m_2\end{bmatrix}\begin{bmatrix}\ddot x_1\\ \ddot x_{2r}\end{bmatrix}
 + \begin{bmatrix}0\\kx_{2r}\end{bmatrix} = \begin{pmatrix}0\\F\end{pmatrix} $$""",
        "lecture-3b",
    )
    assert [line.kind for line in answer.lines] == ["T", "V", "L", "equation", "equation", "equation"]
    m1, m2, k = sp.symbols("m1 m2 k")
    x1, x2r, F = (sp.Function(n)(t) for n in ("x1", "x2r", "F"))
    first = (m1 + m2) * x1.diff(t, 2) + m2 * x2r.diff(t, 2)
    assert sp.expand(answer.lines[3].residual - first + generalized_force("x1")) == 0
    assert sp.expand(answer.lines[4].residual - first) == 0
    assert sp.expand(answer.lines[5].residual - m2 * (x1 + x2r).diff(t, 2) - k * x2r + F) == 0


# -- the package's own documents ----------------------------------------------------------------------------------


def number(expr: sp.Expr, d: lg.Derivation) -> sp.Float:
    """The value at one state, the same for every expression."""
    expr = d.model.expand(expr, constants=True)
    table: dict[sp.Basic, sp.Expr] = {}
    atoms = [*expr.atoms(sp.Derivative), *expr.atoms(AppliedUndef), *expr.free_symbols]
    for atom in atoms:
        table[atom] = sp.Rational(Random(str(atom)).randint(200, 1200), 997)
    return sp.N(expr.xreplace(table), 40)


NAMES = [
    *("pendulum", "lecture-1", "lecture-2", "lecture-3b", "cart-pole", "double-pendulum-relative", "kapitza-pendulum"),
    *("quarter-car", "spring-net", "spinning-top", "two-carts", "bead-on-hoop"),
]
DOCUMENTS = [(name, "lecture") for name in NAMES] + [("lecture-3b", "physics"), ("cart-pole", "robotics")]


@pytest.mark.sampled(("physics", "robotics", "two-carts"))
@pytest.mark.parametrize(("name", "notation"), DOCUMENTS)
def test_our_own_document_is_read_back(name, notation):
    d = derivation(name)
    answer = parse_answer(d.to_latex(notation=notation, full=True), d.model)
    coordinates = [c.name for c in d.model.coordinates]
    equations = dict(zip(coordinates, d.equations, strict=True))
    meant = {("T", None): d.T, ("V", None): d.V, ("L", None): d.L}
    for c in d.model.coordinates:
        momentum = d.model.expand(d.L).diff(c.rate)
        meant |= {("Xi", c.name): d.Xi[c.symbol], ("p", c.name): momentum, ("p-rate", c.name): momentum.diff(t)}
        meant["slope", c.name] = d.model.expand(d.L).diff(c.symbol)
        meant["left", c.name] = momentum.diff(t) - meant["slope", c.name]
    values = {key: number(value, d) for key, value in meant.items()}
    seen = set()
    for line in answer.lines:
        key = (line.kind, line.name)
        if key in values:
            assert abs(number(line.rhs, d) - values[key]) < 1e-30 * (1 + abs(values[key])), line.text
            seen.add(key)
    assert seen == set(values)
    residuals = [abs(number(e.lhs - e.rhs, d)) for e in equations.values()]
    told = [abs(number(line.residual, d)) for line in answer.lines if line.kind == "equation" and not held(line)]
    for value in residuals:
        assert any(abs(value - x) < 1e-30 * (1 + value) for x in told)
    assert not [u.name for u in answer.unknown]


def held(line) -> bool:
    """Whether a Ξ or an energy stands in a line without its value."""
    names = {a.func.__name__ for a in line.residual.atoms(AppliedUndef)}
    return any(n.startswith("⟨") for n in names) or bool(names & {str(e.func) for e in ENERGIES.values()})


def test_one_half_of_a_symmetric_matrix_may_be_left_out():
    d = derivation("lecture-3b")
    columns = r"\begin{bmatrix} \ddot x_1 \\ \ddot x_{2r} \end{bmatrix}"
    right = r"\begin{bmatrix} 0 \\ F - k x_{2r} \end{bmatrix}"

    def residuals(M: str) -> list[sp.Expr]:
        return [line.residual for line in parse_answer(f"${M} {columns} = {right}$", d.model).lines]

    upper = r"\begin{bmatrix} m_1 + m_2 & m_2 \\ LOWER & m_2 \end{bmatrix}"
    whole = residuals(upper.replace("LOWER", "m_2"))
    assert len(whole) == 2
    for lower in (r"\text{sym.}", r"\mbox{symmetric}", r"\text{ Symm. }"):
        assert residuals(upper.replace("LOWER", lower)) == whole
        assert residuals(rf"\begin{{bmatrix}} m_1 + m_2 & {lower} \\ m_2 & m_2 \end{{bmatrix}}") == whole
    with pytest.raises(lg.ParseError, match="has no counterpart above the diagonal"):
        residuals(r"\begin{bmatrix} m_1 + m_2 & \text{sym.} \\ \text{sym.} & m_2 \end{bmatrix}")


@pytest.mark.parametrize("sign", ["&=&", "&=", "="])
def test_a_row_states_what_a_letter_stands_for_behind_a_gap(sign: str) -> None:
    sheet = r"\begin{eqnarray*} T " + sign + r" \frac{m}{2}\varrho^2\dot\theta^2,\qquad \varrho=L \\"
    sheet += r"mL^2\ddot\theta &=& -b\dot\theta - mg\varrho\sin\theta \end{eqnarray*}"
    assert derivation("pendulum").check(sheet, hint=0).right
    assert not derivation("pendulum").check(sheet.replace("=L ", "=2L "), hint=0).right


def test_words_lead_to_what_a_letter_stands_for() -> None:
    sheet = r"\begin{align*} &\text{Solved, with } \Delta=mL^2:\\ "
    sheet += r"&\ddot\theta=-\frac{b\dot\theta+mgL\sin\theta}{\Delta} \end{align*}"
    assert derivation("pendulum").check(sheet, hint=0).right
    assert not derivation("pendulum").check(sheet.replace("mL^2:", "mL:"), hint=0).right
