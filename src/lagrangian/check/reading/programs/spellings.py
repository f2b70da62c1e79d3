"""Takes the spellings of programs off an answer, before it is known whether it is LaTeX or plain text.

np.sin(x)  sp.Rational(1, 2)  Math.pow(x, 2)        sin(x)  ((1)/(2))  ((x)^(2))         NumPy, SymPy, JavaScript
x.diff(t, 2)  x(t).diff(t).diff(t)  L.diff(x')      x''  x''  diff(L, x')                SymPy
diff(x(t), t$2)  diff(x(t), `$`(t, 2))  D(x)(t)  (D@@2)(x)(t)              diff(x(t), t, 2)  x'  x''            Maple
Derivative[2][x][t]  (x^\\[Prime])[t]  \\[Theta]     x''  x'  θ                            Mathematica
D2x  DDx  Dx  D²x  D^2 x                            x''  x''  x'                         MATLAB, operators
$ frac(1, 2) m dot.double(x) $                      ((1)/(2)) m x''                      Typst
m*D(D(x)) ~ 1//2*F  Differential(t)(x(t))           m*x'' = (1/2)*F  x'                  Julia
der(x) = v                                          x' = v                              Modelica
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from lagrangian.check.reading.prose.words import REWRITES, function_of
from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.read.letters import SPELLED

_NAME = r"[^\W\d_⁰¹²³⁴-⁹₀-₉][^\W⁰¹²³⁴-⁹]*"
_MODULE = re.compile(
    r"(?<![\w.])(?=[A-Za-z]{2,6}\.)"  # few words have a point behind them
    r"(?:np|numpy|jnp|math|Math|cmath|sp|sy|sym|sympy|smp|ca|casadi|mp|mpmath|torch|onp)\.(?P<name>[A-Za-z]\w*)"
)
_CALLED = {
    "array": "Matrix",
    "matrix": "Matrix",
    "asarray": "Matrix",
    "ImmutableMatrix": "Matrix",
    **{x: x for x in ("simplify", "expand", "factor", "trigsimp", "together", "cancel")},
    **{x: x for x in ("pi", "diff", "Derivative", "Matrix", "Eq", "Rational", "pow", "power", "square", "Symbol")},
    **{x: x for x in ("deg2rad", "radians", "rad2deg", "degrees")},
}
_REWRITTEN = re.compile(rf"(?<=[\w)'′])\s?\.\s?(?:{'|'.join(sorted(REWRITES))}|doit)\(\s*\)")
"""A method that writes what stands in front of it in another way."""
_T = r"\s*['\"]?t['\"]?\s*"
_SECOND = re.compile(rf"\.\s*diff\((?:{_T},(?:\s*2\s*|{_T})|\s*\({_T},\s*2\s*\)\s*)\)")
_FIRST = re.compile(rf"(?<=[\w)'′])\.\s*diff\((?:{_T}(?:,\s*1\s*)?|\s*)\)")
_ENERGY = re.compile(rf"(?<![\w.])(?P<of>T|V|L|D|ℒ)\.diff\(\s*(?P<by>{_NAME}(?:\(t\))?['’′]*)\s*\)")
_TIMES = re.compile(r"(?<=[,(\s])t\s*\$\s*(?P<order>[12])(?=\s*[,)])")
_SEQUENCE = re.compile(r"`\$`\(\s*t\s*,\s*(?P<order>[12])\s*\)")
_OPERATOR = re.compile(
    rf"(?<!\w)(?:\(\s*D\s*@@\s*2\s*\)|`@@`\(\s*D\s*,\s*2\s*\)|(?P<once>D))\(\s*(?P<of>{_NAME})\s*\)\(\s*t\s*\)"
)
_JULIA = re.compile(
    rf"(?P<outer>Differential\(t\)\()?Differential\(t(?:,\s*(?P<two>2))?\)\(\s*(?P<of>{_NAME})\(t\)\s*\)(?(outer)\))"
)
_MODELICA = re.compile(rf"(?<!\w)(?P<twice>der\()?der\((?P<of>{_NAME})\)(?(twice)\))")
_FULL_FORM = re.compile(rf"\bDerivative\[(?P<order>[12])\]\[(?P<of>{_NAME})\](?:\[t\])?")
_LONG_NAME = re.compile(r"\\\[(?P<capital>Capital)?(?P<letter>Curly(?:Theta|Phi|Epsilon)|[A-Z][a-z]{1,6})\]")
_ONE_NAME = rf"(?:\\\[\w+\]|{_NAME})"
_RAISED = re.compile(
    rf"(?:\([ \t]?(?P<of>{_ONE_NAME})[ \t]?\^[ \t]?|Superscript\[[ \t]?(?P<in>{_ONE_NAME})[ \t]?,[ \t]?)"
    r"(?P<primes>(?:\\\[Prime\][ \t]?){1,2}|(?:\\\[DoublePrime\]))[ \t]?(?(of)\)|\])(?:\[t\])?"
)
"""How Mathematica shows a rate as text: (x^\\[Prime]\\[Prime])[t]."""
_OVER = re.compile(rf"\bOverDot\[\s*(?P<of>{_ONE_NAME})\s*(?:,\s*(?P<two>2)\s*)?\](?:\[t\])?")
_SUBSCRIPT = re.compile(r"\bSubscript\[\s*(?P<of>\w+|\\\[\w+\])\s*,\s*(?P<index>\w+)\s*\]")
_QUOTED = re.compile(r"(?<![\w)\]'’′])['%](?=[dD]iff\()")
_TWO_LINES = re.compile(r"(?<=[^\W_])__(?=[^\W_])")
_EQUALS = re.compile(
    r"^(?:[ \t]*+[^\W\d]\w{0,23}+[ \t]*+=[ \t]*+)?(?P<left>[^=~\n]*\S)[ \t]+~[ \t]+(?=\S)(?=[^=~\n]*$)", re.MULTILINE
)
_RATIO = re.compile(r"(?<![\w.])(?P<above>\d{1,6})//(?P<below>\d{1,6})(?![\w.])")
_RATE = re.compile(
    rf"(?:(?<![\w\\])|(?<=/[d∂]))D(?P<two>[2D]|[ \t]?(?:²|(?:\^|\*\*)[ \t]?2)[ \t]*)?(?P<of>(?>{_NAME}))(?!\w)"
)
_SECOND_RATE = re.compile(rf"(?<![\w\\.])d2_?(?P<of>(?>{_NAME}))(?!\w|[ \t]?\(|[ \t]?/[ \t]?d)")
"""How programs spell second derivatives: d2x for x''."""
_LINE_OF_CODE = re.compile(
    r"^[ \t]*+(?:from\s+\w[\w.]*\s+import\b[^=\n]*|import\s+\w[\w. ,]*|syms\s[^=\n]*|using\s+[\w, ]+|clear|clc"
    r"|restart:?|with\(\w+\)[:;]|#(?:import|let|set|include)\b.*"
    r"|[\w, ]++=\s*+(?:\w{1,6}\.)?(?:symbols|dynamicsymbols|Symbol|Function|var)\(.*)$",
    re.MULTILINE,
)
"""Lines of programs that state nothing: imports, and declarations of symbols."""
_TYPE = re.compile(
    r"^[ \t]*+(?:(?:const|final|static)[ \t]++)?(?:double|float|real|auto|let|var|val|const|Float64|local)[ \t]++"
    r"(?=[^\W\d]\w*+[ \t]*+=(?!=))",
    re.MULTILINE,
)
"""The type of a variable that a program declares with its value: double D = m*g;"""
_PLAIN_DOTS = re.compile(r"\\(?P<dots>d{1,2})ot\s*\\?(?P<of>[^\W\d_]\w*)")
_COMMAND = re.compile(r"\\(?P<word>[A-Za-z]+)")
_PLAIN_CALL = re.compile(rf"(?<![\w\\])(?:sin|cos|tan|sqrt)\s*\(|(?<![\w\\])(?:{'|'.join(SPELLED.values())})(?!\w)")
_LATEX = re.compile(r"\\[A-Za-z]|[_^]\{")
_PARTIAL_RATE = re.compile(
    r"\\frac\s?\{\s?\\partial\s?(?P<two>\^\s?(?:2|\{2\})\s?)?\}\s?\{\s?\\partial\s?t\s?(?(two)\^\s?(?:2|\{2\})\s?)\}"
)
"""How MATLAB's latex() writes rates: \\frac{\\partial ^2}{\\partial t^2} x\\left(t\\right)."""
_GREEK = {word: letter for letter, word in SPELLED.items() if letter != "ς"}
_TURNED = {"deg2rad": "*pi/180", "radians": "*pi/180", "rad2deg": "*180/pi", "degrees": "*180/pi"}
"""What an angle is multiplied with in other units."""
_CALLS = re.compile(rf"(?<![\w.\\])(?P<name>frac|Rational|pow|power|square|mat|vec|{'|'.join(_TURNED)})\(")
_SHAPES = {
    "frac": ("((", ")/(", "))"),
    "Rational": ("((", ")/(", "))"),
    "pow": ("((", ")^(", "))"),
    "power": ("((", ")^(", "))"),
    "square": ("((", "", "))^2"),
    "mat": ("[", ",", "]"),
    "vec": ("[", ";", "]"),
    **{name: ("((", "", f"){factor})") for name, factor in _TURNED.items()},
}
"""How a call is written in plain text: what opens it, what stands between its arguments, and what closes it."""

