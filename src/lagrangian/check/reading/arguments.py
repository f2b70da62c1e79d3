"""What quantities are said to depend on: after I(r) = …, I(r) is I and no product of I and r.

After V = m g l cos θ, V(θ) is V, too.
After L(x) = L0 + L1 x and g(x, y) = x² + y² − l², with L the Lagrangian and g gravity, these are other names.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from itertools import islice
from unicodedata import normalize

from lagrangian.check.reading.prose.words_or_mathematics import moves
from lagrangian.check.reading.traced_text import Edit, TracedText, apart
from lagrangian.read.letters import SPELLED, key

_NAME = r"(?<![\w\\])\\?[^\W\d_]\w*(?:\{\w{1,20}\})?"
_STATED = re.compile(
    rf"(?P<name>{_NAME})\s{{0,3}}(?P<of>(?:\\left)?\([^()=+*/^\n-]{{1,60}}\))\s{{0,3}}&?\s{{0,3}}=(?!=)"
)
_QUANTITY = re.compile(r"\s*(?:\\d{0,2}dot)?[\s{]*\\?[^\W\d_]\w*(?:\{\w{1,20}\})?[\s}'’]*\Z")
_BEFORE = re.compile(r"(?:([^\W\d_]+)|[\w*/+^·×=)\]}'−-])[ \t]*\Z")
"""What makes something a factor or a term, and no beginning of a statement; a word of several letters does not."""

_BOLD = frozenset(["mathbf", "boldsymbol", "bm", "pmb", "vec", "underline"])
r"""What makes another name of a letter: \mathbf g(q) is a column, beside the g of the system."""

_MATRIX = re.compile(r"\s*(?:\[|\\begin|\\left)")

_RATES = frozenset(["dot", "ddot", "der"])
"""What is written as a function and is a rate: ddot(x) = …"""

_UPRIGHT_INDEX = re.compile(
    r"_\s{0,3}(?:\\(?:text|textrm|textup|mathrm|mathit|mathsf)\s{0,3}\{\s{0,3}(?P<bare>\w{1,20})\s{0,3}\}"
    r"|\{\s{0,3}\\(?:text|textrm|textup|mathrm|mathit|mathsf)(?:\s{0,3}\{\s{0,3}(?P<word>\w{1,20})\s{0,3}\}"
    r"|\s{1,3}(?P<letter>[A-Za-z]))\s{0,3}\})"
)
"""An index in upright letters."""
_MAX = 100
"""The largest number of such quantities."""


_CALLED = re.compile(
    r"(?P<name>(?:(?<=frac\d\d)|(?<=½)|(?<![\w\\])(?!\\[dt]?frac\d))\\?[^\W\d_]\w*(?:\{\w{1,20}\})?)"
    r"(?P<prime>\s?['’′])?\s{0,3}"
    r"(?:\\left)?\((?P<of>[\\\w ,{}'’′\u0307\u0308]{1,60}?)(?:\\right)?\)"
)
"""A name with coordinates or rates in brackets: V(θ), U'(x), T(ẋ), J_P(θ)."""
_VARIANT = re.compile(r"(?<=\\)var(?=(?:phi|theta|epsilon|rho|sigma|pi)(?![A-Za-z]))")
"""What begins the command of another form of a Greek letter."""
_LETTERS_IN = re.compile(r"\\?[^\W\d_⁰¹²³⁴-⁹][^\W⁰¹²³⁴-⁹]*+")
_FUNCTION = re.compile(r"(?:sin|cos|tan)(?=[^\W\d_])")
_POWER = re.compile(r"\s{0,3}(?:[²³]|\^|\*\*)")
_ENERGIES = frozenset(["T", "V", "U", "K", "L", "E"])
_OF_RATE = re.compile(r"\\d?dot(?![A-Za-z])|['’′\u0307\u0308]")


