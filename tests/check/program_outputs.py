"""Equations as programs write them: in one line and in LaTeX, in lists and sessions, and as copying leaves them."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pprint import pformat

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.physics.vector.printing import vlatex, vsprint
from sympy.printing.latex import LatexPrinter
from sympy.printing.precedence import precedence
from sympy.printing.pretty.pretty import PrettyPrinter
from sympy.printing.pretty.pretty_symbology import pretty_use_unicode
from sympy.printing.pretty.stringpict import prettyForm
from sympy.printing.str import StrPrinter

Shape = Callable[[Sequence[str]], str]


class Line(StrPrinter):
    """One line of a program: how it writes a rate, a power, an equals sign and a call."""

    def __init__(self, rates: Sequence[str], equals: str = " = ", of_time: str = "(t)", brackets: str = "()") -> None:
        super().__init__()
        self.rates, self.equals, self.of_time, self.brackets = rates, equals, of_time, brackets

    def _print_Derivative(self, e: sp.Derivative) -> str:
        return self.rates[e.derivative_count - 1].format(e.expr.func.__name__)

    def _print_Function(self, e: sp.Function) -> str:
        if isinstance(e, AppliedUndef):
            return e.func.__name__ + self.of_time
        name = e.func.__name__ if self.brackets == "()" else e.func.__name__.capitalize()
        return name + self.brackets[0] + self._print(e.args[0]) + self.brackets[1]

    def _print_Pow(self, e: sp.Pow, rational: bool = False) -> str:
        over = self.parenthesize(e.base, precedence(e))
        return f"1/{over}" if e.exp == -1 else f"{over}^{self.parenthesize(e.exp, precedence(e))}"

    def _print_Equality(self, e: sp.Eq) -> str:
        return f"{self._print(e.lhs)}{self.equals}{self._print(e.rhs)}"


class Tex(LatexPrinter):
    """LaTeX of a program: how it writes a rate, and a name in which {} stands for the letters."""

    def __init__(self, rates: Sequence[str], of_time: str, space: str = " ", names: str = "{}") -> None:
        super().__init__({"mul_symbol": space})
        self.rates, self.of_time, self.names = rates, of_time, names

    def _print_Symbol(self, e: sp.Symbol, style: str = "plain") -> str:
        long = len(e.name) > 1 and e.name not in ("theta", "tau")
        return self.names.format(e.name) if long and self.names != "{}" else super()._print_Symbol(e, style)

    def _print_Derivative(self, e: sp.Derivative, exp: str | None = None) -> str:
        made = self.rates[e.derivative_count - 1].format(self._print_Symbol(sp.Symbol(e.expr.func.__name__)))
        return made if exp is None else rf"{{\left({made}\right)}}^{exp}"

    def _print_Function(self, e: sp.Function, exp: str | None = None) -> str:
        if isinstance(e, AppliedUndef):
            made = self._print_Symbol(sp.Symbol(e.func.__name__)) + self.of_time
            return made if exp is None else f"{{{made}}}^{exp}"
        power = "" if exp is None else f"^{{{exp}}}"
        return rf"\{e.func.__name__}{power}\left({self._print(e.args[0])}\right)"

    _print_sin = _print_cos = _print_Function


class Drawing(PrettyPrinter):
    """A drawing of a program in ASCII: d/dt in front of a function, or primes behind it, and what opens a call."""

    def __init__(self, *, primes: bool, equals: str) -> None:
        super().__init__({"use_unicode": False, "wrap_line": False})
        self.primes, self.equals, self.brackets = primes, equals, "[]" if primes else "()"

    def _print_Derivative(self, e: sp.Derivative) -> prettyForm:
        order, function = e.derivative_count, self._print(e.expr)
        if self.primes:
            return prettyForm(f"{e.expr.func.__name__}{chr(39) * order}[t]", binding=prettyForm.ATOM)
        over, under = (prettyForm(x) ** prettyForm("2") if order == 2 else prettyForm(x) for x in ("d", "dt"))
        return prettyForm(*(over / under).right(" ", function), binding=prettyForm.MUL)

    def _print_Function(self, e: sp.Function) -> prettyForm:
        opens, closes = self.brackets
        if isinstance(e, AppliedUndef):
            return prettyForm(f"{e.func.__name__}{opens}t{closes}")
        name = e.func.__name__.capitalize() if self.primes else e.func.__name__
        inside = prettyForm(*self._print(e.args[0]).parens(opens, closes))
        return prettyForm(*inside.left(name), binding=prettyForm.ATOM)

    _print_sin = _print_cos = _print_Function

    def write(self, label: str, e: sp.Eq) -> str:
        """The drawing with a label in front of the line with the equals sign."""
        written = sp.expand(e.lhs - e.rhs) if self.primes else e.lhs - e.rhs
        before = pretty_use_unicode(False)
        try:
            rows = self.doprint(written).replace("*", " ").split("\n")
        finally:
            pretty_use_unicode(before)
        middle = self._print(written).baseline
        rows[middle] += f" {self.equals} 0"
        return "\n".join((label if k == middle else " " * len(label)) + row for k, row in enumerate(rows))


def lines(rows: Sequence[str]) -> str:
    return "\n".join(rows)


def within(opens: str, closes: str, between: str = ", ") -> Shape:
    return lambda rows: opens + between.join(rows) + closes


def each(form: str) -> Shape:
    return lambda rows: "\n".join(form.format(row, k=k) for k, row in enumerate(rows, 1))


MATLAB = Line(("diff({}(t), t)", "diff({}(t), t, t)"), " == ")
MAPLE = Line(("(diff({}(t), t))", "(diff(diff({}(t), t), t))"))
OPERATORS = Line(("D({})(t)", "`@@`(D, 2)({})(t)"))
MAXIMA = Line(("'diff({},t,1)", "'diff({},t,2)"), of_time="")
MATHEMATICA = Line(("Derivative[1][{}][t]", "Derivative[2][{}][t]"), " == ", "[t]", "[]")
MATHEMATICA_SHOWN = Line((r"({}^\[Prime])[t]", r"({}^\[Prime]\[Prime])[t]"), " == ", "[t]", "[]")
MATHEMATICA_DOTS = Line(("OverDot[{}][t]", "OverDot[{}, 2][t]"), " == ", "[t]", "[]")
JULIA = Line(("Differential(t)({}(t))", "Differential(t)(Differential(t)({}(t)))"), " ~ ")
MATLAB_TEX = Tex((r"\frac{{\partial }}{{\partial t}} {}\left(t\right)",
                  r"\frac{{\partial ^2}}{{\partial t^2}} {}\left(t\right)"), r" \left(t\right)", r"\,")  # fmt: skip
MAPLE_TEX = Tex((r"\frac{{d}}{{d t}}{} \! \left(t \right)", r"\frac{{d^{{2}}}}{{d t^{{2}}}}{} \! \left(t \right)"),
                r" \! \left(t \right)")  # fmt: skip
MATHEMATICA_TEX = Tex(("{} '(t)", "{} ''(t)"), "(t)", names=r"\text{{{}}}")
MAXIMA_TEX = Tex(
    (r"\left({{{{d}}\over{{d\,t}}}}\,{}\right)", r"\left({{{{d^2}}\over{{d\,t^2}}}}\,{}\right)"), "", r"\,"
)

SHAPES: dict[str, tuple[Callable[[sp.Eq], str], Shape]] = {
    "MATLAB, a row": (MATLAB.doprint, within("ans =\n \n[", "]")),
    "MATLAB, LaTeX of a set": (MATLAB_TEX.doprint, within(r"$$\left\{", r"\right\}$$", ",")),
    "Maple, a list": (MAPLE.doprint, within("> eqs;\n[", "]", ",\n ")),
    "Maple, a set": (MAPLE.doprint, within("eqs := {", "}", ",\n ")),
    "Maple, operators": (OPERATORS.doprint, lines),
    "Maple, LaTeX of a list": (MAPLE_TEX.doprint, within(r"$$\left[", r"\right]$$", ",")),
    "Maxima, a session": (MAXIMA.doprint, each("(%i{k}) eq[{k}];\n(%o{k}) {0}")),
    "wxMaxima, a list": (MAXIMA.doprint, within("[%i7] eqs;\n[%o7] [", "]")),
    "Maxima, TeX": (MAXIMA_TEX.doprint, each("$${0}$$")),
    "Mathematica, TeXForm": (MATHEMATICA_TEX.doprint, within(r"$$\left\{", r"\right\}$$", ",")),
    "Mathematica, InputForm": (MATHEMATICA.doprint, within("Out[5]//InputForm=\n{", "}")),
    "Mathematica, StandardForm": (MATHEMATICA_SHOWN.doprint, within("Out[5]= {", "}")),
    "Mathematica, dots": (MATHEMATICA_DOTS.doprint, lines),
    "Julia": (JULIA.doprint, lines),
    "SymPy, LaTeX of a list": (sp.latex, within(r"$\displaystyle \left[ ", r"\right]$", r", \  ")),
    "a conversation, shown": (vlatex, each("[\n{0}\n]")),
    "a conversation, in lines": (vlatex, each("[ {0} ]")),
    "Markdown": (lambda e: vsprint(e.lhs).replace("*", r"\*") + f" = {vsprint(e.rhs)}", each("- {0}")),
    "mail": (lambda e: f"{vsprint(e.lhs)} = {vsprint(e.rhs)}", each("> {0}")),
}
"""How an equation is printed, and how several are put together."""


def solutions(equations: Sequence[sp.Eq], accelerations: Sequence[sp.Expr]) -> dict[str, str]:
    """The accelerations as programs show what they solved for, and sides as lists."""
    left = [e.lhs - e.rhs for e in equations]
    matrix = sp.Matrix(left).jacobian(sp.Matrix(accelerations))
    rest = sp.Matrix(left).subs(dict.fromkeys(accelerations, 0))
    found = [dict(zip(accelerations, -matrix.LUsolve(rest), strict=True))]
    zeros = ", ".join("0" for _ in left)
    return {
        "SymPy, a solution": str(found),
        "SymPy, LaTeX of a solution": f"$\\displaystyle {sp.latex(found[0])}$",
        "SymPy, a loop over a solution": "\n".join(f"{a} : {e}" for a, e in found[0].items()),
        "SymPy, a loop, in vectors' spelling": "\n".join(f"{vsprint(a)} -> {vsprint(e)}" for a, e in found[0].items()),
        "Python, a dictionary": pformat({str(a.args[0].func): e for a, e in zip(accelerations, left, strict=True)}),
        "JSON": json.dumps(
            {str(a.args[0].func): f"{vsprint(e)} = 0" for a, e in zip(accelerations, left, strict=True)}
        ),
        "Maxima, a matrix": f"(%o3) matrix({','.join(f'[{MAXIMA.doprint(x)}]' for x in left)})",
        "Mathematica, sides": f"{{{', '.join(map(MATHEMATICA.doprint, left))}}} == {{{zeros}}}",
    }


def drawings(equations: Sequence[sp.Eq]) -> dict[str, str]:
    """Sessions in which programs draw equations over several lines."""
    forms = {
        "Mathematica": ("In[{k}]:= eq{k}", "Out[{k}]= ", Drawing(primes=True, equals="==")),
        "MATLAB": (">> pretty(eq{k})", "", Drawing(primes=False, equals="==")),
        "Maple": ("> eq{k};", "eq{k} := ", Drawing(primes=False, equals="=")),
    }
    return {
        program: "\n\n".join(
            f"{typed.format(k=k)}\n{drawing.write(label.format(k=k), e)}" for k, e in enumerate(equations, 1)
        )
        for program, (typed, label, drawing) in forms.items()
    }