_COMMAS = {"frac": 1, "Rational": 1, "pow": 1, "power": 1, "square": 0, **dict.fromkeys(_TURNED, 0)}


def without_marks_of_latex(written: TracedText) -> TracedText:
    """Return an answer without what is LaTeX nowhere but looks like it: \\[Theta], Subscript[m, 1] of Mathematica,
    diff(x(t), t$2) of Maple."""
    written = written.sub(_SEQUENCE, lambda m: f"t, {m['order']}").sub(_TIMES, lambda m: f"t, {m['order']}")
    written = written.sub(_OVER, _primed)
    if "\\[" not in written.text:
        return written
    written = written.sub(_SUBSCRIPT, lambda m: f"{m['of']}_{m['index']}").sub(_RAISED, _primed)
    return written.sub(_LONG_NAME, _letter)


def without_programs(written: TracedText, moves: Callable[[str], bool], taken: Callable[[str], bool]) -> TracedText:
    """Return an answer without the spellings of programs.

    ``moves`` says whether a name changes with time, ``taken`` whether it belongs to the system.
    """
    written = written.sub(_LINE_OF_CODE, lambda m: "")
    if _is_mixed(written.text):
        written = written.sub(_PLAIN_DOTS, lambda m: m["of"] + "'" * len(m["dots"])).sub(_COMMAND, lambda m: m["word"])
    if _LATEX.search(written.text):
        written = written.sub(_PARTIAL_RATE, lambda m: r"\frac{d^2}{dt^2}" if m["two"] else r"\frac{d}{dt}")
        return written.sub(_SECOND, lambda m: "''").sub(_FIRST, lambda m: "'")
    from_typst = _is_typst(written.text)
    if from_typst:
        written = _without_typst(written)
    written = written.sub(_TYPE, lambda m: m.group() if m.group().split()[-1] == "let" else "").sub(_MODULE, _bare)
    written = written.sub(_REWRITTEN, lambda m: "")
    written = written.sub(_SUBSCRIPT, lambda m: f"{m['of']}_{m['index']}")
    written = written.sub(_SECOND, lambda m: "''").sub(_FIRST, lambda m: "'")
    written = written.sub(_ENERGY, lambda m: f"diff({m['of']}, {m['by']})")
    written = written.sub(_OPERATOR, lambda m: m.group() if taken("D") else m["of"] + ("'" if m["once"] else "''"))
    written = written.sub(_RATIO, lambda m: f"({m['above']}/{m['below']})")
    written = written.sub(_JULIA, lambda m: m["of"] + ("''" if m["outer"] or m["two"] else "'"))
    written = written.sub(_MODELICA, lambda m: m["of"] + ("''" if m["twice"] else "'"))
    written = written.sub(_FULL_FORM, lambda m: m["of"] + "'" * int(m["order"]))
    written = (
        written.sub(_QUOTED, lambda m: "").sub(_TWO_LINES, lambda m: "_").sub(_EQUALS, lambda m: f"{m['left']} = ")
    )
    written = written.edited(_called(written.text, taken, typst=from_typst))
    return _with_primes(written, moves, taken)