def dependents(text: str, taken: Callable[[str], bool], changes: Callable[[str], bool]) -> frozenset[str]:
    """Return the quantities that an answer states with what they depend on, as I(r), or that it has with coordinates
    behind them; ``taken`` are names of the system, which are no such quantities unless they are given a matrix."""
    text = _with_plain_indices(text)
    found = {f"{written(m['name'])}({written(m['of'])})" for m in _called(text, taken, changes) if not m["prime"]}
    for match in _STATED.finditer(text):
        name, of = written(match["name"]), match["of"].removeprefix("\\left")[1:-1].removesuffix("\\right")
        before = _BEFORE.search(text, max(0, match.start() - 40), match.start())
        first = before is None or (before[1] is not None and len(before[1]) > 1 and not taken(before[1]))
        free = (not taken(name) and name not in _RATES) or _MATRIX.match(text, match.end()) is not None
        if len(found) < _MAX and first and free and all(_QUANTITY.match(x) for x in re.split("[,;]", of)):
            found.add(f"{name}({written(of)})")
    return frozenset(found)


def _with_plain_indices(text: str) -> str:
    r"""Return LaTeX with indices in the letters of formulas: J_{\\text{tot}} and J_{\\mathrm{tot}} as J_{tot}."""
    return _UPRIGHT_INDEX.sub(lambda m: f"_{{{m['bare'] or m['word'] or m['letter']}}}", text)


def value_stated(name: str, text: str) -> str | None:
    """What stands behind the first = of a name in an answer, up to the end of its line or sentence; None if there is
    none."""
    stated = re.search(rf"(?<![\w\\]){re.escape(name)}\s{{0,3}}&?\s{{0,3}}=(?!=)(?P<value>[^\n=;$]{{0,300}})", text)
    return None if stated is None else _SENTENCE_END.split(stated["value"], maxsplit=1)[0]


_SENTENCE_END = re.compile(r"\.\s")


def is_in_chain(name: str, text: str) -> bool:
    """Whether a name stands as the factor of a square in the last side of a chain: T = ½ […] θ'² = ½ I(θ) θ'²."""
    return any(_goes_on(x) for x in islice(re.finditer(_LAST_OF_CHAIN.format(re.escape(name)), text), _MAX))


def names_in_chains(text: str) -> Iterator[str]:
    """The names of which this is so, as they are written; an index in braces without these."""
    form = _LAST_OF_CHAIN.format(
        r"(?P<name>\\?[^\W\d_]\w{0,24}+(?:\{(?:\\(?:rm[ ]?|(?:mathrm|text)\{))?\w{1,20}\}{1,2})?)"
    )
    for last in islice(re.finditer(form, text), _MAX):
        if _goes_on(last):
            yield re.sub(r"\\(?:rm|mathrm|text)(?![A-Za-z])[ ]?|[\\{}]", "", last["name"])


def _goes_on(last: re.Match[str]) -> bool:
    """Whether a side has another equals sign before it, in the same sentence."""
    before = last.string[max(0, last.start() - _LONGEST_SIDE) : last.start()]
    before = before if "\\" in last.string else _NEW_LINE.split(before)[-1]
    return "=" in _CHAIN_BEGINS.split(before)[-1]


_LAST_OF_CHAIN = (
    r"(?:=|≡|\\equiv)[ \t]?:?[ \t&]*+"
    r"(?:(?:½|\(?1[ ]?/[ ]?2\)?|0\.5|\\[dt]?frac[ ]?\{{?[ ]?1[ ]?\}}?[ ]?\{{?[ ]?2(?![\d])[ ]?\}}?)"
    r"(?:\\[,;!]|\\cdot(?![A-Za-z])|[ \t*·])*+)?{}(?![\w'’′])(?:[ ]?(?:\\left)?\([^()=\n]{{1,24}}\))?"
    r"[^=\n;+−-]{{1,30}}?(?:²|(?:\^|\*\*)[ ]?\{{?[ ]?2)"
)
_CHAIN_BEGINS = re.compile(r"[$;]|\n[ \t]*\n|\\[\[\]]|[.;,][ ]")
_NEW_LINE = re.compile(r"\n(?![ \t]*+(?:=|\Z))")
"""A line of plain text that does not go on with another side."""
_LONGEST_SIDE = 600
"""How much of a chain before its last side is looked at."""


