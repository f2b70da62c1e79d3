"""The classical Runge–Kutta method of order 4 with fixed steps."""

from .explicit import Explicit, Tableau

RK4 = Explicit(
    "rk4",
    "classical Runge–Kutta, order 4, fixed step",
    "W. Kutta, Z. Math. Phys. 46 (1901) 435–453",
    4,
    Tableau(
        c=(0.0, 1 / 2, 1 / 2, 1.0),
        a=((), (1 / 2,), (0.0, 1 / 2), (0.0, 0.0, 1.0)),
        b=(1 / 6, 1 / 3, 1 / 3, 1 / 6),
    ),
)
