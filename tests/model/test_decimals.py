"""Numbers that were written as decimals are shown so, exactly, wherever they come from; fractions stay fractions."""

import pytest
import sympy as sp

import lagrangian as lg

BLOCK = """
name = "block"
[coordinates]
x = ""
[parameters]
m = 1
[inputs]
F = ""
[[particle]]
mass = "m"
at = ["x", "{height}"]
[[friction]]
name = "belt"
deflection = "x"
normal = "m*{g}"
mu = {mu}
[[force]]
deflection = "x"
value = "F/3"
"""


def block(g: str, mu: str, height: str = "0") -> lg.System:
    return lg.loads(BLOCK.format(g=g, mu=mu, height=height))


@pytest.mark.parametrize(
    ("system", "text", "latex"),
    [
        (block("9.81", "0.3"), "2.943 m sgn(ẋ)", "2.943 m"),
        (block("9.81", "1"), "9.81 m sgn(ẋ)", "9.81 m"),
        (block("981/100", "1"), "(981/100) m sgn(ẋ)", r"\tfrac{981}{100} m"),
        (block("2.5", "1"), "2.5 m sgn(ẋ)", "2.5 m"),
        (block("5/2", "1"), "(5/2) m sgn(ẋ)", r"\tfrac{5}{2} m"),
        (block("5/2", "1", "0.3"), "(5/2) m sgn(ẋ)", r"\tfrac{5}{2} m"),
    ],
)
def test_a_file_s_decimals_are_printed_as_they_were_written(system: lg.System, text: str, latex: str) -> None:
    d = system.derive()
    assert f"m ẍ + {text} = ⅓ F" in d.to_text(brief=True)
    assert latex in d.to_latex(brief=True)
    assert "½ m ẋ²" in d.to_text(brief=True)


def described() -> lg.System:
    system = lg.System("in Python")
    x, m = system.coordinates("x"), system.parameter("m", 1)
    carried = system.frame(0).point(0.3 * x, 0.5)
    system.particle(m, at=carried)
    system.potential(1.25 * m * x)
    return system


def test_decimals_in_python_are_remembered_and_saved() -> None:
    system = described()
    assert system.model.decimals == {sp.Rational(3, 10), sp.Rational(1, 2), sp.Rational(5, 4)}
    assert "0.09 m ẍ + 1.25 m = 0" in system.derive().to_text(brief=True)
    again = lg.loads(system.to_toml())
    assert "0.3*x" in system.to_toml()
    assert again.model.decimals == system.model.decimals
    assert again.derive().to_text() == system.derive().to_text()
    assert system.in_coordinates({"x": "2*y"}).model.decimals == system.model.decimals


@pytest.mark.parametrize("g", ["9.81", "981/100", "(981/100)"])
def test_answers_with_decimals_and_with_fractions_are_read(g: str) -> None:
    assert block("9.81", "1").derive().check(f"m*x'' + {g}*m*sign(x') = F/3").right