def _is_mixed(text: str) -> bool:
    """Whether an answer is plain text with a few commands of LaTeX: \\dot x, \\theta, but sin(theta)."""
    words = {m["word"] for m in _COMMAND.finditer(text)}
    few = words and all(word in ("dot", "ddot") or word in _GREEK for word in words)
    return bool(few) and not re.search(r"[${}]|\\[^A-Za-z]", text) and _PLAIN_CALL.search(text) is not None


def _primed(match: re.Match[str]) -> str:
    """(x^\\[Prime]\\[Prime])[t] and OverDot[x, 2][t] as x''."""
    named = match.groupdict()
    twice = named.get("two") or named.get("primes", "").count("Prime") > 1 or "Double" in named.get("primes", "")
    return f"{named['of'] or named['in']}{chr(39) * (2 if twice else 1)}"


def _letter(match: re.Match[str]) -> str:
    """\\[Theta] as θ, \\[CapitalOmega] as Ω."""
    word = match["letter"].removeprefix("Curly")
    word = word[0].upper() + word[1:].lower() if match["capital"] else word.lower()
    return _GREEK.get(word, match.group())


def _bare(match: re.Match[str]) -> str:
    """np.sin as sin, if that is a function."""
    name = match["name"]
    return _CALLED.get(name) or (name if name in REWRITES or function_of(name) is not None else match.group())


