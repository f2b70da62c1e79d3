"""Takes off an answer, before its statements are found, how programs, HTML and drawings write mathematics."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection
from functools import partial

from lagrangian.check.reading.applied import with_functions_applied, with_slopes_by_arguments, with_values_above
from lagrangian.check.reading.arguments import with_own_functions, with_primes_as_slopes
from lagrangian.check.reading.called_dissipation import with_called_dissipation
from lagrangian.check.reading.canonical import with_routhian
from lagrangian.check.reading.characters import LATEX
from lagrangian.check.reading.copied import (
    with_plain_numbers,
    with_typed_arrays,
    without_copying,
    without_leaders,
    without_proved,
)
from lagrangian.check.reading.crossed_out import without_crossed_out
from lagrangian.check.reading.declared_slopes import with_declared_slopes, with_spelled_slopes
from lagrangian.check.reading.defined_functions import is_defined_by_one, with_slopes_of_definitions
from lagrangian.check.reading.derived_lines import with_derivatives, with_derivatives_in_latex, with_energies_beside
from lagrangian.check.reading.drawn.ascii_pieces import with_drawn_pieces
from lagrangian.check.reading.drawn.barred import with_tall_brackets
from lagrangian.check.reading.drawn.dots_above import with_dots_above
from lagrangian.check.reading.drawn.formulas import without_drawn_formulas
from lagrangian.check.reading.drawn.named_columns import with_named_columns
from lagrangian.check.reading.drawn.text_matrices import on_one_line
from lagrangian.check.reading.energy_parts import with_parts_of_energies
from lagrangian.check.reading.entries import (
    entered_in_latex,
    entered_matrices,
    solved_matrices,
    with_determinants,
    with_symmetric_entries,
)
from lagrangian.check.reading.finite_sums import with_sums_written_out
from lagrangian.check.reading.forces_by_element import with_forces_by_element
from lagrangian.check.reading.general_matrices import with_general_form
from lagrangian.check.reading.gloss_of_rates import without_glosses_of_rates
from lagrangian.check.reading.hypertext import without_tags
from lagrangian.check.reading.index_form import with_index_form
from lagrangian.check.reading.labelled_forces import with_labelled_forces
from lagrangian.check.reading.latex.layout import with_open_text
from lagrangian.check.reading.latex.numbers_with_units import with_siunitx
from lagrangian.check.reading.latex.said_names import with_named_formulas
from lagrangian.check.reading.lines import Lines
from lagrangian.check.reading.markup import sentences_apart
from lagrangian.check.reading.named_sums import with_named_sums
from lagrangian.check.reading.names import Names
from lagrangian.check.reading.operators import without_operators
from lagrangian.check.reading.own_derivatives import with_own_derivatives, with_second_derivatives
from lagrangian.check.reading.own_lagrangian import with_own_lagrangian
from lagrangian.check.reading.own_length import with_own_length
from lagrangian.check.reading.places_of_bodies import with_places_of_bodies
from lagrangian.check.reading.primed_constants import with_primed_constants
from lagrangian.check.reading.programs.anonymous import without_anonymous_functions
from lagrangian.check.reading.programs.braced_lists import with_braced_lists
from lagrangian.check.reading.programs.indexed_coordinates import with_indexed_coordinates
from lagrangian.check.reading.programs.indexed_parameters import with_indexed_parameters
from lagrangian.check.reading.programs.marks import without_program_marks, without_terminators
from lagrangian.check.reading.programs.mathematica_tables import with_tables_written_out
from lagrangian.check.reading.programs.matrices import told_order, with_whole_matrices
from lagrangian.check.reading.programs.modelica import without_modelica
from lagrangian.check.reading.programs.names import with_declared, with_program_names
from lagrangian.check.reading.programs.notebooks import with_columns, with_named_matrices, with_shown_values
from lagrangian.check.reading.programs.quotes import without_quotes
from lagrangian.check.reading.programs.residuals import residuals
from lagrangian.check.reading.programs.session_lists import without_lists, without_sets
from lagrangian.check.reading.programs.sessions import without_prompts, without_session
from lagrangian.check.reading.programs.source_code import is_session, told_commands, without_code, without_maxima
from lagrangian.check.reading.programs.spellings import without_marks_of_latex, without_programs
from lagrangian.check.reading.programs.templates import with_templates_applied
from lagrangian.check.reading.prose.intervals import without_intervals
from lagrangian.check.reading.prose.leading_words import without_leading_words
from lagrangian.check.reading.prose.relaxed import without_relaxed
from lagrangian.check.reading.prose.remarks import without_legend
from lagrangian.check.reading.references import without_marks_of_terms, without_references
from lagrangian.check.reading.said.at_the_start import with_start_alone
from lagrangian.check.reading.said.derivative_legends import (
    with_derivative_legends,
    with_paired_rates,
    with_raised_dots,
)
from lagrangian.check.reading.said.deviations import with_deviations
from lagrangian.check.reading.said.elements_behind import without_elements_behind
from lagrangian.check.reading.said.explained_names import with_explained_names
from lagrangian.check.reading.said.factors_named_behind import with_factors_named_behind
from lagrangian.check.reading.said.glossed_names import with_words_below, without_glosses_of_names
from lagrangian.check.reading.said.listed_names import with_listed_names
from lagrangian.check.reading.said.of_each import with_names_of_each
from lagrangian.check.reading.said.quantity_words import with_items
from lagrangian.check.reading.said.rates_of_bodies import with_rates_of_bodies
from lagrangian.check.reading.said.rates_with_p import with_p_as_points
from lagrangian.check.reading.said.running_letters import with_running_letters
from lagrangian.check.reading.said.side_by_side import with_definitions_apart
from lagrangian.check.reading.said.spelled_apart import with_letters_apart
from lagrangian.check.reading.said.spoken_dots import with_spoken_dots
from lagrangian.check.reading.said.stands_for import (
    with_stated_letters,
    with_stated_rates,
    with_stated_values,
    with_variations,
)
from lagrangian.check.reading.said.subscripts import (
    with_energies_below,
    with_index_behind_comma,
    with_index_of_time,
)
from lagrangian.check.reading.said.summed_tables import with_summed_tables
from lagrangian.check.reading.said.tables import with_tables
from lagrangian.check.reading.said.turned_by import with_turned_bodies
from lagrangian.check.reading.said.virtual_velocities import with_virtual_velocities
from lagrangian.check.reading.slopes_with_primes import with_primes_of_slopes
from lagrangian.check.reading.spoken_matrices import with_spoken_matrices
from lagrangian.check.reading.star_math import without_star_math
from lagrangian.check.reading.starred import with_starred_names
from lagrangian.check.reading.thousands import with_whole_numbers
from lagrangian.check.reading.traced_text import TracedText
from lagrangian.check.reading.unit_checks import without_unit_checks, without_units_of_numbers
from lagrangian.quantities.source import Source
from lagrangian.read.letters import key

_STAR_BELOW = re.compile(r"_(?:\\(?P<sign>ast|star)(?![A-Za-z])|\{\\(?P<within>ast|star)\})")
"""An index that is a star, in LaTeX: J_\\ast."""
_SIGN_BELOW = re.compile(
    r"(?<=[^\W\d_}])_(?:\{[ ]?(?P<within>[-+−*]|\\(?:perp|parallel|bot|\|))[ ]?\}"
    r"|(?P<alone>[-+−](?![\w.(\[])|\*(?![\w*.(\[]))|(?P<sign>\\(?:perp|parallel|bot)(?![A-Za-z])|\\\|))"
)
"""An index that is a sign: m_+, m_{-}, v_\\perp, s_*."""
_SIGNS = {"+": "plus", "-": "minus", "−": "minus", "*": "ast", "\\|": "parallel", "\\bot": "perp"}
"""The names of such signs."""
_BRACED_INDEX = re.compile(r"_\{(\w{1,12})\}")
_BRACED_POWER = re.compile(r"\^\{([^{}\n]{1,40})\}")
_ADDED_DEGREES = re.compile(r"(?P<sign>[-+−])[ ]?(?P<number>\d{1,3}(?:\.\d{1,4})?)[ ]?deg(?:rees?)?\b(?![ ]?/)")
"""Degrees in words that are added: phi = u + 180 deg."""
_DEGREES = re.compile(
    r"(?<![\d.,_])(?P<number>\d{1,6}(?:[.,]\d{1,6})?)(?:\\[,;! ]|[ ]){0,3}"
    r"(?:\^\s?(?:\{\s?\\circ\s?\}|\\circ(?![A-Za-z]))|\\degree(?![A-Za-z])|°)"
)
"""An angle in degrees in LaTeX."""
_ROW_OF = re.compile(
    r"^[ \t]*+(?:\\d?dot[ ]?\{?[ ]?)?\\?[^\W\d]\w{0,15}\}?['’′]{0,2}"
    r"[ \t]*+(?:&[ \t]*+:|:[ \t]*+&)[ \t]*+(?=\\text\s?\{)",
    re.MULTILINE,
)
r"""What a row of LaTeX is about, in front of words: s'' &: \text{from the second equation} \ddot s = …"""
_BY_TIME = re.compile(r"[(\[](?P<by>d/dt)[)\]](?=[ \t]?[(\[d∂])")
"""d/dt in brackets of its own: (d/dt)(∂T/∂x')."""
_DOT_OF_BRACKET = re.compile(r"(?<=\))_(?P<two>d)?dot(?!\w)")
"""The rate of what stands in brackets: (l c w)_dot."""
_ROUND_BY_TIME = re.compile(
    r"∂[ ]?(?P<two>²|\^2)?[ ]?(?P<of>(?![TVLDℒE]\b)[^\W\d]\w{0,23}+(?:\(t\))?)[ ]?/[ ]?∂[ ]?t(?P<twice>²|\^2)?(?!\w)"
)
"""A rate with round signs: ∂²x/∂t²."""


def _copied(text: str, notes: dict[str, None]) -> TracedText:
    """The text of an answer without what copying, drawing and a formula editor leave in it."""
    plain = without_copying(
        with_typed_arrays(without_leaders(without_proved(without_star_math(with_plain_numbers(TracedText(text))))))
    )
    plain = with_whole_numbers(without_intervals(plain), notes)
    plain = plain.sub(_STAR_BELOW, lambda m: f"_{{{m['sign'] or m['within']}}}")
    plain = plain.sub(_SIGN_BELOW, lambda m: _below(m["within"] or m["alone"] or m["sign"], latex="\\" in text))
    return with_drawn_pieces(with_tall_brackets(plain))


def _below(sign: str, *, latex: bool) -> str:
    """An index that is a sign, as a word."""
    word = _SIGNS.get(sign, sign.removeprefix("\\"))
    return f"_{{{word}}}" if latex else f"_{word}"


def _moves(lines: Lines) -> Callable[[str], bool]:
    """What says whether a name is a coordinate."""
    moving = {key(c.name) for c in lines.model.coordinates}
    return lambda name: key(name) in moving


def _with_slopes(text: TracedText, lines: Lines, taken: Callable[[str], bool], latex: bool) -> TracedText:
    """An answer in which derivatives by a coordinate are slopes, however they are written: dℓ/dθ, ℓ', ℓ_θ."""
    names, moves = lines.names, _moves(lines)
    if not latex:
        applied = with_functions_applied(with_second_derivatives(text, moves, taken), taken, names.notes)
        applied = with_spelled_slopes(applied, moves, names.notes)
        text = with_own_derivatives(with_slopes_by_arguments(applied, moves, taken, names.notes), moves, taken)
    text = with_declared_slopes(text, moves, taken, names.notes, latex=latex)
    defined = partial(is_defined_by_one, names=names)
    text = with_primes_of_slopes(text, moves, taken, defined, names.notes, latex=latex)
    text = with_primes_as_slopes(text, taken, names.changes, latex=latex)
    return with_slopes_of_definitions(text, names, latex=latex)


def _with_rates(text: TracedText, names: Names, own: Collection[str]) -> TracedText:
    """An answer in plain text whose rates have primes, however it says what its marks for them mean."""

    def has(name: str) -> bool:
        return key(name) in own

    text = with_virtual_velocities(text, names.changes).sub(_DOT_OF_BRACKET, lambda m: "''" if m["two"] else "'")
    raised = with_raised_dots(with_spoken_dots(text, names.changes), names.changes)
    paired = with_paired_rates(raised, names.changes, has)
    pointed = with_p_as_points(with_derivative_legends(paired, names.changes, has), names.changes, has)
    return without_glosses_of_rates(pointed, names.changes)


def _unprompted(text: TracedText) -> TracedText:
    """An answer without the prompts of a session and the quotes of mail."""
    return without_quotes(without_prompts(text))


def _with_letters_apart(text: TracedText, lines: Lines, taken: Callable[[str], bool]) -> TracedText:
    """An answer in which letters that words alone tell from those of the system are what they stand for."""
    if LATEX.search(text.text):
        return text
    moves, spelled = _moves(lines), lines.model.symbols.__contains__
    text = with_words_below(without_glosses_of_names(text, lines.model, taken), moves, taken, exact=spelled)
    return with_letters_apart(text, moves, spelled, taken, lines.names.notes)


def _with_said_letters(
    text: TracedText, names: Names, taken: Callable[[str], bool], own: Collection[str]
) -> TracedText:
    """An answer in which what sentences say of its letters stands as statements."""
    latex = bool(LATEX.search(text.text))
    apart = with_running_letters(text, names.known, names.notes)
    listed = apart if latex else with_listed_names(apart, taken, lambda name: key(name) in own)
    said = with_stated_letters(listed, names.changes, taken, latex=latex)
    return with_called_dissipation(with_routhian(with_values_above(said), taken), taken)


def without_notations(typed: Source, lines: Lines) -> TracedText:
    """An answer without HTML and without the spellings of programs, and with matrices in one line."""
    names, text = lines.names, typed.text

    def taken(name: str) -> bool:
        return bool(names.scope.meanings(name)[0])

    commands: list[int] = []
    moves = _moves(lines)
    dotted = _copied_with_dots(text, lines, taken)
    typed_in = without_crossed_out(without_terminators(without_maxima(without_modelica(dotted))), names.notes)
    listed = with_tables_written_out(with_tables(typed_in, names.changes, taken))
    shown = with_shown_values(with_named_matrices(without_marks_of_latex(without_tags(listed))))
    prompted = _with_letters_apart(with_columns(with_whole_matrices(_unprompted(shown))), lines, taken)
    own = {key(name) for name in lines.model.symbols}
    zero = residuals(with_declared(prompted, lambda name: key(name) in own), taken, names.changes)
    names.residuals = zero.names
    code = without_code(with_templates_applied(zero.written), taken, commands.append, session=is_session(text))
    session = without_session(code, taken, commands.append)
    if commands:
        names.notes.setdefault(told_commands(text, commands))
    names.in_order(told_order(text))
    if not LATEX.search(session.text):
        session = with_braced_lists(session)
        session = _with_rates(with_indexed_parameters(session, [p.name for p in lines.model.parameters]), names, own)
    session = with_energies_below(session, moves, taken)
    relaxed = without_legend(_with_times(session, moves, taken))
    if not lines.model.constraints:  # x = 2 r φ beside a rope is one
        relaxed = without_relaxed(relaxed, moves, taken, names.notes)
    referred = without_units_of_numbers(without_unit_checks(relaxed, taken))
    tagless = with_determinants(solved_matrices(without_drawn_formulas(referred, typed), taken))
    latex = bool(LATEX.search(tagless.text))
    tagless = _with_slopes(tagless, lines, taken, latex)
    tagless = with_own_functions(tagless, lambda name: key(name) in own, names.changes, names.notes, latex=latex)
    if "\\" not in text and "$" not in text:  # F_{12} cos(w t) is no LaTeX
        tagless = tagless.sub(_BRACED_INDEX, lambda m: f"_{m[1]}").sub(_BRACED_POWER, lambda m: f"^({m[1]})")
    if not LATEX.search(tagless.text):
        tagless = without_lists(without_operators(without_program_marks(tagless, taken), taken))
        tagless = entered_matrices(tagless, len(lines.model.coordinates), taken)
    else:
        tagless = entered_in_latex(tagless, len(lines.model.coordinates))
    tagless = with_own_lagrangian(tagless, lines.model, taken, latex=bool(LATEX.search(tagless.text)))
    tagless = with_own_length(tagless, names, taken, latex=bool(LATEX.search(tagless.text)))
    varied = with_variations(_with_own_letters(tagless, lines), taken, None if latex else names.changes)
    said = _with_said_letters(with_turned_bodies(varied, lines.model, taken), names, taken, own)
    of = [c.name for c in lines.model.coordinates]
    if LATEX.search(said.text):
        said = _in_latex(with_named_formulas(said, taken))
    else:
        beside = with_energies_beside(said.sub(_BY_TIME, lambda m: m["by"]).sub(_ROUND_BY_TIME, _straight))
        starred = with_starred_names(with_derivatives(beside), names.known)
        said = with_stated_values(with_explained_names(starred, taken, lambda name: key(name) in own), taken)
        said = with_rates_of_bodies(with_stated_rates(said, of, names.known, sure=True), lines.model, taken)
        named = with_program_names(said, names.changes, lambda name: key(name) in own)
        said = with_items(with_forces_by_element(named, taken), text, names)
        said = with_labelled_forces(said, lambda x: [n for n in names.scope.meanings(x)[0] if n in of], taken, len(of))
    plain = sentences_apart(with_named_columns(on_one_line(without_programs(said, names.changes, taken)), taken))
    return with_parts_of_energies(with_places_of_bodies(plain, lines.model, taken), lines.model, taken)


def _copied_with_dots(text: str, lines: Lines, taken: Callable[[str], bool]) -> TracedText:
    """An answer without marks of copying, with the general form in its entries and dots above letters behind them."""
    names = lines.names
    copied = with_symmetric_entries(_copied(text, names.notes), names.notes)
    whole = _with_whole_forms(copied, lines, taken, latex="\\" in text or "$" in text)
    dotted = with_dots_above(whole, _moves(lines))
    return dotted if LATEX.search(text) else with_summed_tables(dotted, taken, names.notes)


def _with_whole_forms(copied: TracedText, lines: Lines, taken: Callable[[str], bool], *, latex: bool) -> TracedText:
    """An answer with sums over an index, matrices in words and general forms of matrices written out."""
    names, coordinates = lines.names, [c.name for c in lines.model.coordinates]
    rated = with_index_form(with_index_behind_comma(copied, names.changes), latex=latex)
    whole = with_sums_written_out(rated, taken)
    if not LATEX.search(whole.text):
        whole = with_indexed_coordinates(with_spoken_matrices(whole), coordinates, names.scope.meanings)
        whole = _with_factors_apart(without_elements_behind(whole, lines.model, taken), taken)
    return with_general_form(whole, coordinates, taken, names.notes, latex=latex)


def _with_times(written: TracedText, moves: Callable[[str], bool], taken: Callable[[str], bool]) -> TracedText:
    """An answer without numbers of lines and terms, in which no t is an index and the start is no argument."""
    timed = with_index_of_time(written, moves, taken)
    return with_start_alone(without_references(without_marks_of_terms(timed)), moves)


def _with_factors_apart(copied: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """A plain text without functions that have no name and leading words, with definitions and named factors apart."""
    opened = without_leading_words(without_anonymous_functions(copied, taken), taken)
    return with_factors_named_behind(with_definitions_apart(with_names_of_each(opened, taken), taken), taken)


def _in_latex(said: TracedText) -> TracedText:
    """An answer in LaTeX with degrees as parts of π, and without sets and numbers of rows."""
    degrees = with_siunitx(said).sub(_DEGREES, lambda m: f"({m['number']}\\pi/180)")
    rows = with_derivatives(degrees.sub(_ROW_OF, lambda _: ""), latex=True)
    return with_derivatives_in_latex(with_open_text(without_sets(rows)))


def _with_own_letters(written: TracedText, lines: Lines) -> TracedText:
    """The answer with deviations from rest stated by themselves, degrees that are added as parts of π, and names for
    primes of constants."""
    model = lines.model
    inputs, fixed = ({key(x.name) for x in some} for some in (model.inputs, model.parameters))
    summed = with_named_sums(written, lambda name: key(name) in fixed, latex=bool(LATEX.search(written.text)))
    apart = with_deviations(summed, _moves(lines), lambda name: key(name) in inputs, lines.names.known)
    apart = apart.sub(_ADDED_DEGREES, lambda m: f"{m['sign']} ({m['number']}*pi/180)")
    return with_primed_constants(apart, lambda name: key(name) in fixed)


def _straight(match: re.Match[str]) -> str:
    """∂²x/∂t² as d²x/dt²."""
    return f"d{match['two'] or ''}{match['of']}/dt{match['twice'] or ''}"
