"""Reads a whole answer: recognizes the notation, splits it into statements, and converts these to lines."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial

import sympy as sp

from lagrangian.check.reading.answer import Answer, AnswerLine, MarkedRow, without_lines
from lagrangian.check.reading.arguments import dependents, names_in_chains
from lagrangian.check.reading.bullets import Bullets
from lagrangian.check.reading.carried_out.stated import carried_out
from lagrangian.check.reading.characters import LATEX, plainer
from lagrangian.check.reading.choices import LIKELIEST, Choices, less_likely, marked_readings
from lagrangian.check.reading.components import component_names, segments
from lagrangian.check.reading.defined_functions import called_definitions
from lagrangian.check.reading.indexed import counted_names, without_indices
from lagrangian.check.reading.latex.macros import ExpandedLatex, written_out
from lagrangian.check.reading.latex.rows import beside_mathematics, latex_rows
from lagrangian.check.reading.latex.variants import with_variants_apart
from lagrangian.check.reading.limits import MAX_ANSWER, check_length, check_number
from lagrangian.check.reading.line_forms import accelerates, together
from lagrangian.check.reading.linear_format import dots_in_letters, plain_format
from lagrangian.check.reading.lines import Lines
from lagrangian.check.reading.marked_names import begun
from lagrangian.check.reading.marked_values import with_marks
from lagrangian.check.reading.markup import without_markup
from lagrangian.check.reading.name_patterns import NAME, WORD_LETTER
from lagrangian.check.reading.names import Names
from lagrangian.check.reading.notations import without_notations
from lagrangian.check.reading.own_letters import called_otherwise
from lagrangian.check.reading.parsed import parsed, parsers_of, places_of_marks
from lagrangian.check.reading.plain.rows import AnswerRow, plain_rows, without_sums
from lagrangian.check.reading.plain.tokens import with_points
from lagrangian.check.reading.programs.added_in_loops import without_sums_of_loops
from lagrangian.check.reading.programs.marks import (
    is_program,
    told_beside_comments,
    told_comments,
    with_comments_read,
)
from lagrangian.check.reading.prose.changing_words import changing_words
from lagrangian.check.reading.prose.conditions import IF
from lagrangian.check.reading.prose.spoken_signs import with_spoken_signs
from lagrangian.check.reading.prose.spoken_words import doubled_letters, is_spelled_out, spoken_words, terms_alone
from lagrangian.check.reading.prose.values_said import values_said
from lagrangian.check.reading.prose.words import Words, function_of, led_names
from lagrangian.check.reading.prose.words_or_mathematics import ARTICLES, LINKING, is_statement
from lagrangian.check.reading.read_steps import equations_of_motion, read_program
from lagrangian.check.reading.renamed import read_in_own_letters
from lagrangian.check.reading.said.deviations import constants_of_deviations
from lagrangian.check.reading.said.dots_behind import with_dots_behind
from lagrangian.check.reading.said.listed_values import is_value_of_product, without_values
from lagrangian.check.reading.said.mentioned import chosen_names, described_names, mentioned_names
from lagrangian.check.reading.said.own_deviations import in_deviations
from lagrangian.check.reading.said.running_letters import introduced_letters
from lagrangian.check.reading.said.senses import stated_senses
from lagrangian.check.reading.said.stands_for import speaks_of_virtual_work, with_stated_rates
from lagrangian.check.reading.said.values import SaidValues, completed, misspelled, related, said_values, typed_in
from lagrangian.check.reading.set_aside import once, without_names_of_rates
from lagrangian.check.reading.side_remarks import told_remarks, without_side_remarks
from lagrangian.check.reading.starred import with_starred_names
from lagrangian.check.reading.stated import energy_of, force_of
from lagrangian.check.reading.subjects import MULTIPLIERS
from lagrangian.check.reading.traced_text import TracedText
from lagrangian.check.reading.wrapped_lines import refuse_unread, with_cut_lines
from lagrangian.errors import ParseError, Place
from lagrangian.model import Model
from lagrangian.quantities.source import Source
from lagrangian.read.letters import key

LONGEST_NAME = 3
"""The most letters of a word that may be a product."""

EXAMPLE = "an equation, such as m*x'' + k*x = F"
_BEGINS = (
    r"(?<=\w)\.(?=\s)|(?<=\S)[ \t]{3}|^|^[^\S\n]*+[(\[]?\w{1,4}[)\]]|^[^\S\n]*+[(\[]|[,;:$→⇒⟹]|[-=]>"
    r"|\\[(\[]|\\begin\{[a-z]{4,12}\*?\}"
    rf"|\bwhere|\bwith|\band|(?<=\s)\((?={NAME}[ \t]*=[ \t]*{NAME}[ \t]*[,)])"
    rf"|(?<=[ \t])[(\[](?=[ \t]?{NAME}[ \t]*=(?![=>])(?![ \t]*[-−]?[\d.,/]{{1,9}}[ \t]?\w{{0,4}}[)\]])"
    r"(?:[^()\[\]=,;:\n]|\([^()=\n]{1,40}\)){1,80}[)\]][.,;]?[ \t]*$)"
)
"""Where a name that gets a value may stand; also in brackets at the end of a line: (a = cos β)."""
_SQUARED = r"(?:(?:\^|\*\*)\s*2|²)?"
_DEFINED = re.compile(rf"(?:{_BEGINS})[^\S\n]*+\\?((?>{NAME}))[ \t]*+{_SQUARED}\s*+&?=(?![=>])", re.MULTILINE)
_CALLED = re.compile(rf"(?<![\w*/^+-])({WORD_LETTER}{{2,}})[ \t]+((?>{NAME}))\s*=(?!=)")
_NAMED = re.compile(
    rf"(?:^|[.:;,][ \t])[^\S\n]*+(?:(?:[^\W\d_]{{2,24}}|\d{{1,3}})[ \t]++){{1,4}}((?>{NAME}))"
    rf"[ \t]*+{_SQUARED}[ \t]*+=(?![=>])",
    re.MULTILINE,
)
"""A name behind words or a number: 2 Ms = …, Put Js = …."""
_MULTIPLE = re.compile(r"(?<=\d)[ \t]?(δ)[ \t]*=(?!=)")  # 2δ = b/m says that δ stands for no virtual displacement
_FUNCTION = re.compile(r"(?:arc|a)?(?:sin|cos|tan|sqrt|exp)")
_USED = re.compile(rf"(?<!\w)((?>{NAME}))(?:['’′″](?!s\b)|\s*(?:[*/^²³]))|[*/^]\s*((?>{NAME}))")
_COUNTED = re.compile(rf"(?<![\w.])\d{{1,3}}[ \t]+((?>{NAME}))[ \t]*\((?=[^()=\n]{{1,80}}[-+−])")
"""A name between a number and a sum in brackets: 2 lam (x1 - x2)."""
_PRIMED = re.compile(rf"(?<![\w/])((?>{NAME}))['’′″](?!s\b)")
_ALONE = re.compile(rf"(?<![\w.])(?<!\d\s)((?>{NAME}))")


def parse_answer(text: str, model: Model, *, name: str | None = None) -> Answer:
    """Return the content of an answer to ``model``, line by line.

    ``text`` is LaTeX, or plain text in the grammar of model files; ``name`` is the name of its file, for messages.
    Names that the model does not have are listed in ``unknown`` of the answer; they are not errors. Nothing in the text
    is executed; sizes, depths and exponents are bounded. If it cannot be read as it is most likely meant, it is read in
    another way that is possible. Raises `ParseError` with line, column, caret and what was expected there; if several
    statements cannot be read, the error lists all of them.
    """
    place = Place(name) if name else None
    Source(text, "the answer", place).check_text(MAX_ANSWER, EXAMPLE, shorter="give the equations alone")
    read = partial(read_in_own_letters, model=model, read=partial(_parsed, place=place))
    program = carried_out(text, model)
    if program is not None:
        return read_program(program, text, model, read)
    found = without_sums_of_loops(text, read)
    beside = told_beside_comments(text, [x.place for x in equations_of_motion(found)])
    return in_deviations(replace(found, notes=(*beside, *found.notes)), text, model, read)


def _parsed(text: str, model: Model, place: Place | None) -> Answer:
    """The content of an answer, as it is most likely meant if it can be read so."""
    others: list[Choices] = []
    likeliest: Answer | ParseError
    try:
        likeliest = _with_said_values(LIKELIEST, others, text, model, place)
    except ParseError as error:
        likeliest = error
        others = others if error.code != "E703" else []
    if isinstance(likeliest, Answer) and not likeliest.lacking:
        return likeliest
    for k, reading in enumerate(others):
        try:
            found = _with_said_values(reading, [], text, model, place)
        except ParseError:
            continue
        if isinstance(likeliest, Answer) and found.lacking:
            continue
        if isinstance(likeliest, Answer) or not reading.marks:
            return found
        more = (partial(_with_said_values, x, [], text, model, place) for x in others[k + 1 :])
        return replace(found, doubt=likeliest, others=(*found.others, *more))
    if isinstance(likeliest, ParseError):
        raise likeliest
    return likeliest


def _with_said_values(
    reading: Choices,
    choices: list[Choices],
    text: str,
    model: Model,
    place: Place | None,
    asked: frozenset[str] | None = None,
) -> Answer:
    """The answer in one reading, with names, of which some may be ``asked`` alone, that only its sentences explain;
    where they leave it open, with ``others`` that are possible."""
    answer = _answer(text, model, place, reading, choices)
    again = partial(with_marks, text, lambda x: _answer(text, model, place, replace(reading, values=x), []))
    answer = replace(answer, marked=again if "[" in text or any(x.name for x in answer.lines) else None)
    if not answer.unknown:
        return answer
    lines = Lines(model)
    typed, latex = with_starred_names(TracedText(plainer(text)), lines.names.known).text, answer.notation == "latex"
    names = [u.name for u in answer.unknown if asked is None or u.name in asked]
    said = said_values(typed, names, _words(lines, typed), answer)

    def read(values: SaidValues) -> Answer:
        found = _answer(completed(text, values.values, latex=latex), model, place, reading, [])
        return replace(typed_in(text, found), notes=(*values.told, *found.notes))

    others = (*answer.others, *(partial(read, x) for x in said))
    if near := misspelled(names, model.symbols):

        def corrected() -> Answer:
            told = [f"'{name}' was read as {value}, misspelled." for name, value in near.items()]
            found = read(SaidValues(near, False))
            return replace(found, notes=(*told, *found.notes))

        others = (*others, corrected)
    answer = replace(answer, others=others)
    for sure in (x for x in said if x.sure and not related(answer, x.values, model)):
        try:
            found = read(sure)
        except ParseError:
            continue
        if any(len(re.findall(r"\w+", value)) > 1 for value in sure.values.values()):  # a single name may be misread
            return replace(found, others=(*found.others, *(partial(read, x) for x in said if x.open and x is not sure)))
        return replace(found, others=(*found.others, lambda: answer, *others))
    return answer


def _answer(text: str, model: Model, place: Place | None, reading: Choices, others: list[Choices]) -> Answer:
    """The answer in one reading; those that are less likely are added to ``others``.

    Comments with equations of motion are read where no other line states one.
    """
    try:
        found = _read_as(text, model, place, reading, others)
    except ParseError as error:
        if reading.comments or error.code == "E703" or not any(told_comments(plainer(text))):
            raise
        try:
            return _read_as(text, model, place, replace(reading, comments=True), [])
        except ParseError:
            raise error from None
    if not found.commented or reading.comments or any(accelerates(sp.sympify(x.residual)) for x in found.equations):
        return found
    try:
        return _read_as(text, model, place, replace(reading, comments=True), [])
    except ParseError:
        return found


def _read_as(text: str, model: Model, place: Place | None, reading: Choices, others: list[Choices]) -> Answer:
    """The answer in one reading, without comments unless they are to be read."""
    given, lines = text, Lines(model, reading.names(model))
    remarks = without_side_remarks(text, model, lines.names.known)
    dots = with_dots_behind(plainer(remarks.text if reading.bare else text), lines.names, stops=reading.stops)
    typed = Source(dots.text, "the answer", place)
    plain = _with_names_apart(without_notations(typed, lines), lines)
    called = with_stated_rates(plain, [c.name for c in model.coordinates], lines.names.known)
    rated = called.text != plain.text
    plain, comments = _with_comments(called if reading.rated else plain, reading)
    text = without_markup(plain.text)
    latex = bool(LATEX.search(text))
    text = text if latex else dots_in_letters(plain_format(text), [c.name for c in model.coordinates], model.symbols)
    bullets, signed = Bullets(text, partial(_has_no_minus, lines)), text
    text = bullets.without(reading.listed, lines.names.notes, marked=text != plain.text and not latex)
    listing = text == signed if bullets.doubtful else None
    source = plain.source(typed, text)
    check_length(source)
    written = written_out(source) if latex else None
    _set_dependents(lines.names, text, written)
    words = _chosen(reading, _words(lines, text), lines, given)
    text, cut = (text, False) if latex else with_cut_lines(text, words, reading.wrapped)
    source = plain.source(typed, text := text if latex else with_spoken_signs(text, words))
    text = text if latex else without_values(text, partial(_value, lines), lines.names.notes)
    rows, outside = _rows(text, written, words, lines)
    check_number(rows, source, written)
    parsers = parsers_of(rows, outside if latex else rows, words, lines)
    statements, errors, aside = begun(lines.names, *parsed(source, parsers, written, words, lines, reading))
    refuse_unread([*errors, *lines.failed, *lines.remarks] if reading.wrapped else [])
    if reading == LIKELIEST:
        others += less_likely(words, dots, rated=rated and not latex, listed=listing, remarks=remarks.lines, cut=cut)
    marked = partial(places_of_marks, rows, source, written, words)
    try:
        made = without_names_of_rates(lines.read(statements, errors), given)
    finally:
        others += _seen_when_read(lines, marked) if reading == LIKELIEST else ()
    check_number(rows if _states_anything(made, lines) else [], source, written)
    aside += told_remarks(remarks.lines) if reading.bare else []
    spoken = given if latex else with_spoken_signs(given, words)
    return Answer(
        made,
        "latex" if latex else "text",
        tuple(lines.names.unknown.values()),
        (*once((*aside, *words.notes(), *reading.told(), *lines.names.notes, *comments, *changing_words(spoken))),),
        described_names(given, lines.names.known),
        frozenset(lines.unread) | chosen_names(given),
        remarks.said,
        values_said(given, lines.names),
        tuple(partial(_answer, given, model, place, x, []) for x in others),
        together(lines.doubts) if lines.doubts else None,
        bool(lines.lacking),
        marked,
        lambda marks: _with_said_values(replace(reading, marks=marks), [], given, model, place),
        partial(_left_out, reading, given, model, place, lines.names.unexplained),
        commented=bool(comments),
        senses=stated_senses(plainer(given), [u.name for u in lines.names.unknown.values()]),
        sentences=tuple(words.unread),
        renamed=tuple(lines.names.renamed.values()),
        mentioned=mentioned_names(given, lines.names.asked),
    )


def _set_dependents(names: Names, text: str, written: ExpandedLatex | None) -> None:
    """Set which quantities stand with what they depend on in brackets, and which letters words call no energies."""
    names.called = called_otherwise(text)
    own = {key(name) for name in names.model.symbols}
    stated = dependents(written.text if written else text, lambda name: key(name) in own, names.changes)
    names.dependents = stated | called_definitions(text, names)


def _left_out(
    reading: Choices, text: str, model: Model, place: Place | None, asked: frozenset[str], numbers: frozenset[int]
) -> Answer:
    """The answer without some lines; what these say of a name no sentence says."""
    return _with_said_values(reading, [], without_lines(text, numbers), model, place, asked)


def _with_names_apart(written: TracedText, lines: Lines) -> TracedText:
    """An answer in which forms of one letter, and names with a star, are names of their own where they are meant so."""
    names = lines.names
    apart = with_variants_apart(written, names.changes, lambda name: bool(names.scope.meanings(name)[0]))
    return with_starred_names(apart, names.known)


def _chosen(reading: Choices, words: Words, lines: Lines, text: str) -> Words:
    """The words of an answer, which are read as a reading says, and so are relations of coordinates."""
    words.flipped, words.units, words.summed = reading.flipped, reading.units, reading.summed
    words.factored = reading.factors(text)
    lines.names.relations.put, lines.names.inputs.put = reading.puts(text), reading.driven
    return words


def _seen_when_read(lines: Lines, marked: Callable[[], Sequence[MarkedRow]]) -> Iterator[Choices]:
    """The other readings that only the lines of an answer show."""
    yield from marked_readings(marked(), lines.failed) if lines.failed else ()
    if lines.names.relations.asked:
        yield Choices(put=not lines.names.relations.put)
    if lines.names.inputs.asked:
        yield Choices(driven=True)


def _with_comments(plain: TracedText, reading: Choices) -> tuple[TracedText, list[str]]:
    """An answer, in which comments with equations of motion are read if they are to be, and notes about these."""
    told = list(told_comments(plain.text, read=reading.comments)) if is_program(plain.text) else []
    return with_comments_read(plain) if told and reading.comments else plain, told


def _rows(
    text: str, latex: ExpandedLatex | None, words: Words, lines: Lines
) -> tuple[list[AnswerRow], list[AnswerRow]]:
    """The statements of an answer, and those of them that are plain text beside LaTeX."""
    rows, outside = plain_rows(text, words) if latex is None else latex_rows(latex.text), list[AnswerRow]()
    if latex is not None:
        rows = [row for row in (without_sums(x, lines.names) for x in rows) if row.text.strip()] or rows[:1]
        outside = _beside(latex, words)
        rows = sorted([*rows, *outside], key=lambda row: row.start)
    return without_indices(rows, lambda name: bool(lines.names.scope.meanings(name)[0])), outside


def _states_anything(made: Sequence[AnswerLine], lines: Lines) -> bool:
    """Whether a line equates something or holds a name of the system: "help" and "pdf" are names of nothing."""
    own = {u.symbol for u in lines.names.unknown.values()}
    alone = [x.kind == "equation" and "=" not in x.text and x.residual in own for x in made]
    return not alone or not all(alone)


def _has_no_minus(lines: Lines, name: str) -> bool:
    """Whether a line that gives the value of a name, and begins with a minus, is one of a list."""
    if energy_of(name, lines.model, lhs=True) or force_of(name, lines.model):
        return True
    return not lines.names.scope.meanings(name)[0] and not key(name).startswith(MULTIPLIERS)


def _value(lines: Lines, written: str) -> float | None:
    """The value of a parameter of the system; NaN if it has none, None for another name."""
    names, _ = lines.names.scope.meanings(written)
    found = [p for p in lines.model.parameters if p.name in names]
    return None if len(found) != 1 else float("nan") if found[0].value is None else float(found[0].value)


def _beside(written: ExpandedLatex, words: Words) -> list[AnswerRow]:
    """The statements in plain text on lines of their own beside LaTeX's mathematics: M = m_1 + m_2."""
    text = beside_mathematics(written.text)
    if "=" not in text:
        return []
    rows = [row for row in plain_rows(text, words) if is_statement(row.text, words)]
    return [replace(row, text=with_points(row.text)) for row in rows]


