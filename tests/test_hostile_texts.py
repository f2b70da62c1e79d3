"""Texts of up to 50 000 characters that cost the square or the cube of their length if they are read carelessly.

A regular expression cannot be counted: there, the test is that it ends. Everything else is counted in calls.
"""

from __future__ import annotations

import re
import tracemalloc

import pytest

import built_in
import lagrangian as lg
import size
from effort import at_most
from lagrangian.check.explain import beside_lengths
from lagrangian.check.names import amounts_said
from lagrangian.check.reading import Answer, labels, parse_answer, read
from lagrangian.check.reading.carried_out import rates_said
from lagrangian.check.reading.file_text import decode_answer
from lagrangian.check.reading.latex.macros import written_out
from lagrangian.check.reading.plain.ends import defines_behind
from lagrangian.check.reading.programs import marks, sessions, templates
from lagrangian.check.reading.programs import spellings as programs
from lagrangian.check.reading.prose import sketches, spoken_words
from lagrangian.check.reading.prose import words_or_mathematics as prose
from lagrangian.check.reading.said import stands_for
from lagrangian.errors import ParseError
from lagrangian.quantities.source import Source
from lagrangian.read.robots.markup import MarkupFile

LONGEST = 50_000
N = LONGEST if size.FULL else LONGEST // 5
"""Characters of an answer; the longest are read among the tests that take long."""
BLANK = " " * N
BLANKS = " " * LONGEST
CARTS = built_in.system("lecture-3b").model

