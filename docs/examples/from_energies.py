"""A bead on a wire bent to a parabola y = c x²: energies that are at hand already, and dissipation by Rayleigh."""

from sympy import Rational, symbols
from sympy.physics.mechanics import dynamicsymbols

import lagrangian as lg

x = dynamicsymbols("x")
m, c, g, b = symbols("m c g b")
height = c * x**2
speed2 = x.diff() ** 2 + height.diff("t") ** 2

bead = lg.System.from_energies(
    x,
    T=Rational(1, 2) * m * speed2,
    V=m * g * height,
    D=Rational(1, 2) * b * speed2,
    name="bead on a parabola",
)
d = bead.derive()

if __name__ == "__main__":
    for equation in d.equations:
        print(equation)
    print("M =", d.mass_matrix)