def _words(lines: Lines, text: str) -> Words:
    """The words of an answer: those that it defines, all, and those that it uses as names."""
    defined = (m for m in _DEFINED.finditer(text) if not is_spelled_out(text, m.end(), m[1]))
    own = dict.fromkeys(m[1] for m in defined if not is_value_of_product(m[1], text, m.end(), partial(_value, lines)))
    alone = [m[1] for m in _ALONE.finditer(text)]
    own |= dict.fromkeys(_MULTIPLE.findall(text))
    system = Words(lines.names, (), ())
    for match in _CALLED.finditer(text):  # with the total mass M_t = …, but not mgLl sinθ = …
        word = match[1]
        long = len(word) > LONGEST_NAME and not _FUNCTION.match(word)
        if word.lower() in IF and system.is_product(match[2]):
            continue  # if m1r = m2(l - r)
        if len(match[2]) > LONGEST_NAME and match[2].isalpha() and text[: match.start()].rstrip(" \t")[-1:] == "=":
            continue  # y = block drop = l sin θ
        if word.lower() in LINKING or (long and not system.known(word) and not system.is_product(word)):
            own.setdefault(match[2])
    for name in (m[1] for m in _NAMED.finditer(text)):
        if len(name) > 1 and function_of(name) is None and not system.known(name) and not system.is_product(name):
            own.setdefault(name)
    own |= dict.fromkeys(x for name in list(own) for x in counted_names(name, alone))  # kappa_i is kappa_1, too
    own |= dict.fromkeys(x.partition("(")[0] for x in lines.names.dependents)
    own |= dict.fromkeys(x for x in names_in_chains(text) if not system.known(x) and not system.is_product(x))
    own |= dict.fromkeys(constants_of_deviations(text)) | dict.fromkeys(component_names(text, system.is_name))
    own |= dict.fromkeys(x for x in segments(text) if not system.is_product(x))
    used = dict.fromkeys(m[1] or m[2] for m in _USED.finditer(text)) | doubled_letters(text) | terms_alone(text)
    used |= introduced_letters(text)
    used |= {m[1]: None for m in _COUNTED.finditer(text) if m[1].lower() not in LINKING - ARTICLES}
    counts, all_counts = Counter(m[1] for m in _PRIMED.finditer(text)), Counter(alone)
    primed = [x for x, count in counts.items() if all_counts[x] == count]
    lines.names.scope.learn(own, used, text)
    spoken = spoken_words(text, Words(lines.names, own, alone, used, primed))
    return Words(lines.names, own, alone, used, primed, led_names(text), spoken, speaks_of_virtual_work(text))
