r"""Slopes of what a system or an answer defines by a coordinate, in every notation, beside a parameter called d.

Oracle: a lid on a hinge with a weight on a cord of the length s = √(h² + d² − 2 h d cos φ), by hand:
s' = h d sin φ/s, s'' = (h d cos φ − s'²)/s and (I + m s'²) φ̈ + m s' s'' φ̇² + k s'² φ̇ + m g s' = M. Every form has
twins with a wrong factor in the first slope, in the second one and in the equation.
"""

from functools import cache

import pytest

import lagrangian as lg

LID = """name = "lid"
[coordinates]
phi = {}

[parameters]
I = "0.3 kg*m^2"
h = "0.5 m"
d = "1.2 m"
m = "2 kg"
k = "6 N*s/m"
g = "9.81 m/s^2"

[inputs]
M = "N*m"

[define]
s = "sqrt(h^2 + d^2 - 2*h*d*cos(phi))"

[points]
W = ["d", "0", "s"]

[[frame]]
name = "lid"
angle = "phi"
axis = [0, 0, 1]

[[rigid_body]]
name = "lid"
mass = 0
inertia = ["0", "0", "I"]
at = "origin"
frame = "lid"

[[particle]]
name = "weight"
mass = "m"
at = "W"

[[gravity]]
direction = [0, 0, -1]
g = "g"

[[damper]]
name = "guide"
b = "k"
deflection = "s"

[[force]]
name = "motor"
value = "M"
deflection = "phi"
"""
LENGTH = "s = √(h² + d² − 2 h d cos φ)\n"
PRIMED = (
    "s' = h d sin φ/s\ns'' = (h d cos φ − s'²)/s\n(I + m s'²) φ̈ + m s' s'' φ̇² + k s'² φ̇ + m g s' = M\n"  # with a legend
)


@cache
def lid() -> lg.Derivation:
    """A lid whose cord lifts a weight in a guide with a damper."""
    return lg.loads(LID).derive()


def right(answer: str) -> bool:
    """Whether an answer about the lid is right in all that is judged."""
    return bool(lid().check(answer).right)


def quotients(first: str, second: str) -> str:
    """An answer with slopes as they are written."""
    return LENGTH + (
        f"{first} = h d sin φ/s\n{second} = (h d cos φ − ({first})²)/s\n"
        f"(I + m ({first})²) φ̈ + m ({first}) ({second}) φ̇² + k ({first})² φ̇ + m g {first} = M\n"
    )


PLAIN = {
    "ds/dφ": quotients("ds/dφ", "d²s/dφ²"),
    "d^2s": quotients("ds/dphi", "d^2s/dphi^2"),
    "d2s": quotients("ds/dphi", "d2s/dphi2"),
    "∂s/∂φ": quotients("∂s/∂φ", "∂²s/∂φ²"),
    "operators": quotients("d/dφ(s)", "d²/dφ²(s)"),
    "slope of a slope": quotients("ds/dφ", "d/dφ(ds/dφ)"),
    "indices": quotients("s_φ", "s_φφ").replace("\ns_φ =", "\ns_φ = ∂s/∂φ =").replace("\ns_φφ =", "\ns_φφ = ∂²s/∂φ² ="),
    "primes": f"Notation: dot = d/dt, prime = d/dφ.\n{LENGTH}{PRIMED}",
    "primes in words": f"A prime denotes the derivative with respect to φ.\n{LENGTH}{PRIMED}",
    "primes in a list": f"* prime = d/dφ\n* {PRIMED.replace(chr(10), chr(10) + '* ', 1)}".replace("/s\n(", "/s\n\n("),
    "primes unsaid": LENGTH + PRIMED,
    "primes declared": LENGTH + PRIMED.replace("' =", "' = ds/dφ =", 1).replace("'' =", "'' = d²s/dφ² ="),
    "primes applied": LENGTH + PRIMED.replace("''", "″").replace("'", "'(φ)").replace("″", "''(φ)"),
    "primes of own names": f"prime = d/dφ\n{LENGTH}{PRIMED.partition('(I')[0]}A = I + m s'² ⇒ A' = 2 m s' s''\n"
    "A φ̈ + ½ A' φ̇² + k s'² φ̇ + m g s' = M\n",
    "spelled": LENGTH
    + "p = ds/dφ = h d sin φ/s, dp = dp/dφ = (h d cos φ − p²)/s\n"
    + "(I + m p²) φ̈ + m p dp φ̇² + k p² φ̇ + m g p = M\n",
    "spelled twice": LENGTH
    + "sd = ds/dphi = h d sin φ/s, sdd = d2s/dphi2 = (h d cos φ − sd²)/s\n"
    + "(I + m sd²) φ̈ + m sd sdd φ̇² + k sd² φ̇ + m g sd = M\n",
}
TEX = r"\[ s=\sqrt{h^2+d^2-2hd\cos\varphi},\quad 1=\frac{hd\sin\varphi}{s},\quad 2=\frac{hd\cos\varphi-(1)^2}{s} \]" + (
    "\n" + r"\[ (I+m(1)^2)\ddot\varphi+m(1)(2)\dot\varphi^2+k(1)^2\dot\varphi+mg(1)=M \]"
)