def _called(text: str, taken: Callable[[str], bool], *, typst: bool) -> Iterator[Edit]:
    """The edits that write fractions, powers and matrices out of calls; a name of the system is no call."""
    opened = {
        m.end() - 1: m
        for m in _CALLS.finditer(text)
        if not taken(m["name"]) and (typst or m["name"] not in ("frac", "mat", "vec"))
    }
    if not opened:
        return
    stack: list[tuple[int, list[int]]] = []
    for at, c in enumerate(text):
        if c in "([{":
            stack.append((at, []))
        elif c == "," and stack:
            stack[-1][1].append(at)
        elif c in ")]}" and stack:
            start, commas = stack.pop()
            match = opened.get(start)
            if match is None or _COMMAS.get(match["name"], len(commas)) != len(commas):
                continue
            opens, between, closes = _SHAPES[match["name"]]
            if match["name"] == "frac" and text[start + 1 : commas[0]].strip() == "d":  # d/dt
                opens, between, closes = " ", "/", " "
            yield match.start(), match.end(), opens
            yield from ((comma, comma + 1, between) for comma in commas)
            yield at, at + 1, closes


def _with_primes(written: TracedText, moves: Callable[[str], bool], taken: Callable[[str], bool]) -> TracedText:
    """D2x, DDx, Dx as x'', x'', x', unless D is a factor: where the answer has a second derivative so, or x moves."""
    if not taken("d2"):
        written = written.sub(
            _SECOND_RATE, lambda m: f"{m['of']}''" if moves(m["of"]) and taken(m["of"]) else m.group()
        )
    own = taken("D") or re.search(r"(?<!\w)D\s*=(?!=)", written.text) is not None
    found = [m for m in _RATE.finditer(written.text) if not taken(m.group())]
    found = [m for m in found if not own or m["two"] in (None, "2")]  # D² x is a product if D is a name
    second = {m["of"] for m in found if m["two"]}
    if not second and (own or re.search(r"(?<!\w)D(?!\w)", written.text)):
        return written
    edits = [(*m.span(), m["of"] + ("''" if m["two"] else "'")) for m in found if moves(m["of"]) or m["of"] in second]
    return written.edited(edits)


