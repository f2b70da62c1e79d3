"""Composes the interactive page: HTML around a schematic, sliders, plots and a derivation, with its data and scripts.

The page is one file that opens without a network. It forbids itself every request (Content-Security-Policy), and it
runs no text of a model: names are escaped in HTML, and the data is JSON in which no ``<`` occurs.
"""

from __future__ import annotations

import json
import re
from base64 import b64encode
from collections.abc import Mapping, Sequence
from importlib.resources import files
from string import Template
from typing import Any, Literal
from zlib import DEFLATED, MAX_WBITS, compressobj

from lagrangian.records import dataclass, field
from lagrangian.write import html_page
from lagrangian.write.document import Boxed, Document, Section
from lagrangian.write.expression_tree import Math
from lagrangian.write.html_page import escape
from lagrangian.write.interactive.columns import in_columns
from lagrangian.write.mathml import mathml

SCRIPTS = (
    "elements.js",
    "history.js",
    "run.js",
    "state.js",
    "depth.js",
    "ground.js",
    "picture.js",
    "motion.js",
    "player.js",
    "plots.js",
    "graphs.js",
    "address.js",
    "sliders.js",
    "dragging.js",
    "lighting.js",
    "background.js",
    "map.js",
    "sweep.js",
    "section.js",
    "saving.js",
    "page.js",
)
"""The scripts of the page itself, in this order: those that define, then the one that starts the page."""


WORKER = ("worker.js", "work_map.js", "work_sweep.js", "work_section.js")
"""The scripts of the page's workers."""


@dataclass(frozen=True)
class Adjustable:
    """A number that the reader can change: a parameter (``p``), an input (``u``) or one of the initial state (``x``).

    ``value``, ``low`` and ``high`` are in SI units; ``words`` describe it.
    """

    group: Literal["p", "u", "x"]
    name: str
    label: Math
    value: float
    low: float
    high: float
    unit: str = ""
    words: str = ""
    plain: str = ""


UNPACKED = (
    "const unpacked = (text) => new Response(new Blob([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))])"
    '.stream().pipeThrough(new DecompressionStream("deflate")));'
)
"""The inverse of `packed`, in JavaScript."""


LARGE_PICTURE = 16_000
"""A schematic of more characters travels packed; smaller ones are seen without a script, too."""


def compressed(content: bytes) -> bytes:
    """Return bytes in short blocks with codes of their own: formulas, data and scripts differ, so 2 % are saved."""
    made = compressobj(9, DEFLATED, MAX_WBITS, 5)
    return made.compress(content) + made.flush()


PACKED_RULES = "/* -- what follows comes packed"
"""The comment in the style sheet after the rules for what is seen before a script has run."""


def packed(content: bytes) -> str:
    """Return bytes compressed and in base64, a fifth of their size where they are the MathML of a derivation."""
    return b64encode(compressed(content)).decode("ascii")


DIGITS = "".join(map(chr, range(33, 127))).translate(dict.fromkeys(map(ord, '"&<')))
"""The 91 characters in which a page is packed: those that can be seen and have no meaning in HTML."""

