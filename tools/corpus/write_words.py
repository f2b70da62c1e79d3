"""How people write what they found: plain text with one of many dots, Greek or spelled names, LaTeX; in what form."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.physics.vector.printing import vlatex
from sympy.printing.str import StrPrinter
from sympy.simplify.fu import TR8
from write_systems import System

GREEK = {"theta": "θ", "phi": "φ", "psi": "ψ", "alpha": "α", "tau": "τ", "omega": "ω", "Omega": "Ω"}
LOW = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


def unicode_name(name: str) -> str:
    for spelled, letter in GREEK.items():
        if name.startswith(spelled):
            return letter + name.removeprefix(spelled).translate(LOW)
    head = name.rstrip("0123456789")
    return head + name[len(head) :].translate(LOW) if len(head) == 1 else name


DOTS: dict[str, Callable[[str, int], str]] = {
    "primes": lambda n, k: n + "'" * k,
    "suffix": lambda n, k: f"{n}_{'d' * k}ot" if k == 1 else f"{n}_ddot",
    "leibniz": lambda n, k: f"d{n}/dt" if k == 1 else f"d2{n}/dt2",
    "calls": lambda n, k: f"{'d' * k}ot({n})" if k == 1 else f"ddot({n})",
    "diff": lambda n, k: f"diff({n}, t)" if k == 1 else f"diff({n}, t, 2)",
    "combining": lambda n, k: unicode_name(n)[0] + ("\u0307" if k == 1 else "\u0308") + unicode_name(n)[1:],
}


class Plain(StrPrinter):
    """SymPy's text with our dots; ``order`` none, so that the terms stand as they were put together."""

    def __init__(self, dots: str) -> None:
        super().__init__({"order": None})
        self.dots = dots

    def _name(self, name: str) -> str:
        return unicode_name(name) if self.dots == "combining" else name

    def _print_Symbol(self, expr: sp.Symbol) -> str:
        return self._name(expr.name)

    def _print_Function(self, expr: sp.Expr) -> str:
        if isinstance(expr, AppliedUndef):
            return self._name(expr.func.__name__)
        return super()._print_Function(expr)

    def _print_Derivative(self, expr: sp.Derivative) -> str:
        name = expr.expr.func.__name__
        text = DOTS[self.dots](name, expr.derivative_count)
        return f"({text})" if "/" in text else text


def plain(expr: sp.Expr, dots: str = "primes") -> str:
    text = Plain(dots).doprint(expr)
    return text.replace("**", "^") if dots != "diff" else text


def latex(expr: sp.Expr) -> str:
    return vlatex(expr).replace("x2r", "x_{2r}")


# -- forms -----------------------------------------------------------------------------------------------------------

Form = Callable[[sp.Expr, System], sp.Expr]


def expanded(x: sp.Expr, s: System) -> sp.Expr:
    return sp.expand(x)


def collected(x: sp.Expr, s: System) -> sp.Expr:
    return sp.collect(sp.expand(x), [*s.a, *s.v])


def factored(x: sp.Expr, s: System) -> sp.Expr:
    return sp.factor_terms(sp.expand(x))


def angles_apart(x: sp.Expr, s: System) -> sp.Expr:
    """sin(a + b) written with the sines and cosines of a and b."""
    return sp.expand_trig(x)


def products_of_angles(x: sp.Expr, s: System) -> sp.Expr:
    return TR8(sp.expand(x))


def shorter(x: sp.Expr, s: System) -> sp.Expr:
    return sp.trigsimp(sp.expand(x))


FORMS: dict[str, Form] = {
    "expanded": expanded,
    "collected": collected,
    "factored": factored,
    "angles apart": angles_apart,
    "products of angles": products_of_angles,
    "shorter": shorter,
}


def two_sides(row: sp.Expr, s: System, how: str) -> tuple[sp.Expr, sp.Expr]:
    """A row = 0 as left = right: all on the left, inputs on the right, inertia alone, or turned round."""
    if how == "zero":
        return row, sp.S.Zero
    if how == "turned":
        a, b = two_sides(row, s, "inputs")
        return b, a
    terms = sp.Add.make_args(row if row.is_Add else sp.expand(row))
    inputs = [p.f for p in s.inputs]
    if how == "inputs":
        right = [x for x in terms if any(x.has(f) for f in inputs)]
    else:
        right = [x for x in terms if not any(x.has(a) for a in s.a)]
    left = [x for x in terms if x not in right]
    return sp.Add(*left), -sp.Add(*right)


def written(rows: Sequence[tuple[sp.Expr, sp.Expr]], style: str) -> str:
    """Equations in a style: "latex…" or one of `DOTS`."""
    if style == "align":
        body = " \\\\\n".join(f"{latex(a)} &= {latex(b)}" for a, b in rows)
        return f"\\begin{{align}}\n{body}\n\\end{{align}}\n"
    if style == "display":
        return "\n".join(f"\\[ {latex(a)} = {latex(b)} \\]" for a, b in rows) + "\n"
    if style == "dollars":
        return "The equations are\n" + " and\n".join(f"${latex(a)} = {latex(b)}$" for a, b in rows) + ".\n"
    if style == "lines":
        return " \\\\\n".join(f"{latex(a)} = {latex(b)}" for a, b in rows) + "\n"
    if style == "numbered":
        return "\n".join(f"({i + 1}) {plain(a)} = {plain(b)}" for i, (a, b) in enumerate(rows)) + "\n"
    return "\n".join(f"{plain(a, style)} = {plain(b, style)}" for a, b in rows) + "\n"


STYLES = (
    "primes",
    "align",
    "suffix",
    "display",
    "leibniz",
    "lines",
    "combining",
    "dollars",
    "calls",
    "numbered",
    "diff",
)
SIDES = ("inputs", "zero", "inertia", "turned")


def matrix_form(rows: Sequence[sp.Expr], s: System, style: str) -> str:
    """M ξ̈ + rest = inputs."""
    rows = [sp.expand(r) for r in rows]
    M = sp.Matrix([[sp.factor_terms(r.diff(a)) for a in s.a] for r in rows])
    acceleration = sp.Matrix(s.a)
    inputs = sp.Matrix([-sum((r.diff(p.f) * p.f for p in s.inputs), sp.S.Zero) for r in rows])
    rest = sp.Matrix([sp.expand(r - (M * acceleration)[i] + inputs[i]) for i, r in enumerate(rows)])
    if style == "plain":

        def put(m: sp.Matrix) -> str:
            return "[" + "; ".join(", ".join(plain(x) for x in m.row(i)) for i in range(m.rows)) + "]"

        return f"{put(M)}*{put(acceleration)} + {put(rest)} = {put(inputs)}\n"

    def tex(m: sp.Matrix) -> str:
        body = " \\\\ ".join(" & ".join(latex(x) for x in m.row(i)) for i in range(m.rows))
        return f"\\begin{{bmatrix}} {body} \\end{{bmatrix}}"

    return f"\\[ {tex(M)} {tex(acceleration)} + {tex(rest)} = {tex(inputs)} \\]\n"


def newton_form(rows: Sequence[sp.Expr], s: System) -> list[tuple[sp.Expr, sp.Expr]]:
    """ξ̈ = …, every acceleration alone."""
    M = sp.Matrix([[sp.expand(r).diff(a) for a in s.a] for r in rows])
    rest = sp.Matrix([sp.expand(r).xreplace(dict.fromkeys(s.a, sp.S.Zero)) for r in rows])
    found = -M.adjugate() * rest / M.det(method="berkowitz")
    return [(a, sp.together(x)) for a, x in zip(s.a, found, strict=True)]