# -- Typst -------------------------------------------------------------------------------------------------------------

_WORDS = "|".join(sorted((word for word in _GREEK if len(word) > 2), key=len, reverse=True))
_TYPST = re.compile(
    r"\bdot\.(?:double|op|c)\b|\b(?:frac|mat|vec|d?dot|accent)\("
    rf"|\b(?:{_WORDS})\b|\b(?:sin|cos|tan|sqrt)\s*\("
)
_MATHEMATICS = re.compile(r"\$(?P<inside>[^$]*)\$")
_DOTTED = re.compile(r"\bdot(?P<two>\.double)?\(\s*(?P<of>\w+)\s*\)(?P<index>_\w+)?")
_TYPST_FORMS: list[tuple[re.Pattern[str], Callable[[re.Match[str]], str]]] = [
    (re.compile(r'"[^"\n]*"'), lambda m: m.group()[1:-1] if re.fullmatch(r'"\w{1,12}"', m.group()) else " "),
    (re.compile(r"_\(\s*(\w+)\s*\)"), lambda m: f"_{m[1]}"),
    (re.compile(r"\baccent\(\s*(\w+)\s*,\s*dot(\.double)?\s*\)"), lambda m: m[1] + ("''" if m[2] else "'")),
    (_DOTTED, lambda m: m["of"] + (m["index"] or "") + ("''" if m["two"] else "'")),
    (re.compile(r"\bdot\.double(?=\()"), lambda m: "ddot"),
    (re.compile(r"\bdot(?:\.(?:op|c))?(?![\w.(])|\btimes(?:\.op)?(?![\w.(])"), lambda m: "*"),
    (re.compile(r"\b(?:partial|diff)\s+(?=\w)|\b(?:partial|diff)(?=\s*[),/])"), lambda m: "∂"),
    (re.compile(r"\bdif\b\s*"), lambda m: "d"),
    (re.compile(r"(?<!\w)d\s+t(?!\w)"), lambda m: "dt"),
    (re.compile(r"\b(?:quad|wide|thin|med|thick|space)(?!\w)|&"), lambda m: " "),
    (re.compile(r"\b(?:upright|italic|bold|cal|lr|display|inline|bb|sans|op)(?=\()"), lambda m: ""),
    (re.compile(r"\\(?=\s)"), lambda m: "\n"),
]


def _is_typst(text: str) -> bool:
    """Whether the mathematics between $ is Typst: it has words without a backslash, and functions with brackets."""
    return any(_TYPST.search(m["inside"]) for m in _MATHEMATICS.finditer(text))


def _without_typst(written: TracedText) -> TracedText:
    """Return the mathematics of an answer in Typst, one piece a line; words around it are blank."""
    kept: list[Edit] = []
    at = 0
    for match in _MATHEMATICS.finditer(written.text):
        outside = written.text[at : match.start()]
        kept.append((at, match.start("inside"), "\n" if "=" not in outside else f"{outside}\n"))
        kept.append((match.end("inside"), match.end(), "\n"))
        at = match.end()
    if "=" not in written.text[at:]:
        kept.append((at, len(written.text), ""))
    written = written.edited(kept)
    for form, make in _TYPST_FORMS:
        written = written.sub(form, make)
    return written