def _called(text: str, taken: Callable[[str], bool], changes: Callable[[str], bool]) -> Iterator[re.Match[str]]:
    """The quantities with coordinates behind them that the answer states without these: V(θ) where V = m g l cos θ, and
    J_P(θ) where J_P = J + m (a² − 2 a b cos θ)."""
    for match in islice(_CALLED.finditer(text), _MAX):
        name, listed = match["name"], [written(_OF_RATE.sub("", _VARIANT.sub("", x))) for x in match["of"].split(",")]
        if taken(written(name)) or changes(written(name)) or not all(map(changes, listed)):
            continue
        if _FUNCTION.match(name) and changes(_FUNCTION.sub("", written(name))):
            continue  # sinθ cosθ (θ̇)²
        if _OF_RATE.search(match["of"]) and _POWER.match(text, match.end()):
            continue  # m r (θ')² is a product
        stated = value_stated(name, text)
        if stated is None and not is_in_chain(name, text):
            continue
        held = {key(_FUNCTION.sub("", written(_VARIANT.sub("", x)))) for x in _LETTERS_IN.findall(stated or "")}
        if stated is None or name in _ENERGIES or {*map(key, listed)} <= held:
            yield match


_LETTERS = frozenset(["L", "T", "D", "R", "K"])
"""Letters of energies that always hold rates."""
_ENERGY = re.compile(r"(?<![\w\\])(?:[TVUK]|PE|KE)\*?(?![\w(])")
_VALUE_END = re.compile(r"[\n;$]|\\\\")


def with_own_functions(
    text: TracedText,
    system: Callable[[str], bool],
    changes: Callable[[str], bool],
    told: dict[str, None],
    *,
    latex: bool,
) -> TracedText:
    """Return an answer in which functions of coordinates that are called as a quantity of the system, or as an energy
    without any rate, have names of their own; notes tell these.

    ``system`` says whether a name belongs to the system, ``changes`` whether it changes with time.
    """
    named = {key(name): name for name in _functions(text.text, system, changes)}
    if not named:
        return text
    edits = list(_slopes(text.text, named.values(), latex=latex))
    spans = [(start, end) for start, end, _ in edits]
    for match in _APPLIED.finditer(text.text):
        whole = written(match["name"] + match["of"].removeprefix("\\left"))
        if key(whole) not in named or any(start <= match.start() < end for start, end in spans):
            continue
        index = re.sub(r"\W", "", whole.partition("(")[2])
        edits.append((*match.span("of"), f"_{{{index}}}" if latex else f"_{index}"))
        told.setdefault(f"'{whole}' was read as a quantity of its own.")
    for whole in named.values():
        edits += _bare(text.text, whole, system, latex=latex)
    return text.edited(apart(edits))


_DOTTED = re.compile("[\u0307\u0308]|\\\\d?dot(?![A-Za-z])|(?<=[^\\W\\d])_?d?dot(?!\\w)|(?<=[^\\W\\d])_dd?(?!\\w)")
"""How rates are written without primes."""
_PRIMED = re.compile(
    r"(?:(?<!\w)(?!\\?[dt]?frac\d)|(?<=frac\d\d))\\?(?P<name>[^\W\d_]\w{0,24}(?:\{\w{1,20}\})?)[ }]{0,2}['’′″]"
)


def with_primes_as_slopes(
    text: TracedText, system: Callable[[str], bool], changes: Callable[[str], bool], *, latex: bool
) -> TracedText:
    """Return an answer in which the derivative of a function of one coordinate by this coordinate, dΘ/dr or Θ'(r) after
    Θ(r) = …, is written ∂Θ/∂r; Θ' alone, too, if rates have dots and nothing that moves has a prime, but not where its
    value holds a rate: Θ' = 2 m r ṙ is Θ̇.

    ``system`` says whether a name belongs to the system; d/dr of such a function is read elsewhere.
    """
    found: dict[str, tuple[str, str]] = {}
    for match in islice(_STATED.finditer(text.text), _MAX):
        of = match["of"].removeprefix("\\left")[1:-1].removesuffix("\\right").strip()
        found.setdefault(written(match["name"]), (match["name"], of))
    for match in _called(text.text, system, changes):
        found.setdefault(written(match["name"]), (match["name"], match["of"].strip()))
    found = {
        x: (name, of)
        for x, (name, of) in found.items()
        if re.fullmatch(r"\\?\w{1,24}", of) and (changes(written(of)) or _has_rate(written(of), text.text))
    }
    primed = {written(m["name"]) for m in _PRIMED.finditer(text.text)} if found else set[str]()
    moving = any(changes(x) for x in primed) or not _DOTTED.search(normalize("NFD", text.text))
    edits: list[Edit] = []
    for name, (top, of) in found.items():
        if changes(name):
            continue
        rated = moving or (name in primed and _is_given_rate(top, text.text))
        forms = _primed(name, of, alone=not rated) if name in primed else []
        forms += differentiated(name, of) if not system(name) and name not in _LETTERS else []
        new = rf"\frac{{\partial {top}}}{{\partial {of}}}" if latex else f"∂{top}/∂{of}"
        edits += [(*m.span(), apart_from(text.text, m, new)) for form in forms for m in re.finditer(form, text.text)]
    return text.edited(apart(sorted(edits)))


