"""Formulas that SymPy draws with the signs of a keyboard alone: bars of -, brackets of / | and backslashes.

Oracle: SymPy draws the equations of known systems, of which each has a wrong twin.
"""

import pytest
import sympy as sp
from drawn_carts import J, cart, l, m, t, theta, x

from built_in import derivation


def drawn(thing: sp.Basic, wide: bool = True) -> str:
    """What SymPy's pprint shows without Unicode, whole or in pieces as in a window of 80 columns."""
    return str(sp.pretty(thing, use_unicode=False, wrap_line=not wide, num_columns=80))


@pytest.mark.sampled(4)
@pytest.mark.parametrize("form", ["equations", "pieces", "session", "fractions", "stacked", "matrix"])
def test_what_sympy_draws_without_unicode_is_read(form: str) -> None:
    def answer(sign: int) -> str:
        first, second = cart(sign)
        e1, e2 = sp.Eq(first, 0), sp.Eq(second, 0)
        if form == "fractions":
            e1 = sp.Eq(x.diff(t, 2) / 2, sp.solve(first, x.diff(t, 2))[0] / 2)
            e2 = sp.Eq(theta.diff(t, 2) / m, theta.diff(t, 2) / m - second / sp.sqrt(J + m / l))
        if form == "session":
            return f">>> pprint(e1, wrap_line=False)\n{drawn(e1)}\n>>> pprint(e2, wrap_line=False)\n{drawn(e2)}\n"
        if form == "matrix":
            return drawn(sp.Matrix([first, second]))
        return f"{drawn(e1, form != 'pieces')}{'' if form == 'stacked' else chr(10)}\n{drawn(e2, form != 'pieces')}"

    judge = derivation("cart-pole")
    assert judge.check(answer(1), hint=0).right
    assert not judge.check(answer(-1), hint=0).right


def test_a_drawing_that_is_cut_does_not_go_on_from_a_whole_one_above() -> None:
    judge = derivation("elastic-pendulum")
    first, second = (sp.Eq(e.lhs - e.rhs, 0) for e in judge.equations)
    assert judge.check(f"{drawn(first, False)}\n\n{drawn(second, False)}", hint=0).right
    assert not judge.check(f"{drawn(first, False)}\n\n{drawn(sp.Eq(second.lhs + 1, 0), False)}", hint=0).right