ANSWERS = {
    "a macro before blanks": "\\def\\a" + BLANK + "x",
    "a command before blanks": "\\newcommand" + BLANK + "x",
    "blanks behind an equation": "m = 1" + BLANK + "y",
    "letters behind full stops": "x1'' = 0\n" + ("x1'. " + "a" * 76 + "\n") * (N // 82),
    "blanks below a slope": "dT/dx1' = m1 x1'\n" + BLANK + "\nx1'' = 0",
    "blanks behind a letter of a form": "A q'' + h = f\nx" + BLANK + "y\n",
    "newlines": "\n" * N + "y",
    "sentences that take back": "x1'' = 0\n" + "I first had = " * (N // 14),
    "sentences on one line": "Abc def. " * (N // 9) + "\nx1'' = 0",
    "calls that do not end": "x1'' = 0\n"
    + "".join(f"E{i}[q_] := D[q,t]\n" for i in range(60))
    + "E1[E2[E3[" * (N // 12),
    "blanks behind sentences that take back": "x1'' = 0\n" + "(I had first put" * 16 + BLANK + "y",
    "functions that differentiate": "x1'' = 0\n" + "f[q_] := D[f[q]];\n" * (N // 18),
    "blanks in front": BLANK + "y",
    "blanks behind a label": "cart:" + BLANK + "1/2 m1 x1'^2",
    "blanks behind a name": "y" + BLANK + "z = 1",
    "a line below": "x1'' = 0 " + "_" * N + "y",
    "words in brackets": "x1'' = 0 (" + "so" * (N // 2) + ")",
    "a word before blanks": "ad" + BLANK + "y",
    "a side in words": "x1'' = " + "word " * (N // 5) + "= x2r",
    "signs of a side in words": "x1'' = w" + "-" * N + "= x2r",
    "a special case before blanks": "x1'' = 0\nx1 = 0" + BLANK + "z:",
    "items below a heading": "x1'' = 0\nvelocities of the carts:\n" + "- a: b, c\n" * (N // 20),
    "an item below a heading": "x1'' = 0\nvelocities of the carts:\n- a: " + "b(, " * (N // 4),
    "names in a row of words": "x1'' = 0\nthe same here and there, " + "q = x1, " * (N // 8),
    "products of constants": "x1'' = 0\n" + "".join(f"2 q_{k} q_{k + 1} = m1\n" for k in range(400)),
    "a condition before blanks": "x1'' = 0\ncheck: for x1" + BLANK + "= x2r y",
    "functions without a name": "x1'' = 0\n" + "f = @(t,y) [(" * (N // 13),
    "many functions without a name": "x1'' = 0\n" + "f = @(y) y + f(y);\n" * (N // 19),
    "texts in quotes": "x1'' = 0\n" + 'e = "a = b' * (N // 10),
    "lists in quotes": "x1'' = 0\n" + "e = ['" * (N // 6),
    "blanks before a text in quotes": "x1'' = 0\ne =" + BLANK + '"',
    "columns in comments": "A = [1, 0]\n% " + "states " * (N // 7) + "z = [",
    "a model in Modelica": "model A\n Real x(start" + BLANK + "= 1, " * (N // 60) + "\nequation\nx1'' = 0;\nend A;",
    "declarations in Modelica": "model A\n" + "parameter Real a = 1, b\n" * (N // 26) + "equation\nx1'' = 0",
    "conditions of Julia": "using A\nf(t) = " + "t ? " * (N // 4) + "\nx1'' = 0",
    "lists of Julia": "using A\na, b = " + "1, " * (N // 3) + "x\nx1'' = 0",
    "names of what is zero": "".join(f"e{k} = x1'' + e{k + 1} - [e{k}, 0];\n" for k in range(N // 48)),
    "lists of what is zero": "# all zero\n" + "".join(f"r{k} = [r{k + 1}, r{k + 2}];\n" for k in range(N // 24)),
    "blanks in what is zero": "r1 = x1'' - 2\nr2 =" + BLANK + "x1'' + 3\nreturn r1",
    "points between spaces": "x1'' = 0\nQ = m1" + " . dq" * (N // 5),
    "arguments": "x1 = 2 sin(" + "2 sin(" * (N // 6),
    "conditions": "x1'' = 0\n" + "if x1 = 0 " * (N // 10),
    "letters in words": "x1'' = 0\n" + "c statt k, " * (N // 11),
    "words of one letter": "x1'' = 0\n" + "c for a " * (N // 8),
    "rows of tables": "| a | b |\n|---|---|\n" + "| x1 | x2r |\n" * (N // 12),
    "strokes": "|" * N,
    "words behind a force": "x1'' = H\n" + "H to the (" * (N // 10),
    "amounts in a chain": "x1'' = 0\n" + "m1 m2 = " + "1.5 = " * (N // 6) + "2",
    "amounts in lines": "x1'' = 0\n" + "m1*m2 = 1.5*1.5 = 2.25\n" * (N // 23),
    "names with stars": "m* = 1\n" + "m* " * (N // 3),
    "stars behind indices": "m_a" * (N // 3) + "^*",
    "functions of coordinates": "".join(f"I_{k}(x1) = x1\n" for k in range(60)) + "dI_1(x1)/d" * (N // 10),
    "slopes before blanks": "I(x1) = x1^2\n" + ("d/d x1" + " " * 200 + "I") * (N // 200),
    "functions without a body": "f = @(t, z) [z(1)]\n" + "f = @(t, z" * (N // 10),
    "calls of a function": "f = @(z) z(1)\n" + "f(z) " * (N // 10),
    "ends of rows": "function dz = f(t, z)\ndz = [" + "z(1)\n" * (N // 5),
    "values by name in Julia": "function f!(du, u, p, t)\n" + "p = (m=1, " * (N // 10),
    "ends of rows before blanks": "function dz = f(t, z)\ndz = [z(1)" + BLANK + "y",
    "words of rest": "x1'' = 0\n" + "rest for " * (N // 9),
    "products of columns": "C q' = [1; 2]\n" + "C q' + " * (N // 14) + "x1'' = 0",
    "a label before blanks": "\\[ \\theta" + BLANK + ": y = 1 \\]",
    "lines below formulas": "\\[ x1 = 0 " + "\\underline{" * (N // 11) + " \\]",
    "bullets": "- a\n" * (N // 4),
    "fractions of TeX": "\\[ x1 = " + "{a\\over b}" * (N // 12) + " \\]",
    "fractions around each other": "{" * (N // 10) + "a\\over b}" * (N // 10),
    "a rule before blanks": "x1'' = 0\n-- " + BLANK + "y --",
    "rules": "x1'' = 0\n" + "-- y " * (N // 5),
    "a number before blanks": "x1'' = 0 (1)" + BLANK + "y",
    "virtual displacements": "δW = " + "δx" * 1500,
    "functions of programs": "x1'' = 0\nf = lambda q: q + 1\n" + "f(" * (N // 2),
    "functions around each other": "".join(f"f{k} = lambda q: f{k + 1}(q) + f{k + 1}(q)\n" for k in range(40))
    + "f0(1)",
    "a function before blanks": "def f(q):" + "\n   " * (N // 4) + "x1'' = 0",
    "loops": "qs = [x1, x2r]\n" + "for q in qs:\n    diff(q, t)\n" * (N // 26),
    "loops in lists": "e = [" + "diff(q) for q in " * (N // 17),
    "slopes in slopes": "x1'' = 0\n" + "diff(" * (N // 5),
    "over and over": "{1 over 2} dot y\n" + "dot {" * (N // 5) + "%x over {",
    "matrices of the editor": "{1 over 2}" + "matrix{ a # " * (N // 12),
    "comments": "x1 = 1\n" + "# x1'' + x1 = 0\n" * (N // 16),
    "a comment behind blanks": "x1 = 1" + BLANK + "#" * (N // 10) + "x1'' + x1 = 0",
    "returns": "A = [1]\n" + "return   " * (N // 9) + "a.b.c.solve(A, ",
    "signs between words": "x1'' = 0\n" + "mast + arm " * (N // 11) + ". And",
    "signs between words in front of a name": "x1'' = 0\n" + "mast + arm " * (N // 11) + " give J2 = 1",
    "what is left out in words": "x1'' = 0\n" + "without the " * (N // 12) + "force = 1",
    "quotation marks": "x1'' = 0\n" + ('a a a "b = ' * (N // 400) + "\n") * 30,
    "rates of rates": "d/dt " * (N // 5) + "x1'' = 0",
    "labels of slopes": "d/dt ∂T/∂x1" + BLANK + "y: x1'' = 0",
    "letters in drawn lines": "  ─\n" + "a" * N + "\nx1'' = 0",
}


@pytest.mark.sampled(5)
@size.also_in_full
@pytest.mark.parametrize("text", ANSWERS.values(), ids=ANSWERS)
def test_an_answer_is_read_or_refused(text: str) -> None:
    with at_most(min(6_000_000, 250 * N)):
        try:
            parsed = parse_answer(text, CARTS)
        except ParseError as error:
            assert error.place is not None
        else:
            assert isinstance(parsed, Answer)


@pytest.mark.slow
def test_subscripts_cost_as_much_each_at_the_end_as_at_the_start() -> None:
    with at_most(700_000), pytest.raises(ParseError):
        parse_answer(r"\dot x_1" + "a_b+" * 1200, CARTS)


FORMS = {
    "_TRAIL": (labels._TRAIL, "m=1" + BLANKS + "y"),
    "_LABEL": (labels._LABEL, BLANKS + "y"),
    "_AFTER": (labels._AFTER, "x = 1 " + "_" * LONGEST + "y"),
    "_AFTER of a number": (labels._AFTER, "x = 1 (1)" + BLANKS + "y"),
    "_CALLED": (labels._CALLED, "ad" + BLANKS + "y"),
    "_DEFINED at newlines": (read._DEFINED, "\n" * LONGEST + "y"),
    "_DEFINED at blanks": (read._DEFINED, "y" + BLANKS + "y"),
    "_DOUBLED": (spoken_words._DOUBLED, "=" + BLANKS + "II" + BLANKS + "y"),
    "_IN_BRACKETS": (stands_for._IN_BRACKETS, "y" + BLANKS + "z = 1"),
    "_LINE_OF_CODE": (programs._LINE_OF_CODE, BLANKS + "y"),
    "_INSIDE": (prose._INSIDE, "(" + "so" * (LONGEST // 2) + ")"),
    "_INSIDE with blanks": (prose._INSIDE, "(" + "so " * (LONGEST // 3) + ")"),
    "_ENDS": (prose._ENDS, "1" + BLANKS + "+"),
    "_PROMPT": (sessions._PROMPT, "y" + BLANKS + "y"),
    "_DRAWN": (sketches._DRAWN, "w" + "-" * LONGEST),
    "_NUMBER of an amount": (amounts_said._NUMBER, "a" + "1" * LONGEST),
    "_TWICE": (beside_lengths._TWICE, "2" + BLANKS + "y 2" + "y" * LONGEST),
    "_HALF": (beside_lengths._HALF, "y" * LONGEST + BLANKS + r"/3 \frac{y" + BLANKS),
    "_RATED": (rates_said._RATED, "y" * LONGEST + " = " + "y" * LONGEST),
    "_SOLVES": (marks._SOLVES, "solve" + BLANKS + "y\n" + BLANKS),
    "_NUMBER_ALONE": (prose._NUMBER_ALONE, BLANKS + "yy"),
}


@pytest.mark.parametrize(("form", "text"), FORMS.values(), ids=FORMS)
def test_a_form_is_not_found_and_ends(form: re.Pattern[str], text: str) -> None:
    at_the_start = form in (labels._LABEL, labels._CALLED, prose._NUMBER_ALONE)
    assert (form.match(text) if at_the_start else form.search(text)) is None


@pytest.mark.parametrize(
    "text",
    [
        r"\newcommand{\a}[1]{" + "#1" * 2000 + r"}\a{" + "x" * 4000 + "}",
        r"\newcommand{\a}[1]{" + "#1" * 10_000 + "}" + r"\a{}" * 5000,
    ],
    ids=["long", "empty"],
)
def test_macros_that_become_too_long_are_refused_before_they_are_written(text: str) -> None:
    tracemalloc.start()
    try:
        with at_most(200_000), pytest.raises(ParseError) as caught:
            written_out(Source(text, "an answer"))
        most = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert caught.value.code == "E703"
    assert most < 100 * LONGEST  # bytes; the formula would have 8 million characters


def test_a_macro_keeps_its_arguments() -> None:
    text = written_out(Source(r"\newcommand{\a}[2]{#1+#2+#1}\a{x}{y} \def \b #1 {(#1)}\b{z}", "an answer")).text
    assert text.replace(" ", "") == "x+y+x(z)"


@pytest.mark.parametrize(
    ("text", "sure"),
    [
        ("Lösung: für " * 5000, True),
        ("x = 1 " + "für " * 5000, False),
        ("x = 1 " + "für " * 5000 + ": y", True),
        ("Lösung" + BLANKS + "+ 1", False),
    ],
    ids=["sentence", "equation", "label", "operator"],
)
def test_a_long_line_of_windows(text: str, sure: bool) -> None:
    data = text.encode("cp1252")
    with at_most(400_000):
        if sure:
            assert decode_answer(data, "answer.txt") == text
        else:
            with pytest.raises(ParseError):
                decode_answer(data, "answer.txt")


def robot(inside: str) -> str:
    return f"<robot name='r'>{inside}</robot>"


def test_places_in_one_line_share_what_is_shown_of_it() -> None:
    root = MarkupFile(robot("".join(f"<link name='l{i}'/>" for i in range(2000))), "robot.urdf").parse()
    first, last = root.children[0].place, root.children[-1].place
    assert first.line == last.line == 1
    assert first.column != last.column
    assert first.text is last.text


def test_links_are_counted_before_they_are_read() -> None:
    with at_most(60_000), pytest.raises(ParseError, match="at most 1000 are read") as caught:
        lg.loads(robot("\n".join(f"<link name='l{i}'/>" for i in range(3000))))
    assert caught.value.code == "E703"


JOINT = "<joint name='j' type='revolute'><parent link='a'/><child link='b'/><origin rpy='{} 0 0'/></joint>"
BODY = "<mujoco><worldbody><body {}><joint/><geom size='1'/></body></worldbody></mujoco>"


@pytest.mark.parametrize(
    "text",
    [
        robot("<link name='a'/><link name='b'/>" + JOINT.format("1e308")),
        robot("<link name='a'/><link name='b'/>" + JOINT.format("-1e300")),
        BODY.format("euler='1e300 0 0'"),
        BODY.format("axisangle='0 0 1 1e308'"),
    ],
)
def test_an_angle_whose_digits_say_nothing_is_refused(text: str) -> None:
    with pytest.raises(ParseError, match="at most 1000 rad") as caught:
        lg.loads(text)
    assert caught.value.code == "E703"
    assert caught.value.place is not None
    assert caught.value.place.line == 1


def test_half_a_character_is_refused() -> None:
    with pytest.raises(ParseError, match=r"U\+D800 is half of a character") as caught:
        lg.loads("<robot name='\ud800'/>")
    assert caught.value.code == "E702"
    assert caught.value.place is not None
    assert caught.value.place.column == 14


def test_words_far_before_a_point_are_not_looked_for() -> None:
    for far, found in ((1, True), (LONGEST, False)):
        text = "the force acts" + " " * far + "y. s = 1"
        at = text.index(".")
        assert defines_behind(text, 0, (at, at + 1)) is found


def test_calls_that_do_not_end_are_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[int] = []
    closes = templates.closes
    monkeypatch.setattr(templates, "closes", lambda text, at: seen.append(at) or closes(text, at))
    defined = "".join(f"E{i}[q_] := D[q,t]\n" for i in range(60))
    assert list(templates._calls(defined + "".join(f"E{i}[" for i in range(60)) * 60)) == []
    assert len(seen) <= templates.MOST