def _is_given_rate(name: str, text: str) -> bool:
    """Whether a statement gives a name with a prime a value in which a rate stands: d' = cos β ds/dt, d' = ṡ cos β."""
    given = rf"(?<![\w\\]){re.escape(name)}\s?['’′]\s{{0,3}}&?\s{{0,3}}=(?![=>])(?P<value>[^\n,;$]{{1,300}})"
    values = (normalize("NFD", m["value"]) for m in islice(re.finditer(given, text), _MAX))
    return any(_DOTTED.search(x) or QUOTIENT.search(x) for x in values)


QUOTIENT = re.compile(r"(?<![^\W\d_])d[ ]?\\?[^\W\d_]\w{0,15}\}?[ ]?(?:/[ ]?|\{)d[ ]?t(?![^\W\d_])")
"""A rate as a quotient, also in LaTeX: ds/dt."""
_APART = "$([{=,;:"
"""Signs behind which nothing has to stand apart."""


def apart_from(text: str, match: re.Match[str], new: str) -> str:
    """What stands in the place of a match, with spaces where there are none: two would be a gap between statements."""
    before, behind = text[match.start() - 1 : match.start()], text[match.end() : match.end() + 1]
    return f"{'' if before.isspace() or before in _APART else ' '}{new}{'' if behind.isspace() else ' '}"


def _primed(name: str, of: str, *, alone: bool) -> list[str]:
    """The pattern of a function with a prime: Θ'(r), and Θ' ``alone``."""
    applied = rf"(?:\s?{_argument(of)})"
    begins = r"(?:(?<![\w\\])|(?<=\d)(?=\\)|(?<=frac\d\d))"
    return [rf"{begins}{_spelled(name)}\s?['’′](?!['’′]){applied}{'?' if alone else ''}"]


def differentiated(name: str, of: str) -> list[str]:
    """The patterns of a function of a coordinate that is differentiated by it, as a fraction or by an operator."""
    d, by = r"(?:\\mathrm\s?\{d\}|\\mathrm\s{1,3}d|\\partial|d|∂)\s?", rf"{_letter(of)}(?![\w'’′\u0307(])"
    applied = rf"{_spelled(name)}\s?{_argument(of)}"
    whole, begins = rf"(?:{applied}|{_spelled(name)})", r"(?<![^\W\d])(?<!\\)"
    alone = rf"{_spelled(name)}(?=\s{{0,3}}(?:&?\s{{0,3}}=|[)\]]))"
    inner = rf"(?:{applied}|(?:\\left)?[(\[]\s?{whole}\s?(?:\\right)?[)\]]|{alone})"
    fraction = r"\\[dt]?frac\s?\{{\s?{}\s?\}}\s?\{{\s?{}\s?\}}"
    return [
        rf"{begins}{d}{whole}\s?/\s?{d}{by}",
        fraction.format(d + whole, d + by),
        rf"{begins}{d}/\s?{d}{_letter(of)}(?![\w'’′\u0307])\s?{inner}",
        fraction.format(d, d + by) + rf"\s?{inner}",
    ]


def _argument(of: str) -> str:
    """A pattern of a coordinate in brackets behind a function."""
    return rf"(?:\\left)?\(\s?{_letter(of)}\s?(?:\\right)?\)"


def _letter(of: str) -> str:
    """A pattern of a coordinate, whose Greek letter may be spelled out."""
    bare = of.removeprefix("\\")
    named = {bare, SPELLED.get(bare, bare), *(letter for letter, word in SPELLED.items() if word == bare)}
    return rf"\\?(?:{'|'.join(map(re.escape, sorted(named)))})"