PAIRS = [DIGITS[n % 91] + DIGITS[n // 91] for n in range(1 << 13)]
"""13 bits as two characters."""


def dense(content: bytes) -> str:
    """Return bytes compressed, 13 bits in two characters, for `unpack.js`; the first byte says how many fill up."""
    made = compressed(content)
    spare = -(len(made) + 1) % 13  # groups have 104 bits
    made = bytes([spare]) + made + bytes(spare)
    groups = (int.from_bytes(made[k : k + 13], "big") for k in range(0, len(made), 13))
    return "".join(PAIRS[group >> shift & 8191] for group in groups for shift in range(91, -1, -13))


@dataclass(frozen=True)
class PageSolver:
    """An integrator for the page: WebAssembly, its description, and functions and driver in JavaScript."""

    code: bytes
    layout: Mapping[str, Any]
    functions: str
    driver: str

    def script(self) -> str:
        """Return the script that defines ``physics``: {layout, functions, solver()}; it also runs in a worker."""
        lines = [
            UNPACKED,
            _script("columns.js"),
            squeezed(self.driver),
            "const physics = (() => {",
            f"const code = async () => fromColumns(new Uint8Array(await unpacked("
            f'"{packed(in_columns(self.code))}").arrayBuffer()));',
            f"const layout = {embedded(self.layout)};",
            f"const functions = {squeezed(self.functions)};",
            "const solver = async () => lagrangianSolver.load(await code(), layout, functions);",
            "return {layout, functions, solver};",
            "})();",
        ]
        return "\n".join(lines)


@dataclass(frozen=True)
class PageContents:
    """What a page is made of.

    ``schematic`` is SVG; ``adjustables`` the sliders in order; ``coordinates`` the number of those entries of the
    initial state that are coordinates; ``data`` is given to the scripts; ``solver`` integrates.
    """

    document: Document
    schematic: str
    adjustables: Sequence[Adjustable]
    coordinates: int
    data: Mapping[str, Any]
    solver: PageSolver
    subtitle: str = ""
    missing: Sequence[str] = field(default=())
    space: bool = False
    bodies: bool = True
    """Whether there is a body that moves; a circuit alone has none."""
    flows: bool = False
    """Whether dots move with the charges of a circuit."""


def page_html(contents: PageContents) -> str:
    """Return the page."""
    title = escape(contents.document.title)
    first, mark, _ = _file("page.css").partition(PACKED_RULES)
    assert mark, "the style sheet says which rules are packed"
    return Template(_file("page.html")).substitute(
        title=title,
        subtitle=f"<p>{escape(contents.subtitle)}</p>" if contents.subtitle else "",
        style=_style(html_page.style_sheet().partition("\n.")[0] + "\n" + first),
        schematic="" if len(contents.schematic) > LARGE_PICTURE else contents.schematic,
        missing=_missing(contents.missing),
        motion_hint=_hint(contents),
        packed=dense(_parts(contents).encode()),
        unpack=_script("unpack.js"),
    )


def _bench(contents: PageContents) -> str:
    """The panels with the equations, the values, the plots and the studies, which the scripts fill."""
    states = [a for a in contents.adjustables if a.group == "x"]
    coordinates, rates = states[: contents.coordinates], states[contents.coordinates :]
    return Template(_file("bench.html")).substitute(
        coordinate_legend=_legend(coordinates),
        energy_legend=_ENERGIES,
        phase_up=_choice("phase-y", "vertical axis", states, len(coordinates) if rates else 0),
        phase_across=_choice("phase-x", "horizontal axis", states, 0),
        **_studies(contents, states, coordinates),
        map_of=_choice("map-of", "what is coloured", coordinates, 0),
        map_across=_choice("map-x", "from left to right", states, 0),
        map_up=_choice("map-y", "upward", states, 1 if len(states) > 1 else 0),
        map_end=f"{float(contents.data['duration']) / 4:.3g}",
    )


def _studies(contents: PageContents, states: Sequence[Adjustable], coordinates: Sequence[Adjustable]) -> dict[str, str]:
    """The choices of the sweep and of the section: at first the second coordinate and its rate where the first is 0."""
    nq, duration = len(coordinates), float(contents.data["duration"])
    parameters = [a for a in contents.adjustables if a.group == "p"]
    shown = min(1, nq - 1)
    where = _choice("section-where", "section", coordinates, 0 if nq > 1 else -1)
    stroboscope = f'<option value="-1"{"" if nq > 1 else " selected"}>time, again and again</option>'
    return {
        "sweep_of": _choice("sweep-of", "parameter", parameters, 0),
        "sweep_state": _choice("sweep-state", "what is shown", states, 0),
        "sweep_end": f"{duration / 2:.3g}",
        "section_where": where.replace("</select>", f"{stroboscope}</select>"),
        "section_across": _choice("section-x", "from left to right", states, shown),
        "section_up": _choice("section-y", "upward", states, min(nq + shown, len(states) - 1)),
    }


def _parts(contents: PageContents) -> str:
    """What is packed, as JSON: [id, text, type] of the insides of elements and of scripts, in the order of use."""
    html, plain, script = "text/html", "text/plain", "text/javascript"
    parts = [
        ("style", _style(html_page.style_sheet() + _file("page.css")), html),
        ("bench", _bench(contents), html),
        *([("drawing", _lighter(contents.schematic), html)] if len(contents.schematic) > LARGE_PICTURE else []),
        ("result", _equations(contents.document), html),
        ("values", _controls(contents.adjustables), html),
        ("numbers", _numbers([a for a in contents.adjustables if a.group == "x"]), html),
        ("whole", _steps(contents.document), html),
        ("data", embedded(contents.data), "application/json"),
        ("engine", contents.solver.script(), script),
        ("shared", _script("closing.js"), script),
        ("worker", "\n".join(map(_script, WORKER)), plain),
        ("page", "\n".join(map(_script, SCRIPTS)), script),
    ]
    return json.dumps(parts, ensure_ascii=False)


def _lighter(picture: str) -> str:
    """A schematic without the colours that its style repeats, its outlines as steps of tenths of a pixel."""
    text = re.sub(r' (fill|stroke)="#[0-9a-f]{6}"', "", picture)
    return re.sub(r' d="([MLCZ\d. -]*)"', lambda d: f' d="{_in_steps(d[1])}"', text)


def _in_steps(outline: str) -> str:
    """An outline of moves, lines and cubic curves with every point counted from where its command begins.

    Points are rounded, not steps, so that no error grows along the outline.
    """
    made: list[str] = []
    at = start = (0, 0)
    for letter, listed in re.findall(r"([MLCZ])([^MLCZ]*)", outline):
        made.append(letter.lower())
        numbers = [round(10 * float(x)) for x in re.findall(r"-?[\d.]+", listed)]
        for k in range(0, len(numbers), 6 if letter == "C" else 2):
            points = numbers[k : k + 6 if letter == "C" else k + 2]
            for n, x in enumerate(points):
                step = re.sub(r"^(-?)0\.", r"\1.", f"{(x - at[n % 2]) / 10:.1f}".removesuffix(".0"))
                made.append(f" {step}" if made[-1][-1:] not in "mlc" and not step.startswith("-") else step)
            at = (points[-2], points[-1])
        if letter == "M":
            start = (numbers[0], numbers[1])
        elif letter == "Z":
            at = start
    return "".join(made)


def embedded(data: Mapping[str, Any]) -> str:
    """Return data as JSON that can stand within a script element: no ``<``, and no line separators of JavaScript."""
    text = json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    for character in "<>&\u2028\u2029":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return text


def squeezed(script: str) -> str:
    """Return a script or style sheet without indentation, and without lines and blocks that are only comments."""
    text = re.sub(r"^[ \t]*/\*.*?\*/[ \t]*$", "", script, flags=re.DOTALL | re.MULTILINE)
    lines = (line.strip() for line in text.splitlines())
    return "\n".join(line for line in lines if line and not line.startswith("//"))


def _file(name: str) -> str:
    return files("lagrangian.write.interactive").joinpath(name).read_text(encoding="utf-8")


_SPACED = re.compile(r" ?([=,:;?&|(){}\[\]*%]) ?")


def _script(name: str) -> str:
    """A script of this folder, squeezed; where nothing is quoted or divided, spaces beside punctuation mean nothing."""
    lines = squeezed(_file(name)).splitlines()
    return "\n".join(line if re.search(r"[\"'`/\\]", line) else _SPACED.sub(r"\1", line) for line in lines)


def _hint(contents: PageContents) -> str:
    if not contents.bodies:
        return "dots move with the charges" if contents.flows else "no body moves: the plots show the charges"
    return "drag a body to place it" + ("; drag beside it to turn the view" if contents.space else "")


def _style(sheet: str) -> str:
    """A style sheet, squeezed, without the spaces beside its punctuation (a colon ends a property before a space)."""
    text = re.sub(r"\n(?=[^}])", " ", squeezed(sheet))
    return re.sub(r" ?([{};,]) ?", r"\1", text).replace(": ", ":").replace(";}", "}") + "\n"


def _missing(listed: Sequence[str]) -> str:
    if not listed:
        return ""
    items = "".join(f"<li>{escape(words)}</li>" for words in listed)
    return f'<details class="missing"><summary>Not drawn: {len(listed)}</summary><ul>{items}</ul></details>\n'


def _equations(document: Document) -> str:
    """The boxed equations with their legend, without the other blocks of the result."""
    for section in document.sections:
        if section.anchor == "result":
            boxed = tuple(block for block in section.blocks if isinstance(block, Boxed))
            return html_page.blocks_html(Section(section.anchor, (), boxed or section.blocks))
    return ""


def _steps(document: Document) -> str:
    """Everything but the result."""
    return "\n".join(html_page.section_html(s) for s in document.sections if s.anchor != "result")


# -- sliders ----------------------------------------------------------------------------------------------------------


def _controls(adjustables: Sequence[Adjustable]) -> str:
    titles = {"p": "Parameters", "u": "Inputs", "x": "Initial state"}
    return "\n".join(
        f'<fieldset class="{kind}"><legend>{title}</legend><div class="sliders">{"".join(rows)}</div></fieldset>'
        for kind, title in titles.items()
        if (rows := [_control(a, i) for i, a in enumerate(a for a in adjustables if a.group == kind)])
    )


def _control(a: Adjustable, index: int) -> str:
    identity = f"{a.group}-{index}"
    said = ", ".join(filter(None, (a.plain or a.name, a.words)))
    hint = f' title="{escape(a.words)}"' if a.words else ""
    pushes = ""
    if a.group == "u":
        by = max(abs(a.low), abs(a.high)) / 2
        pushes = "".join(
            f'<button type="button" class="push" data-push="{sign * by!r}" '
            f'aria-label="Push {escape(a.plain or a.name)} {way} while held">{arrow}</button>'
            for sign, way, arrow in ((-1, "down", "−"), (1, "up", "+"))
        )
    return (
        f'<div class="control" data-group="{a.group}" data-index="{index}" data-unit="{escape(a.unit)}">'
        f'<label for="{identity}"{hint}>{mathml(a.label)}</label>'
        f'<input type="range" id="{identity}" min="{a.low!r}" max="{a.high!r}" step="any" value="{a.value!r}" '
        f'aria-label="{escape(said)}">{pushes}'
        f'<input type="text" inputmode="decimal" aria-label="{escape(a.plain or a.name)}, exact value" '
        f'autocomplete="off" size="7"><span class="unit">{escape(a.unit)}</span></div>'
    )


# -- plots ------------------------------------------------------------------------------------------------------------

_ENERGIES = (
    '<span class="key key-0">T</span> <span class="key key-1">V</span> '
    '<span class="key key-2 dashed">T + V − supplied</span> [J] over t [s]'
)


def _legend(coordinates: Sequence[Adjustable]) -> str:
    keys = "".join(
        f'<button type="button" class="key key-{i % 6}" data-series="{i}" aria-pressed="true">{_both(a)}</button> '
        for i, a in enumerate(coordinates)
    )
    units = ", ".join(dict.fromkeys(a.unit for a in coordinates if a.unit))
    return f"{keys}{f'[{escape(units)}] ' if units else ''}over t [s]"


def _choice(identity: str, what: str, states: Sequence[Adjustable], chosen: int) -> str:
    options = "".join(
        f'<option value="{i}"{" selected" if i == chosen else ""}>{escape(a.plain or a.name)}'
        f"{f' [{escape(a.unit)}]' if a.unit else ''}</option>"
        for i, a in enumerate(states)
    )
    return f'<span class="unseen">{what}</span><select id="{identity}">{options}</select>'


def _numbers(states: Sequence[Adjustable]) -> str:
    rows = [(_both(a), f"number-{i}", escape(a.unit)) for i, a in enumerate(states)]
    rows += [("T", "number-T", "J"), ("V", "number-V", "J"), ("T + V − supplied", "number-balance", "J")]
    rows += [("its change since the start", "number-audit", "J")]
    return "".join(_number(*row) for row in rows)


def _both(a: Adjustable) -> str:
    """The formula to look at, and its name for readers of the screen that do not speak formulas."""
    return f'<span aria-hidden="true">{mathml(a.label)}</span><span class="unseen">{escape(a.plain or a.name)}</span>'


def _number(label: str, identity: str, unit: str) -> str:
    return f'<tr><th scope="row">{label}</th><td id="{identity}">0</td><td class="unit">{unit}</td></tr>\n'