def latex(first: str, second: str) -> str:
    """The same in LaTeX."""
    whole = TEX.replace("(1)", "(ONE)").replace("(2)", "(TWO)").replace("1=", "ONE=").replace("2=", "TWO=")
    return whole.replace("ONE", first).replace("TWO", second)


LATEX = {
    "d": latex(r"\frac{ds}{d\varphi}", r"\frac{d^2s}{d\varphi^2}"),
    "upright": latex(r"\frac{\mathrm{d}s}{\mathrm{d}\varphi}", r"\frac{\mathrm{d}^{2} s}{\mathrm{d}\varphi^{2}}"),
    "round": latex(r"\dfrac{\partial s}{\partial\varphi}", r"\dfrac{\partial^2 s}{\partial\varphi^2}"),
    "in a line": latex(r"ds/d\varphi", r"d^2s/d\varphi^2"),
    "round in a line": latex(r"\partial s/\partial\varphi", r"\partial^2 s/\partial\varphi^2"),
    "physics": latex(r"\dv{s}{\varphi}", r"\dv[2]{s}{\varphi}"),
    "primes": latex("s'", "s''").replace("(s')", "s'").replace("(s'')", "s''"),
    "primes applied": latex(r"s'(\varphi)", r"s''(\varphi)"),
    "primes said": r"Here $'$ means $d/d\varphi$. " + latex("s'", "s''"),
}
ALL = {**PLAIN, **{f"LaTeX, {name}": answer for name, answer in LATEX.items()}}
WRONG = (
    (("= h d sin", "= 2 h d sin"), (r"\frac{hd\sin", r"\frac{2hd\sin")),
    (("(h d cos", "(2 h d cos"), (r"\frac{hd\cos", r"\frac{2hd\cos")),
    (("+ m g", "+ 2 m g"), ("+mg", "+2mg")),
)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("form", ALL)
def test_slopes_are_read_in_every_notation(form: str) -> None:
    answer = ALL[form]
    assert right(answer), answer
    for changes in WRONG:
        wrong = answer
        for before, after in changes:
            wrong = wrong.replace(before, after, 1)
        assert wrong != answer and not right(wrong), wrong


@pytest.mark.slow
def test_factors_of_slopes_in_an_equation_are_judged() -> None:
    whole = quotients("ds/dφ", "d²s/dφ²").splitlines()[-1]
    assert right(whole) and right(LENGTH + whole)
    assert not right(whole.replace("(d²s/dφ²)", "½ (d²s/dφ²)"))
    assert not right(whole.replace("(d²s/dφ²)", "(ds/dφ)"))
    assert not right(whole.replace("φ̇²", "φ̇"))


def test_primes_beside_primes_of_coordinates_are_rates() -> None:
    rates = LENGTH + "s' = h d sin φ φ'/s\nI φ'' + (m s'' + k s' + m g) h d sin φ/s = M"
    assert right(rates) and not right(rates.replace(" φ'/s", "/s"))


NUMBERS = """{}
(0.3 + 0.72 sin²φ/s²) φ̈ + 0.72 sin φ (cos φ/s² − 0.6 sin²φ/s⁴) φ̇² + 2.16 sin²φ/s² φ̇ + 11.772 sin φ/s = M
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "above", ["", "h d = 0.6, so s² = 1.69 − 1.2 cos φ", "s = √(1.69 − 1.2 cos φ)", "h² + d² = 1.69"]
)
def test_own_lengths_of_a_system_are_in_numbers_where_an_answer_is(above: str) -> None:
    answer = NUMBERS.format(above)
    assert right(answer), lid().check(answer).to_text()
    for before, after in (("− 1.2", "− 1.3"), ("0.6 sin²", "0.7 sin²"), ("11.772", "11.472"), ("2.16", "2.61")):
        assert before not in answer or not right(answer.replace(before, after))


CROSS = """r = (h cos φ, h sin φ), u = (d − h cos φ, −h sin φ)
S = m (g + s̈) + k ṡ
{} = −S h d sin φ/s
I φ̈ = M − S h d sin φ/s
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize("moment", ["r × S u/s", "r × (S/s) u", "S/s · r × u", "(r × S·u)/s", "M_z = r × S u/s"])
def test_a_cross_product_goes_on_behind_a_factor(moment: str) -> None:
    answer = CROSS.format(moment)
    assert right(answer), lid().check(answer).to_text()
    assert not right(answer.replace("= −S", "= S"))
    assert not right(answer.replace("= −S", "= −2 S"))