def _spelled(name: str) -> str:
    r"""A pattern of a name as it may be written: J_{b} and \Theta."""
    return r"\\?" + r"[_{\s]{0,2}".join(map(re.escape, name)) + r"\}?"


def _bare(text: str, whole: str, system: Callable[[str], bool], *, latex: bool) -> Iterator[Edit]:
    """The letter of an energy without what it depends on, where no line states or differentiates it: K φ', after
    K(θ) = J + m a²."""
    name, _, of = whole.removesuffix(")").partition("(")
    alone = rf"(?<![\w\\]){re.escape(name)}(?![\w(]|\s{{0,3}}\()"
    if system(name) or re.search(rf"{alone}\s{{0,3}}&?\s{{0,3}}=|(?:∂|\bd|\\partial\s?){re.escape(name)}(?!\w)", text):
        return
    index = re.sub(r"\W", "", of)
    for match in re.finditer(alone, text):
        yield (match.end(), match.end(), f"_{{{index}}}" if latex else f"_{index}")


def _slopes(text: str, functions: Iterable[str], *, latex: bool) -> Iterator[Edit]:
    """The derivatives of functions of one coordinate, dL/dx and L'(x), by the names of their own."""
    for whole in functions:
        name, _, of = whole.removesuffix(")").partition("(")
        if not re.fullmatch(r"\w{1,24}", name) or not re.fullmatch(r"\w{1,24}", of):
            continue
        d, by = r"(?:\\mathrm\s?\{d\}|\\partial|d|∂)\s?", rf"\\?{of}(?![\w'’′\u0307(])"
        top = rf"{d}\\?{name}\s?(?:\(\s?\\?{of}\s?\))?"
        forms = [rf"(?<![\w\\]){name}['’′]\s?\(\s?\\?{of}\s?\)"]
        if not re.search(
            rf"{d}{name}\s?\}}?\s?[/{{]\s?{d}(?!\s?{by})|(?<![\w\\]){name}\s?&?=", text
        ):  # no Lagrangian, too
            forms += [rf"(?<!\w){top}/\s?{d}{by}", rf"\\[dt]?frac\s?\{{{top}\}}\s?\{{{d}{by}\s?\}}"]
        new = rf"\frac{{\partial {name}_{{{of}}}}}{{\partial {of}}}" if latex else f"∂{name}_{of}/∂{of}"
        for match in re.finditer("|".join(forms), text):
            yield (*match.span(), new)


_APPLIED = re.compile(rf"(?P<name>{_NAME})\s{{0,3}}(?P<of>(?:\\left)?\([^()=+*/^\n-]{{1,60}}\))")


def _functions(text: str, system: Callable[[str], bool], changes: Callable[[str], bool]) -> Iterator[str]:
    """The functions that are stated under a name of the system, or of an energy."""
    for match in _STATED.finditer(text):
        name, of = written(match["name"]), written(match["of"].removeprefix("\\left"))
        before = _BEFORE.search(text, max(0, match.start() - 40), match.start())
        first = before is None or (before[1] is not None and len(before[1]) > 1 and before[1] not in _BOLD)
        listed = [x for x in re.split("[,;]", of[1:-1]) if x]
        end = _VALUE_END.search(text, match.end())
        value = text[match.end() : len(text) if end is None else end.start()]
        if _MATRIX.match(text, match.end()):
            continue
        own = system(name) or (name in _LETTERS and not moves(value) and not _ENERGY.search(value))
        if first and own and not changes(name) and all(changes(x) or _has_rate(x, text) for x in listed):
            yield f"{name}{of}"


def _has_rate(name: str, text: str) -> bool:
    """Whether an answer differentiates a name by time."""
    return (
        re.search(
            rf"(?<!\w){re.escape(name)}(?:['’′\u0307\u0308]|d?dot\b)|\\d?dot\s?\{{?\s?\\?{re.escape(name)}(?!\w)", text
        )
        is not None
    )


def written(text: str) -> str:
    r"""Return a quantity without spaces, braces and commands: J_{b}(\theta) as Jb(theta)."""
    return re.sub(r"\\(?:left|right|,)|[\s\\{}_]", "", text)
